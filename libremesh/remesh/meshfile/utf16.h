//! \file
//! Texts in UTF-16, as some programs and shells write them. Private to the readers.
#pragma once

#include <bit>
#include <optional>
#include <string>
#include <string_view>

#include "agvd/core/progress.h"
#include "remesh/names.h"

namespace remesh {

//! The byte order of a text in UTF-16 with a byte order mark; nothing if the bytes are something
//! else.
[[nodiscard]] std::optional<std::endian> utf16_order(std::string_view bytes);

//! The text in UTF-8, without its mark. Half a pair of surrogates becomes '?'.
//! \throw Cancelled
[[nodiscard]] std::string utf8_of_utf16(std::string_view bytes, std::endian order, Ticker ticker);

}  // namespace remesh
