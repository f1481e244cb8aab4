// Two labels meet on an edge where both distances are equal. u, v: ends of an edge; h: a half-edge.
// Subdivision divides triangles at the middles of the longest edges: new inner sites get six
// neighbours, old ones keep their number.
#include "remesh/sites/site_dual.h"

#include <algorithm>

#include "agvd/core/types.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/curves/curve_network.h"
#include "remesh/curves/walk.h"
#include "remesh/sites/cell_measures.h"

namespace remesh::detail {
namespace {

// Least distance of middles from the ends of their edge, and from the edge, as shares of it.
constexpr double end_margin = 1e-3;
constexpr double side_margin = 1e-6;
// Distance of points on the boundary from a vertex, as a share of the edge.
constexpr double off_vertex = 0.25;

// A point on half-edge h, or just inside its face.
SurfacePoint point_on(Index h, double along, double inside) {
    SurfacePoint point{FaceId(Surface::face(h)), {inside, inside, inside}};
    point.barycentric[h % 3] = (1 - along) * (1 - inside);
    point.barycentric[Surface::next(h) % 3] = along * (1 - inside);
    return point;
}

struct Subdivision {
    const Surface& surface;
    const SiteDual& dual;
    TriangulatedSites result;
    std::vector<double> unit;          // By site.
    std::vector<Index> new_site = {};  // By middle; no_index: not added.

    std::optional<TriangulatedSites> run(Index count) {
        const auto has_no_site = [](const Middle& m) { return m.site == no_index; };
        const std::size_t room =
            result.sites.size() + static_cast<std::size_t>(std::count_if(
                                      dual.middles.begin(), dual.middles.end(), has_no_site));
        if (count < result.sites.size()) return std::nullopt;
        add_middles(std::min<std::size_t>(count, room) - result.sites.size());
        for (const Triangle& t : dual.triangles) divide(t);
        if (room < count && !add_centres(static_cast<Index>(count - room))) return std::nullopt;
        return std::move(result);
    }

    // Adds the middles of the `count` longest pairs.
    void add_middles(std::size_t count) {
        std::vector<Index> order;
        for (Index i = 0; i < dual.middles.size(); ++i) {
            if (dual.middles[i].site == no_index) order.push_back(i);
        }
        std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
            return length_of(dual.middles[a]) > length_of(dual.middles[b]);
        });
        new_site.assign(dual.middles.size(), no_index);
        for (std::size_t i = 0; i < count; ++i) new_site[order[i]] = 0;
        for (Index i = 0; i < new_site.size(); ++i) {
            const Middle& m = dual.middles[i];
            if (m.site != no_index) new_site[i] = m.site;
            if (m.site != no_index || new_site[i] == no_index) continue;
            new_site[i] = static_cast<Index>(result.sites.size());
            result.sites.push_back(m.point);
            result.weights.push_back((result.weights[m.low] + result.weights[m.high]) / 2);
            unit.push_back((unit[m.low] + unit[m.high]) / 2);
        }
    }

    [[nodiscard]] double length_of(const Middle& m) const {
        return 2 * m.length / (unit[m.low] + unit[m.high]);
    }

    [[nodiscard]] Index between(Index a, Index b) const {
        const std::pair<Index, Index> pair = std::minmax({a, b});
        const auto found = std::lower_bound(
            dual.middles.begin(), dual.middles.end(), pair,
            [](const Middle& m, const auto& p) { return std::pair(m.low, m.high) < p; });
        if (found == dual.middles.end() || std::pair(found->low, found->high) != pair) {
            return no_index;
        }
        return new_site[static_cast<std::size_t>(found - dual.middles.begin())];
    }

    // Divides a triangle into four, three or two.
    void divide(const Triangle& t) {
        std::array<Index, 3> middle{};
        std::size_t num_missing = 0, missing = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            middle[k] = between(t[k], t[(k + 1) % 3]);
            if (middle[k] != no_index) continue;
            ++num_missing;
            missing = k;
        }
        auto& out = result.triangles;
        if (num_missing == 0) {
            for (std::size_t k = 0; k < 3; ++k) {
                out.push_back({t[k], middle[k], middle[(k + 2) % 3]});
            }
            out.push_back(middle);
            return;
        }
        // Otherwise the triangle is a polygon, cut into a fan around one of its middles.
        std::vector<Index> polygon;
        for (std::size_t i = 1; i <= 3; ++i) {
            const std::size_t k = (missing + i) % 3;
            polygon.push_back(t[k]);
            if (middle[k] != no_index) polygon.push_back(middle[k]);
        }
        if (num_missing < 3) {
            const auto first = std::find_if(polygon.begin(), polygon.end(), [&](Index site) {
                return std::find(t.begin(), t.end(), site) == t.end();
            });
            std::rotate(polygon.begin(), first, polygon.end());
        }
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            out.push_back({polygon[0], polygon[i - 1], polygon[i]});
        }
    }

    // Adds one site in the centre of each of the largest triangles; false if these are too few.
    bool add_centres(Index count) {
        auto& triangles = result.triangles;
        if (count > triangles.size()) return false;
        const auto at = [&](Index site) {
            return position(surface.mesh.view(), result.sites[site]);
        };
        std::vector<std::pair<double, Index>> by_size;  // (minus the area, triangle)
        for (Index i = 0; i < triangles.size(); ++i) {
            const auto& [a, b, c] = triangles[i];
            const double mean = (unit[a] + unit[b] + unit[c]) / 3;
            by_size.emplace_back(-(at(b) - at(a)).cross(at(c) - at(a)).norm() / (mean * mean), i);
        }
        std::sort(by_size.begin(), by_size.end());
        for (Index i = 0; i < count; ++i) {
            const auto [a, b, c] = triangles[by_size[i].second];
            const auto site = static_cast<Index>(result.sites.size());
            const Vec3 centre = (at(a) + at(b) + at(c)) / 3;
            result.sites.push_back(walk_straight(surface, result.sites[a], centre - at(a)).end);
            const auto& w = result.weights;
            result.weights.push_back((w[a] + w[b] + w[c]) / 3);
            triangles[by_size[i].second] = {a, b, site};
            triangles.push_back({b, c, site});
            triangles.push_back({c, a, site});
        }
        return true;
    }
};

}  // namespace

DistanceBounds label_vertices(const PreparedSurface& surface, std::span<const SurfacePoint> sites,
                              int num_threads, const Progress& progress) {
    return distance_bounds(surface.base.surface(), surface.layout, surface.base.to_intrinsic(sites),
                           num_threads, progress);
}

std::vector<Middle> label_middles(const IntrinsicTriangulation& base,
                                  const DistanceBounds& labels) {
    const Surface& surface = base.surface();
    std::vector<Middle> middles;
    struct Crossing {
        std::uint64_t pair;
        bool is_rim;  // Inner edges come first.
        double length;
        Index half_edge;
    };
    std::vector<Crossing> crossings;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        const Index u = surface.tail(h), v = surface.head(h);
        const Index a = labels.site[u], b = labels.site[v];
        if (a == b) continue;
        const double length = static_cast<double>(labels.distance[u]) + labels.distance[v];
        crossings.push_back(
            {edge_key(a, b), surface.twin[h] == no_index, length + surface.length[e], h});
    }
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& x, const Crossing& y) {
        return std::tie(x.pair, x.is_rim, x.length, x.half_edge) <
               std::tie(y.pair, y.is_rim, y.length, y.half_edge);
    });
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        const Crossing& c = crossings[i];
        if (i > 0 && crossings[i - 1].pair == c.pair) continue;
        const Index h = c.half_edge;
        const double along = std::clamp(
            meeting_share(labels, surface.tail(h), surface.head(h), surface.length_of(h)),
            end_margin, 1 - end_margin);
        middles.push_back({static_cast<Index>(c.pair >> 32), static_cast<Index>(c.pair), c.length,
                           base.to_input(point_on(h, along, side_margin))});
    }
    return middles;
}

void move_to_boundary(const PreparedSurface& prepared, double spacing, int num_threads,
                      const Progress& progress, std::vector<SurfacePoint>& sites) {
    const IntrinsicTriangulation& base = prepared.base;
    const Surface& surface = base.surface();
    const DistanceBounds labels = label_vertices(prepared, sites, num_threads, progress);
    std::vector<Index> nearest(sites.size(), no_index);
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        const Index site = labels.site[v];
        if (site == no_index || !surface.is_boundary_vertex(v)) continue;
        Index& best = nearest[site];
        if (best == no_index || labels.distance[v] < labels.distance[best]) best = v;
    }
    for (std::size_t s = 0; s < sites.size(); ++s) {
        if (nearest[s] != no_index) {
            sites[s] = base.to_input(point_on(surface.outgoing[nearest[s]], off_vertex, 0));
        }
    }
    std::vector<bool> has_corner(sites.size(), false);  // The first one of each site counts.
    for (const std::vector<Index>& loop : boundary_loops(base.input())) {
        const Curve curve = curve_of_loop(base.input(), loop);
        for (const std::size_t i : corners_of_curve(base.input(), curve, spacing)) {
            const Index v = base.input().tail(loop[i]);
            const Index site = labels.site[v];
            if (site == no_index || has_corner[site]) continue;
            has_corner[site] = true;
            sites[site] = point_at(base.input(), v);
        }
    }
}

std::optional<TriangulatedSites> subdivide(const Surface& surface,
                                           const std::vector<SurfacePoint>& sites,
                                           const std::vector<double>& weights, const SiteDual& dual,
                                           Index count, std::span<const double> unit) {
    std::vector<double> units(unit.begin(), unit.end());
    units.resize(sites.size(), 1);
    return Subdivision{surface, dual, {sites, {}, weights}, std::move(units)}.run(count);
}

}  // namespace remesh::detail
