//! \file
//! Numbers as text, the same in any locale. Private.
#pragma once

#include <charconv>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>

#include "agvd/core/number_text.h"
#include "remesh/names.h"

namespace remesh {

namespace detail {

//! "1 face", "2 faces", "2 vertices", "2 patches".
[[nodiscard]] inline std::string counted(std::size_t count, const std::string& noun) {
    std::string plural = noun + 's';
    if (noun.ends_with("vertex")) plural.replace(plural.size() - 3, 3, "ices");
    if (noun.ends_with("ch")) plural.insert(plural.size() - 1, 1, 'e');
    return std::to_string(count) + ' ' + (count == 1 ? noun : plural);
}

//! printf's %.*f.
[[nodiscard]] inline std::string fixed(double value, int digits) {
    return number_text(value, digits, std::chars_format::fixed);
}

//! printf's %.4g.
[[nodiscard]] inline std::string significant(double value) { return number_text(value, 4); }

}  // namespace detail

//! Texts and numbers, one behind the other. They are taken by value: a reader's counter whose
//! address is taken would not stay in a register.
template <typename... Parts>
[[nodiscard]] std::string joined(Parts... parts) {
    std::string text;
    const auto append = [&]<typename Part>(const Part& part) {
        if constexpr (std::is_arithmetic_v<Part>) {
            text += std::to_string(part);
        } else {
            text += part;
        }
    };
    (append(parts), ...);
    return text;
}

//! Appends the number with the fewest digits that read back as the same value.
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

//! Appends a blank and the numbers of a row to the last line.
template <typename Row>
void append_to_line(std::string& bytes, const Row& row) {
    bytes.pop_back();
    append_line(bytes, " ", row);
}

}  // namespace remesh
