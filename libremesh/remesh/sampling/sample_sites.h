//! \file
//! First sites on the surface.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace remesh {

enum class Init {
    Random,     //!< Area-uniform, independent (the paper's choice).
    BlueNoise,  //!< Area-uniform with large mutual distances, by sample elimination.
    Farthest,   //!< Each as far from those before it as can be: no gap, and never very close.
};

//! As on the command line: "blue-noise".
[[nodiscard]] const char* init_name(Init init);

enum class Boundary {
    Keep,  //!< Sites that the boundary belongs to lie on it.
    Free,  //!< Sites are placed as if there were none.
};

struct SamplingOptions {
    agvd::Index num_samples = 2000;  //!< >= 1.
    Init init = Init::BlueNoise;
    Boundary boundary = Boundary::Keep;  //!< Random sites know no boundary.
    std::uint64_t seed = 1;              //!< Same seed, same bytes, any num_threads.
    int num_threads = 0;                 //!< >= 0; 0: all cores.
    agvd::Progress progress = {};
};

//! Exactly num_samples points, no two at one position, component by component (by lowest face).
//! Every connected component first gets what its topology needs (minimum_samples), the rest goes by
//! area (and by length of boundary, where sites lie on it). Points lie strictly inside faces, but
//! for those of Boundary::Keep, which come first: corners (find_corners), and points at equal
//! distances between them. Blue noise is taken from five times as many area-uniform points by
//! weighted sample elimination ([yuksel2015]); points on opposite walls of a thin part do not repel
//! each other. Farthest points are told by distances along the surface, along edges and across them
//! ([eldar1997], [moenning2003]): those on the boundary, or else a random one, come first. They
//! leave the smallest gaps of the three.
//!
//! \throw agvd::InvalidOption    num_samples < 1 or > 8e8, or num_threads < 0.
//! \throw agvd::InvalidInput     the surface has no face.
//! \throw agvd::ConstraintUnmet  num_samples is below the sum of minimum_samples over the
//!        components (the text gives that sum), or a component is too small, compared with its
//!        coordinates, to hold its share of different points.
//! \throw agvd::Cancelled        the progress callback returned false.
//! Cost: O(#F + N log N); farthest points O((#F + N) log(#F + N) log N), a few seconds for 20 000
//! on 100 000 faces.
[[nodiscard]] std::vector<agvd::SurfacePoint> sample_sites(const agvd::Surface& surface,
                                                           const SamplingOptions& options = {});

//! Sites strictly inside the faces of a surface whose boundary has its sites already.
//!
//! \param rim      sites on the boundary: inner ones keep off them.
//! \param count    of inner sites; they are shared out by what components lack at this spacing.
//! \param spacing  > 0, mesh units: of all sites.
//! \param options  num_samples and boundary do not count.
//! \throw as sample_sites.
[[nodiscard]] std::vector<agvd::SurfacePoint> sample_inner_sites(
    const agvd::Surface& surface, std::span<const agvd::SurfacePoint> rim, agvd::Index count,
    double spacing, const SamplingOptions& options);

}  // namespace remesh
