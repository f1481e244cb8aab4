//! \file
//! Target lengths from curvature, lengths or densities: bounded, gradual, and scaled to a number of
//! vertices.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/surface.h"
#include "remesh/sites/sizing.h"

namespace remesh {

//! The root mean square of the two principal curvatures, over patches (cells of evenly spread
//! vertices, with those next to them): the deviation of normals over that of positions. Independent
//! of the triangles. Patches end at the boundary: cut creases first.
//! \param num_cells  rounded down, at least 1; there are no more than vertices of the base.
//! \return #V of base.surface(): 1 / mesh units, >= 0.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n).
[[nodiscard]] std::vector<double> patch_curvature(const IntrinsicTriangulation& base,
                                                  double num_cells, Ticker& ticker);

//! The edge of an equilateral triangle whose corners lie on a sphere of this curvature and whose
//! middle is off by `error`: sqrt(6 e / k - 3 e^2) (pmp and CGAL have it too). Where the radius is
//! below the error, that of the radius e: e sqrt(3).
//! \param curvature  >= 0; 0 gives infinity.
//! \param error      > 0.
[[nodiscard]] double length_for_error(double curvature, double error);

//! The gradation with which target_lengths() lets targets grow by a slope.
[[nodiscard]] double gradation_for(double slope);

//! Calls visit(vertex, wait) for some vertices, then, in rounds, for those that visits have given
//! to wait(vertex).
template <typename Visit>
void visit_in_rounds(Index num_vertices, std::vector<Index> now, const Visit& visit) {
    std::vector<std::uint8_t> waits(num_vertices, 0);
    for (std::vector<Index> next; !now.empty(); now.swap(next)) {
        next.clear();
        for (const Index v : now) {
            waits[v] = 0;
            visit(v, [&](Index other) {
                if (waits[other] == 0) next.push_back(other);
                waits[other] = 1;
            });
        }
    }
}

//! Paths that lengths are measured along.
enum class Paths {
    Edges,  //!< Up to twice as long as geodesics.
    //! Straight lines to the vertices across the opposite edges, too: a few per cent too long in
    //! most directions, at most a fifth.
    Lines
};

//! Lowers lengths until length[u] <= length[v] + slope * d for all vertices u and v, where d is the
//! length of the shortest path. Lengths that keep this already stay.
//! \param joined  pairs of vertices that are one, such as copies on both sides of a cut.
//! \param slope   >= 0.
//! \param length  #V, > 0; edited in place.
//! Cost: O(n), and O(n log n) for the vertices that change.
void limit_growth(const Surface& surface, std::span<const std::pair<Index, Index>> joined,
                  double slope, Paths paths, std::span<double> length, Ticker& ticker);

//! \param values  #V: curvatures (patch_curvature), lengths or densities, whichever `sizing` asks
//!        for.
//! \param most    #V: no target is longer; or empty.
//! \param least   #V: edges that stay are so long there; 0: none. Targets fall from there by at most
//!        half the distance, except below `most`. Or empty.
//! \param joined  see limit_growth.
//! \param area    in squares of the local length, that the result has; 0: as the lengths give it.
//!        Bounds and gradation hold in the scaled lengths unless no scale gives this area: then all
//!        are multiplied by one factor in the end.
//! \return #V; mesh units.
//! Cost: O(n log n) for each scale that is tried, some five.
[[nodiscard]] std::vector<double> target_lengths(const Surface& surface,
                                                 std::span<const double> values,
                                                 std::span<const double> most,
                                                 std::span<const std::pair<Index, Index>> joined,
                                                 const Sizing& sizing, double area, Ticker& ticker,
                                                 std::span<const double> least = {});

}  // namespace remesh
