#include "remesh/pipeline/tile_meshes.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/build_mesh.h"
#include "remesh/pipeline/free_borders.h"
#include "remesh/pipeline/placed_dual.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/pipeline/tile_mesher.h"
#include "remesh/placement/mesh_curves.h"
#include "remesh/tiles/tiling.h"

namespace remesh::detail {
namespace {

// A tile as a mesh.
struct TileMesh {
    bool has_mesh = false;
    PlacedMesh mesh = {};                    // On the whole surface.
    std::vector<Index> border_site = {};     // #V: its number; no_index: none.
    std::vector<DirectedEdge> creases = {};  // Edges along creases inside the tile.
    std::vector<DirectedEdge> rim = {};      // Borders and boundary.
    std::vector<SurfacePoint> narrow_points = {};
    RemeshResult told = {};
};

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
    [[nodiscard]] TileMesh run(Index number, Poller& poller) const {
        TileMesh made;
        try {
            mesh(number, poller, made);
        } catch (const InvalidInput&) {
            made.has_mesh = false;  // Cutting left a face too narrow.
        }
        return made;
    }

private:
    void mesh(Index number, Poller& poller, TileMesh& made) const {
        const Progress progress = poller.progress();
        Tile tile = take_tile(tiling_, faces_[number], Ticker(poller));
        TileInput input{.spacing = curved_.spacing};
        input.cleaned.surface = build_surface(tile.mesh, 1, progress);
        tile.mesh = {};
        input.cleaned.topology = analyze_topology(input.cleaned.surface.mesh.view(), progress);
        find_curves(tile, input);
        input.border_site = std::move(tile.border_site);
        lock_sites(input);
        RemeshOptions options = context_.options;
        options.num_threads = 1;
        options.num_samples =
            tiling_.num_inner[number] + static_cast<Index>(input.cleaned.locked.vertices.size());
        if (progress) options.progress = [&](Stage, double) { return progress(0); };
        made.told.seconds = context_.result.seconds;
        for (auto& [stage, seconds] : made.told.seconds) seconds = 0;
        std::optional<MeshedTile> meshed = mesh_tile(input, {options, made.told});
        if (!meshed) return;
        made.rim = rim_of(meshed->joined.mesh.triangles);
        made.creases = std::move(meshed->creases);
        made.border_site = std::move(meshed->border_site);
        for (SurfacePoint& point : meshed->joined.mesh.points) point = tile.parts.to_whole(point);
        made.mesh = std::move(meshed->joined.mesh);
        for (const SurfacePoint& point : meshed->narrow_points) {
            made.narrow_points.push_back(tile.parts.to_whole(point));
        }
        made.has_mesh = true;
    }

    // Locks the edges of borders of a tile, and marks its creases.
    void find_curves(const Tile& tile, TileInput& input) const {
        const Surface &surface = input.cleaned.surface, &whole = *curved_.whole;
        LockedElements& locked = input.cleaned.locked;
        input.is_crease.assign(surface.num_edges(), 0);
        locked.is_edge.assign(surface.num_edges(), 0);
        for (Index e = 0; e < surface.num_edges(); ++e) {
            const Index h = surface.edge_half[e];
            const Index of_whole = tile.parts.half_edge_of_whole(h);
            if (surface.twin[h] == no_index) {
                const bool is_border = of_whole == no_index || whole.twin[of_whole] != no_index;
                locked.is_edge[e] = is_border ? 1 : 0;
            } else if (of_whole != no_index && is_crease_[whole.edge[of_whole]] != 0) {
                input.is_crease[e] = 1;
            }
        }
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
JoinedMesh join(const CurvedSurface& curved, std::vector<TileMesh>& tiles, Index num_sites,
                TileBorders& borders) {
    PlacedMesh all;
    std::vector<Index> group;
    std::vector<DirectedEdge> hard, rim;
    std::vector<Index> num_tiles_at(num_sites, 0);
    Index next = num_sites;
    for (TileMesh& tile : tiles) {
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
    std::vector<TileMesh> tiles(tiling.num_tiles);
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
    if (!std::ranges::all_of(tiles, &TileMesh::has_mesh)) return std::nullopt;
    double seconds = 0;
    for (const TileMesh& tile : tiles) {
        for (const auto& [stage, of_stage] : tile.told.seconds) seconds += of_stage;
    }
    TiledMesh made;
    made.num_tiles = tiling.num_tiles;
    result.refined_faces = 0;
    result.certified_error = 0;
    result.relaxation.clear();
    for (const TileMesh& tile : tiles) {
        add_told(tile.told, spent.count() / seconds, result);
        made.narrow_points.insert(made.narrow_points.end(), tile.narrow_points.begin(),
                                  tile.narrow_points.end());
    }
    const StageClock clock(Stage::Place, result);
    const Index num_sites = tiling.borders.num_sites;
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
