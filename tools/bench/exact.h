//! \file
//! What benchmarks take from CGAL's exact distances, if the build has CGAL. Without it all
//! functions that ask CGAL throw agvd::InvalidOption.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "paper/compare.h"

namespace bench {

[[nodiscard]] bool has_exact();

//! exact_nearest_sites of all vertices: #V; infinity where no site reaches.
[[nodiscard]] std::vector<double> exact_vertex_distances(const agvd::Surface& surface,
                                                         std::span<const agvd::SurfacePoint> sites);

//! distances_by_one_search of all vertices: #V; infinity where no site reaches.
[[nodiscard]] std::vector<double> vertex_distances_by_one_search(
    const agvd::Surface& surface, std::span<const agvd::SurfacePoint> sites);

//! agvd::compare_labels on all cores.
[[nodiscard]] std::vector<agvd::LabelError> exact_label_errors(
    const agvd::Surface& surface, std::span<const agvd::SurfacePoint> sites,
    std::span<const agvd::SurfacePoint> points, std::span<const std::vector<agvd::SiteId>> labels);

//! Error of vertex distances, relative to the exact ones.
struct VertexError {
    double mean = 0;
    double max = 0;
    double lowest = 0;  //!< Below 0: a distance shorter than exact.
};

//! \param ours, exact  #V; vertices that neither reaches are left out, infinite where only one does
//!                     or where only the exact one is 0.
[[nodiscard]] VertexError vertex_error(std::span<const double> ours, std::span<const double> exact);

}  // namespace bench
