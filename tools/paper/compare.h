//! \file
//! How far a diagram is from the exact one. In target agvd::oracle, which knows the exact
//! distances.
#pragma once

#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "paper/bisector_error.h"

namespace agvd {

//! Scale-free error of an approximate diagram.
struct DiagramError {
    double wrong_label_area = 0;        //!< Share of the surface's area with a wrong label.
    BisectorError bisectors;            //!< Of the points of its bisectors.
    double min_relative_distance = 0;   //!< Lowest (ours - exact) / exact at the vertices; never
                                        //!< below rounding, since distances are of real paths.
    double mean_relative_distance = 0;  //!< Mean of the same.
};

//! Labels of points that are not those of the exact nearest sites. Where sites tie within rounding,
//! each of them is right.
struct LabelError {
    double wrong = 0;    //!< Share of the points.
    double largest = 0;  //!< Most by which a wrong label's site is farther than the nearest one,
                         //!< mesh units; infinite where only one of them reaches.
};

//! What is judged; both belong to the same sites.
struct Approximation {
    const Propagation& propagation;  //!< Of the surface, or of `base` if there is one.
    const Diagram& diagram;          //!< Drawn on the surface: see diagram_on_input().
    const IntrinsicTriangulation* base = nullptr;  //!< Of the surface; outlives this.
};

//! `{}` gives the defaults.
struct CompareOptions {
    Index area_samples = 20000;  //!< Points, uniform by area, whose labels are compared, >= 1.
    std::uint64_t seed = 1;      //!< Same seed, same figures, any num_threads.
    int num_threads = 0;         //!< >= 0; 0: all cores.
};

//! Error of each approximation of one diagram. Bisectors are measured at the points of their
//! polylines and at the middles between these; labels are those of the nearest relay at a point. A
//! vertex that only one side reaches has an infinite relative distance.
//!
//! Cost: one exact search from all sites, and one from each site as far as its cell and the
//! neighbours of its bisectors; shared by all approximations.
[[nodiscard]] std::vector<DiagramError> compare_with_exact(
    const Surface& surface, std::span<const SurfacePoint> sites,
    std::span<const Approximation> approximations, const CompareOptions& options = {});

//! Errors of several lists of labels of the same points.
//! \param labels       #points each.
//! \param num_threads  >= 0; 0: all cores. Same result for any number.
//!
//! Cost: exact_nearest_sites of the points, and a search from each site as far as its wrong labels.
[[nodiscard]] std::vector<LabelError> compare_labels(const Surface& surface,
                                                     std::span<const SurfacePoint> sites,
                                                     std::span<const SurfacePoint> points,
                                                     std::span<const std::vector<SiteId>> labels,
                                                     int num_threads = 0);

}  // namespace agvd
