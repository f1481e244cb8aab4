// The reader of 3MF. Bytes that begin with "PK" are the whole file. Checksums would refuse nearly
// all changes of such a file, so other bytes are the model part of a package.
#include "check_reader.h"
#include "remesh/meshfile/packed.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string bytes(reinterpret_cast<const char*>(data), size);
    if (!bytes.starts_with("PK")) {
        agvd::Ticker ticker;
        bytes = remesh::pack_zip(
            {{"_rels/.rels",
              "<R><Relationship Target='/a.model' "
              "Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel'/></R>"},
             {"a.model", bytes}},
            ticker);
    }
    return fuzz::check_reader(".3mf", reinterpret_cast<const std::uint8_t*>(bytes.data()),
                              bytes.size());
}
