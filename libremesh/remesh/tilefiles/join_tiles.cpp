#include <algorithm>
#include <numeric>

#include "agvd/core/error.h"
#include "agvd/core/number_text.h"
#include "remesh/clean/clean_input.h"
#include "remesh/curves/glue.h"
#include "remesh/meshfile/point_welder.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/free_borders.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/quality/evaluate.h"
#include "remesh/tilefiles/tile_file.h"

namespace remesh {
namespace {

namespace fs = std::filesystem;

// Rounds in which vertices of intersecting triangles go back to the surface.
constexpr int most_rounds = 4;

// The meshes of all tiles, glued at their borders.
struct Glued {
    TriangleMesh mesh;
    std::vector<Vec3> foot;            // #V: on the surface.
    detail::TileBorders borders;       // Vertices.
    std::vector<Index> near;           // Vertices on the strips, ascending.
    std::vector<SurfacePoint> points;  // Of these, on `strips`.
    TriangleMesh strips;
    std::int64_t euler = 0;  // Of the tiles together.
};

class TileGluer {
public:
    TileGluer(const fs::path& folder, const TilePlan& plan) : folder_(folder), plan_(plan) {}

    Glued run(Ticker ticker) {
        std::vector<Index> num_tiles_at(plan_.num_sites, 0);
        PointWelder welder;
        Index next = plan_.num_sites;
        for (Index tile = 0; tile < plan_.num_tiles(); ++tile) {
            ticker.tick(1 << 20);
            if (!is_meshed(folder_, tile)) {
                throw IoError(mesh_path(folder_, tile).string() +
                              ": is not there; mesh this tile first");
            }
            const TileMeshFile part = read_tile_mesh(folder_, tile, identity_of(plan_));
            for (const Index site : distinct(part.border_site)) {
                if (site != no_index) ++num_tiles_at.at(site);
            }
            for (const Index site : part.border_site) {
                group_.push_back(site != no_index ? site : next++);
            }
            add(part, welder);
        }
        strips_.positions = std::move(welder.points());
        (void)flip_repeated(triangles_, group_);
        const GluedMesh glued = glue(triangles_, group_);
        Glued made;
        made.mesh = {take(positions_, glued.first), glued.triangles};
        made.foot = take(foot_, glued.first);
        made.euler = euler_ - plan_.border_euler;
        made.strips = std::move(strips_);
        for (Index v = 0; v < glued.first.size(); ++v) {
            const Index site = group_[glued.first[v]];
            if (site >= plan_.num_sites) continue;
            made.borders.vertices.push_back(v);
            if (num_tiles_at[site] > 2) made.borders.nodes.push_back(v);
        }
        std::vector<std::pair<Index, Index>> order;  // Vertex, index.
        for (Index i = 0; i < near_.size(); ++i) order.emplace_back(glued.vertex[near_[i]], i);
        std::ranges::sort(order);
        for (const auto& [vertex, i] : order) {
            if (!made.near.empty() && made.near.back() == vertex) continue;
            made.near.push_back(vertex);
            made.points.push_back(points_[i]);
        }
        return made;
    }

private:
    void add(const TileMeshFile& part, PointWelder& welder) {
        const auto first = static_cast<Index>(positions_.size());
        const auto first_face = static_cast<Index>(strips_.triangles.size());
        positions_.insert(positions_.end(), part.mesh.positions.begin(), part.mesh.positions.end());
        foot_.insert(foot_.end(), part.foot.begin(), part.foot.end());
        for (const auto& [a, b, c] : part.mesh.triangles) {
            triangles_.push_back({first + a, first + b, first + c});
        }
        for (Index f = 0; f < part.strip.triangles.size(); ++f) {
            const std::array<Vec3, 3> corners = corners_of(part.strip.view(), f);
            strips_.triangles.push_back({welder.index_of(corners[0]), welder.index_of(corners[1]),
                                         welder.index_of(corners[2])});
        }
        for (const Index v : part.near) near_.push_back(first + v);
        for (SurfacePoint point : part.points) {
            point.face = FaceId(first_face + point.face.value());
            points_.push_back(point);
        }
        euler_ += part.euler;
    }

    const fs::path& folder_;
    const TilePlan& plan_;
    std::vector<Vec3> positions_, foot_;
    std::vector<Triangle> triangles_;
    std::vector<Index> group_;  // #V: equal for the copies of a site.
    TriangleMesh strips_;
    std::vector<Index> near_;
    std::vector<SurfacePoint> points_;
    std::int64_t euler_ = 0;
};

// Relaxes and improves the vertices near borders. Leaves all as it is if the strips are no surface.
void free_vertices(const TilePlan& plan, const TileJobOptions& options, Glued& glued) {
    if (glued.near.empty()) return;
    const CleanResult clean =
        clean_input(glued.strips.view(), {.keep_slits = true, .num_threads = options.num_threads});
    if (clean.mesh.triangles.size() != glued.strips.triangles.size()) return;
    glued.strips = {};
    const Surface surface = build_surface(clean.mesh.view(), options.num_threads, options.progress);
    auto curves = std::make_unique<detail::CurvePlan>();
    const std::vector<std::uint8_t> no_edges(surface.num_edges(), 0);
    curves->network.network = find_network(surface, no_edges, plan.spacing);
    curves->network.cut = cut_surface(surface, no_edges, options.num_threads, options.progress);
    const detail::CurvedSurface curved{
        .plan = std::move(curves), .whole = &surface, .cleaned = &surface, .spacing = plan.spacing};
    PlacedMesh part;
    part.points = glued.points;
    for (Index i = 0; i < glued.near.size(); ++i) {
        part.offsets.push_back(glued.mesh.positions[glued.near[i]] -
                               position(surface.mesh.view(), glued.points[i]));
    }
    std::vector<Triangle> others;
    for (const Triangle& t : glued.mesh.triangles) {
        Triangle made{};
        bool is_near = true;
        for (Index k = 0; k < 3; ++k) {
            made[k] = rank_of(glued.near, t[k]);
            is_near = is_near && made[k] < glued.near.size() && glued.near[made[k]] == t[k];
        }
        if (is_near) {
            part.triangles.push_back(made);
        } else {
            others.push_back(t);
        }
    }
    const std::vector<DirectedEdge> boundary = rim_of(glued.mesh.triangles);
    std::vector<std::uint8_t> stays(glued.near.size(), 0);
    for (const DirectedEdge& edge : rim_of(part.triangles)) {
        part.hard.push_back(edge);
        const DirectedEdge of_whole{glued.near[edge.first], glued.near[edge.second]};
        if (!std::ranges::binary_search(boundary, of_whole)) {
            stays[edge.first] = stays[edge.second] = 1;
        }
    }
    detail::TileBorders borders;
    for (const Index v : glued.borders.vertices) {
        borders.vertices.push_back(rank_of(glued.near, v));
    }
    for (const Index v : glued.borders.nodes) borders.nodes.push_back(rank_of(glued.near, v));
    RemeshResult told;
    RemeshOptions run{.num_threads = options.num_threads};
    if (options.progress) {
        run.progress = [&](Stage, double) { return options.progress(0.5); };
    }
    detail::free_borders(curved, borders, part, {run, told});
    detail::improve_in_places(curved, stays, part, {run, told});
    for (Index i = 0; i < glued.near.size(); ++i) {
        const Index v = glued.near[i];
        glued.foot[v] = position(surface.mesh.view(), part.points[i]);
        glued.mesh.positions[v] = glued.foot[v] + part.offsets[i];
    }
    glued.mesh.triangles = std::move(others);
    for (const auto& [a, b, c] : part.triangles) {
        glued.mesh.triangles.push_back({glued.near[a], glued.near[b], glued.near[c]});
    }
}

// Moves the vertices of intersecting triangles back to the surface.
// \return the pairs that still intersect; unset without CGAL.
std::optional<Index> unfit_crossings(Glued& glued, const TileJobOptions& options) {
    for (int round = 0;; ++round) {
        const auto pairs =
            find_self_intersections(glued.mesh.view(), options.num_threads, options.progress);
        if (!pairs) return std::nullopt;
        bool is_moved = false;
        for (const auto& [f, g] : *pairs) {
            for (const Index face : {f, g}) {
                for (const Index v : glued.mesh.triangles[face]) {
                    is_moved = is_moved || glued.mesh.positions[v] != glued.foot[v];
                    glued.mesh.positions[v] = glued.foot[v];
                }
            }
        }
        if (!is_moved || round == most_rounds) return static_cast<Index>(pairs->size());
    }
}

// \return unset: the mesh is none, or has another Euler characteristic.
std::optional<Topology> right_topology(const Glued& glued, const Progress& progress) {
    Topology topology = analyze_topology(glued.mesh.view(), progress);
    if (!topology.is_manifold || !topology.is_oriented || euler_of(topology) != glued.euler) {
        return std::nullopt;
    }
    return topology;
}

}  // namespace

JoinedTiles join_tiles(const fs::path& folder, const TileJobOptions& options) {
    const TilePlan plan = read_tile_plan(folder);
    Poller poller(options.progress);
    Glued glued = TileGluer(folder, plan).run(Ticker(poller));
    if (!right_topology(glued, options.progress)) {
        throw ConstraintUnmet(folder.string() +
                              ": the meshes of the tiles do not fit together; split the file for "
                              "more vertices, or for larger tiles");
    }
    const Glued before{glued.mesh, glued.foot, {}, {}, {}, {}, glued.euler};
    free_vertices(plan, options, glued);
    std::optional<Topology> topology = right_topology(glued, options.progress);
    if (!topology) {
        glued = before;
        topology = right_topology(glued, options.progress);
    }
    JoinedTiles joined;
    joined.self_intersections = unfit_crossings(glued, options);
    joined.mesh = std::move(glued.mesh);
    joined.topology = *std::move(topology);
    return joined;
}

}  // namespace remesh
