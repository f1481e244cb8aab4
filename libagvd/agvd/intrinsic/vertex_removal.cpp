// Removes vertices in the order of (curvature + a small constant) times mean edge length
// ([liu2023]). The lengths around one are scaled until it is flat ([springborn2008]), its edges are
// flipped away, the best triangle first, until three faces (two on the boundary) are left, which
// merge. Those that stay are tried again with the lengths of straight edges in space.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "agvd/core/portable_math.h"
#include "agvd/intrinsic/delaunay_queue.h"
#include "agvd/intrinsic/simplify_steps.h"

namespace agvd::detail {
namespace {

constexpr double angle_tolerance = 1e-10;
constexpr int most_steps = 60;
// Share of the range of factors left out at both ends, where faces are nearly degenerate.
constexpr double margin = 1e-3;

// With edges scaled by s the corner between a and b across from c has the cosine p - q w, w = 1/s².
struct Corner {
    double p, q;
};

struct Angle {
    double value, slope;
};

Angle angle_at(const std::vector<Corner>& corners, double w) {
    Angle sum{0, 0};
    for (const auto& [p, q] : corners) {
        const double cosine = std::clamp(p - q * w, -1.0, 1.0);
        const double sine = std::sqrt((1 - cosine) * (1 + cosine));
        sum.value += portable::atan2(sine, cosine);
        sum.slope += q / std::max(sine, 1e-150);
    }
    return sum;
}

// The angle grows with w: Newton, and bisection where a step would leave the range.
double solve(const std::vector<Corner>& corners, double target, double low, double high) {
    double w = std::clamp(1.0, low, high);
    for (int step = 0; step < most_steps; ++step) {
        const Angle angle = angle_at(corners, w);
        const double excess = angle.value - target;
        if (std::abs(excess) < angle_tolerance) break;
        (excess > 0 ? high : low) = w;
        const double next = w - excess / angle.slope;
        w = next > low && next < high ? next : (low + high) / 2;
    }
    return w;
}

// Radians: a vertex flatter than this counts as flat.
constexpr double flat_tolerance = 1e-9;
// Radians: a vertex flatter than this goes as it is where no lengths make it flat, as among
// slivers.
constexpr double nearly_flat = 1e-4;
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
          flips_(surface, charts, nullptr, nullptr, [this](Index h) { return may_flip(h); }) {}

    void run() {
        for (Index e = 0; e < surface_.num_edges(); ++e) flips_.push(e);
        flip_all();
        remove_all();
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            if (!is_to_go(v)) continue;
            measure_in_space();
            remove_all();
            return;
        }
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
        for (Index v = 0; v < surface_.num_vertices(); ++v) judge(v);
        while (!queue_.empty()) {
            const Waiting next = queue_.top();
            queue_.pop();
            if (next.stamp != stamp_[next.vertex]) continue;
            remove(next.vertex);
            flip_all();
            for (const Index v : ring_) judge(v);
        }
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
    void remove(Index v) {
        ring_.clear();
        const double angle = cone_angle(surface_, v), wanted = flat_angle(v);
        const bool is_boundary = surface_.is_boundary_vertex(v);
        collect_spokes(v);
        if (is_boundary && spokes_.size() == 1) return cut_ear(v);
        const double curvature = std::abs(angle - wanted);
        if (lengths_ == Lengths::OnSurface && curvature > flat_tolerance &&
            !flatten(surface_, charts_, v, wanted) && curvature > nearly_flat) {
            return;
        }
        const std::size_t fewest = is_boundary ? 2 : 3;
        bool is_free = true;
        while (spokes_.size() > fewest && is_free) is_free = flip_away(v);
        is_free = is_free && may_drop(v, is_boundary);
        for (const Index h : spokes_) {
            for (const Index w : surface_.mesh.triangles[Surface::face(h)]) {
                if (w != v) ring_.push_back(w);
            }
        }
        ring_ = distinct(std::move(ring_));
        if (is_free) {
            drop(v, is_boundary);
            push_sides(Surface::face(spokes_[0]));
        } else {
            for (const Index h : spokes_) push_sides(Surface::face(h));
            ring_.clear();
        }
    }

    void collect_spokes(Index v) {
        spokes_.clear();
        for_each_outgoing(surface_, v, [&](Index h) { spokes_.push_back(h); });
    }

    // Flips the edge at v whose flip gives the best triangle without v.
    bool flip_away(Index v) {
        Index best = no_index;
        double best_quality = -1;
        for (const Index h : spokes_) {
            if (surface_.twin[h] == no_index) continue;
            const Quad quad = quad_at(surface_, h);
            if (lengths_ == Lengths::OnSurface && !quad.is_convex()) continue;
            const double quality = quality_behind(h, quad);
            if (quality > best_quality && may_flip(h)) {
                best_quality = quality;
                best = h;
            }
        }
        if (best == no_index) return false;
        flip_edge(best);
        collect_spokes(v);
        return true;
    }

    // As Quad::quality_behind().
    [[nodiscard]] double quality_behind(Index h, const Quad& quad) const {
        if (lengths_ == Lengths::OnSurface) return quad.quality_behind();
        const Vec3& a = surface_.mesh.positions[surface_.head(h)];
        const Vec3 b = surface_.mesh.positions[apex(h)] - a;
        const Vec3 c = surface_.mesh.positions[apex(surface_.twin[h])] - a;
        const double squares = b.squaredNorm() + c.squaredNorm() + (b - c).squaredNorm();
        return squares > 0 ? b.cross(c).norm() / squares : 0;
    }

    void flip_edge(Index h) {
        const Index edge = surface_.edge[h];
        const std::array faces{Surface::face(h), Surface::face(surface_.twin[h])};
        flip(surface_, charts_, h, quad_at(surface_, charts_, h));
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

    void cut_ear(Index v) {
        const Index h = surface_.outgoing[v];
        const Index inside = surface_.twin[Surface::next(h)];
        if (inside == no_index) return;
        ring_ = {surface_.head(h), surface_.tail(Surface::previous(h))};
        remove_ear(surface_, h);
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
    DelaunayQueue flips_;
    std::priority_queue<Waiting> queue_;
    Lengths lengths_ = Lengths::OnSurface;
    double shortest_ = 0;
    std::vector<Index> ring_, spokes_;
};

}  // namespace

double cone_angle(const Surface& surface, Index vertex) {
    double sum = 0;
    for_each_outgoing(surface, vertex, [&](Index h) {
        sum += portable::atan2(surface.apex[h].y(), surface.apex[h].x());
    });
    return sum;
}

bool flatten(Surface& surface, FaceCharts& charts, Index vertex, double target) {
    std::vector<Corner> corners;
    double low = 0, high = infinity;
    for_each_outgoing(surface, vertex, [&](Index h) {
        const double a = surface.length_of(h), b = surface.length_of(Surface::previous(h));
        const double c = surface.length_of(Surface::next(h));
        corners.push_back({(a * a + b * b) / (2 * a * b), c * c / (2 * a * b)});
        low = std::max(low, (a - b) * (a - b) / (c * c));
        high = std::min(high, (a + b) * (a + b) / (c * c));
    });
    const double left_out = margin * (high - low);
    low += left_out;
    high -= left_out;
    if (!(low < high) || angle_at(corners, low).value > target ||
        angle_at(corners, high).value < target) {
        return false;
    }
    const double scale = 1 / std::sqrt(solve(corners, target, low, high));
    for_each_outgoing(surface, vertex, [&](Index h) {
        surface.length[surface.edge[h]] *= scale;
        const Index back = Surface::previous(h);
        if (surface.twin[back] == no_index) surface.length[surface.edge[back]] *= scale;
    });
    for_each_outgoing(surface, vertex,
                      [&](Index h) { renew_face(surface, charts, Surface::face(h)); });
    return true;
}

void remove_vertices(Surface& surface, FaceCharts& charts, const std::vector<Index>& number) {
    VertexRemover(surface, charts, number).run();
}

}  // namespace agvd::detail
