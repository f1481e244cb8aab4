//! \file
//! Makes relays from the views of the vertices.
#pragma once

#include <span>
#include <vector>

#include "agvd/propagation/corners.h"
#include "agvd/propagation/relays.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/vertex_views.h"

namespace agvd {

//! Reads vertices that no longer change.
//!
//! The relays of a face are: the images that its corners see through one of its edges, with the
//! interval through which they are known to be seen; the sites in a neighbour; a neighbour's far
//! corner from which the shared edge was reached; and its own corners, unless one of these relays
//! replaces them.
class VertexRelays {
public:
    VertexRelays(const Surface& surface, std::span<const SurfacePoint> sites,
                 const SitePlacement& placement, const Corners& corners,
                 std::span<const VertexReach> reach, std::span<const VertexView> views)
        : surface_(surface),
          sites_(sites),
          placement_(placement),
          corners_(corners),
          reach_(reach),
          views_(views) {}

    //! The faces with corners of different sites, and the faces that hold, or whose neighbour
    //! holds, a site other than that of their corners. Ascending.
    [[nodiscard]] std::vector<Index> mixed_faces() const;

    //! Appends the relays of a face.
    void collect(Index face, std::vector<Relay>& out) const;

    //! Starts to load a face that will be collected soon.
    [[gnu::always_inline]] void prefetch(Index face) const {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            __builtin_prefetch(&views_[surface_.tail(h)]);
        }
        __builtin_prefetch(&corners_[3 * face]);
        __builtin_prefetch(&corners_[3 * face + 2]);
    }

private:
    [[nodiscard]] Index source_of(const VertexView& view) const;
    [[nodiscard]] bool is_served(Index half_edge, std::vector<Relay>& out) const;
    void collect_sites(Index face, std::vector<Relay>& out) const;
    void add_point(Index half_edge, const Vec2& point, double weight, Index site,
                   std::vector<Relay>& out) const;
    [[nodiscard]] bool add_across(Index half_edge, const VertexView& view, Index site,
                                  std::vector<Relay>& out) const;
    void add_image(Index half_edge, const Vec2& image, double weight, Index site, const Vec2& left,
                   const Vec2& right, std::vector<Relay>& out) const;

    const Surface& surface_;
    std::span<const SurfacePoint> sites_;
    const SitePlacement& placement_;
    const Corners& corners_;
    std::span<const VertexReach> reach_;
    std::span<const VertexView> views_;
};

}  // namespace agvd
