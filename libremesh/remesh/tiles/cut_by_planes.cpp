// Each face goes down the tree as a convex polygon. Its sides are divided first, by all planes that
// they cross; so are the chords along which planes divide it. What divides a side depends on the
// positions of its ends and the tree alone, so both faces at an edge have the same points there.
#include "remesh/tiles/cut_by_planes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace remesh {
namespace {

using Polygon = std::vector<PartPoint>;

class PlaneCutter {
public:
    PlaneCutter(const MeshView& mesh, const PlaneTree& tree, double snap, Ticker& ticker)
        : mesh_(mesh), tree_(tree), snap_(snap), ticker_(ticker) {}

    CutMesh run() {
        made_.mesh.positions.assign(mesh_.positions.begin(), mesh_.positions.end());
        const std::size_t num_faces = mesh_.triangles.size();
        made_.mesh.triangles.reserve(num_faces);
        made_.parts.reserve(num_faces);
        made_.cell.reserve(num_faces);
        for (Index f = 0; f < num_faces; ++f) {
            ticker_.tick(16);
            cut_face(f);
        }
        return std::move(made_);
    }

private:
    void cut_face(Index f) {
        const Triangle& t = mesh_.triangles[f];
        Polygon polygon;
        for (Index k = 0; k < 3; ++k) {
            const Index next = (k + 1) % 3;
            append_side({t[k], whole_face[k]}, {t[next], whole_face[next]}, tree_.root(), polygon);
        }
        divide(f, tree_.root(), polygon);
    }

    // The distance of a vertex from a plane; 0: it lies on it.
    [[nodiscard]] double height(const PlaneTree::Node& node, Index vertex) const {
        const double height = node.normal.dot(made_.mesh.positions[vertex]) - node.offset;
        return std::abs(height) <= snap_ ? 0 : height;
    }

    // Appends the first end and the points where planes divide the way to the second one. A side
    // in a plane belongs to what is on both sides of it.
    void append_side(const PartPoint& from, const PartPoint& to, PlaneTree::Side side,
                     Polygon& points) {
        if (side.is_cell) {
            points.push_back(from);
            return;
        }
        const PlaneTree::Node& node = tree_.nodes[side.index];
        const double at_from = height(node, from.vertex), at_to = height(node, to.vertex);
        if (at_from == 0 && at_to == 0) {
            Polygon below;
            append_side(from, to, node.below, below);
            below.push_back(to);
            for (std::size_t i = 1; i < below.size(); ++i) {
                append_side(below[i - 1], below[i], node.above, points);
            }
        } else if (at_from * at_to < 0) {
            const PartPoint middle = point_between(side.index, from, to, at_from, at_to);
            append_side(from, middle, at_from < 0 ? node.below : node.above, points);
            append_side(middle, to, at_to < 0 ? node.below : node.above, points);
        } else {
            append_side(from, to, at_from + at_to < 0 ? node.below : node.above, points);
        }
    }

    // Where a side crosses the plane of a node.
    PartPoint point_between(Index node, const PartPoint& from, const PartPoint& to, double at_from,
                            double at_to) {
        std::vector<Vec3>& positions = made_.mesh.positions;
        const Vec3 &start = positions[from.vertex], &end = positions[to.vertex];
        if (std::lexicographical_compare(end.begin(), end.end(), start.begin(), start.end())) {
            return point_between(node, to, from, at_to, at_from);
        }
        const double share = at_from / (at_from - at_to);
        const auto [found, is_new] = vertex_at_.try_emplace({from.vertex, to.vertex, node},
                                                            static_cast<Index>(positions.size()));
        if (is_new) {
            const Vec3 point = (1 - share) * start + share * end;
            positions.push_back(point);
            made_at_.push_back(node);
        }
        return {found->second, between(from.weights, to.weights, share)};
    }

    // On which sides of a plane the corners of a polygon lie: -1, 0, 1. Where corners in the plane
    // part those below from those above, the nearest one of them is 0; others in the plane go with
    // their neighbours. Those that a later node made do not part: append_side() did not know them.
    // \return whether the plane divides the polygon.
    bool find_signs(Index number, const Polygon& polygon, std::vector<int>& sign) const {
        const PlaneTree::Node& node = tree_.nodes[number];
        const std::size_t n = polygon.size();
        sign.clear();
        bool is_below = false, is_above = false;
        for (const PartPoint& p : polygon) {
            const double at = height(node, p.vertex);
            sign.push_back(at < 0 ? -1 : at > 0 ? 1 : 0);
            is_below = is_below || at < 0;
            is_above = is_above || at > 0;
        }
        if (!is_below || !is_above) return false;
        const auto distance = [&](std::size_t i) {
            const Index vertex = polygon[i % n].vertex;
            const auto first_made = static_cast<Index>(mesh_.positions.size());
            if (vertex >= first_made && made_at_[vertex - first_made] > number) return infinity;
            return std::abs(node.normal.dot(made_.mesh.positions[vertex]) - node.offset);
        };
        std::size_t start = 0;
        while (sign[start] == 0) ++start;
        for (std::size_t i = start + 1; i < start + n; ++i) {
            if (sign[i % n] != 0) continue;
            std::size_t end = i, nearest = i;
            for (; sign[end % n] == 0; ++end) {
                if (distance(end) < distance(nearest)) nearest = end;
            }
            const int before = sign[(i - 1) % n], after = sign[end % n];
            for (; i < end; ++i) {
                if (before != after && i == nearest) continue;
                sign[i % n] = i < nearest ? before : after;
            }
        }
        return true;
    }

    void divide(Index f, PlaneTree::Side side, const Polygon& polygon) {
        if (side.is_cell) {
            add_piece(f, polygon, side.index);
            return;
        }
        const PlaneTree::Node& node = tree_.nodes[side.index];
        std::vector<int> sign;
        if (!find_signs(side.index, polygon, sign)) {
            const bool is_below = std::find(sign.begin(), sign.end(), -1) != sign.end();
            divide(f, is_below ? node.below : node.above, polygon);
            return;
        }
        const auto first =
            static_cast<std::size_t>(std::find(sign.begin(), sign.end(), 0) - sign.begin());
        const auto second = static_cast<std::size_t>(
            std::find(sign.begin() + static_cast<std::ptrdiff_t>(first) + 1, sign.end(), 0) -
            sign.begin());
        // From the first corner to the second one, and on to the first.
        Polygon one(polygon.begin() + static_cast<std::ptrdiff_t>(first),
                    polygon.begin() + static_cast<std::ptrdiff_t>(second));
        Polygon other(polygon.begin() + static_cast<std::ptrdiff_t>(second), polygon.end());
        other.insert(other.end(), polygon.begin(),
                     polygon.begin() + static_cast<std::ptrdiff_t>(first));
        append_side(polygon[second], polygon[first], side, one);
        append_side(polygon[first], polygon[second], side, other);
        const bool is_one_below = sign[first + 1] < 0;
        divide(f, node.below, is_one_below ? one : other);
        divide(f, node.above, is_one_below ? other : one);
    }

    void add_piece(Index f, const Polygon& polygon, Index cell) {
        if (polygon.size() == 3 && polygon[0].weights == whole_face[0] &&
            polygon[1].weights == whole_face[1] && polygon[2].weights == whole_face[2]) {
            made_.mesh.triangles.push_back(mesh_.triangles[f]);
            made_.parts.add_whole(f);
            made_.cell.push_back(cell);
            return;
        }
        for (const auto& [i, j, k] : triangulate_part(corners_of(mesh_, f), polygon)) {
            made_.mesh.triangles.push_back(
                {polygon[i].vertex, polygon[j].vertex, polygon[k].vertex});
            made_.parts.add(f, {polygon[i].weights, polygon[j].weights, polygon[k].weights});
            made_.cell.push_back(cell);
        }
    }

    const MeshView mesh_;
    const PlaneTree& tree_;
    const double snap_;
    Ticker& ticker_;
    CutMesh made_;
    std::map<std::tuple<Index, Index, Index>, Index> vertex_at_;  // By ends and node.
    std::vector<Index> made_at_;  // Of each new vertex: the first node that made it.
};

}  // namespace

CutMesh cut_by_planes(const MeshView& mesh, const PlaneTree& tree, double snap, Ticker ticker) {
    return PlaneCutter(mesh, tree, snap, ticker).run();
}

}  // namespace remesh
