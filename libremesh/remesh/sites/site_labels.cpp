// Labels are a site and an upper bound of its distance for each vertex of the base. Two labels meet
// on an edge where both distances are equal; faces with two labels are cut at such points.
// Notation: u, v are the ends of an edge, h a half-edge.
#include "remesh/sites/site_labels.h"

#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/core/types.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/sites/face_parts.h"

namespace remesh::detail {
namespace {

// Least distance of middles from the ends of their edge, and from the edge, as shares of it.
constexpr double end_margin = 1e-3;
constexpr double side_margin = 1e-6;
// Distance of places on the boundary from a vertex, as a share of the edge.
constexpr double off_vertex = 0.25;

// Where the labels meet on the way from u to v, in [0, 1].
double meeting_place(const DistanceBounds& labels, Index u, Index v, double length) {
    const double ahead = static_cast<double>(labels.distance[v]) - labels.distance[u];
    return std::clamp((length + ahead) / (2 * length), 0.0, 1.0);
}

// A point on half-edge h, or just inside its face.
SurfacePoint point_on(Index h, double along, double inside) {
    SurfacePoint point{FaceId(Surface::face(h)), {inside, inside, inside}};
    point.barycentric[h % 3] = (1 - along) * (1 - inside);
    point.barycentric[Surface::next(h) % 3] = along * (1 - inside);
    return point;
}

// Adds what the sites of one part hold, face by face.
void add_part(const PreparedSurface& prepared, const DistanceBounds& labels, const FaceParts& parts,
              Index part, Ticker ticker, CellMeasures& result, std::vector<Vec3>& shadow) {
    const Surface& surface = prepared.base.surface();
    parts.for_each_face(part, [&](Index f) {
        ticker.tick();
        const Triangle& t = surface.mesh.triangles[f];
        const std::array<Index, 3> site{labels.site[t[0]], labels.site[t[1]], labels.site[t[2]]};
        const auto add = [&](Index s, double share) {
            if (!parts.has(part, s)) return;
            prepared.pieces->for_each(f, [&](const SurfacePiece& piece) {
                const double area = piece.vector.norm();
                result.area[s] += share * area;
                shadow[s] += share * piece.vector;
                if (!(share * area > 0)) return;
                result.planes[s].add(share * piece.vector, share * area, piece.position);
            });
        };
        if (site[0] == site[1] && site[1] == site[2]) {
            add(site[0], 1);
            return;
        }
        // If two corners have one label, the third corner is cut off; three labels get equal
        // shares.
        std::size_t k = 0;
        while (k < 3 && site[(k + 1) % 3] != site[(k + 2) % 3]) ++k;
        if (k == 3) {
            for (const Index s : site) add(s, 1.0 / 3);
            return;
        }
        const std::size_t next = (k + 1) % 3, previous = (k + 2) % 3;
        const auto h = 3 * f + static_cast<Index>(k);
        const double cut =
            meeting_place(labels, t[k], t[next], surface.length_of(h)) *
            meeting_place(labels, t[k], t[previous], surface.length_of(Surface::previous(h)));
        add(site[k], cut);
        add(site[next], 1 - cut);
    });
}

}  // namespace

DistanceBounds label_vertices(const PreparedSurface& surface, std::span<const SurfacePoint> sites,
                              int num_threads, const Progress& progress) {
    return distance_bounds(surface.base.surface(), surface.layout, surface.base.to_intrinsic(sites),
                           num_threads, progress);
}

CellMeasures measure_cells(const PreparedSurface& surface, const DistanceBounds& labels,
                           Index num_sites, int num_threads, const Progress& progress) {
    Poller poller(progress);
    CellMeasures result{std::vector<double>(num_sites, 0), std::vector<double>(num_sites, 0),
                        std::vector<CellPlanes>(num_sites)};
    std::vector<Vec3> shadow(num_sites, Vec3::Zero());  // Norm: largest projection.
    const FaceParts parts(surface.base.surface(), labels.site, num_threads, poller);
    const auto body = [&](Index part, Index, Index) {
        add_part(surface, labels, parts, part, Ticker(poller), result, shadow);
    };
    parallel_chunks(parts.count(), 1, num_threads, body, poller);
    for (Index i = 0; i < num_sites; ++i) {
        if (result.area[i] > 0) {
            result.bending[i] = std::max(0.0, 1 - shadow[i].norm() / result.area[i]);
        }
    }
    return result;
}

std::vector<Triangle> label_triangles(const Surface& surface, const DistanceBounds& labels) {
    std::vector<Triangle> triangles;
    for (const Triangle& t : surface.mesh.triangles) {
        const Index a = labels.site[t[0]], b = labels.site[t[1]], c = labels.site[t[2]];
        if (a != b && b != c && c != a) triangles.push_back({a, b, c});
    }
    return triangles;
}

SiteDual label_dual(const IntrinsicTriangulation& base, const DistanceBounds& labels,
                    bool keeps_inside) {
    const Surface& surface = base.surface();
    SiteDual result{label_triangles(surface, labels), {}};
    struct Crossing {
        std::uint64_t pair;
        bool is_late;  // False where the middle should lie; such edges come first.
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
        crossings.push_back({edge_key(a, b), (surface.twin[h] != no_index) != keeps_inside,
                             length + surface.length[e], h});
    }
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& x, const Crossing& y) {
        return std::tie(x.pair, x.is_late, x.length, x.half_edge) <
               std::tie(y.pair, y.is_late, y.length, y.half_edge);
    });
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        const Crossing& c = crossings[i];
        if (i > 0 && crossings[i - 1].pair == c.pair) continue;
        const Index h = c.half_edge;
        const double along = std::clamp(
            meeting_place(labels, surface.tail(h), surface.head(h), surface.length_of(h)),
            end_margin, 1 - end_margin);
        const bool is_inside = keeps_inside || surface.twin[h] != no_index;
        result.middles.push_back({static_cast<Index>(c.pair >> 32), static_cast<Index>(c.pair),
                                  c.length,
                                  base.to_input(point_on(h, along, is_inside ? side_margin : 0))});
    }
    return result;
}

std::vector<std::optional<SurfacePoint>> boundary_places(const IntrinsicTriangulation& base,
                                                         const DistanceBounds& labels,
                                                         Index num_sites,
                                                         std::span<const Index> corners) {
    const Surface& surface = base.surface();
    std::vector<Index> nearest(num_sites, no_index);
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        const Index site = labels.site[v];
        if (site == no_index || !surface.is_boundary_vertex(v)) continue;
        Index& best = nearest[site];
        if (best == no_index || labels.distance[v] < labels.distance[best]) best = v;
    }
    std::vector<std::optional<SurfacePoint>> places(num_sites);
    for (Index s = 0; s < num_sites; ++s) {
        if (nearest[s] != no_index) {
            places[s] = base.to_input(point_on(surface.outgoing[nearest[s]], off_vertex, 0));
        }
    }
    std::vector<bool> has_corner(num_sites, false);
    for (const Index v : corners) {
        const Index site = labels.site[v];
        if (site == no_index || has_corner[site]) continue;
        has_corner[site] = true;
        places[site] = point_at(base.input(), v);
    }
    return places;
}

}  // namespace remesh::detail
