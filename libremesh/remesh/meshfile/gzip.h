//! \file
//! Files compressed with gzip. Private to the readers and writers. Without zlib
//! (AGVD_WITH_ZLIB=OFF) they are refused.
#pragma once

#include <string>
#include <string_view>

#include "remesh/meshfile/source_file.h"

namespace remesh {

//! Whether this build reads and writes gzip.
[[nodiscard]] bool knows_gzip();

//! Whether the bytes begin as gzip does.
[[nodiscard]] inline bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

//! Unpacks the bytes of the file, all members one after the other. Memory follows what has been
//! unpacked, in steps of some megabytes, and the ticker polls between them: a small file of a huge
//! content is stopped by the progress callback.
//! \throw IoError  damaged, truncated, or this build has no zlib.  \throw Cancelled
void unpack_gzip(SourceFile& file);

//! Packs the bytes; the same bytes for the same version of zlib.
//! \throw Cancelled
[[nodiscard]] std::string pack_gzip(const std::string& bytes, Ticker ticker);

}  // namespace remesh
