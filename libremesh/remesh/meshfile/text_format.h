//! \file
//! Lines of numbers with the fewest digits that read back as the same value. Private to the
//! writers.
#pragma once

#include <charconv>
#include <iterator>
#include <string>

#include "remesh/names.h"

namespace remesh {

//! Appends the number.
template <typename Number>
void append_shortest(std::string& bytes, Number value) {
    char digits[32];  // The longest double takes 24.
    const auto [last, error] = std::to_chars(std::begin(digits), std::end(digits), value);
    bytes.append(digits, last);
}

//! Appends `prefix`, the row's numbers with blanks between them, and a line end.
template <typename Row>
void append_line(std::string& bytes, const char* prefix, const Row& row) {
    bytes += prefix;
    for (const auto value : row) {
        append_shortest(bytes, value);
        bytes += ' ';
    }
    bytes.back() = '\n';
}

}  // namespace remesh
