//! \file
//! How far two diagrams of the same sites are from each other, and their bisectors from the exact
//! ones.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/diagram/diagram.h"
#include "paper/bisector_error.h"

namespace agvd {

//! The paper's measure ([meng2023] Sec. 6.2). The curves are the boundary loops of the cells, the
//! cell on their left; arcs of the surface's boundary are part of them.
struct FrechetError {
    double sum = 0;      //!< Eq. 8, mesh units: over all cells and loops, unmatched ones with
                         //!< their diameters.
    double largest = 0;  //!< Its largest summand, mesh units.
    double delta = 0;    //!< Eq. 9, in [0, 1]: 1 - exp(-sum / unit / c^2).
    double unit = 0;     //!< Length that counts as 1 in delta, mesh units: the mean cell radius.
    double spacing = 0;  //!< Of the points along the loops, mesh units.
    Index matched_loops = 0;    //!< Pairs of loops.
    Index unmatched_loops = 0;  //!< Loops of either diagram without a partner.
};

//! How far two diagrams of the same sites differ.
struct DiagramDifference {
    double cell_radius = 0;       //!< mean_cell_radius, mesh units.
    FrechetError frechet;         //!< Between the borders of their cells.
    double wrong_label_area = 0;  //!< Share of the surface's area that lies in different cells.
    double hausdorff = 0;         //!< Between the networks of bisectors, mesh units; infinity if
                                  //!< only one diagram has any.
};

//! `{}` gives the defaults.
struct DiagramCompareOptions {
    //! Between neighbouring points of a loop, in mean cell radii, > 0. Both loops of a pair get as
    //! many points as the longer one needs, between 8 and max_loop_points.
    double spacing = 0.01;
    Index max_loop_points = 20'000;  //!< >= 8; bounds the cost: see closed_frechet_distance.
    double c = 10;                   //!< Of Eq. 9, > 0.
    Index area_samples = 100'000;    //!< Points, uniform by area, whose cells are compared, >= 1.
    std::uint64_t seed = 1;          //!< Same seed, same figures, any num_threads.
    int num_threads = 0;             //!< >= 0; 0: all cores.
    Progress progress = {};          //!< Polled during the call; see agvd::poll.
};

//! Sets two diagrams of the same surface and sites side by side. Distances between points of curves
//! are taken in space, as in the paper, which gives its curves in R^3.
//!
//! Loops of one cell are matched nearest first, by their Fréchet distance. Those left over are
//! charged their diameter and counted. Resampling starts at the first point of a's loop and at the
//! nearest point of b's; it adds at most one spacing to a distance, and next to nothing where the
//! loops have the same shape.
//! \throw InvalidOption  an option is out of range.
//! \throw InvalidInput   the diagrams differ in their number of sites or do not fit the surface.
//! \throw Cancelled      the progress callback returned false.
//! Cost: see closed_frechet_distance for each pair of loops of a cell; O(log n) for each sample.
[[nodiscard]] DiagramDifference compare_diagrams(const Surface& surface, const Diagram& a,
                                                 const Diagram& b,
                                                 const DiagramCompareOptions& options = {});

//! The loops of each cell as closed polylines in space, ordered as build_cells orders them.
struct LoopCurves {
    std::vector<Index> cell_loops;         //!< #sites + 1 offsets into loops.
    std::vector<std::vector<Vec3>> loops;  //!< First points are not repeated.
};
//! See LoopCurves. Cost: O(points of the diagram).
[[nodiscard]] LoopCurves loop_curves(const Surface& surface, const Diagram& diagram,
                                     Ticker ticker = {});

//! `{}` gives the defaults.
struct BisectorErrorOptions {
    SitePoints points = {};              //!< What the points given as sites stand for.
    std::vector<SiteShape> shapes = {};  //!< Lines and regions, besides the points.
    //! >= 1; of more points that a diagram has, every k-th is measured.
    Index max_points = 20'000;
    int num_threads = 0;     //!< >= 0; 0: all cores. Same result for any number.
    Progress progress = {};  //!< Polled during the call; see agvd::poll.
};

//! |dA - dB| of each diagram, dA and dB being the exact distances (window engine) of points of its
//! bisectors from the two sites that they are said to be between; of a site's points and shapes the
//! nearest counts. A point that one of them does not reach counts as infinitely wrong.
//!
//! \param diagrams  of the same surface and sites; they share the searches.
//! Cost: for each site one exact search as far as its bisectors, in a mesh with their points as
//! vertices; with random sites, together some 3 to 6 exact propagations; for each shape O(#F)
//! besides. Far more on meshes of long slivers, where windows are many: measure fewer points there.
//! \throw Cancelled  the progress callback returned false.
[[nodiscard]] std::vector<BisectorError> exact_bisector_errors(
    const Surface& surface, std::span<const SurfacePoint> sites,
    std::span<const Diagram* const> diagrams, const BisectorErrorOptions& options = {});

}  // namespace agvd
