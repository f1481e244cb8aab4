// A queue holds the edges whose opposite angles sum to more than pi. An edge is flipped if the new
// edge meets the condition and nothing folds in space; the four edges around it are then tested
// again. Notation: edge (a, b) lies in triangles (a, b, c) and (b, a, d).
#include "remesh/dual/delaunay_flips.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

#include "remesh/dual/edge_paths.h"

namespace remesh {

namespace {

// Radians. Two right angles opposite an edge are Delaunay.
constexpr double delaunay_tolerance = 1e-6;
// A flip may always leave this cosine between the normals of two triangles.
constexpr double gentle_fold = 0.5;
constexpr std::size_t max_flips_per_edge = 10;

// The angle opposite side a as (cos, sin) times a positive number; 0 or pi if rounding leaves no
// triangle. The area follows [kahan2014].
Vec2 corner_opposite(double a, double b, double c) {
    const double x = std::max({a, b, c}), z = std::min({a, b, c});
    const double y = std::max(std::min(a, b), std::min(std::max(a, b), c));
    const double product = (x + (y + z)) * (z - (x - y)) * (z + (x - y)) * (x + (y - z));
    return {(b - a) * (b + a) + c * c, std::sqrt(std::max(product, 0.0))};
}

bool is_above_pi(const Vec2& a, const Vec2& b) {
    // The sine of the sum decides most cases without angles.
    if (a.x() * b.y() + a.y() * b.x() > 0) return false;
    return std::atan2(a.y(), a.x()) + std::atan2(b.y(), b.x()) >
           std::numbers::pi + delaunay_tolerance;
}

bool is_non_delaunay(const FlippableMesh& mesh, std::span<const double> length, Index edge) {
    const auto corner = [&](Index h) {
        return corner_opposite(length[edge], length[mesh.edge(FlippableMesh::next(h))],
                               length[mesh.edge(FlippableMesh::previous(h))]);
    };
    return is_above_pi(corner(mesh.sides(edge)[0]), corner(mesh.sides(edge)[1]));
}

// The corners around an edge and the edges between them: a is the tail of its first side, c and d
// lie opposite, as in triangles (a, b, c) and (b, a, d).
struct Quad {
    Index a, b, c, d;
    Index bc, ca, ad, db;  // Half-edges.

    Quad(const FlippableMesh& mesh, Index edge) {
        const auto [h, g] = mesh.sides(edge);
        bc = FlippableMesh::next(h);
        ca = FlippableMesh::previous(h);
        ad = FlippableMesh::next(g);
        db = FlippableMesh::previous(g);
        a = mesh.tail(h);
        b = mesh.tail(g);
        c = mesh.tail(ca);
        d = mesh.tail(db);
    }
};

class Flipper {
public:
    Flipper(FlippableMesh& mesh, std::vector<double>& length, std::span<const Vec3> positions,
            const Diagonals& diagonals, Ticker ticker)
        : ticker_(ticker),
          mesh_(mesh),
          length_(length),
          positions_(positions),
          diagonals_(diagonals),
          is_queued_(mesh.num_edges(), false) {}

    FlipCounts run() {
        FlipCounts counts;
        for (Index e = 0; e < mesh_.num_edges(); ++e) {
            ticker_.tick(2);
            if (mesh_.is_inner(e) && is_non_delaunay(mesh_, length_, e)) enqueue(e);
        }
        counts.failing_before = counts.failing_after = static_cast<Index>(queue_.size());
        const std::size_t max_flips = max_flips_per_edge * mesh_.num_edges();
        while (!queue_.empty()) {
            ticker_.tick(8);
            const Index edge = queue_.front();
            queue_.pop_front();
            is_queued_[edge] = false;
            if (!is_non_delaunay(mesh_, length_, edge)) continue;
            if (counts.flips == max_flips) {
                counts.is_finished = false;
                break;
            }
            if (try_flip(edge)) ++counts.flips;
        }
        if (counts.flips == 0) return counts;
        counts.failing_after = 0;
        for (Index e = 0; e < mesh_.num_edges(); ++e) {
            ticker_.tick(2);
            if (mesh_.is_inner(e) && is_non_delaunay(mesh_, length_, e)) ++counts.failing_after;
        }
        return counts;
    }

private:
    void enqueue(Index edge) {
        if (is_queued_[edge] || !mesh_.is_inner(edge)) return;
        is_queued_[edge] = true;
        queue_.push_back(edge);
    }

    bool try_flip(Index edge) {
        if (!mesh_.can_flip(edge)) return false;
        const Quad quad(mesh_, edge);
        if (folds(quad)) return false;
        const double diagonal = diagonals_.measure(edge);
        const auto length = [&](Index h) { return length_[mesh_.edge(h)]; };
        const double bc = length(quad.bc), ca = length(quad.ca), ad = length(quad.ad),
                     db = length(quad.db);
        if (!is_triangle(diagonal, ca, ad) || !is_triangle(diagonal, db, bc)) return false;
        if (is_above_pi(corner_opposite(diagonal, ca, ad), corner_opposite(diagonal, db, bc))) {
            return false;
        }
        mesh_.flip(edge);
        length_[edge] = diagonal;
        diagonals_.accept(edge);
        const Quad flipped(mesh_, edge);
        for (const Index h : {flipped.bc, flipped.ca, flipped.ad, flipped.db}) {
            enqueue(mesh_.edge(h));
        }
        return true;
    }

    [[nodiscard]] Vec3 normal(Index a, Index b, Index c) const {
        return (positions_[b] - positions_[a]).cross(positions_[c] - positions_[a]).normalized();
    }

    // Whether the flip would make an edge here sharper than gentle_fold and than all were before.
    [[nodiscard]] bool folds(const Quad& quad) const {
        const auto [a, b, c, d] = std::array{quad.a, quad.b, quad.c, quad.d};
        const Vec3 old_first = normal(a, b, c), old_second = normal(b, a, d);
        const Vec3 new_first = normal(c, a, d), new_second = normal(d, b, c);
        if (new_first.isZero() || new_second.isZero()) return true;  // No area.
        double before = old_first.dot(old_second);
        double after = new_first.dot(new_second);
        const auto compare = [&](Index half_edge, const Vec3& old_normal, const Vec3& new_normal) {
            const Index rim = mesh_.edge(half_edge);
            if (!mesh_.is_inner(rim)) return;
            const auto& sides = mesh_.sides(rim);
            const Index across = sides[0] == half_edge ? sides[1] : sides[0];
            const Triangle& t = mesh_.triangles()[across / 3];
            const Vec3 beyond = normal(t[0], t[1], t[2]);
            before = std::min(before, beyond.dot(old_normal));
            after = std::min(after, beyond.dot(new_normal));
        };
        compare(quad.bc, old_first, new_second);
        compare(quad.ca, old_first, new_first);
        compare(quad.ad, old_second, new_first);
        compare(quad.db, old_second, new_second);
        return !(after >= std::min(before, gentle_fold));
    }

    Ticker ticker_;
    FlippableMesh& mesh_;
    std::vector<double>& length_;
    std::span<const Vec3> positions_;
    const Diagonals& diagonals_;
    std::deque<Index> queue_;
    std::vector<bool> is_queued_;
};

}  // namespace

FlipCounts flip_to_delaunay(FlippableMesh& mesh, std::vector<double>& length,
                            std::span<const Vec3> positions, const Diagonals& diagonals,
                            Ticker ticker) {
    return Flipper(mesh, length, positions, diagonals, ticker).run();
}

}  // namespace remesh
