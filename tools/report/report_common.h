//! \file
//! Parts shared by the reports as JSON and as text.
#pragma once

#include <array>
#include <numbers>
#include <numeric>

#include "remesh/pipeline/remesh.h"

namespace remesh::detail {

inline constexpr double degrees = 180 / std::numbers::pi;  //!< Per radian.

[[nodiscard]] inline double total_seconds(const RemeshResult& result) {
    return std::accumulate(result.seconds.begin(), result.seconds.end(), 0.0,
                           [](double sum, const auto& stage) { return sum + stage.second; });
}

//! A count of a repair, and its names.
struct RepairRow {
    Index CleanCounts::*count;
    const char* key;
    const char* what;  //!< Singular.
};

inline constexpr std::array repair_rows = {
    RepairRow{&CleanCounts::divided_edges, "divided_edges", "divided boundary edge"},
    RepairRow{&CleanCounts::welded_vertices, "welded_vertices", "welded vertex"},
    RepairRow{&CleanCounts::degenerate_faces, "degenerate_faces", "degenerate face"},
    RepairRow{&CleanCounts::absorbed_faces, "absorbed_faces", "absorbed face without area"},
    RepairRow{&CleanCounts::duplicate_faces, "duplicate_faces", "duplicate face"},
    RepairRow{&CleanCounts::touching_faces, "touching_faces", "touching face"},
    RepairRow{&CleanCounts::flipped_faces, "flipped_faces", "flipped face"},
    RepairRow{&CleanCounts::split_edges, "split_edges", "split edge"},
    RepairRow{&CleanCounts::split_vertices, "split_vertices", "split vertex"},
    RepairRow{&CleanCounts::filled_holes, "filled_holes", "filled hole"},
    RepairRow{&CleanCounts::isolated_vertices, "isolated_vertices", "isolated vertex"},
};
static_assert(sizeof(CleanCounts) == repair_rows.size() * sizeof(Index), "every count is reported");

}  // namespace remesh::detail
