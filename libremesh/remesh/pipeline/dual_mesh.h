//! \file
//! From sites to the mesh: the diagram, its dual, flips to Delaunay, and the patches between curves
//! glued to one mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "remesh/placement/placement.h"

namespace remesh::detail {

struct Domain;
struct PlacedSites;
struct StageContext;

//! The dual as one mesh. Its vertices lie on the surface.
struct DualMesh {
    PlacedMesh mesh;                     //!< No triangles: none has all curves.
    std::vector<Index> site;             //!< #V: its first copy; no_index: the vertex is no site.
    std::vector<std::uint8_t> is_last;   //!< #V: 1 for vertices to remove last.
    std::vector<std::uint8_t> has_cell;  //!< #sites: 1 for those that own a part of the surface.
    std::vector<Index> nearest_site;     //!< #V of the base; no_index: none.
};

//! Propagates from the sites, builds their diagram, and takes the dual of its cells. What is no
//! disc is simplified to its sites in its place (triangulate_sites).
//! \param domain  its layout is consumed.
//! Cost: a propagation and a diagram, and that of path_between for each edge.
[[nodiscard]] DualMesh build_dual_mesh(Domain& domain, const PlacedSites& placed,
                                       const StageContext& context);

//! Removes vertices, or divides edges, until there are so many, as far as the topology allows.
//! \param may_add  whether edges may be divided.
//! Cost: O(n log n).
void set_vertex_count(const Domain& domain, Index count, bool may_add, DualMesh& dual,
                      const StageContext& context);

//! Fits the vertices to the surface as far as the options ask for it, and flips triangles without
//! area.
//! \param domain  its pieces are found if they were reset, and reset then.
//! Cost: that of fit_vertices.
[[nodiscard]] PlacedMesh place_vertices(Domain& domain, const PlacedSites& placed,
                                        const DualMesh& dual, const StageContext& context);

}  // namespace remesh::detail
