//! \file
//! Finds the relays that matter near a point, where a face has many.
#pragma once

#include <algorithm>
#include <numeric>

#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/face_relays.h"

namespace agvd {

//! Boxes around the images of relays, half of them in each half.
class RelayTree {
public:
    //! Keeps a reference. Cost: O(n log n).
    void build(std::span<const PlanarRelay> relays) {
        relays_ = relays;
        order_.resize(relays.size());
        std::iota(order_.begin(), order_.end(), Index{0});
        nodes_.clear();
        add_node(0, static_cast<Index>(relays.size()));
    }

    //! Replaces `out` by indices, ascending: all relays through which p is no farther from a site
    //! than `radius`, and maybe some others. Cost: O(log n) and what it finds, in practice.
    void find_near(const Vec2& p, double radius, std::vector<Index>& out) const {
        out.clear();
        std::array<Index, 64> open;
        std::size_t num_open = 0;
        open[num_open++] = 0;
        while (num_open > 0) {
            const Index i = open[--num_open];
            const Node& node = nodes_[i];
            const Vec2 outside = (node.low - p).cwiseMax(p - node.high).cwiseMax(0.0);
            if (!(node.least_weight + outside.norm() <= radius)) continue;
            if (node.second_half != no_index) {
                open[num_open++] = node.second_half;
                open[num_open++] = i + 1;
                continue;
            }
            for (Index j = node.begin; j < node.end; ++j) {
                const PlanarRelay& relay = relays_[order_[j]];
                if (relay.is_parallel || relay.weight + (p - relay.image).norm() <= radius) {
                    out.push_back(order_[j]);
                }
            }
        }
        std::sort(out.begin(), out.end());
    }

private:
    struct Node {
        Vec2 low, high;       // Corners of the box.
        double least_weight;  // Of its relays.
        Index begin, end;     // Of order_.
        Index second_half;    // Node; the first half follows this one. no_index: a leaf.
    };

    void add_node(Index begin, Index end) {
        constexpr Index leaf_size = 16;
        Node node{
            Vec2(infinity, infinity), Vec2(-infinity, -infinity), infinity, begin, end, no_index};
        for (Index i = begin; i < end; ++i) {
            const PlanarRelay& relay = relays_[order_[i]];
            if (relay.is_parallel) {  // It has no image: it may be near everywhere.
                node = {Vec2(-infinity, -infinity),
                        Vec2(infinity, infinity),
                        -infinity,
                        begin,
                        end,
                        no_index};
                break;
            }
            node.low = node.low.cwiseMin(relay.image);
            node.high = node.high.cwiseMax(relay.image);
            node.least_weight = std::min(node.least_weight, relay.weight);
        }
        const auto here = size_of(nodes_);
        nodes_.push_back(node);
        if (end - begin <= leaf_size) return;
        const Vec2 extent = node.high - node.low;
        const Eigen::Index axis = extent.x() > extent.y() ? 0 : 1;
        const Index middle = begin + (end - begin) / 2;
        std::nth_element(
            order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
            [&](Index a, Index b) { return relays_[a].image[axis] < relays_[b].image[axis]; });
        add_node(begin, middle);
        nodes_[here].second_half = size_of(nodes_);
        add_node(middle, end);
    }

    std::span<const PlanarRelay> relays_;
    std::vector<Index> order_;
    std::vector<Node> nodes_;
};

}  // namespace agvd
