#include "paper/paper_plots.h"

#include <algorithm>
#include <functional>

namespace bench {
namespace {

using Json = nlohmann::ordered_json;

// One series of y over x for each method, of the rows that `wanted` lets through.
std::vector<Series> series(const Json& rows, const std::string& x, const std::string& y,
                           const std::function<std::string(const Json&)>& name_of) {
    std::vector<Series> all;
    for (const Json& row : rows) {
        const std::string name = name_of(row);
        if (name.empty() || !row.contains(y) || !row[y].is_number()) continue;
        auto found =
            std::find_if(all.begin(), all.end(), [&](const Series& s) { return s.name == name; });
        if (found == all.end()) found = all.insert(all.end(), {name, {}});
        const double at = row.contains(x) ? row[x].get<double>() : 0;
        found->points.emplace_back(at, row[y].get<double>());
    }
    return all;
}

std::string method_of(const Json& row) { return row["method"]; }

// One name for all of the Steiner engine, whose points are told by x.
std::string engine_of(const Json& row) {
    return row.contains("steiner_points") ? "steiner" : method_of(row);
}

}  // namespace

std::vector<Plot> plots_over_sites(const Json& rows) {
    const auto largest = [&](const Json& row) {
        return row["mesh"] == rows.back()["mesh"] ? method_of(row) : "";
    };
    return {{"Time", "sites", "all, P0", true, true, series(rows, "sites", "total_p0", largest)},
            {"Memory", "sites", "MB beyond the mesh", true, true,
             series(rows, "sites", "peak_mb", largest)}};
}

std::vector<Plot> plots_over_points(const Json& rows) {
    const auto plot = [&](const char* title, const char* label, const char* key) {
        return Plot{title, "Steiner points per edge",
                    label, false,
                    true,  series(rows, "steiner_points", key, engine_of)};
    };
    return {plot("Time", "all, P0", "total_p0"), plot("Error of Eq. 9", "%", "delta_percent"),
            plot("Area in wrong cells", "%", "wrong_percent")};
}

std::vector<Plot> plots_over_lambda(const Json& rows) {
    const auto plot = [&](const char* title, const char* label, const char* key) {
        return Plot{title, "lambda", label, true, false, series(rows, "lambda", key, engine_of)};
    };
    return {plot("Time", "all, P0", "total_p0"), plot("Memory", "MB beyond the mesh", "peak_mb")};
}

std::vector<Plot> plots_over_quality(const Json& rows) {
    const auto at = [](const char* method) {
        return [=](const Json& row) {
            return row["method"] == method ? std::to_string(row["faces"].get<int>()) + " faces"
                                           : std::string();
        };
    };
    const auto plot = [&](const char* method) {
        return Plot{method, "mean Lo", "delta, %",
                    false,  true,      series(rows, "mean_lo", "delta_percent", at(method))};
    };
    return {plot("steiner m=8"), plot("steiner m=8 base"), plot("window 0.001")};
}

}  // namespace bench
