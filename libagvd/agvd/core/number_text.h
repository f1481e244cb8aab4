//! \file
//! Numbers in texts for people, the same in any locale.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>

#include "agvd/core/types.h"

namespace agvd {

//! The number as printf's %.*g writes it, or %.*f and %.*e for the other forms.
//! \param digits  at most 20.
[[nodiscard]] inline std::string number_text(double value, int digits = 6,
                                             std::chars_format form = std::chars_format::general) {
    char text[360];  // Fixed, the largest double has 309 digits before the point.
    const auto [end, error] = std::to_chars(text, std::end(text), value, form, digits);
    return {text, end};
}

//! An index that a caller gave; one that was negative there is told so.
[[nodiscard]] inline std::string index_text(Index index) {
    return std::to_string(static_cast<std::int32_t>(index));
}

//! Coordinates with the digits that tell a place in a mesh of this size, however far from the
//! origin.
[[nodiscard]] inline std::string place_text(const Vec3& at, double size) {
    constexpr double per_bit = 0.30103;  // Digits.
    const double far = at.cwiseAbs().maxCoeff() / size;
    const double more = far > 1 ? 1 + per_bit * std::ilogb(far) : 0;
    const int digits = 4 + static_cast<int>(std::min(12.0, more));
    return number_text(at.x(), digits) + ' ' + number_text(at.y(), digits) + ' ' +
           number_text(at.z(), digits);
}

}  // namespace agvd
