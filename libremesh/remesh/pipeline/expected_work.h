//! \file
//! How the time of a run is expected to be spread over its stages, for a progress bar of the whole.
#pragma once

#include <utility>
#include <vector>

#include "remesh/pipeline/remesh.h"

namespace remesh {

//! For each stage, in their order, the time that it is expected to take in a run without repeats,
//! in a unit that depends on the machine. Repair, creases that give way and lengths asked for can
//! make stages run again.
//!
//! \param num_faces    of the input.
//! \param num_samples  a guess where options.sizing decides it.
[[nodiscard]] std::vector<std::pair<Stage, double>> expected_work(std::size_t num_faces,
                                                                  std::size_t num_samples,
                                                                  const RemeshOptions& options);

}  // namespace remesh
