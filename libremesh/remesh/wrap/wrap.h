//! \file
//! The outside of any triangles as seen by balls: a closed surface without intersections.
//! Held by Wrap.*, AlphaWrap.* and FitWrap.* in tests/remesh/wrap.
#pragma once

#include <optional>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh::detail {

//! The distance of a wrap's vertices from its input, as a share of the radius.
inline constexpr double wrap_offset = 0.2;

//! CGAL's alpha wrap of a mesh [portaneri2022]: closed, oriented and free of intersections.
//! \throw InvalidInput   no face has an area.
//! \throw InvalidOption  the build is without CGAL.
//! \throw Cancelled      the progress callback returned false.
//! Cost: some 25 microseconds for each face of the wrap, of which there are O((size / radius)^2).
[[nodiscard]] TriangleMesh alpha_wrap(const MeshView& mesh, double radius,
                                      const Progress& progress = {});

//! The outside of the union of solids, by CGAL's corefinement: closed, oriented outward and free of
//! intersections. Cavities are filled.
//! \param mesh  of clean_input(): each of its components is a solid, however it is oriented.
//! \return nothing if a component is open, has no volume or intersects itself, where solids touch
//!         so that the union is no surface, where rounding makes faces intersect, and without CGAL.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n log n log #solids) and that of their intersections.
[[nodiscard]] std::optional<TriangleMesh> unite_solids(const TriangleMesh& mesh, int num_threads,
                                                       const Progress& progress = {});

struct FitWrapOptions {
    double radius = 0;       //!< Mesh units, > 0: of the balls.
    int num_threads = 0;     //!< >= 0; 0: all cores. The result is the same for any number.
    Progress progress = {};  //!< Polled during the call; see poll.
};

//! A wrap whose vertices lie on its input.
struct FittedWrap {
    TriangleMesh mesh;          //!< Closed, oriented and free of intersections.
    std::vector<Vec3> outside;  //!< #V: where the vertices were before, outside of the input.
    double sheets = 0;          //!< The share of the area whose vertices are there still.
};

//! Moves the vertices of a wrap to the nearest points of its input, and splits edges so that they
//! follow the input and its creases. Vertices stay where faces would intersect otherwise.
//! \param wrap   of `input`, with this radius.
//! \param tree   of `input`.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n log n).
[[nodiscard]] FittedWrap fit_wrap(const TriangleMesh& wrap, const ClosestPointTree& tree,
                                  const FitWrapOptions& options);

}  // namespace remesh::detail
