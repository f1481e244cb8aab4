// Removes vertices in the order of (curvature + a small constant) times mean edge length
// ([liu2023]). The lengths around the vertex are scaled by one factor until its angles sum to 2 pi
// (pi on the boundary), which is a conformal change ([springborn2008]). Its edges are flipped away,
// the one that gives the best triangle first, until three faces (two on the boundary) are left,
// which merge. The rest is kept Delaunay, and no flip may repeat an edge. Vertices that cannot be
// removed in this way are tried again with the lengths of straight edges in space.
#include "agvd/intrinsic/vertex_removal.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <queue>

#include "agvd/intrinsic/delaunay_queue.h"
#include "agvd/intrinsic/face_sides.h"
#include "agvd/intrinsic/flatten.h"
#include "agvd/intrinsic/simplicial.h"
#include "agvd/intrinsic/vertex_operations.h"
#include "agvd/mesh/one_ring.h"

namespace agvd::detail {
namespace {

// Radians: a vertex flatter than this counts as flat.
constexpr double flat_tolerance = 1e-9;
// Radians: among vertices flatter than this, those in dense regions go first.
constexpr double small_curvature = 1e-2;
// The most flips for each edge.
constexpr std::size_t most_flips = 1000;

enum class Lengths : std::uint8_t { OnSurface, InSpace };

class VertexRemover {
public:
    VertexRemover(Surface& surface, FaceCharts& charts, const std::vector<Index>& number)
        : surface_(surface),
          charts_(charts),
          number_(number),
          stamp_(surface.num_vertices(), 0),
          flips_(surface, charts, nullptr, none_kept_, nullptr,
                 [this](Index h) { return may_flip(h); }) {}

    std::size_t run() {
        for (Index e = 0; e < surface_.num_edges(); ++e) flips_.push(e);
        flip_all();
        remove_all();
        if (num_left_ > 0) {
            measure_in_space();
            remove_all();
        }
        return flips_.num_flips() + num_own_flips_;
    }

private:
    struct Waiting {
        double cost;
        Index vertex;
        std::uint32_t stamp;

        // Reversed, so that the least is on top of a heap.
        [[nodiscard]] bool operator<(const Waiting& other) const {
            return cost != other.cost ? cost > other.cost : vertex > other.vertex;
        }
    };

    void remove_all() {
        num_left_ = 0;
        for (Index v = 0; v < surface_.num_vertices(); ++v) judge(v);
        while (!queue_.empty()) {
            const Waiting next = queue_.top();
            queue_.pop();
            if (next.stamp != stamp_[next.vertex]) continue;
            if (!remove(next.vertex)) ++num_left_;
            flip_all();
            for (const Index v : ring_) judge(v);
        }
        num_left_ = 0;
        for (Index v = 0; v < surface_.num_vertices(); ++v) num_left_ += is_to_go(v) ? 1 : 0;
    }

    [[nodiscard]] bool is_to_go(Index v) const {
        return number_[v] == no_index && surface_.outgoing[v] != no_index;
    }

    [[nodiscard]] double flat_angle(Index v) const {
        return surface_.is_boundary_vertex(v) ? std::numbers::pi : 2 * std::numbers::pi;
    }

    void judge(Index v) {
        if (!is_to_go(v)) return;
        double length = 0;
        Index num_faces = 0;
        for_each_outgoing(surface_, v, [&](Index h) {
            length += surface_.length_of(h);
            ++num_faces;
        });
        const double curvature = std::abs(flat_angle(v) - cone_angle(surface_, v));
        queue_.push({(curvature + small_curvature) * length / num_faces, v, ++stamp_[v]});
    }

    // Afterwards ring_ holds the vertices whose priority may have changed.
    bool remove(Index v) {
        ring_.clear();
        const double angle = cone_angle(surface_, v), wanted = flat_angle(v);
        const bool is_boundary = surface_.is_boundary_vertex(v);
        collect_faces(v);
        if (is_boundary && faces_.size() == 1) return cut_ear(v);
        if (lengths_ == Lengths::OnSurface && std::abs(angle - wanted) > flat_tolerance &&
            !flatten(surface_, charts_, v, wanted)) {
            return false;
        }
        const std::size_t fewest = is_boundary ? 2 : 3;
        bool is_free = true;
        while (faces_.size() > fewest && is_free) is_free = flip_away(v);
        is_free = is_free && may_drop(v, is_boundary);
        for (const Index f : faces_) {
            for (const Index w : surface_.mesh.triangles[f]) {
                if (w != v) ring_.push_back(w);
            }
        }
        const std::vector<Index> faces = faces_;
        if (is_free) drop(v, is_boundary);
        for (const Index f : is_free ? std::vector<Index>{faces[0]} : faces) push_sides(f);
        if (!is_free) ring_.clear();
        return is_free;
    }

    void collect_faces(Index v) {
        faces_.clear();
        spokes_.clear();
        for_each_outgoing(surface_, v, [&](Index h) {
            faces_.push_back(Surface::face(h));
            spokes_.push_back(h);
        });
    }

    // Flips the edge at v whose flip gives the best triangle without v.
    bool flip_away(Index v) {
        Index best = no_index;
        double best_quality = -1;
        for (const Index h : spokes_) {
            if (surface_.twin[h] == no_index || !may_flip(h)) continue;
            const Quad quad = quad_at(surface_, h);
            if (lengths_ == Lengths::OnSurface && !quad.is_convex()) continue;
            const double quality = quality_behind(h, quad);
            if (quality > best_quality) {
                best_quality = quality;
                best = h;
            }
        }
        if (best == no_index) return false;
        flip_edge(best);
        collect_faces(v);
        return true;
    }

    // The quality of the triangle at the head after the flip: its area over the squares of its
    // sides.
    [[nodiscard]] double quality_behind(Index h, const Quad& quad) const {
        if (lengths_ == Lengths::InSpace) {
            const Vec3& a = surface_.mesh.positions[surface_.head(h)];
            const Vec3 b = surface_.mesh.positions[apex(h)] - a;
            const Vec3 c = surface_.mesh.positions[apex(surface_.twin[h])] - a;
            const double squares = b.squaredNorm() + c.squaredNorm() + (b - c).squaredNorm();
            return squares > 0 ? b.cross(c).norm() / squares : 0;
        }
        const Vec2 b = quad.apex - quad.head, c = quad.across - quad.head;
        const double area = std::abs(b.x() * c.y() - b.y() * c.x());
        return area / (b.squaredNorm() + c.squaredNorm() + (b - c).squaredNorm());
    }

    void flip_edge(Index h) {
        const Index edge = surface_.edge[h];
        const std::array faces{Surface::face(h), Surface::face(surface_.twin[h])};
        flip(surface_, charts_, h, quad_at(surface_, charts_, h));
        ++num_own_flips_;
        push_sides(faces[0]);
        push_sides(faces[1]);
        if (lengths_ == Lengths::OnSurface) return;
        surface_.length[edge] = distance(surface_.edge_half[edge]);
        for (const Index f : faces) renew_face(surface_, charts_, f);
    }

    void push_sides(Index face) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) flips_.push(surface_.edge[h]);
    }

    // Three faces around an inner vertex become one, as do two on the boundary.
    [[nodiscard]] bool may_drop(Index v, bool is_boundary) const {
        const Index first = surface_.outgoing[v];
        const Index outer = surface_.twin[Surface::next(first)];
        if (!is_boundary) {
            // With a fourth face they may be a tetrahedron: the whole component.
            const Index other =
                surface_.twin[Surface::next(surface_.twin[Surface::previous(first)])];
            return outer == no_index || other == no_index ||
                   Surface::face(outer) != Surface::face(other);
        }
        const Index last = Surface::previous(surface_.twin[Surface::previous(first)]);
        return !has_edge(surface_, surface_.head(first), surface_.tail(last));
    }

    void drop(Index v, bool is_boundary) {
        const Index h = surface_.outgoing[v];
        if (!is_boundary) {
            remove_from_face(surface_, charts_, h);
            return;
        }
        const Index last = Surface::previous(surface_.twin[Surface::previous(h)]);
        const Index a = surface_.head(h), b = surface_.tail(last);
        const double length = lengths_ == Lengths::OnSurface
                                  ? surface_.length_of(h) + surface_.length_of(last)
                                  : distance(a, b);
        remove_from_boundary(surface_, charts_, h, length);
    }

    bool cut_ear(Index v) {
        const Index h = surface_.outgoing[v];
        const Index inside = surface_.twin[Surface::next(h)];
        if (inside == no_index) return false;
        ring_ = {surface_.head(h), surface_.tail(Surface::previous(h))};
        remove_ear(surface_, h);
        return true;
    }

    [[nodiscard]] Index apex(Index h) const { return surface_.tail(Surface::previous(h)); }

    [[nodiscard]] bool may_flip(Index h) const {
        return !has_edge(surface_, apex(h), apex(surface_.twin[h]));
    }

    void flip_all() { flips_.flip_all(flips_.num_flips() + most_flips * surface_.num_edges()); }

    [[nodiscard]] double distance(Index half_edge) const {
        return distance(surface_.tail(half_edge), surface_.head(half_edge));
    }
    [[nodiscard]] double distance(Index a, Index b) const {
        const double d = (surface_.mesh.positions[a] - surface_.mesh.positions[b]).norm();
        return std::max(d, shortest_);
    }

    void measure_in_space() {
        lengths_ = Lengths::InSpace;
        for (const double length : surface_.length) shortest_ = std::max(shortest_, length);
        shortest_ *= least_doubled_area;
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            const Index h = surface_.edge_half[e];
            if (h != no_index) surface_.length[e] = distance(h);
        }
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            if (surface_.mesh.triangles[f][0] != no_index) renew_face(surface_, charts_, f);
        }
    }

    Surface& surface_;
    FaceCharts& charts_;
    const std::vector<Index>& number_;
    std::vector<std::uint32_t> stamp_;
    const std::vector<std::uint8_t> none_kept_;
    DelaunayQueue flips_;
    std::priority_queue<Waiting> queue_;
    Lengths lengths_ = Lengths::OnSurface;
    double shortest_ = 0;
    Index num_left_ = 0;
    std::size_t num_own_flips_ = 0;
    std::vector<Index> ring_, faces_, spokes_;
};

}  // namespace

std::size_t remove_vertices(Surface& surface, FaceCharts& charts,
                            const std::vector<Index>& number) {
    return VertexRemover(surface, charts, number).run();
}

}  // namespace agvd::detail
