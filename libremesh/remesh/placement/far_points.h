//! \file
//! Proofs that a triangle lies near a surface.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/closest_point.h"
#include "remesh/names.h"

namespace remesh::detail {

//! A surface, and where its points are.
struct SearchedMesh {
    MeshView mesh;
    const ClosestPointTree& tree;  //!< Of the mesh.
};

struct FarPoint {
    Vec3 at;               //!< On the triangle.
    ClosestPoint nearest;  //!< Of the surface.
};

//! A point of a face, or of the input, and the nearest one of the other surface.
struct FarPair {
    Index face;  //!< Of the edited mesh.
    Vec3 on_mesh, on_input;
    bool is_of_input;  //!< The point of the input was given, the other one is the nearest.
};

//! A point beyond this share of the limit counts as too far: nearer to the limit a proof would take
//! ever smaller parts.
inline constexpr double provable_share = 0.98;

//! Proves that all of a triangle lies within a limit of a surface, or finds a point that does not.
//! \param limit  > 0, mesh units.
//! \return a point beyond provable_share of the limit; unset: all of the triangle is within it.
//! Cost: O(log n) for each triangle of the surface near it.
[[nodiscard]] std::optional<FarPoint> find_far(const std::array<Vec3, 3>& triangle,
                                               const SearchedMesh& other, double limit,
                                               Ticker& ticker);

//! find_far() for all faces of a mesh, side by side.
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
//! \return faces with a point that is too far, ascending.
[[nodiscard]] std::vector<std::pair<Index, FarPoint>> find_far_faces(const MeshView& mesh,
                                                                     const SearchedMesh& other,
                                                                     double limit, int num_threads,
                                                                     Poller& poller);

}  // namespace remesh::detail
