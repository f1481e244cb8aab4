//! \file
//! Numbers in texts for people, the same in any locale.
#pragma once

#include <charconv>
#include <iterator>
#include <string>

namespace agvd {

//! The number as printf's %.*g writes it, or %.*f and %.*e for the other forms.
//! \param digits  at most 20.
[[nodiscard]] inline std::string number_text(double value, int digits = 6,
                                             std::chars_format form = std::chars_format::general) {
    char text[360];  // Fixed, the largest double has 309 digits before the point.
    const auto [end, error] = std::to_chars(text, std::end(text), value, form, digits);
    return {text, end};
}

}  // namespace agvd
