//! \file
//! Initial sites on the surface: as many as asked for, no two at one position, and every component
//! gets its share.
//! Held by SampleSites.GivesTheExactCountOfDifferentPointsInsideFaces and the other tests of
//! SampleSites in tests/remesh/sites.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh {

class SizeField;

//! How the first sites are sampled.
enum class Init {
    Random,     //!< Area-uniform, independent (the paper's choice).
    BlueNoise,  //!< Area-uniform with large mutual distances, by sample elimination.
    Farthest,   //!< Each as far as possible from those before it: no large gaps, no close pairs.
};

//! As on the command line: "blue-noise".
[[nodiscard]] const char* init_name(Init init);

//! What sites have to do with the boundary.
enum class Boundary {
    Keep,  //!< Sites whose cells meet the boundary lie on it.
    Free,  //!< Sites are placed as if there were no boundary.
};

//! `{}` gives the defaults.
struct SamplingOptions {
    Index num_samples = 2000;            //!< >= 1.
    Init init = Init::BlueNoise;         //!< How sites are sampled.
    Boundary boundary = Boundary::Keep;  //!< Ignored by Init::Random.
    std::uint64_t seed = 1;              //!< Same seed, same bytes, any num_threads.
    int num_threads = 0;                 //!< >= 0; 0: all cores.
    Progress progress = {};              //!< Polled during the call; see poll.
    //! Target lengths on the surface: areas, lengths and distances count in local lengths. Outlives
    //! the call; null: all are equal.
    const SizeField* sizes = nullptr;
};

//! Places exactly num_samples points, no two at one position, component by component (by lowest
//! face). Every connected component first gets what its topology needs (minimum_samples); the rest
//! is shared by area, and by length of boundary if sites lie on it. Of several components small
//! ones get up to four times what their topology needs, so that they can be recognised. Fewer
//! samples than all topologies need are shared by size alone: components may get none. Points lie
//! strictly inside faces, except those of Boundary::Keep, which come first: corners,
//! and points at equal distances between them. Blue noise is chosen from five times as many
//! area-uniform points by weighted sample elimination ([yuksel2015]); points on opposite walls of a
//! thin part do not repel each other. Farthest points use distances on the surface, along edges and
//! across them ([eldar1997], [moenning2003]). They begin from the points on the boundary, or from a
//! random one if there are none, and leave the smallest gaps of the three.
//!
//! \throw InvalidOption    num_samples < 1 or > 8e8, or num_threads < 0.
//! \throw InvalidInput     the surface has no face.
//! \throw ConstraintUnmet  a component is too small, compared with its coordinates, to hold
//!        its share of different points.
//! \throw Cancelled        the progress callback returned false.
//! Cost: O(#F + N log N); farthest points O((#F + N) log(#F + N) log N), a few seconds for 20 000
//! points on 100 000 faces.
[[nodiscard]] std::vector<SurfacePoint> sample_sites(const Surface& surface,
                                                     const SamplingOptions& options = {});

}  // namespace remesh
