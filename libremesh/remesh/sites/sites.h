//! \file
//! Sites on the surface: as many as asked for, no two at one position, every component with its
//! share; and their relaxation towards a centroidal Voronoi tessellation, so that they are spread
//! evenly. Held by SampleSites.* and RelaxSites.* in tests/remesh/sites.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh {

class SizeField;
struct PreparedSurface;

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

//! Places exactly num_samples points, no two at one position. First those on the boundary with
//! Boundary::Keep, as plan_network plans them: corners, and points at equal distances between them;
//! none if they are too few for that. The others lie strictly inside faces, component by component
//! (by lowest face). Each gets what its topology needs (minimum_samples), small ones up to four
//! times that; the rest is shared by area. Too few for all topologies are shared by size alone.
//! Points on opposite walls of a
//! thin part do not repel each other in blue noise. Farthest points begin from the boundary or a
//! random point.
//! \throw InvalidOption    num_samples < 1 or > 8e8, or num_threads < 0.
//! \throw InvalidInput     the surface has no face.
//! \throw ConstraintUnmet  a component is too small, compared with its coordinates, to hold
//!        its share of different points.
//! \throw Cancelled        the progress callback returned false.
//! Cost: O(#F + N log N); farthest points O((#F + N) log(#F + N) log N), a few seconds for 20 000
//! points on 100 000 faces.
[[nodiscard]] std::vector<SurfacePoint> sample_sites(const Surface& surface,
                                                     const SamplingOptions& options = {});

// --- Relaxation --------------------------------------------------------------------------------

//! One level of relaxation.
struct RelaxLevel {
    Index num_sites = 0;  //!< Sites of this level.
    //! Before the first step and after each: the sum over the cells of the integral of the squared
    //! distance from the site, on the triangulation of the sites; mesh units to the fourth.
    std::vector<double> energy;
};

//! The energy after a step as a share of that before the first. None where the first is 0: all
//! triangles of the sites are too thin for it.
[[nodiscard]] inline std::optional<double> energy_share(const RelaxLevel& level, std::size_t step) {
    if (!(level.energy.front() > 0)) return std::nullopt;
    return level.energy[step] / level.energy.front();
}

//! `{}` gives the defaults.
struct RelaxOptions {
    int steps = 60;  //!< >= 0; on each level.
    //! Stops when ten steps lower the energy by less than this share, >= 0.
    double tolerance = 1e-4;
    //! The caller's own rule besides these two: asked after each step, on the caller's thread, with
    //! the level so far. False ends the level; its sites stay where they are now. May be empty.
    std::function<bool(const RelaxLevel&)> goes_on = {};
    std::vector<std::uint8_t> is_fixed = {};  //!< #sites: 1 for sites that stay; or empty.
    //! Keep: before the first step, inner sites whose cells meet it move to it, and to its corners.
    Boundary boundary = Boundary::Keep;
    int num_threads = 0;     //!< >= 0; 0: all cores. The same bytes for any number.
    Progress progress = {};  //!< Polled during the call; see poll.
    //! Target lengths: cells get areas in proportion to their squares. Outlives the call; null: all
    //! are equal, and cells are smaller where they are bent.
    const SizeField* sizes = nullptr;
};

//! Sites after relaxation.
struct RelaxResult {
    std::vector<SurfacePoint> sites;  //!< On the input, in the order given.
    std::vector<RelaxLevel> levels;   //!< Coarse to fine.
};

//! Lloyd's method with momentum, along the surface. Sites on the boundary (barycentric coordinates
//! of exactly 0) stay on it, those at boundary vertices do not move. The start may be as uneven as
//! all sites at one position.
//!
//! Sites that are too few for their triangulation to resemble the surface are not relaxed.
//! \param surface  prepared for the spacing of the sites.
//! \param sites    on surface.input(), as are those of the result.
//! \throw InvalidOption  an option is out of range.
//! \throw InvalidSites   a site is not on the surface.
//! \throw Cancelled      the progress callback returned false.
//! Cost: O(#F) every ten steps, O(#sites) each.
[[nodiscard]] RelaxResult relax_sites(const PreparedSurface& surface,
                                      std::vector<SurfacePoint> sites,
                                      const RelaxOptions& options = {});

}  // namespace remesh
