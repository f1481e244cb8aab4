//! \file
//! Finds the relays that matter near a point, where a face has many.
#pragma once

#include "agvd/diagram/face_relays.h"

namespace agvd {

//! Boxes around the images of relays, half of them in each half.
class RelayTree {
public:
    //! Keeps a reference. Cost: O(n log n).
    void build(std::span<const PlanarRelay> relays);

    //! Replaces `out` by indices, ascending: all relays through which p is no farther from a site
    //! than `radius`, and maybe some others. Cost: O(log n) and what it finds, where images are
    //! spread evenly.
    void find_near(const Vec2& p, double radius, std::vector<Index>& out) const;

private:
    struct Node {
        Vec2 low, high;       // Corners of the box.
        double least_weight;  // Of its relays.
        Index begin, end;     // Of order_.
        Index second_half;    // Node; the first half follows this one. no_index: a leaf.
    };

    void add_node(Index begin, Index end);

    std::span<const PlanarRelay> relays_;
    std::vector<Index> order_;
    std::vector<Node> nodes_;
};

}  // namespace agvd
