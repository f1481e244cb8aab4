// Each face goes down the tree as a convex polygon, which the planes divide. A point on a side has
// the ends of that side and the plane as its name, so both faces at an edge find the same one.
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
    struct Piece {
        Polygon polygon;
        Index cell;
    };

    void cut_face(Index f) {
        const Triangle& t = mesh_.triangles[f];
        pieces_.clear();
        divided_.clear();
        divide(tree_.root(), {{t[0], whole_face[0]}, {t[1], whole_face[1]}, {t[2], whole_face[2]}});
        if (pieces_.size() == 1 && divided_.empty()) {
            made_.mesh.triangles.push_back(t);
            made_.parts.add_whole(f);
            made_.cell.push_back(pieces_[0].cell);
            return;
        }
        for (const Piece& piece : pieces_) add_piece(f, piece);
    }

    // The distances from the plane, as -1, 0, 1. A polygon that crosses the plane has two zeros, or
    // sides across, in places that part it; zeros beside these count for the side that they join.
    // \return whether it crosses.
    bool find_signs(const PlaneTree::Node& node, const Polygon& polygon) {
        const std::size_t n = polygon.size();
        distance_.clear();
        sign_.clear();
        bool is_below = false, is_above = false;
        for (const PartPoint& p : polygon) {
            const double d = node.normal.dot(made_.mesh.positions[p.vertex]) - node.offset;
            distance_.push_back(std::abs(d));
            sign_.push_back(std::abs(d) <= snap_ ? 0 : d < 0 ? -1 : 1);
            is_below = is_below || sign_.back() < 0;
            is_above = is_above || sign_.back() > 0;
        }
        if (!is_below || !is_above) return false;
        std::size_t start = 0;
        while (sign_[start] == 0) ++start;
        for (std::size_t i = 1; i <= n;) {
            if (sign_[(start + i) % n] != 0) {
                ++i;
                continue;
            }
            std::size_t end = i, nearest = i;
            for (; sign_[(start + end) % n] == 0; ++end) {
                if (distance_[(start + end) % n] < distance_[(start + nearest) % n]) nearest = end;
            }
            const int before = sign_[(start + i - 1) % n], after = sign_[(start + end) % n];
            for (std::size_t j = i; j < end; ++j) {
                if (before != after && j == nearest) continue;
                sign_[(start + j) % n] = j < nearest ? before : after;
            }
            i = end;
        }
        return true;
    }

    void divide(PlaneTree::Side side, const Polygon& polygon) {
        if (side.is_cell) {
            pieces_.push_back({polygon, side.index});
            return;
        }
        const PlaneTree::Node& node = tree_.nodes[side.index];
        if (!find_signs(node, polygon)) {
            const bool is_below = std::find(sign_.begin(), sign_.end(), -1) != sign_.end();
            divide(is_below ? node.below : node.above, polygon);
            return;
        }
        Polygon below, above;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const std::size_t next = (i + 1) % polygon.size();
            if (sign_[i] <= 0) below.push_back(polygon[i]);
            if (sign_[i] >= 0) above.push_back(polygon[i]);
            if (sign_[i] * sign_[next] >= 0) continue;
            const PartPoint added = point_on_side(side.index, polygon, i, next);
            below.push_back(added);
            above.push_back(added);
        }
        divide(node.below, below);
        divide(node.above, above);
    }

    // Where a side crosses the plane of a node.
    PartPoint point_on_side(Index node, const Polygon& polygon, std::size_t from, std::size_t to) {
        if (polygon[from].vertex > polygon[to].vertex) std::swap(from, to);
        const PartPoint &a = polygon[from], &b = polygon[to];
        const double share = distance_[from] / (distance_[from] + distance_[to]);
        std::vector<Vec3>& positions = made_.mesh.positions;
        const auto [found, is_new] =
            vertex_at_.try_emplace({a.vertex, b.vertex, node}, static_cast<Index>(positions.size()));
        if (is_new) {
            positions.emplace_back((1 - share) * positions[a.vertex] + share * positions[b.vertex]);
        }
        PartPoint added{found->second, between(a.weights, b.weights, share)};
        divided_.push_back({a.vertex, b.vertex, added});
        return added;
    }

    // A side of one piece may be two sides of those behind it.
    void append_side(const PartPoint& from, const PartPoint& to, Polygon& polygon) const {
        const auto [low, high] = std::minmax(from.vertex, to.vertex);
        const auto found = std::find_if(divided_.begin(), divided_.end(), [&](const Divided& d) {
            return d.low == low && d.high == high;
        });
        if (found == divided_.end()) {
            polygon.push_back(from);
            return;
        }
        append_side(from, found->middle, polygon);
        append_side(found->middle, to, polygon);
    }

    void add_piece(Index f, const Piece& piece) {
        Polygon polygon;
        const std::size_t n = piece.polygon.size();
        for (std::size_t i = 0; i < n; ++i) {
            append_side(piece.polygon[i], piece.polygon[(i + 1) % n], polygon);
        }
        for (const auto& [i, j, k] : triangulate_part(corners_of(mesh_, f), polygon)) {
            made_.mesh.triangles.push_back(
                {polygon[i].vertex, polygon[j].vertex, polygon[k].vertex});
            made_.parts.add(f, {polygon[i].weights, polygon[j].weights, polygon[k].weights});
            made_.cell.push_back(piece.cell);
        }
    }

    struct Divided {
        Index low, high;  // Ends of a side.
        PartPoint middle;
    };

    const MeshView mesh_;
    const PlaneTree& tree_;
    const double snap_;
    Ticker& ticker_;
    CutMesh made_;
    std::map<std::tuple<Index, Index, Index>, Index> vertex_at_;  // By ends and node.
    // Of the face in work.
    std::vector<Piece> pieces_;
    std::vector<Divided> divided_;
    // Of the polygon in work.
    std::vector<double> distance_;
    std::vector<int> sign_;
};

}  // namespace

CutMesh cut_by_planes(const MeshView& mesh, const PlaneTree& tree, double snap, Ticker ticker) {
    return PlaneCutter(mesh, tree, snap, ticker).run();
}

}  // namespace remesh
