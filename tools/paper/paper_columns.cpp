#include "paper/paper_columns.h"

#include <algorithm>

namespace bench::paper {
namespace {

using Json = nlohmann::ordered_json;

bool is_same_case(const Json& a, const Json& b, const std::vector<Column>& same) {
    return std::all_of(same.begin(), same.end(),
                       [&](const Column& column) { return a[column.key] == b[column.key]; });
}

}  // namespace

std::vector<Column> case_columns() {
    return {{"mesh", "mesh", 0, 24},
            {"faces", "faces", 0, 8},
            {"sites", "t", 0, 5},
            {"method", "method", 0, 21}};
}

std::vector<Column> cost_columns() {
    return {{"total_p0", "all, P0", 1, 8},
            {"propagate_p0", "distances", 1, 9},
            {"diagram_p0", "diagram", 1, 8},
            {"peak_mb", "MB", 1, 8},
            {"bytes_per_face", "B/face", 0, 6}};
}

std::vector<Column> ratio_columns() {
    return {{"time_over_exact", "time/exact", 2, 10}, {"memory_over_exact", "MB/exact", 2, 8}};
}

std::vector<Column> error_columns() {
    return {{"delta_percent", "delta %", 3, 8},      {"frechet_radii", "F/radius", 3, 9},
            {"hausdorff_radii", "Hausdorff", 4, 9},  {"wrong_percent", "wrong %", 3, 8},
            {"mean_bisector_error", "dA-dB", -1, 8}, {"p95_bisector_error", "95 %", -1, 8},
            {"max_bisector_error", "largest", -1, 8}};
}

std::vector<Column> label_columns() {
    return {{"wrong_label_percent", "labels %", 3, 8}, {"largest_label_error", "farther", -1, 8}};
}

std::vector<Column> code_columns() { return {{"largest_difference", "differs", -1, 8}}; }

std::vector<Column> join(std::initializer_list<std::vector<Column>> parts) {
    std::vector<Column> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

void add_ratios(std::span<Json> rows) {
    const auto exact = std::find_if(
        rows.begin(), rows.end(), [](const Json& row) { return row["method"] == "window exact"; });
    const double time = (*exact)["total_p0"], memory = (*exact)["peak_mb"];
    for (Json& row : rows) {
        row["time_over_exact"] = row["total_p0"].get<double>() / time;
        row["memory_over_exact"] = row["peak_mb"].get<double>() / memory;
    }
}

std::string methods_side_by_side(const std::vector<Column>& same, const std::vector<Column>& by,
                                 const Json& rows) {
    std::vector<Column> columns = same;
    for (const Column& column : by) {
        for (const Json& row : rows) {
            const std::string method = row["method"];
            const Column wide{column.key + ' ' + method, method + ", " + column.heading,
                              column.digits};
            const bool is_there =
                std::any_of(columns.begin(), columns.end(),
                            [&](const Column& other) { return other.key == wide.key; });
            const bool says_something = row.contains(column.key) && row[column.key] != 0;
            if (!is_there && says_something) columns.push_back(wide);
        }
    }
    Json cases = Json::array();
    for (const Json& row : rows) {
        if (cases.empty() || !is_same_case(cases.back(), row, same)) cases.push_back(row);
        for (const Column& column : by) {
            if (!row.contains(column.key)) continue;
            cases.back()[column.key + ' ' + row["method"].get<std::string>()] = row[column.key];
        }
    }
    return markdown(columns, cases);
}

}  // namespace bench::paper
