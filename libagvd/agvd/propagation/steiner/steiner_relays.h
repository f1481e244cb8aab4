//! \file
//! Makes relays from settled Steiner points.
#pragma once

#include <span>
#include <vector>

#include "agvd/propagation/relays.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/steiner/steiner_pool.h"

namespace agvd {

//! Reads nodes that no longer change, around one face at a time.
//!
//! Inside a face, a node whose parent lies on the same face is dominated by that parent (triangle
//! inequality), and one that came through a neighbour is dominated by its parent's image, unfolded
//! across the shared edge. So the relays of a face are the parents' images: the joint diagram with
//! the neighbours' Steiner points ([meng2023] Sec. 5.3), without the points that cannot win.
class SteinerRelays {
public:
    SteinerRelays(const Surface& surface, const SitePlacement& placement,
                  const SteinerCounts& counts, const std::vector<SteinerNode>& vertices,
                  SteinerPool& pool)
        : surface_(surface),
          placement_(placement),
          counts_(counts),
          vertices_(vertices),
          pool_(pool) {}

    //! Whether a face is not redundant (Sec. 4.3): its boundary has nodes of several sites, or a
    //! site in the face or in a neighbour may have a cell that lies between the nodes.
    [[nodiscard]] bool is_mixed(Index face);

    //! Appends the relays of a face.
    void collect(Index face, std::vector<Relay>& out);

private:
    [[nodiscard]] bool are_all_from(Index half_edge, Index site);
    void add_relay(Index half_edge, const Vec2& image, double weight, Index site,
                   std::vector<Relay>& out) const;
    void collect_across(Index h, Index twin, std::vector<Relay>& out);

    const Surface& surface_;
    const SitePlacement& placement_;
    const SteinerCounts& counts_;
    const std::vector<SteinerNode>& vertices_;
    SteinerPool& pool_;
    std::vector<std::pair<Index, Index>> seen_slots_;  // Scratch: (slot, site).
};

}  // namespace agvd
