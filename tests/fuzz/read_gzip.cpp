// Unpacking of gzip: what was unpacked comes back, packed anew. Input that unpacks to more than a
// few megabytes is stopped as a memory limit does it.
#include "agvd/core/error.h"
#include "remesh/meshfile/packed.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    int num_polls = 0;
    const agvd::Progress few = [&](double) { return ++num_polls < 8; };
    agvd::Poller poller(few);
    remesh::SourceFile file{.path = "fuzzed.gz",
                            .bytes = std::string(reinterpret_cast<const char*>(data), size),
                            .ticker = agvd::Ticker(poller)};
    if (!remesh::is_gzip(file.bytes)) return 0;
    try {
        remesh::unpack_gzip(file);
    } catch (const agvd::IoError&) {
        return 0;
    } catch (const agvd::Cancelled&) {
        return 0;
    }
    remesh::SourceFile again{.path = "again.gz", .bytes = remesh::pack_gzip(file.bytes, {})};
    remesh::unpack_gzip(again);
    fuzz::require(again.bytes == file.bytes, "what was packed comes back");
    return 0;
}
