//! \file
//! Initial paths between neighbouring vertices of the dual. Private to the dual.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "agvd/diagram/diagram.h"
#include "remesh/dual/face_strip.h"

namespace remesh {

//! Vertices of a mesh over the diagram.
struct DualVertices {
    std::span<const SurfacePoint> points;
    std::span<const Index> site;  //!< By vertex; no_index: it is no site.
    const Diagram& diagram;
    std::span<const Vec3> positions;  //!< In space.
};

//! Finds paths from sites into faces of their cells: from vertex to vertex by falling distances,
//! and if that fails by a search along the edges. Keeps its memory; use one for each thread.
class SitePaths {
public:
    //! \param ticker  of the thread.
    SitePaths(const Surface& surface, const DualVertices& vertices, Ticker ticker = {})
        : surface_(surface), vertices_(vertices), ticker_(ticker) {}

    //! From one vertex to another through `face`, by vertices of their cells if possible.
    //! Cost: O(mesh vertices on the way), or a search as far as both.
    [[nodiscard]] FaceStrip through(Index from, Index face, Index to);

    //! From one vertex to another on the same component, by a search.
    [[nodiscard]] FaceStrip between(Index from, Index to);

private:
    using Way = std::vector<Index>;  // Mesh vertices.

    [[nodiscard]] bool holds_goal(Index face, Index goal) const {
        return holds(surface_, face, vertices_.points[goal]);
    }
    // Whether a mesh vertex is in the cell of the goal's site.
    [[nodiscard]] bool is_inside(Index mesh_vertex, Index goal) const {
        return vertices_.diagram.nearest_site[mesh_vertex].value() == vertices_.site[goal];
    }
    void find_way(Index face, Index goal, Way& way);
    [[nodiscard]] Index common_corner(Index face, Index goal) const;
    void descend(Index face, Index goal, Way& way) const;
    void search(Index face, Index goal, Way& way);

    // What a search knows of a mesh vertex.
    struct Reached {
        double length = infinity;
        Index from = no_index;
        bool is_done = false;
    };

    const Surface& surface_;
    const DualVertices& vertices_;
    mutable Ticker ticker_;
    Way back_, forth_;
    // By mesh vertex, made for the first search. With a hash table a rough star of 20 000 corners
    // took 1.4 times as long.
    std::vector<Reached> reached_;
    Way visited_;  // By the last search.
};

}  // namespace remesh
