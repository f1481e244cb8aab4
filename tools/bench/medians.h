//! \file
//! Rows over all meshes.
#pragma once

#include <nlohmann/json.hpp>

namespace bench {

//! One row for each (sites, method, threads) that occurs on several meshes, in the order of their
//! first: of every number the median over the meshes that have it, as mesh "median".
[[nodiscard]] nlohmann::ordered_json medians(const nlohmann::ordered_json& rows);

}  // namespace bench
