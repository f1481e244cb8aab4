#include "remesh/pipeline/tile_meshes.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/build_mesh.h"
#include "remesh/pipeline/cleaned_input.h"
#include "remesh/pipeline/free_borders.h"
#include "remesh/pipeline/place_sites.h"
#include "remesh/pipeline/placed_dual.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/placement/mesh_curves.h"
#include "remesh/tiles/tiling.h"

namespace remesh::detail {
namespace {

// A tile as a mesh.
struct MeshedTile {
    bool has_mesh = false;
    PlacedMesh mesh = {};                    // On the whole surface.
    std::vector<Index> border_site = {};     // #V: its number; no_index: none.
    std::vector<DirectedEdge> creases = {};  // Edges along creases inside the tile.
    std::vector<DirectedEdge> rim = {};      // Borders and boundary.
    std::vector<SurfacePoint> narrow_points = {};
    RemeshResult told = {};
};

// In both directions.
std::vector<DirectedEdge> edges_on_creases(const MeshCurves& curves, const PlacedMesh& mesh) {
    std::vector<CurvePlace> place;
    place.reserve(mesh.points.size());
    for (const SurfacePoint& point : mesh.points) place.push_back(curves.place_of(point));
    std::vector<DirectedEdge> edges;
    for (const Triangle& t : mesh.triangles) {
        for (Index k = 0; k < 3; ++k) {
            const Index from = t[k], to = t[(k + 1) % 3];
            if (!place[from].is_free() && !place[to].is_free() &&
                curves.are_on_crease(place[from], place[to])) {
                edges.emplace_back(from, to);
            }
        }
    }
    return edges;
}

class TileMesher {
public:
    // \param is_crease  #E of the whole surface. All outlive this.
    TileMesher(const CurvedSurface& curved, const std::vector<std::uint8_t>& is_crease,
               const Tiling& tiling, const StageContext& context)
        : curved_(curved),
          is_crease_(is_crease),
          tiling_(tiling),
          context_(context),
          faces_(tiling.num_tiles) {
        for (Index f = 0; f < tiling.tile.size(); ++f) faces_[tiling.tile[f]].push_back(f);
    }

    // \param poller  polled by all threads.
    [[nodiscard]] MeshedTile run(Index number, Poller& poller) const {
        MeshedTile made;
        try {
            mesh(number, poller, made);
        } catch (const InvalidInput&) {
            made.has_mesh = false;  // Cutting left a face too narrow.
        }
        return made;
    }

private:
    void mesh(Index number, Poller& poller, MeshedTile& made) const {
        const Progress progress = poller.progress();
        Tile tile = take_tile(tiling_, faces_[number], Ticker(poller));
        CleanedInput input;
        input.surface = build_surface(tile.mesh, 1, progress);
        tile.mesh = {};
        input.topology = analyze_topology(input.surface.mesh.view(), progress);
        const KeptCurves curves = find_curves(tile, input);
        RemeshOptions options = context_.options;
        options.num_threads = 1;
        options.num_samples =
            tiling_.num_inner[number] + static_cast<Index>(input.locked.vertices.size());
        if (progress) options.progress = [&](Stage, double) { return progress(0); };
        made.told.seconds = context_.result.seconds;
        for (auto& [stage, seconds] : made.told.seconds) seconds = 0;
        const StageContext context{options, made.told};
        CurvedSurface curved{
            .plan = plan_curves(input, {}, curves, curved_.spacing, nullptr, context),
            .whole = &input.surface,
            .cleaned = &input.surface,
            .spacing = curved_.spacing};
        if (curved.plan->network.sites_for_boundary > 0) return;
        Domain domain = prepare_domain(input, std::move(curved), context);
        const PlacedSites sites = place_sites(domain, context);
        BuiltMesh built;
        const std::optional<PlacedDual> placed = place_mesh(domain, sites, built, context);
        if (!placed) return;
        take(*placed, sites.curves, domain, tile, context, made);
        for (const SurfacePoint& point : sites.narrow_points) {
            made.narrow_points.push_back(tile.parts.to_whole(point));
        }
        made.has_mesh = true;
    }

    // Locks the borders of a tile, and marks its creases.
    [[nodiscard]] KeptCurves find_curves(const Tile& tile, CleanedInput& input) const {
        const Surface &surface = input.surface, &whole = *curved_.whole;
        KeptCurves curves{.has_junctions = false, .has_seams = false};
        curves.is_crease.assign(surface.num_edges(), 0);
        input.locked.is_edge.assign(surface.num_edges(), 0);
        for (Index e = 0; e < surface.num_edges(); ++e) {
            const Index h = surface.edge_half[e];
            const Index of_whole = tile.parts.half_edge_of_whole(h);
            if (surface.twin[h] == no_index) {
                const bool is_border = of_whole == no_index || whole.twin[of_whole] != no_index;
                input.locked.is_edge[e] = is_border ? 1 : 0;
            } else if (of_whole != no_index && is_crease_[whole.edge[of_whole]] != 0) {
                curves.is_crease[e] = 1;
            }
        }
        for (Index v = 0; v < tile.border_site.size(); ++v) {
            if (tile.border_site[v] != no_index) input.locked.vertices.push_back(v);
        }
        return curves;
    }

    // Improves the mesh of a tile and takes it to the whole surface.
    static void take(const PlacedDual& placed, const CurveSites& sites, const Domain& domain,
                     const Tile& tile, const StageContext& context, MeshedTile& made) {
        JoinedMesh joined = joined_mesh(placed);
        made.border_site.assign(joined.mesh.points.size(), no_index);
        const std::vector<Index>& nodes = domain.plan->network.network.nodes;
        const JoinedPatches& patches = *placed.patches;
        for (Index v = 0; v < patches.group.size(); ++v) {
            if (patches.group[v] >= sites.num_nodes()) continue;
            made.border_site[patches.glued.vertex[v]] = tile.border_site[nodes[patches.group[v]]];
        }
        improve_in_places(domain, joined, context);
        const MeshCurves curves(*domain.whole, domain.cut(), domain.plan->network.network);
        made.rim = rim_of(joined.mesh.triangles);
        made.creases = edges_on_creases(curves, joined.mesh);
        for (SurfacePoint& point : joined.mesh.points) point = tile.parts.to_whole(point);
        made.mesh = std::move(joined.mesh);
    }

    const CurvedSurface& curved_;
    const std::vector<std::uint8_t>& is_crease_;
    const Tiling& tiling_;
    const StageContext& context_;
    std::vector<std::vector<Index>> faces_;  // By tile, ascending.
};

// #E of the whole surface: the creases of the network.
std::vector<std::uint8_t> mark_creases(const CurvedSurface& curved) {
    std::vector<std::uint8_t> is_crease(curved.whole->num_edges(), 0);
    for (const Curve& curve : curved.plan->network.network.curves) {
        if (!curve.is_crease()) continue;
        for (const Index h : curve.sides.front().half_edges) is_crease[curved.whole->edge[h]] = 1;
    }
    return is_crease;
}

// Joins the meshes of the tiles: sites of borders become one vertex.
JoinedMesh join(const CurvedSurface& curved, std::vector<MeshedTile>& tiles, Index num_sites,
                TileBorders& borders) {
    PlacedMesh all;
    std::vector<Index> group;
    std::vector<DirectedEdge> hard, rim;
    std::vector<Index> num_tiles_at(num_sites, 0);
    Index next = num_sites;
    for (MeshedTile& tile : tiles) {
        const auto first = static_cast<Index>(all.points.size());
        for (const Index site : tile.border_site) group.push_back(site != no_index ? site : next++);
        std::vector<Index> sites = distinct(tile.border_site);
        if (!sites.empty() && sites.back() == no_index) sites.pop_back();
        for (const Index site : sites) ++num_tiles_at[site];
        const auto append = [](auto& some, auto& more) {
            some.insert(some.end(), more.begin(), more.end());
        };
        append(all.points, tile.mesh.points);
        append(all.offsets, tile.mesh.offsets);
        for (const auto& [a, b, c] : tile.mesh.triangles) {
            all.triangles.push_back({first + a, first + b, first + c});
        }
        for (const auto& [from, to] : tile.creases) hard.emplace_back(first + from, first + to);
        for (const auto& [from, to] : tile.rim) rim.emplace_back(first + from, first + to);
        tile.mesh = {};
    }
    GluedMesh glued = glue(all.triangles, group);
    const auto to_glued = [&](DirectedEdge& edge) {
        edge = {glued.vertex[edge.first], glued.vertex[edge.second]};
    };
    std::ranges::for_each(hard, to_glued);
    JoinedMesh joined{{agvd::take(all.points, glued.representative),
                       agvd::take(all.offsets, glued.representative), std::move(glued.triangles)},
                      std::move(hard)};
    for (Index v = 0; v < glued.representative.size(); ++v) {
        const Index site = group[glued.representative[v]];
        if (site >= num_sites) continue;
        borders.vertices.push_back(v);
        if (num_tiles_at[site] > 2) borders.nodes.push_back(v);
    }
    const std::vector<DirectedEdge> boundary = rim_of(joined.mesh.triangles);
    const MeshCurves curves(*curved.whole, curved.cut(), curved.plan->network.network);
    for (DirectedEdge& edge : rim) {
        to_glued(edge);
        if (std::ranges::binary_search(boundary, edge) ||
            curves.are_on_crease(curves.place_of(joined.mesh.points[edge.first]),
                                 curves.place_of(joined.mesh.points[edge.second]))) {
            joined.hard.push_back(edge);
        }
    }
    return joined;
}

// Adds the values of one level of relaxation to those of other tiles. One that took fewer steps
// stays at its last energy.
void add_level(const RelaxLevel& level, RelaxLevel& sum) {
    const std::size_t count = std::max(level.energy.size(), sum.energy.size());
    if (sum.energy.empty()) sum.energy.assign(count, 0.0);
    sum.energy.resize(count, sum.energy.back());
    for (std::size_t i = 0; i < count; ++i) {
        sum.energy[i] += level.energy[std::min(i, level.energy.size() - 1)];
    }
    sum.num_sites += level.num_sites;
}

// Adds what the stages told of a tile.
// \param share  of the time of a tile in that of all on the clock.
void add_told(const RemeshResult& tile, double share, RemeshResult& sum) {
    for (std::size_t i = 0; i < sum.seconds.size(); ++i) {
        sum.seconds[i].second += share * tile.seconds[i].second;
    }
    sum.refined_faces += tile.refined_faces;
    sum.features.simplified_patches += tile.features.simplified_patches;
    sum.features.dropped_length += tile.features.dropped_length;
    sum.features.length -= tile.features.dropped_length;
    for (Index DelaunayCounts::*count :
         {&DelaunayCounts::inner_edges, &DelaunayCounts::failing_before,
          &DelaunayCounts::failing_after, &DelaunayCounts::flips,
          &DelaunayCounts::not_locally_shortest, &DelaunayCounts::broken_triangles}) {
        sum.delaunay.*count += tile.delaunay.*count;
    }
    sum.delaunay.is_finished = sum.delaunay.is_finished && tile.delaunay.is_finished;
    sum.certified_error = std::max(sum.certified_error, tile.certified_error);
    sum.propagation_bytes = std::max(sum.propagation_bytes, tile.propagation_bytes);
    sum.relaxation.resize(std::max(sum.relaxation.size(), tile.relaxation.size()));
    for (std::size_t i = 0; i < tile.relaxation.size(); ++i) {
        add_level(tile.relaxation[i], sum.relaxation[i]);
    }
}

}  // namespace

bool is_tiled(const CurvedSurface& curved, const RemeshOptions& options) {
    const std::uint64_t per_tile = options.samples_per_tile;
    return per_tile > 0 && options.num_samples > per_tile + per_tile / 4 && is_relaxed(options) &&
           !options.sites && options.boundary == Boundary::Keep && curved.sizes == nullptr &&
           !curved.has_junctions() && !curved.has_locked() &&
           !std::holds_alternative<MaxDistance>(options.sizing.count);
}

std::optional<TiledMesh> mesh_tiles(const CurvedSurface& curved, const StageContext& context) {
    const RemeshOptions& options = context.options;
    RemeshResult& result = context.result;
    const std::vector<std::uint8_t> is_crease = mark_creases(curved);
    Tiling tiling;
    {
        const StageClock clock(Stage::Clean, result);
        try {
            tiling = divide_into_tiles(*curved.whole, is_crease,
                                       {.num_vertices = options.num_samples,
                                        .per_tile = options.samples_per_tile,
                                        .spacing = curved.plan->network.spacing,
                                        .progress = progress_at(Stage::Clean, options, 1)});
        } catch (const InvalidInput&) {
            return std::nullopt;
        }
    }
    std::vector<MeshedTile> tiles(tiling.num_tiles);
    std::atomic<Index> num_done = 0;
    const Progress progress = [&](double) {
        return !options.progress ||
               options.progress(Stage::Relax, static_cast<double>(num_done) / tiling.num_tiles);
    };
    const auto start = std::chrono::steady_clock::now();
    {
        const TileMesher mesher(curved, is_crease, tiling, context);
        Poller poller(progress);
        parallel_each(
            tiling.num_tiles, 1, options.num_threads,
            [&](Index t) {
                tiles[t] = mesher.run(t, poller);
                ++num_done;
            },
            poller);
    }
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    if (!std::ranges::all_of(tiles, &MeshedTile::has_mesh)) return std::nullopt;
    double seconds = 0;
    for (const MeshedTile& tile : tiles) {
        for (const auto& [stage, of_stage] : tile.told.seconds) seconds += of_stage;
    }
    TiledMesh made;
    made.num_tiles = tiling.num_tiles;
    result.refined_faces = 0;
    result.certified_error = 0;
    result.relaxation.clear();
    for (const MeshedTile& tile : tiles) {
        add_told(tile.told, spent.count() / seconds, result);
        made.narrow_points.insert(made.narrow_points.end(), tile.narrow_points.begin(),
                                  tile.narrow_points.end());
    }
    const StageClock clock(Stage::Place, result);
    const Index num_sites = tiling.num_sites;
    tiling = {};
    TileBorders borders;
    JoinedMesh joined = join(curved, tiles, num_sites, borders);
    std::vector<Index> on_curves;
    for (const auto& [from, to] : joined.hard) on_curves.push_back(from);
    result.features.vertices = static_cast<Index>(distinct(std::move(on_curves)).size());
    free_borders(curved, borders, joined, context);
    improve_in_places(curved, joined, context);
    made.num_vertices = static_cast<Index>(joined.mesh.points.size());
    made.mesh = std::move(joined.mesh);
    return made;
}

}  // namespace remesh::detail
