// Edges that fail by the lengths of locally shortest paths are flipped in passes. Edge (a, b) lies
// in triangles (a, b, c) and (b, a, d).
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "agvd/core/parallel.h"
#include "agvd/core/portable_math.h"
#include "agvd/paths/geodesic_path.h"
#include "remesh/dual/build_dual.h"
#include "remesh/dual/flippable_mesh.h"

namespace remesh {
namespace {

// Radians. Two right angles opposite an edge are Delaunay.
constexpr double delaunay_tolerance = 1e-6;
constexpr int max_passes = 100;
// Relative to the longest side, as lengths are sums of a few square roots.
constexpr double length_tolerance = 1e-12;
constexpr Index paths_per_task = 128;
constexpr std::size_t ticks_per_path = 100;

// Whether no side is longer than the other two together, up to rounding.
bool is_triangle(double a, double b, double c) {
    const double longest = std::max({a, b, c});
    return longest <= (a + b + c - longest) + length_tolerance * longest;
}

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
    return portable::atan2(a.y(), a.x()) + portable::atan2(b.y(), b.x()) >
           std::numbers::pi + delaunay_tolerance;
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

struct EdgeLength {
    double length;
    bool is_locally_shortest;
};
using Metric = std::function<EdgeLength(Index, Index)>;  // Between two vertices.

std::vector<double> measure_edges(const FlippableMesh& mesh, const Metric& metric, int num_threads,
                                  Poller& poller, DelaunayCounts& counts) {
    std::vector<EdgeLength> found(mesh.num_edges());
    const auto measure = [&](Index, Index begin, Index end) {
        Ticker ticker(poller);
        for (Index e = begin; e < end; ++e) {
            const Index h = mesh.sides(e)[0];
            found[e] = metric(mesh.tail(h), mesh.tail(FlippableMesh::next(h)));
            ticker.tick(ticks_per_path);
        }
    };
    parallel_chunks(mesh.num_edges(), paths_per_task, num_threads, measure, poller);
    std::vector<double> length;
    for (const EdgeLength& edge : found) {
        length.push_back(edge.length);
        if (!edge.is_locally_shortest) ++counts.not_locally_shortest;
    }
    return length;
}

class Flipper {
public:
    Flipper(FlippableMesh& mesh, std::vector<double> length, std::span<const Vec3> positions,
            const Metric& metric, Ticker ticker)
        : ticker_(ticker),
          mesh_(mesh),
          length_(std::move(length)),
          positions_(positions),
          metric_(metric) {}

    void run(DelaunayCounts& counts) {
        std::vector<Index> failing = find_failing();
        counts.failing_before = static_cast<Index>(failing.size());
        counts.is_finished = false;
        for (int pass = 0; pass < max_passes && !counts.is_finished; ++pass) {
            const Index before = counts.flips;
            for (const Index e : failing) {
                if (fails(e) && try_flip(e)) ++counts.flips;
            }
            counts.is_finished = counts.flips == before;
            if (!counts.is_finished) failing = find_failing();
        }
        counts.failing_after = static_cast<Index>(failing.size());
        for (Index t = 0; t < mesh_.triangles().size(); ++t) {
            if (!is_triangle(length(3 * t), length(3 * t + 1), length(3 * t + 2))) {
                ++counts.broken_triangles;
            }
        }
    }

private:
    [[nodiscard]] double length(Index half_edge) const { return length_[mesh_.edge(half_edge)]; }

    [[nodiscard]] std::vector<Index> find_failing() {
        std::vector<Index> failing;
        for (Index e = 0; e < mesh_.num_edges(); ++e) {
            ticker_.tick(2);
            if (mesh_.is_inner(e) && fails(e)) failing.push_back(e);
        }
        return failing;
    }

    [[nodiscard]] bool fails(Index edge) const {
        const auto corner = [&](Index h) {
            return corner_opposite(length_[edge], length(FlippableMesh::next(h)),
                                   length(FlippableMesh::previous(h)));
        };
        return is_above_pi(corner(mesh_.sides(edge)[0]), corner(mesh_.sides(edge)[1]));
    }

    bool try_flip(Index edge) {
        if (!mesh_.can_flip(edge)) return false;
        const Quad quad(mesh_, edge);
        if (folds(quad)) return false;
        const double across = metric_(quad.c, quad.d).length;
        ticker_.tick(ticks_per_path);
        const double bc = length(quad.bc), ca = length(quad.ca);
        const double ad = length(quad.ad), db = length(quad.db);
        if (!is_triangle(across, ca, ad) || !is_triangle(across, db, bc)) return false;
        if (is_above_pi(corner_opposite(across, ca, ad), corner_opposite(across, db, bc))) {
            return false;
        }
        mesh_.flip(edge);
        length_[edge] = across;
        return true;
    }

    [[nodiscard]] bool folds(const Quad& quad) const {
        const auto unit = [&](const Triangle& t) -> Vec3 {
            const Vec3& origin = positions_[t[0]];
            return (positions_[t[1]] - origin).cross(positions_[t[2]] - origin).normalized();
        };
        const std::array rim{quad.bc, quad.ca, quad.ad, quad.db};
        return flip_folds({quad.a, quad.b, quad.c, quad.d}, unit,
                          [&](std::size_t i) -> std::optional<Vec3> {
                              const Index edge = mesh_.edge(rim[i]);
                              if (!mesh_.is_inner(edge)) return std::nullopt;
                              const auto& sides = mesh_.sides(edge);
                              const Index across = sides[0] == rim[i] ? sides[1] : sides[0];
                              return unit(mesh_.triangles()[across / 3]);
                          });
    }

    Ticker ticker_;
    FlippableMesh& mesh_;
    std::vector<double> length_;  // By edge.
    std::span<const Vec3> positions_;
    const Metric& metric_;
};

}  // namespace

DelaunayResult make_delaunay(const Surface& surface, std::span<const SurfacePoint> points,
                             std::span<const Vec3> positions, std::span<const Triangle> triangles,
                             const DelaunayOptions& options) {
    DelaunayResult result{{triangles.begin(), triangles.end()}, {}};
    if (options.mode == Delaunay::Off) return result;
    Poller poller(options.progress);
    const Progress progress = poller.progress();
    const Metric on_surface = [&](Index a, Index b) -> EdgeLength {
        const GeodesicPath path = path_between(surface, points[a], points[b], progress);
        return {path.length, path.is_locally_shortest};
    };
    const Metric in_space = [&](Index a, Index b) -> EdgeLength {
        return {(positions[a] - positions[b]).norm(), true};
    };
    const Metric& metric = options.mode == Delaunay::Intrinsic ? on_surface : in_space;
    FlippableMesh mesh(triangles, Ticker(poller));
    DelaunayCounts& counts = result.counts;
    for (Index e = 0; e < mesh.num_edges(); ++e) counts.inner_edges += mesh.is_inner(e) ? 1 : 0;
    std::vector<double> length = measure_edges(mesh, metric, options.num_threads, poller, counts);
    Flipper(mesh, std::move(length), positions, metric, Ticker(poller)).run(counts);
    result.triangles = mesh.triangles();
    return result;
}

}  // namespace remesh
