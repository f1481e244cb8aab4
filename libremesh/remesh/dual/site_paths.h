//! \file
//! Any path between neighbouring sites, for a start. Private to the dual.
#pragma once

#include <span>

#include "agvd/diagram/diagram.h"
#include "remesh/dual/face_strip.h"

namespace remesh {

//! Finds ways from sites into faces of their cells: down the distances from vertex to vertex, and
//! where that leads nowhere by a search along the edges. Keeps its memory; one for each thread.
class SitePaths {
public:
    SitePaths(const agvd::Surface& surface, std::span<const agvd::SurfacePoint> sites,
              const agvd::Diagram& diagram);

    //! From one site to another through `face`, by vertices of their cells where that is possible.
    //! Cost: O(vertices on the way), or a search as far as the sites.
    [[nodiscard]] FaceStrip through(agvd::Index from, agvd::Index face, agvd::Index to);

    //! From one site to another; by a search. They must lie on one component.
    [[nodiscard]] FaceStrip between(agvd::Index from, agvd::Index to);

private:
    using Vertices = std::vector<agvd::Index>;

    [[nodiscard]] bool holds_site(agvd::Index face, agvd::Index site) const {
        return holds(surface_, face, sites_[site]);
    }
    void find_way(agvd::Index face, agvd::Index site, Vertices& vertices) const;
    [[nodiscard]] agvd::Index common_corner(agvd::Index face, agvd::Index site) const;
    void descend(agvd::Index face, agvd::Index site, Vertices& vertices) const;
    void search(agvd::Index face, agvd::Index site, Vertices& vertices) const;

    const agvd::Surface& surface_;
    std::span<const agvd::SurfacePoint> sites_;
    const agvd::Diagram& diagram_;
    Vertices back_, forth_;
};

}  // namespace remesh
