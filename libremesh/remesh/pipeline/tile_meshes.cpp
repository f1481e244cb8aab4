#include "remesh/pipeline/tile_meshes.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <numeric>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/free_borders.h"
#include "remesh/pipeline/improvable_mesh.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/placement/mesh_curves.h"
#include "remesh/tiles/tiling.h"

namespace remesh::detail {
namespace {

// A tile on the whole surface, and what its stages told.
struct MeshedTile {
    std::optional<TileMesh> made = {};
    RemeshResult told = {};
};

// The fractions of all tiles, of which each thread moves those of its own.
class TileProgress {
public:
    explicit TileProgress(Index num_tiles) : done_(num_tiles) {}

    // Does not fall where stages of a tile are run again.
    void tell(Index tile, double fraction) {
        if (fraction > done_[tile]) done_[tile] = fraction;
    }
    [[nodiscard]] double mean() const {
        const double sum = std::accumulate(done_.begin(), done_.end(), 0.0);
        return sum / static_cast<double>(done_.size());
    }

private:
    std::vector<std::atomic<double>> done_;
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
    [[nodiscard]] MeshedTile run(Index number, TileProgress& done, Poller& poller) const {
        MeshedTile tile;
        try {
            tile.made = mesh(number, done, poller, tile.told);
        } catch (const InvalidInput&) {
            // Cutting left a face too narrow.
        }
        return tile;
    }

private:
    [[nodiscard]] std::optional<TileMesh> mesh(Index number, TileProgress& done, Poller& poller,
                                               RemeshResult& told) const {
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
        options.progress = [&](Stage stage, double fraction) {
            done.tell(number, overall_fraction(stage, fraction, faces_[number].size(), options));
            return !progress || progress(0);
        };
        told.seconds = context_.result.seconds;
        for (auto& [stage, seconds] : told.seconds) seconds = 0;
        std::optional<TileMesh> made = mesh_tile(input, {options, told});
        if (!made) return made;
        for (auto* points : {&made->mesh.points, &made->narrow_points}) {
            for (SurfacePoint& point : *points) point = tile.parts.to_whole(point);
        }
        return made;
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
PlacedMesh join(const CurvedSurface& curved, std::vector<MeshedTile>& tiles, Index num_sites,
                TileBorders& borders) {
    PlacedMesh all;
    std::vector<Index> group;
    std::vector<Index> num_tiles_at(num_sites, 0);
    Index next = num_sites;
    for (MeshedTile& meshed : tiles) {
        TileMesh& tile = *meshed.made;
        const auto first = static_cast<Index>(all.points.size());
        for (const Index site : tile.border_site) group.push_back(site != no_index ? site : next++);
        for (const Index site : distinct(tile.border_site)) {
            if (site != no_index) ++num_tiles_at[site];
        }
        const auto append = [](auto& some, auto& more) {
            some.insert(some.end(), more.begin(), more.end());
        };
        append(all.points, tile.mesh.points);
        append(all.offsets, tile.mesh.offsets);
        for (const auto& [a, b, c] : tile.mesh.triangles) {
            all.triangles.push_back({first + a, first + b, first + c});
        }
        for (const auto& [a, b] : tile.mesh.hard) all.hard.emplace_back(first + a, first + b);
        tile.mesh = {};
    }
    (void)flip_repeated(all.triangles, group);
    GluedMesh glued = glue(all.triangles, group);
    PlacedMesh joined{take(all.points, glued.first), take(all.offsets, glued.first),
                      std::move(glued.triangles)};
    for (Index v = 0; v < glued.first.size(); ++v) {
        const Index site = group[glued.first[v]];
        if (site >= num_sites) continue;
        borders.vertices.push_back(v);
        if (num_tiles_at[site] > 2) borders.nodes.push_back(v);
    }
    // Borders become free where they are no curves.
    const std::vector<DirectedEdge> boundary = rim_of(joined.triangles);
    const MeshCurves curves = curved.curves();
    const auto place = [&](Index v) { return curves.place_of(joined.points[v]); };
    for (const auto& [a, b] : all.hard) {
        const DirectedEdge edge{glued.vertex[a], glued.vertex[b]};
        if (std::ranges::binary_search(boundary, edge) ||
            curves.are_on_crease(place(edge.first), place(edge.second))) {
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
    sum.dual.add(tile.dual);
    sum.features.dropped_length += tile.features.dropped_length;
    sum.features.length -= tile.features.dropped_length;
    for (Index DelaunayCounts::*count :
         {&DelaunayCounts::inner_edges, &DelaunayCounts::failing_before,
          &DelaunayCounts::failing_after, &DelaunayCounts::flips, &DelaunayCounts::measured_edges,
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

std::optional<TileMesh> mesh_in_tiles(const CurvedSurface& curved, const StageContext& context) {
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
    TileProgress done(tiling.num_tiles);
    const Progress progress = [&](double) {
        return !options.progress || options.progress(Stage::Relax, done.mean());
    };
    const auto start = std::chrono::steady_clock::now();
    {
        const TileMesher mesher(curved, is_crease, tiling, context);
        Poller poller(progress);
        parallel_each(
            tiling.num_tiles, 1, options.num_threads,
            [&](Index t) {
                tiles[t] = mesher.run(t, done, poller);
                done.tell(t, 1);
            },
            poller);
    }
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    if (!std::ranges::all_of(tiles, [](const auto& tile) { return tile.made.has_value(); })) {
        return std::nullopt;
    }
    double seconds = 0;
    for (const MeshedTile& tile : tiles) {
        for (const auto& [stage, of_stage] : tile.told.seconds) seconds += of_stage;
    }
    TileMesh all;
    result.tiles = tiling.num_tiles;
    result.refined_faces = 0;
    result.certified_error = 0;
    result.dual = {};
    result.relaxation.clear();
    for (const MeshedTile& tile : tiles) {
        add_told(tile.told, spent.count() / seconds, result);
        all.narrow_points.insert(all.narrow_points.end(), tile.made->narrow_points.begin(),
                                 tile.made->narrow_points.end());
    }
    const StageClock clock(Stage::Place, result);
    const Index num_sites = tiling.borders.num_sites;
    tiling = {};
    TileBorders borders;
    all.mesh = join(curved, tiles, num_sites, borders);
    std::vector<Index> on_curves;
    for (const auto& [from, to] : all.mesh.hard) on_curves.push_back(from);
    result.features.vertices = static_cast<Index>(distinct(std::move(on_curves)).size());
    free_borders(curved, borders, all.mesh, context);
    improve_in_places(curved, {}, all.mesh, context);
    return all;
}

}  // namespace remesh::detail
