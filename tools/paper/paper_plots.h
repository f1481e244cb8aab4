//! \file
//! The figures of the paper's evaluation, drawn from the rows of a section.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/plot.h"

namespace bench {

//! Time and memory over the number of sites, of the mesh that comes last.
[[nodiscard]] std::vector<Plot> plots_over_sites(const nlohmann::ordered_json& rows);

//! Time and errors over the Steiner points per edge.
[[nodiscard]] std::vector<Plot> plots_over_points(const nlohmann::ordered_json& rows);

//! Time and memory over lambda.
[[nodiscard]] std::vector<Plot> plots_over_lambda(const nlohmann::ordered_json& rows);

//! Error of two methods over the mean Lo, a line for each number of faces.
[[nodiscard]] std::vector<Plot> plots_over_quality(const nlohmann::ordered_json& rows);

}  // namespace bench
