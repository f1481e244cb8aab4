//! \file
//! Line charts as SVG, for the documentation.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bench {

struct Series {
    std::string name;
    std::vector<std::pair<double, double>> points;  //!< From left to right.
};

struct Plot {
    std::string title;
    std::string x_label;
    std::string y_label;
    bool is_log_x = false;  //!< Then all x are > 0; likewise for y.
    bool is_log_y = false;
    std::vector<Series> series = {};
    bool is_y_from_zero = true;  //!< Without is_log_y; false: from the lowest value.
};

//! The plots side by side; a series of one point is drawn as a level line. Points that are not
//! finite, or not above 0 on a logarithmic axis, are left out.
[[nodiscard]] std::string to_svg(std::span<const Plot> plots);

}  // namespace bench
