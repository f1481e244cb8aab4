#include "remesh/tilefiles/mapped_file.h"

#include <system_error>

#include "agvd/core/error.h"
#include "remesh/meshfile/text.h"

namespace remesh {

MappedFile::MappedFile(const std::filesystem::path& path) {
    const int reason = map(path);
    if (data_ != nullptr) return;
    throw IoError(joined(
        path.string(), ": cannot be read: ",
        reason != 0 ? std::generic_category().message(reason) : "it is empty, or no regular file",
        "; name a binary PLY or STL file"));
}

}  // namespace remesh
