//! \file
//! The steps of simplify(): cut to a simplicial complex, insert points, remove vertices. Private.
#pragma once

#include "agvd/intrinsic/operations.h"

namespace agvd::detail {

//! Whether two vertices have a common edge. Cost: O(edges of the one that has fewer).
[[nodiscard]] bool has_edge(const Surface& surface, Index a, Index b);

//! Ascending: edges to cut so that the complex comes closer to a simplicial one: loops, and all but
//! one of several edges with the same ends; else one of every face but one with the same corners.
//! Empty where it is simplicial, as it is after a few rounds of cuts at middles. Cost: O(n log n).
[[nodiscard]] std::vector<Index> edges_to_cut(const Surface& surface);

//! Inserts points one by one, each in a face, on an edge, or at a vertex that has no earlier point.
//! What is closer than 1e-9 of a face to an edge or vertex lies there, or is moved there.
//! \param surface  simplicial; stays so.
//! \return by point: its vertex. Cost: O(log n) for each point in practice.
[[nodiscard]] std::vector<Index> insert_points(Surface& surface, FaceCharts& charts,
                                               std::span<const SurfacePoint> points);

//! The sum of the corners at a vertex, radians.
[[nodiscard]] double cone_angle(const Surface& surface, Index vertex);

//! Scales the edges at a vertex by one factor so that the cone angle is `target`: the conformal map
//! that moves its curvature to its neighbours ([springborn2008]; [liu2023] Sec. 3.3).
//! \param target  2 pi; pi on the boundary.
//! \return false if no factor leaves all faces there triangles; then nothing has changed.
//! The vertex must have no edge to itself. Cost: O(edges there).
[[nodiscard]] bool flatten(Surface& surface, FaceCharts& charts, Index vertex, double target);

//! Removes every vertex whose number is no_index, the flattest first, unless the complex would not
//! stay simplicial, and keeps the rest Delaunay.
//! \param surface  simplicial; left with gaps.
void remove_vertices(Surface& surface, FaceCharts& charts, const std::vector<Index>& number);

}  // namespace agvd::detail
