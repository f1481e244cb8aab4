//! \file
//! Shared by the benchmarks: common options, and results as a table and as JSON.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
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
    std::filesystem::path json;  //!< Empty: no file.
};

//! Adds the options above; the lists start with the values that `options` has.
void add_options(CLI::App& app, Options& options);

//! A column of the table: a key of the rows, its heading, and how many digits to print; below 0:
//! that many behind the point, in scientific notation.
struct Column {
    std::string key;
    std::string heading;
    int digits = 0;
    int width = 11;
};

//! Prints a heading or one row, right-aligned; a key that is missing or null as "-".
void print_heading(const std::vector<Column>& columns);
void print_row(const std::vector<Column>& columns, const nlohmann::ordered_json& row);

//! The rows as a Markdown table.
[[nodiscard]] std::string markdown(const std::vector<Column>& columns,
                                   const nlohmann::ordered_json& rows);

//! Writes {"benchmark", "commit", "rows"} to the file; of options: options.json, if
//! given.
void write_json(const Options& options, const std::string& benchmark,
                const nlohmann::ordered_json& rows);
void write_json(const std::filesystem::path& path, const std::string& benchmark,
                const nlohmann::ordered_json& rows);

}  // namespace bench
