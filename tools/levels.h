//! \file
//! Option of `remesh` for levels of detail: several results of one input, from fine to coarse.
#pragma once

#include <filesystem>
#include <vector>

#include "arguments.h"
#include "remesh/pipeline/remesh.h"
#include "sizing_arguments.h"

namespace cli {

struct LevelArguments {
    int count = 1;                //!< 1: no levels are asked for, and OUT is the only result.
    std::vector<Amount> samples;  //!< One for each level; empty: each has a quarter of the last.
};

//! Adds --levels, after --sites.
void add_level_option(CLI::App& app, LevelArguments& arguments);

//! \throw agvd::InvalidOption  the levels and other options both say how fine the results are.
void check_levels(const LevelArguments& arguments, const SizingArguments& sizing);

//! The file of each level: `path` with -0, -1, ... before its extension; `path` itself without
//! levels. An empty path stays empty.
//! \throw agvd::InvalidOption  it is a standard stream, which holds one mesh only.
[[nodiscard]] std::vector<std::filesystem::path> level_paths(const LevelArguments& arguments,
                                                             const std::filesystem::path& path);

//! The options of a level: a quarter of the vertices for each level before it, and so twice the
//! lengths and four times the distance; or the number that is given for it.
//! \param options       of level 0.
//! \param num_vertices  of which percentages are taken.
[[nodiscard]] remesh::RemeshOptions options_of_level(const LevelArguments& arguments,
                                                     std::size_t level,
                                                     remesh::RemeshOptions options,
                                                     std::size_t num_vertices);

}  // namespace cli
