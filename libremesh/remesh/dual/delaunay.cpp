// Edges that fail by the lengths of locally shortest paths are flipped in passes. Edge (a, b) lies
// in triangles (a, b, c) and (b, a, d). A length is measured where its bounds do not decide.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "agvd/core/parallel.h"
#include "agvd/core/portable_math.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/paths/geodesic_path.h"
#include "remesh/curves/glue.h"
#include "remesh/dual/build_dual.h"
#include "remesh/dual/fan_mesh.h"

namespace remesh {
namespace {

// Radians. Two right angles opposite an edge are Delaunay.
constexpr double delaunay_tolerance = 1e-6;
constexpr int max_passes = 100;
// Relative to the longest side, as lengths are sums of a few square roots.
constexpr double length_tolerance = 1e-12;
// Of bounds, which may be rounded to single precision.
constexpr double bound_rounding = 1e-6;
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

// The mesh of the groups. Edges are those of the copies; their number is the label, and stays in a
// flip.
struct NumberedMesh : detail::FanMesh {
    std::vector<DirectedEdge> ends;  // By edge: copies, at the start.
    std::vector<Index> side;         // By edge: a half-edge; no_index: it has no two faces.
    std::vector<Triangle> copy;      // By face: the copies at its corners.

    NumberedMesh(std::span<const Triangle> triangles, std::span<const Index> group,
                 Index num_vertices, Ticker ticker)
        : FanMesh(group.empty() ? std::vector<Triangle>(triangles.begin(), triangles.end())
                                : rename_vertices(triangles, group),
                  num_vertices, ticker),
          copy(triangles.begin(), triangles.end()) {
        for_each_edge(sorted_edge_sides(triangles, ticker), [&](std::span<const EdgeSide> sides) {
            for (const EdgeSide& s : sides) put_label(s.half_edge, num_edges());
            forget();
            const bool has_two = sides.size() == 2 && twin(sides[0].half_edge) != no_index;
            const Index h = sides[has_two && !sides[0].forward ? 1 : 0].half_edge;
            ends.emplace_back(copy[h / 3][h % 3], copy[h / 3][(h + 1) % 3]);
            side.push_back(has_two ? h : no_index);
        });
    }
    [[nodiscard]] Index num_edges() const { return static_cast<Index>(ends.size()); }
    // The copies at the ends of an edge now.
    [[nodiscard]] DirectedEdge copies_of(Index edge) const {
        if (side[edge] == no_index) return ends[edge];
        const Index h = side[edge];
        return {copy[h / 3][h % 3], copy[h / 3][(h + 1) % 3]};
    }
    [[nodiscard]] Index copy_opposite(Index h) const { return copy[h / 3][(h + 2) % 3]; }

    void flip_edge(Index edge) {
        const Index h = side[edge], other = twin(h), f = h / 3, g = other / 3;
        const Index a = copy[f][h % 3], b = copy[f][(h + 1) % 3];
        const Index c = copy_opposite(h), d = copy_opposite(other);
        flip(h);
        copy[f] = {c, a, d};
        copy[g] = {d, b, c};
        put_label(3 * f + 2, edge);
        put_label(3 * g + 2, edge);
        forget();
        for (const Index face : {f, g}) {
            for (Index s = 3 * face; s < 3 * face + 3; ++s) {
                if (side[label(s)] != no_index) side[label(s)] = s;
            }
        }
    }
};

struct EdgeLength {
    double length;
    bool is_locally_shortest;
};
using Metric = std::function<EdgeLength(Index, Index)>;  // Between two vertices.

// Bounds of the lengths of edges, which are equal once the edge is measured.
class EdgeLengths {
public:
    EdgeLengths(const NumberedMesh& mesh, std::span<const Vec3> positions,
                std::span<const PairBound> bounds)
        : mesh_(mesh), least_(mesh.num_edges()), most_(mesh.num_edges(), infinity) {
        for (Index e = 0; e < mesh.num_edges(); ++e) {
            const auto& [a, b] = mesh.ends[e];
            least_[e] = (positions[a] - positions[b]).norm();
            const std::uint64_t key = edge_key(a, b);
            const auto found = std::ranges::lower_bound(bounds, key, {}, &PairBound::ends);
            if (found != bounds.end() && found->ends == key) {
                most_[e] = std::max(found->most * (1 + bound_rounding), least_[e]);
            }
        }
    }

    // Measures the edges around those whose test their bounds do not decide.
    void measure(const Metric& metric, int num_threads, Poller& poller, DelaunayCounts& counts) {
        std::vector<std::uint8_t> is_wanted(mesh_.num_edges(), 0);
        const auto want = [&](Index face) {
            for (Index h = 3 * face; h < 3 * face + 3; ++h) is_wanted[mesh_.label(h)] = 1;
        };
        for (Index e = 0; e < mesh_.num_edges(); ++e) {
            const Index h = mesh_.side[e];
            if (h == no_index || is_proved(e)) continue;
            want(h / 3);
            want(mesh_.twin(h) / 3);
        }
        for (Index f = 0; f < mesh_.num_faces(); ++f) {
            if (!is_proved_triangle(f)) want(f);
        }
        std::vector<Index> wanted;
        for (Index e = 0; e < mesh_.num_edges(); ++e) {
            if (is_wanted[e] != 0) wanted.push_back(e);
        }
        counts.measured_edges = static_cast<Index>(wanted.size());
        std::vector<EdgeLength> found(wanted.size());
        const auto measure = [&](Index, Index begin, Index end) {
            Ticker ticker(poller);
            for (Index i = begin; i < end; ++i) {
                const auto& [a, b] = mesh_.ends[wanted[i]];
                found[i] = metric(a, b);
                ticker.tick(ticks_per_path);
            }
        };
        parallel_chunks(static_cast<Index>(wanted.size()), paths_per_task, num_threads, measure,
                        poller);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            put(wanted[i], found[i].length);
            if (!found[i].is_locally_shortest) ++counts.not_locally_shortest;
        }
    }

    void put(Index edge, double length) { least_[edge] = most_[edge] = length; }
    [[nodiscard]] bool is_measured(Index edge) const { return least_[edge] == most_[edge]; }
    [[nodiscard]] double operator[](Index edge) const { return most_[edge]; }

    // Whether the edge certainly meets the condition.
    [[nodiscard]] bool is_proved(Index edge) const {
        const Index h = mesh_.side[edge];
        const std::optional<Vec2> left = largest_corner(h);
        if (!left) return false;
        const std::optional<Vec2> right = largest_corner(mesh_.twin(h));
        return right && !is_above_pi(*left, *right);
    }
    [[nodiscard]] bool is_proved_triangle(Index face) const {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (most_[mesh_.label(h)] > least_at(mesh_.next(h)) + least_at(mesh_.previous(h))) {
                return false;
            }
        }
        return true;
    }

private:
    [[nodiscard]] double least_at(Index h) const { return least_[mesh_.label(h)]; }
    [[nodiscard]] double most_at(Index h) const { return most_[mesh_.label(h)]; }

    // The angle opposite a half-edge is the largest where that edge is the longest and the others
    // are the shortest, as the corners at its ends are acute for all lengths.
    [[nodiscard]] std::optional<Vec2> largest_corner(Index h) const {
        const Index next = mesh_.next(h), previous = mesh_.previous(h);
        const double a = least_at(next), b = least_at(previous), c = least_at(h);
        const double longest_a = most_at(next), longest_b = most_at(previous);
        const bool are_acute =
            a * a + c * c >= longest_b * longest_b && b * b + c * c >= longest_a * longest_a;
        if (!are_acute || most_at(h) > a + b) return std::nullopt;
        return corner_opposite(most_at(h), a, b);
    }

    const NumberedMesh& mesh_;
    std::vector<double> least_, most_;  // By edge.
};

class Flipper {
public:
    // \param positions  of the groups.
    Flipper(NumberedMesh& mesh, EdgeLengths& length, std::span<const Vec3> positions,
            const Metric& metric, Ticker ticker)
        : ticker_(ticker), mesh_(mesh), length_(length), positions_(positions), metric_(metric) {}

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
        for (Index t = 0; t < mesh_.num_faces(); ++t) {
            if (!length_.is_proved_triangle(t) &&
                !is_triangle(length(3 * t), length(3 * t + 1), length(3 * t + 2))) {
                ++counts.broken_triangles;
            }
        }
    }

private:
    [[nodiscard]] double length(Index half_edge) {
        const Index edge = mesh_.label(half_edge);
        if (!length_.is_measured(edge)) {
            const auto [a, b] = mesh_.copies_of(edge);
            length_.put(edge, metric_(a, b).length);
            ticker_.tick(ticks_per_path);
        }
        return length_[edge];
    }

    [[nodiscard]] std::vector<Index> find_failing() {
        std::vector<Index> failing;
        for (Index e = 0; e < mesh_.num_edges(); ++e) {
            ticker_.tick(2);
            if (fails(e)) failing.push_back(e);
        }
        return failing;
    }

    [[nodiscard]] bool fails(Index edge) {
        const Index h = mesh_.side[edge];
        if (h == no_index || length_.is_proved(edge)) return false;
        const auto corner = [&](Index side) {
            return corner_opposite(length(side), length(mesh_.next(side)),
                                   length(mesh_.previous(side)));
        };
        return is_above_pi(corner(h), corner(mesh_.twin(h)));
    }

    bool try_flip(Index edge) {
        const Index h = mesh_.side[edge];
        if (!mesh_.can_flip(h) || folds(h)) return false;
        const Index other = mesh_.twin(h);
        const double across = metric_(mesh_.copy_opposite(h), mesh_.copy_opposite(other)).length;
        ticker_.tick(ticks_per_path);
        const double bc = length(mesh_.next(h)), ca = length(mesh_.previous(h));
        const double ad = length(mesh_.next(other)), db = length(mesh_.previous(other));
        if (!is_triangle(across, ca, ad) || !is_triangle(across, db, bc)) return false;
        if (is_above_pi(corner_opposite(across, ca, ad), corner_opposite(across, db, bc))) {
            return false;
        }
        mesh_.flip_edge(edge);
        length_.put(edge, across);
        return true;
    }

    [[nodiscard]] bool folds(Index h) const {
        return detail::flip_folds(
            mesh_, h, [&](Index v) { return positions_[v]; },
            [&](Index side, Index) { return mesh_.side[mesh_.label(side)] != no_index; });
    }

    Ticker ticker_;
    NumberedMesh& mesh_;
    EdgeLengths& length_;
    std::span<const Vec3> positions_;
    const Metric& metric_;
};

}  // namespace

std::vector<Triangle> build_dual(const Diagram& diagram) {
    std::vector<Triangle> triangles;
    for (Index v = 0; v < diagram.vertices.size(); ++v) {
        const Index first = diagram.vertex_offsets[v], end = diagram.vertex_offsets[v + 1];
        const auto cells = std::span(diagram.vertex_sites).subspan(first, end - first);
        if (!std::ranges::all_of(cells, &SiteId::is_valid)) continue;  // On the boundary.
        for (std::size_t i = 2; i < cells.size(); ++i) {
            triangles.push_back({cells[0].value(), cells[i - 1].value(), cells[i].value()});
        }
    }
    return triangles;
}

const char* delaunay_name(Delaunay delaunay) {
    constexpr std::array names = {"intrinsic", "extrinsic", "off"};
    return names[static_cast<std::size_t>(delaunay)];
}

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
    std::vector<Vec3> of_group(positions.begin(), positions.end());
    for (Index v = 0; v < options.group.size(); ++v) of_group[options.group[v]] = positions[v];
    NumberedMesh mesh(triangles, options.group, static_cast<Index>(positions.size()),
                      Ticker(poller));
    DelaunayCounts& counts = result.counts;
    counts.inner_edges =
        mesh.num_edges() - static_cast<Index>(std::ranges::count(mesh.side, no_index));
    EdgeLengths length(mesh, positions, options.bounds);
    length.measure(metric, options.num_threads, poller, counts);
    Flipper(mesh, length, of_group, metric, Ticker(poller)).run(counts);
    result.triangles = std::move(mesh.copy);
    return result;
}

}  // namespace remesh
