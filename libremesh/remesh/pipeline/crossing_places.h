//! \file
//! Where a mesh intersects itself: crossings of its remesh near that place follow from it.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh::detail {

using FacePairs = std::vector<std::pair<Index, Index>>;

//! A triangle, mostly a segment with its second end twice, that holds all points which two
//! intersecting triangles have in common: of the two segments in the plane of the other the shorter
//! one, or the triangle of smaller area if they lie in one plane.
[[nodiscard]] std::array<Vec3, 3> crossing_place(const std::array<Vec3, 3>& a,
                                                 const std::array<Vec3, 3>& b);

//! The places where the pairs of faces of a mesh intersect.
class CrossingPlaces {
public:
    //! \param pairs  intersecting faces of the mesh; at least one pair.
    //! Cost: O(n log n), n = pairs.
    CrossingPlaces(const MeshView& mesh, const FacePairs& pairs, const Progress& progress);

    //! The pairs of faces of another mesh that intersect farther from all places than the longest
    //! edge of the two.
    //! Cost: O(log n) for each pair near a place.
    [[nodiscard]] FacePairs pairs_elsewhere(const MeshView& mesh, const FacePairs& pairs) const;

private:
    ClosestPointTree places_;
};

}  // namespace remesh::detail
