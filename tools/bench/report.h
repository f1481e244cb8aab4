//! \file
//! What the benchmarks share: their common options, timing, and results as a table and as JSON.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/workload.h"

namespace bench {

struct Options {
    std::vector<std::filesystem::path> meshes;
    std::vector<agvd::Index> sites;
    std::vector<int> steiner_points;
    Place place = Place::Vertices;
    std::uint64_t seed = 1;
    int threads = 0;             //!< 0: all cores.
    std::filesystem::path json;  //!< Empty: no file.
};

//! Adds the options above; the lists start with the values that `options` has.
void add_options(CLI::App& app, Options& options);

//! Seconds of the wall clock, and of all cores together: the latter stays fair on a busy machine.
struct Seconds {
    double wall = 0;
    double cpu = 0;
};
[[nodiscard]] Seconds time(const std::function<void()>& job);

//! Median, and largest minus smallest over the median.
struct Spread {
    double median;
    double spread;
};
[[nodiscard]] Spread spread_of(std::vector<double> values);

//! A column of the table: a key of the rows, its heading, and how many digits to print.
struct Column {
    std::string key;
    std::string heading;
    int digits;
};

//! Prints a heading or one row, numbers right-aligned.
void print_heading(const std::vector<Column>& columns);
void print_row(const std::vector<Column>& columns, const nlohmann::ordered_json& row);

//! Writes {"benchmark", "commit", "rows"} to options.json, if given.
void write_json(const Options& options, const std::string& benchmark,
                const nlohmann::ordered_json& rows);

}  // namespace bench
