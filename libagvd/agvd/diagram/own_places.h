//! \file
//! The points that own the places where they lie.
#pragma once

#include <span>
#include <vector>

#include "agvd/diagram/edge_labels.h"

namespace agvd {

//! Points with the sites that they belong to.
struct SitePlaces {
    std::vector<SurfacePoint> points;
    std::vector<Index> sites;  //!< #points
    Index num_of_shapes = 0;   //!< The first ones: places of lines and regions.
    Index num_sites = 0;
    bool own_all = false;  //!< Every point is a site, and owns its place.
};

//! The points that may own their places: the given ones, the vertices of shapes, and the middles of
//! regions' faces. Vertices of a shape with a start may belong to other sites: of these also the
//! middles of edges.
//! \param site_of_point  as Propagation::site_of_point.
[[nodiscard]] SitePlaces all_places(const Surface& surface, std::span<const SurfacePoint> points,
                                    std::span<const Index> site_of_point,
                                    std::span<const SiteShape> shapes);

//! Whether a point owns its place, by what the engine says of the vertex at which it lies, or of
//! the face that names it. The middle of a region's face does not where a corner does.
//! \param labels  the vertices as the engine has them; mixed_index.
//! Cost: O(relays).
[[nodiscard]] bool owns_its_place(const Surface& surface, const Propagation& propagation,
                                  const EdgeLabels& labels, const SitePlaces& places, Index point);

}  // namespace agvd
