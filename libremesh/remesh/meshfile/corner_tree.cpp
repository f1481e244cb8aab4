#include "remesh/meshfile/corner_tree.h"

#include <algorithm>
#include <numeric>

namespace remesh {

namespace {

constexpr std::size_t most_in_leaf = 16;
constexpr std::size_t no_parent = ~std::size_t{0};

}  // namespace

CornerTree::CornerTree(const std::vector<Vec2>& points)
    : points_(points), order_(points.size()), leaf_(points.size()), is_marked_(points.size(), 0) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    build(0, points.size(), no_parent);
}

void CornerTree::build(std::size_t begin, std::size_t end, std::size_t parent) {
    const std::size_t index = nodes_.size();
    Node node{begin, end, parent, 0, 0, 0, points_[order_[begin]], points_[order_[begin]]};
    for (std::size_t i = begin; i < end; ++i) {
        node.low = node.low.cwiseMin(points_[order_[i]]);
        node.high = node.high.cwiseMax(points_[order_[i]]);
    }
    nodes_.push_back(node);
    if (end - begin <= most_in_leaf) {
        for (std::size_t i = begin; i < end; ++i) leaf_[order_[i]] = index;
        return;
    }
    const Vec2 size = node.high - node.low;
    const int axis = size.x() >= size.y() ? 0 : 1;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) {
        return points_[a][axis] < points_[b][axis];
    });
    nodes_[index].left = nodes_.size();
    build(begin, middle, index);
    nodes_[index].right = nodes_.size();
    build(middle, end, index);
}

void CornerTree::mark(std::size_t point, bool is_marked) {
    if ((is_marked_[point] != 0) == is_marked) return;
    is_marked_[point] = is_marked ? 1 : 0;
    for (std::size_t i = leaf_[point]; i != no_parent; i = nodes_[i].parent) {
        is_marked ? ++nodes_[i].num_marked : --nodes_[i].num_marked;
    }
}

}  // namespace remesh
