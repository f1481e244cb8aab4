// Zones around the middles of borders come first, then those around the ends. The zones of a round
// have nothing in common, so they are relaxed side by side.
#include "remesh/pipeline/free_borders.h"

#include <algorithm>
#include <utility>

#include "agvd/core/parallel.h"
#include "agvd/core/union_find.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/patch.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/distance_bounds.h"
#include "remesh/pipeline/mesh_part.h"
#include "remesh/sites/cell_measures.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/relaxation.h"
#include "remesh/sites/site_dual.h"

namespace remesh::detail {
namespace {

// Vertices within so many edges of a border are free; those of some more rings are in the zone.
constexpr Index free_rings = 4, outer_rings = 3;
// So far from its ends two borders are farther from each other than their zones reach.
constexpr Index rings_of_ends = 5 * (free_rings + outer_rings) / 2;
constexpr int num_steps = 30;
// In spacings: the surface around the vertices of a zone.
constexpr double reach = 1.5;
// As a share of the spacing: lengths up to this are rounding.
constexpr double rounding = 1e-10;

// Vertices and triangles of the mesh, ascending.
struct Zone {
    std::vector<Index> vertices, triangles;
    std::vector<std::uint8_t> is_fixed;  // By vertex.
};

class BorderRelaxation {
public:
    BorderRelaxation(const CurvedSurface& curved, PlacedMesh& mesh, const StageContext& context)
        : curved_(curved),
          mesh_(mesh),
          context_(context),
          is_hard_(mesh_.triangles.size(), 0),
          is_on_edge_(mesh_.points.size(), 0) {
        std::vector<std::uint64_t> hard;
        for (const auto& [from, to] : mesh_.hard) {
            hard.push_back(edge_key(from, to));
            is_on_edge_[from] = is_on_edge_[to] = 1;
        }
        hard = distinct(std::move(hard));
        for (Index t = 0; t < mesh_.triangles.size(); ++t) {
            const auto& [a, b, c] = mesh_.triangles[t];
            for (const std::uint64_t edge : {edge_key(a, b), edge_key(b, c), edge_key(c, a)}) {
                if (std::ranges::binary_search(hard, edge)) is_hard_[t] = 1;
            }
        }
    }

    // \param seeds  vertices of borders.
    void relax_around(std::span<const Index> seeds) {
        const std::vector<Zone> zones = find_zones(seeds);
        const Progress progress = progress_at(Stage::Place, context_.options, 0);
        Poller poller(progress);
        parallel_each(
            static_cast<Index>(zones.size()), 1, context_.options.num_threads,
            [&](Index i) { relax(zones[i], poller); }, poller);
    }

    // #V: see detail::rings_around().
    [[nodiscard]] std::vector<Index> rings(std::span<const Index> vertices, Index most) const {
        return rings_around(mesh_.triangles, mesh_.points.size(), vertices, most, is_hard_);
    }

private:
    [[nodiscard]] std::vector<Zone> find_zones(std::span<const Index> seeds) const {
        const std::vector<Index> ring = rings(seeds, free_rings + outer_rings);
        const auto is_inside = [&](Index t) {
            return is_hard_[t] == 0 && std::ranges::all_of(mesh_.triangles[t], [&](Index v) {
                       return ring[v] != no_index;
                   });
        };
        UnionFind parts(mesh_.points.size());
        for (Index t = 0; t < mesh_.triangles.size(); ++t) {
            if (!is_inside(t)) continue;
            parts.unite(mesh_.triangles[t][0], mesh_.triangles[t][1]);
            parts.unite(mesh_.triangles[t][0], mesh_.triangles[t][2]);
        }
        std::vector<Zone> zones;
        std::vector<Index> zone_of(mesh_.points.size(), no_index);  // Of a root.
        for (Index t = 0; t < mesh_.triangles.size(); ++t) {
            if (!is_inside(t)) continue;
            Index& zone = zone_of[parts.root(mesh_.triangles[t][0])];
            if (zone == no_index) {
                zone = static_cast<Index>(zones.size());
                zones.emplace_back();
            }
            zones[zone].triangles.push_back(t);
        }
        for (Zone& zone : zones) {
            for (const Index t : zone.triangles) {
                for (const Index v : mesh_.triangles[t]) zone.vertices.push_back(v);
            }
            zone.vertices = distinct(std::move(zone.vertices));
            for (const Index v : zone.vertices) {
                zone.is_fixed.push_back(ring[v] > free_rings || is_on_edge_[v] != 0 ? 1 : 0);
            }
            for (const auto& [from, to] : rim_of(take(mesh_.triangles, zone.triangles))) {
                zone.is_fixed[rank_of(zone.vertices, from)] = 1;
            }
        }
        return zones;
    }

    void relax(const Zone& zone, Poller& poller) {
        const Progress progress = poller.progress();
        const std::vector<SurfacePoint> points = take(mesh_.points, zone.vertices);
        const Surface& whole = curved_.cut();
        const Patch patch =
            patch_of(whole, faces_around(whole, points, reach * curved_.spacing), Ticker(poller));
        const PreparedSurface prepared(patch.surface, curved_.spacing, 1, progress);
        TriangulatedSites start{points, {}, {}};
        for (SurfacePoint& point : start.sites) {
            point.face = FaceId(rank_of(patch.faces, point.face.value()));
        }
        for (const Index t : zone.triangles) {
            Triangle& made = start.triangles.emplace_back(mesh_.triangles[t]);
            for (Index& v : made) v = rank_of(zone.vertices, v);
        }
        Relaxation relaxation(patch.surface, std::move(start), zone.is_fixed, 1, progress);
        const auto num_sites = static_cast<Index>(points.size());
        const CellMeasures cells =
            measure_cells(prepared, label_vertices(prepared, relaxation.sites(), 1, progress),
                          num_sites, 1, progress);
        relaxation.set_density(&cells, {});
        for (int step = 0; step < num_steps; ++step) relaxation.step();
        take_zone(zone, patch, fit(zone, prepared, relaxation, progress));
    }

    // Fits the free vertices.
    [[nodiscard]] PlacedMesh fit(const Zone& zone, const PreparedSurface& prepared,
                                 const Relaxation& relaxation, const Progress& progress) const {
        const std::vector<Index> nearest =
            label_vertices(prepared, relaxation.sites(), 1, progress).site;
        PlacedMesh placed{relaxation.sites(), take(mesh_.offsets, zone.vertices),
                          relaxation.triangles()};
        for (Index i = 0; i < zone.vertices.size(); ++i) {
            if (zone.is_fixed[i] == 0) placed.offsets[i].setZero();
        }
        if (context_.options.fit.value_or(true)) {
            fit_vertices(
                prepared.base, nearest,
                sample_cells(prepared, nearest, static_cast<Index>(zone.vertices.size()), progress),
                placed, 1, progress, rounding * curved_.spacing, zone.is_fixed);
        }
        return placed;
    }

    // Takes a zone back into the mesh.
    void take_zone(const Zone& zone, const Patch& patch, const PlacedMesh& placed) {
        for (Index i = 0; i < zone.vertices.size(); ++i) {
            if (zone.is_fixed[i] != 0) continue;
            SurfacePoint point = placed.points[i];
            point.face = FaceId(patch.faces[point.face.value()]);
            mesh_.points[zone.vertices[i]] = point;
            mesh_.offsets[zone.vertices[i]] = placed.offsets[i];
        }
        for (Index i = 0; i < zone.triangles.size(); ++i) {
            Triangle& made = mesh_.triangles[zone.triangles[i]];
            for (Index k = 0; k < 3; ++k) made[k] = zone.vertices[placed.triangles[i][k]];
        }
    }

    const CurvedSurface& curved_;
    PlacedMesh& mesh_;
    const StageContext& context_;
    std::vector<std::uint8_t> is_hard_;     // #triangles: 1 with an edge on a curve.
    std::vector<std::uint8_t> is_on_edge_;  // #V: 1 at such edges.
};

}  // namespace

void free_borders(const CurvedSurface& curved, const TileBorders& borders, PlacedMesh& mesh,
                  const StageContext& context) {
    const StageClock clock(Stage::Relax, context.result);
    BorderRelaxation relaxation(curved, mesh, context);
    const std::vector<Index> to_end = relaxation.rings(borders.nodes, rings_of_ends);
    std::vector<Index> middles, ends;
    for (const Index v : borders.vertices) {
        (to_end[v] == no_index ? middles : ends).push_back(v);
    }
    relaxation.relax_around(middles);
    relaxation.relax_around(ends);
}

}  // namespace remesh::detail
