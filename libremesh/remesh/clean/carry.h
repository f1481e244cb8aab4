//! \file
//! Carries sites and edges between the caller's mesh and the cleaned mesh.
#pragma once

#include <array>
#include <span>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "agvd/propagation/propagate.h"
#include "remesh/clean/clean_input.h"

namespace remesh {

//! The same points on `clean.mesh`, of clean_input(mesh): bit for bit on a face that has kept its
//! corners, otherwise at the closest point. Coordinates are divided by their sum if it is not 1.
//! \throw InvalidSites  a site's face does not exist, its coordinates are not barycentric, or
//!        its face was dropped and no other surface is there (within 1e-9 of the box diagonal); the
//!        text names the site.
//! Cost: O(#F log #F + #sites log #F).
[[nodiscard]] std::vector<SurfacePoint> to_cleaned(const std::vector<SurfacePoint>& sites,
                                                   const MeshView& mesh, const CleanedView& clean);

//! The reverse: points of `clean.mesh` on the mesh that it came from. A point of a part of a face
//! goes to the closest point of the whole face. Without clean.face_origin, or without a mesh, faces
//! have kept their corners: coordinates are only divided by their sum. Cost: O(#sites).
[[nodiscard]] std::vector<SurfacePoint> to_original(const std::vector<SurfacePoint>& sites,
                                                    const MeshView& mesh, const CleanedView& clean);

//! \param edges    pairs of vertices of `mesh`.
//! \param clean    of clean_input(mesh).
//! \param surface  of clean.mesh.
//! \return #E of the surface: 1 for edges that given ones have become. A given edge whose faces
//!         were split elsewhere by cleaning becomes none.
//! \throw InvalidInput  a pair is not an edge of the mesh; the text names it.
//! Cost: O(#F log #edges).
[[nodiscard]] std::vector<std::uint8_t> carry_edges(std::span<const std::array<Index, 2>> edges,
                                                    const MeshView& mesh, const CleanedView& clean,
                                                    const Surface& surface);

//! A line along edges, or a region of faces, of a mesh.
struct ShapeView {
    std::span<const std::array<Index, 2>> edges;  //!< Pairs of vertices.
    std::span<const Index> faces;                 //!< In any order.
};

//! Lines and regions as shapes of sites, with site and start 0.
//! \param shapes   of `mesh`.
//! \param clean    of clean_input(mesh); without face_origin the surface is that of the mesh itself.
//! \param surface  of clean.mesh; it may have been cut along edges.
//! \throw InvalidInput  a pair is not an edge of the mesh; the text names it.
//! \throw InvalidSites  there is no such face, or cleaning split an edge of a line or dropped a
//!                      whole region; the text names it.
//! Cost: O(#F log #F + n log n) for n edges and faces of all shapes.
[[nodiscard]] std::vector<agvd::SiteShape> carry_shapes(std::span<const ShapeView> shapes,
                                                        const MeshView& mesh,
                                                        const CleanedView& clean,
                                                        const Surface& surface);

//! Finds edges between faces of different labels.
//! \param face_labels  of the faces of the mesh that clean_input() got.
//! \param face_origin  #F of the surface: see CleanResult.
//! \return #E of the surface: 1 for such edges. Cost: O(#E).
[[nodiscard]] std::vector<std::uint8_t> find_label_borders(std::span<const Index> face_labels,
                                                           std::span<const Index> face_origin,
                                                           const Surface& surface);

}  // namespace remesh
