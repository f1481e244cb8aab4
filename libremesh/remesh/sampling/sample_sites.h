//! \file
//! First sites on the surface.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace remesh {

enum class Init {
    Random,     //!< Area-uniform, independent (the paper's choice).
    BlueNoise,  //!< Area-uniform with large mutual distances, by sample elimination.
};

struct SamplingOptions {
    agvd::Index num_samples = 2000;  //!< >= 1.
    Init init = Init::BlueNoise;
    std::uint64_t seed = 1;  //!< Same seed, same bytes, any num_threads.
    int num_threads = 0;     //!< >= 0; 0: all cores.
    agvd::Progress progress = {};
};

//! Exactly num_samples points in face interiors, no two at one position. Every connected component
//! first gets what its topology needs (minimum_samples), the rest goes by area.
//!
//! \throw agvd::InvalidOption    num_samples < 1.
//! \throw agvd::ConstraintUnmet  num_samples is below the sum of minimum_samples over the components;
//!        the text gives that sum.
//! Cost: O(N log N).
[[nodiscard]] std::vector<agvd::SurfacePoint> sample_sites(const agvd::Surface& surface,
                                                           const SamplingOptions& options = {});

//! Fewest vertices that any simplicial surface of this genus and number of boundary loops has
//! (Heawood's bound; [jungerman1980]): 4 for the sphere, 7 for the torus, 3 for the disc.
[[nodiscard]] agvd::Index minimum_samples(int genus, int boundary_loops);

}  // namespace remesh
