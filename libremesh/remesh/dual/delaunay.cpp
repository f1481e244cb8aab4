// Every edge of the dual has the length of a locally shortest path between its ends: over the point
// of the Voronoi edge that is nearest to both sites, or along edges where there is none. A queue
// holds the edges whose opposite angles, by these lengths, sum to more than pi. Notation: edge
// (a, b) lies in triangles (a, b, c) and (b, a, d).

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <unordered_map>

#include "agvd/core/edge_key.h"
#include "agvd/core/parallel.h"
#include "agvd/paths/geodesic_path.h"
#include "remesh/dual/build_dual.h"
#include "remesh/dual/flippable_mesh.h"

namespace remesh {

namespace {

// Radians. Two right angles opposite an edge are Delaunay.
constexpr double delaunay_tolerance = 1e-6;
// A flip may always leave this cosine between the normals of two triangles.
constexpr double gentle_fold = 0.5;
constexpr std::size_t max_flips_per_edge = 10;
// Relative to the longest side, as lengths are sums of a few square roots.
constexpr double length_tolerance = 1e-12;
// Most passes over the triangles while sides become shorter.
constexpr int max_passes = 100;
// Points of two joined paths. Longer ones are not made to shorten a side: joined paths may double
// from pass to pass.
constexpr std::size_t longest_joined = 4000;
constexpr Index paths_per_task = 128;

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
    return std::atan2(a.y(), a.x()) + std::atan2(b.y(), b.x()) >
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

// The path of an edge on the surface, from one of its ends.
struct EdgePath {
    Index from;
    GeodesicPath path;
};

void append(const EdgePath& edge, Index from, GeodesicPath& path) {
    const auto add = [](const auto& some, bool is_forward, auto& all) {
        if (is_forward) {
            all.insert(all.end(), some.begin(), some.end());
        } else {
            all.insert(all.end(), some.rbegin(), some.rend());
        }
    };
    if (!path.points.empty()) path.points.pop_back();  // The same place.
    add(edge.path.points, edge.from == from, path.points);
    add(edge.path.faces, edge.from == from, path.faces);
}

// The lengths of the edges of a mesh on a surface. Keeps only paths that took the place of others.
class EdgePaths {
public:
    EdgePaths(const Surface& surface, std::span<const SurfacePoint> points,
              std::span<const Index> site, const Diagram& diagram, const FlippableMesh& mesh)
        : surface_(surface), points_(points), site_(site), diagram_(diagram), mesh_(mesh) {
        find_gates();
    }

    std::vector<double> lengths(int num_threads, Poller& poller, DelaunayCounts& counts) {
        std::vector<double> length(mesh_.num_edges());
        std::vector<std::uint8_t> is_proved(mesh_.num_edges());
        const auto find = [&](Index, Index begin, Index end) {
            Ticker ticker(poller);
            for (Index e = begin; e < end; ++e) {
                const GeodesicPath path = find_path(e).path;
                ticker.tick(8 * path.points.size());
                length[e] = path.length;
                is_proved[e] = path.is_locally_shortest ? 1 : 0;
            }
        };
        parallel_chunks(mesh_.num_edges(), paths_per_task, num_threads, find, poller);
        counts.not_locally_shortest =
            static_cast<Index>(std::count(is_proved.begin(), is_proved.end(), 0));
        shorten(length, Ticker(poller));
        return length;
    }

    // The length between the corners opposite an edge: of the path straightened from the shorter of
    // the two ways along sides of the quad around the edge.
    double measure_across(const std::vector<double>& length, Index edge) {
        const Quad quad(mesh_, edge);
        const auto at = [&](Index h) { return length[mesh_.edge(h)]; };
        if (at(quad.ca) + at(quad.ad) <= at(quad.bc) + at(quad.db)) {
            across_ = path_along(quad.ca, quad.c, quad.ad, quad.a);
        } else {
            across_ = path_along(quad.bc, quad.c, quad.db, quad.b);
        }
        return across_.path.length;
    }
    // The edge was flipped: it has the path that was measured last.
    void flipped(Index edge) { kept_[edge] = std::move(across_); }

private:
    // Sets gate_ to the points where the cells of both ends meet nearest to their sites.
    void find_gates() {
        site_point_.resize(diagram_.num_sites);
        std::vector<Index> vertex(diagram_.num_sites, no_index);
        for (Index v = 0; v < site_.size(); ++v) {
            if (site_[v] == no_index) continue;
            vertex[site_[v]] = v;
            site_point_[site_[v]] = points_[v];
        }
        std::unordered_map<std::uint64_t, Index> edge_between;
        for (Index e = 0; e < mesh_.num_edges(); ++e) {
            const Index h = mesh_.sides(e)[0];
            edge_between[edge_key(mesh_.tail(h), mesh_.tail(FlippableMesh::next(h)))] = e;
        }
        gate_.assign(mesh_.num_edges(), no_index);
        const std::vector<double>& distance = diagram_.point_distance;
        for (Index i = 0; i < diagram_.edges.size(); ++i) {
            const VoronoiEdge& edge = diagram_.edges[i];
            if (!edge.right.is_valid()) continue;
            const Index a = vertex[edge.left.value()], b = vertex[edge.right.value()];
            if (a == no_index || b == no_index) continue;
            const auto found = edge_between.find(edge_key(a, b));
            if (found == edge_between.end()) continue;
            Index& gate = gate_[found->second];
            for (Index p = diagram_.edge_points[i]; p < diagram_.edge_points[i + 1]; ++p) {
                if (gate == no_index || distance[p] < distance[gate]) gate = p;
            }
        }
    }

    [[nodiscard]] EdgePath find_path(Index edge) const {
        const Index h = mesh_.sides(edge)[0];
        const Index from = mesh_.tail(h), to = mesh_.tail(FlippableMesh::next(h));
        const Index gate = gate_[edge];
        if (gate == no_index) return {from, path_between(surface_, points_[from], points_[to])};
        const auto from_gate = [&](Index v) {
            const Index site = site_[v];
            return path_to_site(surface_, {diagram_.nearest_site, diagram_.nearest_distance},
                                {SiteId(site), site_point_[site], diagram_.point_distance[gate]},
                                diagram_.points[gate]);
        };
        GeodesicPath path;
        append({to, from_gate(from)}, from, path);
        append({from, from_gate(to)}, from, path);
        return {from, straighten_path(surface_, path.points, path.faces)};
    }

    [[nodiscard]] EdgePath path_of(Index edge) const {
        const auto found = kept_.find(edge);
        return found != kept_.end() ? found->second : find_path(edge);
    }

    // The path straightened from those of two half-edges, from one vertex over another.
    [[nodiscard]] EdgePath path_along(Index first, Index from, Index second, Index over) const {
        GeodesicPath path;
        append(path_of(mesh_.edge(first)), from, path);
        append(path_of(mesh_.edge(second)), over, path);
        if (path.points.size() > longest_joined) return {from, {.length = infinity}};
        return {from, straighten_path(surface_, path.points, path.faces)};
    }

    // Replaces a side that is longer than the other two of its triangle together by the path
    // straightened from these, until there is no such side.
    void shorten(std::vector<double>& length, Ticker ticker) {
        bool is_changed = true;
        for (int pass = 0; is_changed && pass < max_passes; ++pass) {
            is_changed = false;
            for (Index t = 0; t < mesh_.triangles().size(); ++t) {
                ticker.tick();
                const auto at = [&](Index h) { return length[mesh_.edge(h)]; };
                if (is_triangle(at(3 * t), at(3 * t + 1), at(3 * t + 2))) continue;
                Index longest = 3 * t;
                for (const Index h : {3 * t + 1, 3 * t + 2}) {
                    if (at(h) > at(longest)) longest = h;
                }
                const Index next = FlippableMesh::next(longest);
                const Index previous = FlippableMesh::previous(longest);
                EdgePath shorter =
                    path_along(next, mesh_.tail(next), previous, mesh_.tail(previous));
                if (!(shorter.path.length < at(longest))) continue;
                length[mesh_.edge(longest)] = shorter.path.length;
                kept_[mesh_.edge(longest)] = std::move(shorter);
                is_changed = true;
            }
        }
    }

    const Surface& surface_;
    std::span<const SurfacePoint> points_;
    std::span<const Index> site_;
    const Diagram& diagram_;
    const FlippableMesh& mesh_;
    std::vector<SurfacePoint> site_point_;
    std::vector<Index> gate_;                   // By edge: a point of the diagram; no_index: none.
    std::unordered_map<Index, EdgePath> kept_;  // By edge.
    EdgePath across_{};
};

class Flipper {
public:
    //! \param paths  nullptr: lengths are those in space.
    Flipper(FlippableMesh& mesh, std::vector<double>& length, std::span<const Vec3> positions,
            EdgePaths* paths, Ticker ticker)
        : ticker_(ticker),
          mesh_(mesh),
          length_(length),
          positions_(positions),
          paths_(paths),
          is_queued_(mesh.num_edges(), false) {}

    void run(DelaunayCounts& counts) {
        counts.failing_before = count_failing([&](Index e) { enqueue(e); });
        const std::size_t max_flips = max_flips_per_edge * mesh_.num_edges();
        while (!queue_.empty() && counts.is_finished) {
            ticker_.tick(8);
            const Index edge = queue_.front();
            queue_.pop_front();
            is_queued_[edge] = false;
            if (!fails(edge)) continue;
            counts.is_finished = counts.flips < max_flips;
            if (counts.is_finished && try_flip(edge)) ++counts.flips;
        }
        counts.failing_after = count_failing([](Index) {});
    }

private:
    template <typename Each>
    Index count_failing(const Each& each) {
        Index count = 0;
        for (Index e = 0; e < mesh_.num_edges(); ++e) {
            ticker_.tick(2);
            if (!mesh_.is_inner(e) || !fails(e)) continue;
            ++count;
            each(e);
        }
        return count;
    }

    [[nodiscard]] double length(Index half_edge) const { return length_[mesh_.edge(half_edge)]; }

    [[nodiscard]] bool fails(Index edge) const {
        const auto corner = [&](Index h) {
            return corner_opposite(length_[edge], length(FlippableMesh::next(h)),
                                   length(FlippableMesh::previous(h)));
        };
        return is_above_pi(corner(mesh_.sides(edge)[0]), corner(mesh_.sides(edge)[1]));
    }

    void enqueue(Index edge) {
        if (is_queued_[edge] || !mesh_.is_inner(edge)) return;
        is_queued_[edge] = true;
        queue_.push_back(edge);
    }

    bool try_flip(Index edge) {
        if (!mesh_.can_flip(edge)) return false;
        const Quad quad(mesh_, edge);
        if (folds(quad)) return false;
        const double across = paths_ != nullptr ? paths_->measure_across(length_, edge)
                                                : (positions_[quad.c] - positions_[quad.d]).norm();
        const double bc = length(quad.bc), ca = length(quad.ca);
        const double ad = length(quad.ad), db = length(quad.db);
        if (!is_triangle(across, ca, ad) || !is_triangle(across, db, bc)) return false;
        if (is_above_pi(corner_opposite(across, ca, ad), corner_opposite(across, db, bc))) {
            return false;
        }
        mesh_.flip(edge);
        length_[edge] = across;
        if (paths_ != nullptr) paths_->flipped(edge);
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
    std::vector<double>& length_;  // By edge.
    std::span<const Vec3> positions_;
    EdgePaths* paths_;
    std::deque<Index> queue_;
    std::vector<bool> is_queued_;
};

std::vector<double> lengths_in_space(const FlippableMesh& mesh, std::span<const Vec3> positions) {
    std::vector<double> length(mesh.num_edges());
    for (Index e = 0; e < mesh.num_edges(); ++e) {
        const Index h = mesh.sides(e)[0];
        length[e] = (positions[mesh.tail(h)] - positions[mesh.tail(FlippableMesh::next(h))]).norm();
    }
    return length;
}

}  // namespace

DelaunayResult make_delaunay(const Surface& surface, std::span<const SurfacePoint> points,
                             std::span<const Vec3> positions, std::span<const Index> site,
                             const Diagram& diagram, std::span<const Triangle> triangles,
                             const DelaunayOptions& options) {
    DelaunayResult result;
    if (options.mode == Delaunay::Off) {
        result.triangles.assign(triangles.begin(), triangles.end());
        return result;
    }
    Poller poller(options.progress);
    const Ticker ticker(poller);
    FlippableMesh mesh(triangles, ticker);
    DelaunayCounts& counts = result.counts;
    for (Index e = 0; e < mesh.num_edges(); ++e) counts.inner_edges += mesh.is_inner(e) ? 1 : 0;
    std::optional<EdgePaths> paths;
    if (options.mode == Delaunay::Intrinsic) paths.emplace(surface, points, site, diagram, mesh);
    std::vector<double> length = paths ? paths->lengths(options.num_threads, poller, counts)
                                       : lengths_in_space(mesh, positions);
    Flipper(mesh, length, positions, paths ? &*paths : nullptr, ticker).run(counts);
    result.triangles = mesh.triangles();
    result.side_lengths.reserve(result.triangles.size());
    for (Index t = 0; t < result.triangles.size(); ++t) {
        const auto& side = result.side_lengths.emplace_back(std::array{
            length[mesh.edge(3 * t)], length[mesh.edge(3 * t + 1)], length[mesh.edge(3 * t + 2)]});
        if (!is_triangle(side[0], side[1], side[2])) ++counts.broken_triangles;
    }
    return result;
}

}  // namespace remesh
