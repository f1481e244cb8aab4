//! \file
//! Finds the marked corners of a polygon in a box. Private to the readers.
#pragma once

#include <vector>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh {

//! A kd-tree of fixed points, some of which are marked; each node stores their number.
class CornerTree {
public:
    //! None is marked. Cost: O(n log n).
    explicit CornerTree(const std::vector<Vec2>& points);

    //! Cost: O(log n).
    void mark(std::size_t point, bool is_marked);

    //! Calls visit(point) for the marked points of the box, edges included, until one says true.
    //! \return whether one did. Cost: O(sqrt n + points in the box).
    template <typename Visit>
    [[nodiscard]] bool any_in(const Vec2& low, const Vec2& high, const Visit& visit) const {
        return any_below(0, low, high, visit);
    }

private:
    struct Node {
        std::size_t begin, end;  // Of order_.
        std::size_t parent;
        std::size_t left = 0, right = 0;  // 0: a leaf.
        std::size_t num_marked = 0;
        Vec2 low, high;
    };

    void build(std::size_t begin, std::size_t end, std::size_t parent);

    template <typename Visit>
    [[nodiscard]] bool any_below(std::size_t index, const Vec2& low, const Vec2& high,
                                 const Visit& visit) const {
        const Node& node = nodes_[index];
        if (node.num_marked == 0 || (node.low.array() > high.array()).any() ||
            (node.high.array() < low.array()).any()) {
            return false;
        }
        if (node.left != 0) {
            return any_below(node.left, low, high, visit) ||
                   any_below(node.right, low, high, visit);
        }
        for (std::size_t i = node.begin; i < node.end; ++i) {
            const std::size_t point = order_[i];
            if (is_marked_[point] == 0) continue;
            const Vec2& p = points_[point];
            if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) continue;
            if (visit(point)) return true;
        }
        return false;
    }

    std::vector<Vec2> points_;
    std::vector<std::size_t> order_;  // Points by leaf.
    std::vector<std::size_t> leaf_;   // By point.
    std::vector<std::uint8_t> is_marked_;
    std::vector<Node> nodes_;  // Depth first.
};

}  // namespace remesh
