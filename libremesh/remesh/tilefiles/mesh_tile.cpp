#include <algorithm>
#include <atomic>
#include <numeric>
#include <unordered_map>

#include "agvd/core/error.h"
#include "agvd/core/number_text.h"
#include "agvd/core/random.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/clean/coarsen.h"
#include "remesh/pipeline/coarse_input.h"
#include "remesh/pipeline/free_borders.h"
#include "remesh/pipeline/mesh_part.h"
#include "remesh/pipeline/tile_mesher.h"
#include "remesh/tilefiles/each_tile.h"
#include "remesh/tilefiles/tile_file.h"
#include "remesh/tiles/tiling.h"

namespace remesh {
namespace {

namespace fs = std::filesystem;

// Samplings that are tried.
constexpr int most_samplings = 3;

// Finds boundary edges by the positions of their ends.
class BoundaryEdges {
public:
    explicit BoundaryEdges(const Surface& surface) : surface_(surface) {
        for (Index h = 0; h < surface.twin.size(); ++h) {
            if (surface.twin[h] == no_index) from_.emplace(tail(h), h);
        }
    }
    // \return no_index: there is none.
    [[nodiscard]] Index find(const Vec3& from, const Vec3& to) const {
        const auto [first, last] = from_.equal_range(from);
        const auto found = std::find_if(first, last, [&](const auto& entry) {
            return surface_.mesh.positions[surface_.head(entry.second)] == to;
        });
        return found == last ? no_index : found->second;
    }

private:
    [[nodiscard]] const Vec3& tail(Index h) const {
        return surface_.mesh.positions[surface_.tail(h)];
    }

    const Surface& surface_;
    std::unordered_multimap<Vec3, Index, PositionHash> from_;
};

// The cleaned tile with the sites of its borders, of which it is the only tile.
Tiling tiling_of(const TileFile& tile, const std::string& name, const TileJobOptions& options) {
    const CleanResult clean = clean_input(tile.mesh.view(), {.num_threads = options.num_threads});
    Tiling tiling;
    tiling.num_tiles = 1;
    tiling.surface = build_surface(clean.mesh.view(), options.num_threads, options.progress);
    const Surface& surface = tiling.surface;
    for (Index f = 0; f < surface.num_faces(); ++f) tiling.parts.add_whole(f);
    tiling.tile.assign(surface.num_faces(), 0);
    tiling.is_border.assign(surface.num_edges(), 0);
    const BoundaryEdges boundary(surface);
    std::vector<Index> edge_of;  // By border.
    for (const auto& [a, b] : tile.border) {
        const Vec3 &from = tile.mesh.positions[a], &to = tile.mesh.positions[b];
        const Index h = boundary.find(from, to);
        if (h == no_index) {
            const auto text = [](double x) { return number_text(x, 12); };
            throw InvalidInput(name + ": the surface is not clean at its border near (" +
                               text(from.x()) + ", " + text(from.y()) + ", " + text(from.z()) +
                               "); clean the mesh first, or choose another number of vertices for "
                               "a tile");
        }
        edge_of.push_back(surface.edge[h]);
        tiling.is_border[surface.edge[h]] = 1;
    }
    for (const TileSite& site : tile.sites) {
        // An edge of the boundary has one half-edge, so both run the same way.
        tiling.borders.sites.push_back({edge_of[site.edge], site.share, site.number});
    }
    std::stable_sort(tiling.borders.sites.begin(), tiling.borders.sites.end(),
                     [](const BorderSite& a, const BorderSite& b) { return a.edge < b.edge; });
    return tiling;
}

// The ends of the edges of the boundary that are borders.
std::vector<DirectedEdge> border_edges(const Tiling& tiling, const Tile& tile,
                                       const Surface& surface) {
    std::vector<DirectedEdge> edges;
    for (Index h = 0; h < surface.twin.size(); ++h) {
        if (surface.twin[h] != no_index) continue;
        const Index of_whole = tile.parts.half_edge_of_whole(h);
        if (of_whole != no_index && tiling.is_border[tiling.surface.edge[of_whole]] != 0) {
            edges.emplace_back(surface.tail(h), surface.head(h));
        }
    }
    return edges;
}

// The tile with no more faces than its mesh needs.
detail::TileInput tile_input(const TileFile& file, const std::string& name, double spacing,
                             const TileJobOptions& options) {
    const Tiling tiling = tiling_of(file, name, options);
    std::vector<Index> all(tiling.surface.num_faces());
    std::iota(all.begin(), all.end(), Index{0});
    Poller poller(options.progress);
    Tile tile = take_tile(tiling, all, Ticker(poller));
    detail::TileInput input{.spacing = spacing, .is_improved = true};
    input.cleaned.surface = build_surface(tile.mesh.view(), options.num_threads, options.progress);
    std::vector<DirectedEdge> borders = border_edges(tiling, tile, input.cleaned.surface);
    input.border_site = std::move(tile.border_site);
    if (const auto coarsening =
            detail::coarsening_for(input.cleaned.surface.num_faces(), file.num_vertices, spacing)) {
        const Surface& fine = input.cleaned.surface;
        const std::vector<std::uint8_t> no_marks(fine.num_edges(), 0);
        CoarsenOptions coarse_options = *coarsening;
        coarse_options.num_threads = options.num_threads;
        coarse_options.progress = options.progress;
        const CoarseMesh coarse =
            coarsen(fine, no_marks, detail::vertices_that_stay(fine, {}), coarse_options);
        input.border_site = take(input.border_site, coarse.vertex_origin);
        for (auto& [from, to] : borders) {
            from = rank_of(coarse.vertex_origin, from);
            to = rank_of(coarse.vertex_origin, to);
        }
        input.cleaned.surface =
            build_surface(coarse.mesh.view(), options.num_threads, options.progress);
    }
    const Surface& surface = input.cleaned.surface;
    input.cleaned.topology = analyze_topology(surface.mesh.view(), options.progress);
    LockedElements& locked = input.cleaned.locked;
    locked.is_edge.assign(surface.num_edges(), 0);
    std::ranges::sort(borders);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        if (surface.twin[h] != no_index) continue;
        locked.is_edge[e] =
            std::ranges::binary_search(borders, DirectedEdge(surface.tail(h), surface.head(h))) ? 1
                                                                                                : 0;
    }
    lock_sites(input);
    return input;
}

// The surface near the borders, and the vertices there.
void take_strip(const Surface& surface, const PlacedMesh& mesh, double spacing,
                TileMeshFile& made) {
    std::vector<Index> seeds;
    for (Index v = 0; v < made.border_site.size(); ++v) {
        if (made.border_site[v] != no_index) seeds.push_back(v);
    }
    const std::vector<Index> ring =
        detail::rings_around(mesh.triangles, mesh.points.size(), seeds, detail::rings_of_strips);
    for (Index v = 0; v < ring.size(); ++v) {
        if (ring[v] == no_index) continue;
        made.near.push_back(v);
        made.points.push_back(mesh.points[v]);
    }
    const std::vector<Index> faces =
        detail::faces_around(surface, made.points, detail::reach_of_strips * spacing);
    for (SurfacePoint& point : made.points) {
        point.face = FaceId(rank_of(faces, point.face.value()));
    }
    made.strip.triangles = take(surface.mesh.triangles, faces);
    made.strip.positions =
        take(surface.mesh.positions, drop_unused(surface.num_vertices(), made.strip.triangles));
}

// Makes the mesh of a tile.
void mesh_tile(const fs::path& folder, const TilePlan& plan, Index number,
               const TileJobOptions& options) {
    const std::string name = tile_path(folder, number).string();
    TileFile file = read_tile(folder, number, identity_of(plan));
    const detail::TileInput input = tile_input(file, name, plan.spacing, options);
    file.mesh = {};
    // Where fans of the tile meet in a site, each has a vertex there.
    std::vector<Index> sites;
    for (const TileSite& site : file.sites) sites.push_back(site.number);
    const auto num_copies = static_cast<Index>(input.cleaned.locked.vertices.size() -
                                               distinct(std::move(sites)).size());
    RemeshOptions run{.num_samples = file.num_vertices + num_copies,
                      .features = Features::Off,
                      .seed = plan.seed,
                      .relax_steps = plan.relax_steps,
                      .num_threads = options.num_threads};
    if (options.progress) {
        run.progress = [&](Stage, double) { return options.progress(0); };
    }
    const Surface& surface = input.cleaned.surface;
    for (int tries = 0; tries < most_samplings; ++tries, ++run.seed) {
        RemeshResult told;
        std::optional<detail::TileMesh> meshed = detail::mesh_tile(input, {run, told});
        if (!meshed) continue;
        const PlacedMesh& placed = meshed->mesh;
        TileMeshFile made{.plan = identity_of(plan), .border_site = std::move(meshed->border_site)};
        made.mesh.triangles = placed.triangles;
        for (Index v = 0; v < placed.points.size(); ++v) {
            made.mesh.positions.push_back(placed.position(surface.mesh.view(), v));
            made.foot.push_back(position(surface.mesh.view(), placed.points[v]));
        }
        const Topology topology = analyze_topology(made.mesh.view(), options.progress);
        if (!topology.is_manifold || !topology.is_oriented ||
            !same_topology(topology, input.cleaned.topology)) {
            continue;
        }
        made.euler = euler_of(topology);
        take_strip(surface, placed, plan.spacing, made);
        write_tile_mesh(folder, number, made);
        return;
    }
    throw ConstraintUnmet(name + ": " + std::to_string(file.num_vertices) +
                          " vertices gave no mesh of its topology; split the file for more "
                          "vertices, or for larger tiles");
}

}  // namespace

bool is_meshed(const fs::path& folder, Index tile) { return fs::exists(mesh_path(folder, tile)); }

MeshedTiles mesh_tiles(const fs::path& folder, std::span<const Index> tiles,
                       const TileJobOptions& options) {
    const TilePlan plan = read_tile_plan(folder);
    for (const Index number : tiles) {
        if (number < plan.num_tiles()) continue;
        throw InvalidOption("there is no tile " + std::to_string(number) + "; the last one of " +
                            folder.string() + " is " + std::to_string(plan.num_tiles() - 1));
    }
    std::atomic<Index> made = 0, there = 0;
    const auto count = static_cast<Index>(tiles.size());
    Progress progress;
    if (options.progress) {
        progress = [&](double) {
            return options.progress(static_cast<double>(made + there) / count);
        };
    }
    Poller poller(progress);
    const TileJobOptions job{count == 1 ? options.num_threads : 1, poller.progress()};
    for_each_tile(
        count, options.num_threads,
        [&](Index i) {
            if (is_meshed(folder, tiles[i])) {
                ++there;
                return;
            }
            mesh_tile(folder, plan, tiles[i], job);
            ++made;
        },
        poller);
    return {made, there};
}

}  // namespace remesh
