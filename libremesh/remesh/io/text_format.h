//! \file
//! Lines of numbers with the fewest digits that read back as the same value. Private to the
//! writers.
#pragma once

#include <charconv>
#include <string>

namespace remesh {

//! Appends `prefix`, the row's numbers with blanks between them, and a line end.
template <typename Row>
void append_line(std::string& bytes, const char* prefix, const Row& row) {
    bytes += prefix;
    for (const auto value : row) {
        char digits[32];  // The longest double takes 24.
        const auto [last, error] = std::to_chars(std::begin(digits), std::end(digits), value);
        bytes.append(digits, last);
        bytes += ' ';
    }
    bytes.back() = '\n';
}

}  // namespace remesh
