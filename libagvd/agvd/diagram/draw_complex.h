//! \file
//! The combinatorial half of drawing: numbers for Voronoi edges and vertices, and how they hang
//! together.
#pragma once

#include "agvd/diagram/diagram.h"
#include "agvd/diagram/diagram_parts.h"

namespace agvd {

//! The Voronoi vertices of a face, in the pools of ArcStore.
struct FaceVoronoiVertices {
    Index face;
    Block voronoi_vertices;
};

//! Of those faces that have any, in their order.
[[nodiscard]] std::vector<FaceVoronoiVertices> list_voronoi_vertices(const ArcStore& arcs,
                                                                     std::span<const Index> faces);

//! A label change on one of the surface's boundaries, in its direction (the surface on the left).
struct BoundaryCrossing {
    Index crossing;
    Index position;  //!< Of its half-edge in the loop.
    Index site_before, site_after;
};

//! What all passes of drawing read.
struct DrawingInput {
    const Surface& surface;
    const DiagramParts& parts;
    std::span<const FaceVoronoiVertices> voronoi_vertices;  //!< Of all faces, ascending.
    std::vector<std::vector<BoundaryCrossing>> boundary;    //!< By loop of the boundary.
};

//! Keeps references.
[[nodiscard]] DrawingInput drawing_input(const Surface& surface, const DiagramParts& parts,
                                         std::span<const FaceVoronoiVertices> voronoi_vertices);

//! Sets the edges of `diagram`, the ends around its vertices and the sites between them. Edges
//! stand in the order of JoinedEdges, then come those on the boundary, loop after loop. Voronoi
//! vertices inside the surface come first, then the label changes on the boundary.
//! Cost: O(edges + boundary).
void draw_complex(const DrawingInput& input, Ticker ticker, Diagram& diagram);

}  // namespace agvd
