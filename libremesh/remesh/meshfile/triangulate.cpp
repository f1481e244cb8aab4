// A quad is cut along the shorter of its inner diagonals. Larger polygons are projected into a
// plane and lose one ear after the other (Meisters 1975); a kd-tree finds the reflex corners
// inside an ear.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "remesh/meshfile/mesh_file.h"

namespace remesh {
namespace {

// A kd-tree of fixed points, some of which are marked; each node stores their number. Below node i
// are the nodes 2 i and 2 i + 1; the first one is 1, and the last half of all are leaves.
class CornerTree {
public:
    // None is marked. Cost: O(n log n).
    explicit CornerTree(const std::vector<Vec2>& points)
        : points_(points),
          order_(points.size()),
          leaf_(points.size()),
          is_marked_(points.size(), 0) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        while (num_leaves_ * most_in_leaf < points.size()) num_leaves_ *= 2;
        nodes_.resize(2 * num_leaves_);
        build(1, 0, points.size());
    }

    // Cost: O(log n).
    void mark(std::size_t point, bool is_marked) {
        if ((is_marked_[point] != 0) == is_marked) return;
        is_marked_[point] = is_marked ? 1 : 0;
        for (std::size_t i = leaf_[point]; i > 0; i /= 2) {
            is_marked ? ++nodes_[i].num_marked : --nodes_[i].num_marked;
        }
    }

    // Whether the test is true for a marked point of the box, edges included, below a node.
    // Cost: O(sqrt n + points in the box).
    template <typename Test>
    [[nodiscard]] bool any_in(const Vec2& low, const Vec2& high, const Test& test,
                              std::size_t index = 1) const {
        const auto is_apart = [&](const Vec2& least, const Vec2& most) {
            return (least.array() > high.array()).any() || (most.array() < low.array()).any();
        };
        const Node& node = nodes_[index];
        if (node.num_marked == 0 || is_apart(node.low, node.high)) return false;
        if (index < num_leaves_) {
            return any_in(low, high, test, 2 * index) || any_in(low, high, test, 2 * index + 1);
        }
        for (std::size_t i = node.begin; i < node.end; ++i) {
            const std::size_t point = order_[i];
            if (is_marked_[point] == 0 || is_apart(points_[point], points_[point])) continue;
            if (test(point)) return true;
        }
        return false;
    }

private:
    static constexpr std::size_t most_in_leaf = 16;
    struct Node {
        std::size_t begin = 0, end = 0;  // Of order_.
        std::size_t num_marked = 0;
        Vec2 low, high;
    };

    void build(std::size_t index, std::size_t begin, std::size_t end) {
        Node node{begin, end, 0, points_[order_[begin]], points_[order_[begin]]};
        for (std::size_t i = begin; i < end; ++i) {
            node.low = node.low.cwiseMin(points_[order_[i]]);
            node.high = node.high.cwiseMax(points_[order_[i]]);
        }
        nodes_[index] = node;
        if (index >= num_leaves_) {
            for (std::size_t i = begin; i < end; ++i) leaf_[order_[i]] = index;
            return;
        }
        const Vec2 size = node.high - node.low;
        const int axis = size.x() >= size.y() ? 0 : 1;
        const std::size_t middle = begin + (end - begin) / 2;
        const auto at = [&](std::size_t i) {
            return order_.begin() + static_cast<std::ptrdiff_t>(i);
        };
        std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) {
            return points_[a][axis] < points_[b][axis];
        });
        build(2 * index, begin, middle);
        build(2 * index + 1, middle, end);
    }

    std::vector<Vec2> points_;
    std::vector<std::size_t> order_;  // Points by leaf.
    std::vector<std::size_t> leaf_;   // By point.
    std::vector<std::uint8_t> is_marked_;
    std::size_t num_leaves_ = 1;
    std::vector<Node> nodes_;
};

// Newell's normal, twice the area long; relative to the first corner to keep digits.
Vec3 normal_of(std::span<const Index> polygon, std::span<const Vec3> positions) {
    const Vec3 origin = positions[polygon[0]];
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        normal += (positions[polygon[i]] - origin).cross(positions[polygon[i + 1]] - origin);
    }
    return normal;
}

void append_quad(std::span<const Index> q, std::span<const Vec3> positions,
                 std::vector<Triangle>& triangles) {
    const Vec3 normal = normal_of(q, positions);
    const auto faces_up = [&](std::size_t i, std::size_t j, std::size_t k) {
        const Vec3& a = positions[q[i]];
        return normal.dot((positions[q[j]] - a).cross(positions[q[k]] - a)) > 0;
    };
    const bool is_02_inside = faces_up(0, 1, 2) && faces_up(0, 2, 3);
    const bool is_13_inside = faces_up(0, 1, 3) && faces_up(1, 2, 3);
    const bool is_02_shorter = (positions[q[0]] - positions[q[2]]).squaredNorm() <=
                               (positions[q[1]] - positions[q[3]]).squaredNorm();
    if (is_02_inside == is_13_inside ? is_02_shorter : is_02_inside) {
        triangles.push_back({q[0], q[1], q[2]});
        triangles.push_back({q[0], q[2], q[3]});
    } else {
        triangles.push_back({q[0], q[1], q[3]});
        triangles.push_back({q[1], q[2], q[3]});
    }
}

// The polygon projected along its normal's largest component, counter-clockwise; no digit is lost.
std::vector<Vec2> project(std::span<const Index> polygon, std::span<const Vec3> positions) {
    const Vec3 normal = normal_of(polygon, positions);
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(u, v);
    std::vector<Vec2> flat;
    flat.reserve(polygon.size());
    for (const Index i : polygon) flat.emplace_back(positions[i][u], positions[i][v]);
    return flat;
}

// The rest of a polygon during ear clipping: a cycle of corners in a linked list.
struct Ring {
    std::vector<Vec2> point;
    std::vector<std::size_t> previous, next;
    CornerTree reflex;  // Corners that do not turn left.

    explicit Ring(std::vector<Vec2> points)
        : point(std::move(points)), previous(point.size()), next(point.size()), reflex(point) {
        for (std::size_t i = 0; i < point.size(); ++i) {
            next[i] = (i + 1) % point.size();
            previous[next[i]] = i;
        }
        for (std::size_t i = 0; i < point.size(); ++i) reflex.mark(i, !(turn(i) > 0));
    }

    [[nodiscard]] double turn(std::size_t i) const {
        const Vec2& at = point[previous[i]];
        return cross(point[i] - at, point[next[i]] - at);
    }

    // The triangle at corner i turns left and holds no other corner. Corners at the position of one
    // of its own do not count: holes joined by a bridge repeat them. Only reflex corners need a
    // test, as the first corner to enter the triangle would be one.
    [[nodiscard]] bool is_ear(std::size_t i) const {
        if (!(turn(i) > 0)) return false;
        const Vec2 &a = point[previous[i]], &b = point[i], &c = point[next[i]];
        const auto is_inside = [&](std::size_t j) {
            const Vec2& p = point[j];
            if (p == a || p == b || p == c) return false;
            return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
        };
        return !reflex.any_in(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), is_inside);
    }

    void remove(std::size_t i) {
        next[previous[i]] = next[i];
        previous[next[i]] = previous[i];
        reflex.mark(i, false);
        for (const std::size_t j : {previous[i], next[i]}) reflex.mark(j, !(turn(j) > 0));
    }
};

}  // namespace

void append_triangles(std::span<const Index> polygon, std::span<const Vec3> positions,
                      Ticker& ticker, std::vector<Triangle>& triangles) {
    if (polygon.size() == 3) {
        triangles.push_back({polygon[0], polygon[1], polygon[2]});
        return;
    }
    if (polygon.size() == 4) {
        append_quad(polygon, positions, triangles);
        return;
    }
    Ring ring(project(polygon, positions));
    const auto clip = [&](std::size_t i) {
        triangles.push_back({polygon[ring.previous[i]], polygon[i], polygon[ring.next[i]]});
        ring.remove(i);
    };
    std::size_t corner = 1, failed = 0, left = polygon.size();
    for (; left > 3 && failed < left; corner = ring.next[corner]) {
        ticker.tick(8);
        if (!ring.is_ear(corner)) {
            ++failed;
            continue;
        }
        clip(corner);
        --left;
        failed = 0;
        // Clips every other corner first, which halves the polygon in each round; clipping at one
        // place would make a fan of slivers.
        corner = ring.next[corner];
    }
    for (; left > 2; --left) clip(corner = ring.next[corner]);
}

}  // namespace remesh
