//! \file
//! Bytes that a file holds as they are or as base64. Private to the readers
//! and writers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "agvd/core/progress.h"
#include "remesh/names.h"

namespace remesh {

//! Gives bytes from the front of a text. Pieces of base64 may follow each other, each filled up by
//! '='; blanks between the digits do not count.
class ByteSource {
public:
    //! \param text  outlives this.
    ByteSource(std::string_view text, bool is_base64) : left_(text), is_base64_(is_base64) {}

    //! The next bytes: a part of the text, or of `buffer` where they were decoded to.
    //! \return nothing: the text ends before, or is no base64. Memory follows the bytes that are
    //!         there.
    //! \throw Cancelled
    [[nodiscard]] std::optional<std::string_view> take(std::uint64_t count, std::string& buffer,
                                                       Ticker& ticker);

    //! Whether only blanks are left.
    [[nodiscard]] bool is_at_end();

private:
    [[nodiscard]] bool decode_group();
    void skip_blanks();

    std::string_view left_;
    bool is_base64_;
    std::string group_;  // Decoded, and not taken yet: below three bytes.
};

//! The bytes as base64.
//! \throw Cancelled
[[nodiscard]] std::string in_base64(std::string_view bytes, Ticker& ticker);

}  // namespace remesh
