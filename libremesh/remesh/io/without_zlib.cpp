// Compressed files, for a build without zlib: they are refused.
#include "agvd/core/error.h"
#include "remesh/io/gzip.h"

namespace remesh {

bool knows_gzip() { return false; }

void unpack_gzip(SourceFile& file) {
    file.fail_malformed(0,
                        "the file is compressed, and this program was built without zlib; unpack "
                        "it with gunzip first");
}

std::string pack_gzip(const std::string&, agvd::Ticker) {
    throw agvd::IoError("this program was built without zlib; write without .gz and run gzip");
}

}  // namespace remesh
