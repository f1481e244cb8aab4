//! \file
//! What the programs expect of a run: its stages, for the bar of the whole run, and its memory.
//! Figures are times as remesh::expected_work has them.
#pragma once

#include <filesystem>
#include <vector>

#include "overall_progress.h"
#include "remesh/pipeline/expected_work.h"

namespace cli {

//! Before the input is read: only the size of the file is known.
//! \param num_samples  the number that is asked for, or a guess.
[[nodiscard]] std::vector<ExpectedStage> stages_with_reading(const std::filesystem::path& input,
                                                             std::size_t num_samples);

//! Of a run of remesh, once the input is read.
//! \param num_faces    of the input.
//! \param num_samples  0: not known.
//! \param has_map      whether the result is mapped to the input.
[[nodiscard]] std::vector<ExpectedStage> stages_of_remesh(std::size_t num_faces,
                                                          std::size_t num_samples, bool has_map,
                                                          const remesh::RemeshOptions& options);

//! Whether it is known how many runs remesh() needs.
[[nodiscard]] Runs runs_of_remesh(const remesh::RemeshOptions& options);

//! Of `agvd diagram`, once the input is read.
[[nodiscard]] std::vector<ExpectedStage> stages_of_diagram(std::size_t num_faces,
                                                           std::size_t num_sites);

//! Of `agvd path`, `agvd isolines` and `agvd distance`, once the input is read.
//! \param query  the name of the stage behind propagation.
[[nodiscard]] std::vector<ExpectedStage> stages_of_query(std::size_t num_faces, const char* query);

//! Of `agvd compare`.
[[nodiscard]] std::vector<ExpectedStage> stages_of_comparison(bool is_exact);

//! About how many samples a run places, before the surface is known well. Curvature does not
//! count: with a distance it is the least number.
//! Cost: O(#F).
[[nodiscard]] std::size_t estimated_samples(const remesh::RemeshOptions& options,
                                            const agvd::MeshView& mesh);

//! Bytes that a run of remesh needs at least: those of a tile in work, and of the result. Meshes of
//! 1 000 to 100 000 faces took 4000 to 7000 bytes a sample of a tile beyond 300 a face.
[[nodiscard]] std::size_t least_memory(std::size_t num_faces, std::size_t num_samples);

}  // namespace cli
