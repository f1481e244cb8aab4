// Compressed files, for a build without zlib: they are refused.

#include "remesh/meshfile/packed.h"

namespace remesh {

bool knows_gzip() { return false; }

void unpack_gzip(SourceFile& file) {
    file.fail_malformed(0,
                        "the file is compressed, and this program was built without zlib; unpack "
                        "it with gunzip first");
}

std::string pack_gzip(const std::string&, Ticker) {
    throw IoError("this program was built without zlib; write without .gz and run gzip");
}

bool append_unpacked(std::string_view, DeflatedIn, std::uint64_t, Ticker&, std::string&) {
    return false;
}

std::string pack_for_zip(const std::string&, Ticker&) {
    throw IoError("this program was built without zlib, which .3mf needs; write .ply");
}

std::uint32_t crc32_of(std::string_view) { return 0; }

}  // namespace remesh
