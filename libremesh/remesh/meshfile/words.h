//! \file
//! Numbers and counts as text, the same in any locale. Private.
#pragma once

#include <iomanip>
#include <locale>
#include <sstream>
#include <string>

#include "remesh/names.h"

namespace remesh::detail {

//! "1 face", "2 faces", "2 vertices", "2 patches".
[[nodiscard]] inline std::string counted(std::size_t count, const std::string& noun) {
    std::string plural = noun + 's';
    if (noun.ends_with("vertex")) plural.replace(plural.size() - 3, 3, "ices");
    if (noun.ends_with("ch")) plural.insert(plural.size() - 1, 1, 'e');
    return std::to_string(count) + ' ' + (count == 1 ? noun : plural);
}

//! printf's %.*f, without a locale's comma.
[[nodiscard]] inline std::string fixed(double value, int digits) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << std::fixed << std::setprecision(digits) << value;
    return out.str();
}

//! printf's %.4g, without a locale's comma.
[[nodiscard]] inline std::string significant(double value) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << std::setprecision(4) << value;
    return out.str();
}

}  // namespace remesh::detail
