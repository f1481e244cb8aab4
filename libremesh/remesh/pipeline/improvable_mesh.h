//! \file
//! Better triangles where placement leaves narrow ones.
#pragma once

#include "remesh/pipeline/remesh.h"
#include "remesh/placement/placement.h"

namespace remesh::detail {

class CrossingFinder;
struct CrossingFaces;
struct CurvedSurface;
struct StageContext;

//! Whether vertices may move: not with given sites, whose vertices stay, and where sheets meet.
[[nodiscard]] bool is_improvable(const CurvedSurface& curved, const RemeshOptions& options);

//! #V: all vertices may move but those at nodes of the network, which may only be merged with
//! others, or stay if something is locked. Those on a curve slide along it. Cost: O(#mesh log
//! #curves).
[[nodiscard]] std::vector<Mobility> find_mobility(const CurvedSurface& curved,
                                                  const MeshCurves& curves, const PlacedMesh& mesh);

//! Improves narrow triangles (repair_shape), or those that exceed bounds (keep_bounds). If more of
//! the improved triangles intersect than before, fixes their corners and tries again, once. The
//! mesh stays if none is better.
//! \param crossings  of the mesh, then of the improved one; unset without CGAL.
//! \param bounds     null: there are none.
//! Cost: O(#surface), and that of repair_shape, twice at most.
void improve(const CurvedSurface& curved, CrossingFinder& finder, PlacedMesh& mesh,
             std::optional<CrossingFaces>& crossings, const StageContext& context,
             const ShapeBounds* bounds = nullptr);

//! Parts faces that intersect where the input's do not (repair_crossings).
//! \param crossings  as of improve().
//! Cost: that of repair_crossings and find_self_intersections, three times at most.
void part_faces(const CurvedSurface& curved, CrossingFinder& finder, PlacedMesh& mesh,
                std::optional<CrossingFaces>& crossings, const StageContext& context);

//! Takes the mark of a crease from the edges at the corners of faces that still intersect, where
//! the input's do not, or have no area; and, if they are few, at those of faces beyond some bounds.
//! \param aims  unless the caller has bounds of his own.
//! \return whether there are any. Cost: O(n log n).
[[nodiscard]] bool free_creases(const CurvedSurface& curved,
                                const std::optional<CrossingFaces>& crossings,
                                const ShapeBounds& aims, PlacedMesh& mesh,
                                const StageContext& context);

//! Improves the bad triangles of a mesh that is large, or a tile of one: only what lies within some
//! rings of them is looked at and changed. Crossings are not searched. Vertices that are kept have
//! their numbers still.
//! \param stays  #V: 1 for vertices that do not move; or empty.
//! Cost: O(#surface), and that of repair_shape there.
void improve_in_places(const CurvedSurface& curved, std::span<const std::uint8_t> stays,
                       PlacedMesh& mesh, const StageContext& context);

}  // namespace remesh::detail
