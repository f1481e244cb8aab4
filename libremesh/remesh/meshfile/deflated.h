//! \file
//! Deflated data inside of files of other formats. Private to the readers and writers. Ask
//! knows_gzip() before: without zlib (AGVD_WITH_ZLIB=OFF) nothing can be unpacked or packed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "agvd/core/progress.h"
#include "remesh/names.h"

namespace remesh {

//! What surrounds deflated data: nothing, as in a ZIP file, or zlib's header and checksum.
enum class DeflatedIn { Zip, Zlib };

//! Appends what `packed` unpacks to. Memory follows what has been unpacked, in steps of some
//! megabytes, and the ticker polls between them, whatever the announced size.
//! \param size  of what comes out.
//! \return false: the data are damaged, or come to another size. Then `bytes` ends anywhere.
//! \throw Cancelled
[[nodiscard]] bool append_unpacked(std::string_view packed, DeflatedIn kind, std::uint64_t size,
                                   Ticker& ticker, std::string& bytes);

//! The bytes, deflated as in a ZIP file; the same bytes for the same version of zlib.
//! \throw Cancelled  \throw IoError  this build has no zlib.
[[nodiscard]] std::string pack_for_zip(const std::string& bytes, Ticker& ticker);

//! The checksum CRC-32 of ZIP files.
[[nodiscard]] std::uint32_t crc32_of(std::string_view bytes);

}  // namespace remesh
