#include "agvd/intrinsic/flat_vertices.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agvd/intrinsic/face_sides.h"
#include "agvd/intrinsic/flatten.h"
#include "agvd/intrinsic/vertex_ring.h"
#include "agvd/mesh/one_ring.h"

namespace agvd::detail {
namespace {

// Radians: rounding of the sum of a vertex's angles in the input.
constexpr double flat_enough = 1e-12;
// Of the faces' size: how far two edges that are one straight line bend by the rounding of charts.
constexpr double straight_enough = 1e-14;

class FlatVertices {
public:
    FlatVertices(Surface& surface, FaceCharts& charts, FaceHistory& history,
                 const std::vector<std::uint8_t>& is_kept, double min_length, Ticker& ticker)
        : surface_(surface),
          charts_(charts),
          history_(history),
          is_kept_(is_kept),
          min_length_(min_length),
          ticker_(ticker) {}

    // Rounds of vertices no two of which are neighbours: one after the other along a line, each
    // would change the faces of the one before, and points would pass as many operations as there
    // are vertices.
    RemovalCounts run() {
        std::vector<Index> waiting = find_flat();
        make_room(waiting.size());
        std::vector<std::uint32_t> round_of(surface_.num_vertices(), 0);
        std::size_t most_edges = few_edges;
        for (std::uint32_t round = 1; !waiting.empty(); ++round) {
            const Index before = counts_.vertices;
            bool has_large = false;
            std::vector<Index> left;
            for (const Index v : waiting) {
                ticker_.tick(removal_work);
                if (round_of[v] == round) {
                    left.push_back(v);
                } else if (num_edges(v) > most_edges) {
                    has_large = true;
                    left.push_back(v);
                } else if (is_dense(v) && remove(v)) {
                    ++counts_.vertices;
                    for (const Index w : around_) round_of[w] = round;
                }
            }
            waiting = std::move(left);
            if (counts_.vertices > before) continue;
            if (!has_large) break;
            most_edges *= 2;
        }
        return counts_;
    }

private:
    static constexpr std::size_t removal_work = 64;  // Steps that a vertex counts for.
    // Vertices of more edges wait: hubs of needles lose them while others go.
    static constexpr std::size_t few_edges = 8;

    [[nodiscard]] std::vector<Index> find_flat() {
        std::vector<Index> found;
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            ticker_.tick(4);
            if (surface_.outgoing[v] == no_index || surface_.is_boundary_vertex(v)) continue;
            if (!is_dense(v)) continue;
            if (may_be_flat(v) &&
                std::abs(cone_angle(surface_, v) - 2 * std::numbers::pi) < flat_enough) {
                found.push_back(v);
            }
        }
        return found;
    }

    // Not, where the product of the corners as complex numbers is clearly no multiple of 1: that is
    // had without an arc tangent for each.
    [[nodiscard]] bool may_be_flat(Index v) const {
        constexpr double clear = 1e-9;  // Radians.
        Vec2 product(1, 0);
        for_each_outgoing(surface_, v,
                          [&](Index h) { product = turned_by(product, surface_.apex[h]); });
        return !(std::abs(product.y()) > clear * std::abs(product.x()));
    }

    // For grids, whose vertices have six edges; what grows on the way would be copied, and pages
    // that nothing is written to cost nothing.
    void make_room(std::size_t num_vertices) {
        const std::size_t num_faces = surface_.num_faces();
        charts_.reserve(std::min(num_faces, 6 * num_vertices));
        history_.reserve(3 * num_vertices, 2 * num_vertices);
    }

    [[nodiscard]] std::size_t num_edges(Index v) const {
        std::size_t count = 0;
        for_each_outgoing(surface_, v, [&](Index) { ++count; });
        return count;
    }

    // It has a short edge, and none that is kept.
    [[nodiscard]] bool is_dense(Index v) const {
        bool is_short = false, is_free = true;
        for_each_outgoing(surface_, v, [&](Index h) {
            is_short = is_short || surface_.length_of(h) < min_length_;
            is_free = is_free && (is_kept_.empty() || is_kept_[surface_.edge[h]] == 0);
        });
        return is_short && is_free;
    }

    bool remove(Index v) {
        for (bool is_first = true;; is_first = false) {
            lay_ring(surface_, charts_, v, ring_);
            if (!ring_.is_simple) return false;
            if (is_first) {
                around_.clear();
                for (const Index h : ring_.half_edge) around_.push_back(surface_.head(h));
            }
            if (ring_.half_edge.size() == 3) break;
            if (ring_.half_edge.size() == 4 && straighten()) break;
            if (!flip_away()) return false;
        }
        for (const MergedFace& made : merge_ring(surface_, charts_, ring_)) {
            if (made.face != no_index) history_.add_merge(made);
        }
        return true;
    }

    // Turns the ring so that its first and third edge are one line, if two are.
    bool straighten() {
        for (int turn = 0; turn < 2; ++turn) {
            const Vec2 &a = ring_.spoke[0], &b = ring_.spoke[2];
            const double size = std::max(ring_.spoke[1].norm(), ring_.spoke[3].norm());
            if (a.dot(b) < 0 && std::abs(cross(a, b)) <= straight_enough * size * (a - b).norm()) {
                return true;
            }
            if (turn == 0) rotate_ring(ring_);
        }
        return false;
    }

    // Flips the edge at the vertex whose flip leaves the best triangle behind.
    bool flip_away() {
        Index best = no_index;
        double best_quality = -1;
        for (const Index h : ring_.half_edge) {
            const Quad quad = quad_at(surface_, charts_, h);
            const Vec2 a = quad.apex - quad.head, b = quad.across - quad.head;
            const double squares = a.squaredNorm() + b.squaredNorm() + (a - b).squaredNorm();
            const double quality = std::abs(cross(a, b)) / squares;
            if (!(quality > best_quality) || !quad.is_convex()) continue;
            best_quality = quality;
            best = h;
        }
        if (best == no_index) return false;
        const Quad quad = quad_at(surface_, charts_, best);
        history_.add_flip(best, surface_.twin[best], quad.shares());
        flip(surface_, charts_, best, quad);
        ++counts_.flips;
        return true;
    }

    Surface& surface_;
    FaceCharts& charts_;
    FaceHistory& history_;
    const std::vector<std::uint8_t>& is_kept_;
    double min_length_;
    Ticker& ticker_;
    VertexRing ring_;
    std::vector<Index> around_;
    RemovalCounts counts_;
};

}  // namespace

RemovalCounts remove_flat_vertices(Surface& surface, FaceCharts& charts, FaceHistory& history,
                                   const std::vector<std::uint8_t>& is_kept, double min_length,
                                   Ticker& ticker) {
    return FlatVertices(surface, charts, history, is_kept, min_length, ticker).run();
}

namespace {

void move_face(Surface& surface, Index from, Index to) {
    surface.mesh.triangles[to] = surface.mesh.triangles[from];
    for (Index k = 0; k < 3; ++k) {
        const Index old = 3 * from + k, now = 3 * to + k;
        Index twin = surface.twin[old];
        if (twin != no_index && Surface::face(twin) == from) twin = 3 * to + twin % 3;
        surface.apex[now] = surface.apex[old];
        surface.twin[old] = no_index;
        join(surface, now, twin, surface.edge[old]);
        Index& outgoing = surface.outgoing[surface.tail(now)];
        if (outgoing == old) outgoing = now;
    }
}

void compact_edges(Surface& surface) {
    std::vector<Index> number(surface.num_edges(), no_index);
    Index count = 0;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (surface.edge_half[e] == no_index) continue;
        number[e] = count;
        surface.edge_half[count] = surface.edge_half[e];
        surface.length[count++] = surface.length[e];
    }
    surface.edge_half.resize(count);
    surface.length.resize(count);
    surface.edge_half.shrink_to_fit();
    surface.length.shrink_to_fit();
    for (Index& e : surface.edge) e = number[e];
}

}  // namespace

void compact_faces(Surface& surface, FaceHistory& history) {
    const auto is_gap = [&](Index f) { return surface.mesh.triangles[f][0] == no_index; };
    Index last = surface.num_faces();
    for (Index f = 0; f < last; ++f) {
        if (!is_gap(f)) continue;
        while (last > f && is_gap(last - 1)) --last;
        if (last <= f + 1) break;
        move_face(surface, --last, f);
        history.move_face(last, f);
    }
    while (last > 0 && is_gap(last - 1)) --last;
    surface.mesh.triangles.resize(last);
    surface.twin.resize(3 * last);
    surface.edge.resize(3 * last);
    surface.apex.resize(3 * last);
    surface.mesh.triangles.shrink_to_fit();
    surface.twin.shrink_to_fit();
    surface.edge.shrink_to_fit();
    surface.apex.shrink_to_fit();
    history.drop_faces_from(last);
    compact_edges(surface);
}

}  // namespace agvd::detail
