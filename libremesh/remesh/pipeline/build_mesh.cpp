// Each round builds cells, dual, the exact vertex count, Delaunay flips and positions. The mesh
// with the fewest intersecting pairs of faces counts.
#include "remesh/pipeline/build_mesh.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/dual/reduce_vertices.h"
#include "remesh/pipeline/crossings.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/improvable_mesh.h"
#include "remesh/pipeline/near_mesh.h"
#include "remesh/pipeline/place_sites.h"
#include "remesh/pipeline/placed_dual.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/pipeline/valid_dual.h"

namespace remesh::detail {
namespace {

// Most rounds that divide edges between patches.
constexpr int most_split_rounds = 5;

void take_crossings(const std::optional<CrossingFaces>& crossings, const PlacedDual& placed,
                    BuiltMesh& built) {
    if (!crossings) return;
    built.self_intersections = crossings->counts();
    for_each_corner(crossings->added, placed.mesh.triangles,
                    [&](Index v) { built.crossing_corners.push_back(placed.mesh.points[v]); });
}

class MeshBuilder {
public:
    MeshBuilder(Domain& domain, const PlacedSites& placed, const StageContext& context)
        : domain_(domain),
          placed_(placed),
          context_(context),
          on_base_(domain.prepared.base.to_intrinsic(placed.sites)) {
        domain.prepared.pieces.reset();  // Not needed until vertices are placed.
    }

    std::optional<PlacedDual> place(BuiltMesh& built) {
        dual_ = build_valid_dual(domain_, placed_, on_base_, context_);
        if (!has_chain(domain_, placed_.chain, dual_)) return std::nullopt;
        built.num_wanted = num_wanted_ = find_target();
        built.num_vertices = fix_edges();
        if (built.num_vertices > num_wanted_) return std::nullopt;
        return place_dual(domain_, placed_.curves, dual_, points_of_vertices(), context_);
    }

    void finish(PlacedDual placed, InputCrossings& of_input, BuiltMesh& built) {
        CrossingFinder finder(domain_, of_input, context_);
        take_crossings(unfit_crossings(finder, placed_.curves, placed, context_.result), placed,
                       built);
        take_mesh(placed, built);
        const bool is_bound = domain_.bound != nullptr && !domain_.has_junctions();
        if (!is_bound && !is_improvable(domain_, context_.options)) return;
        JoinedMesh joined = joined_mesh(placed);
        const bool is_improved =
            is_improvable(domain_, context_.options) &&
            improve(domain_, finder, joined, built.self_intersections, context_);
        if (!is_bound && !is_improved) return;
        if (is_bound) built.proved_distance = bring_near(domain_, joined, context_);
        const PlacedDual improved{std::move(joined.mesh), {}};
        if (auto pairs = is_bound ? finder.find(improved) : std::nullopt) {
            built.crossing_corners.clear();
            take_crossings(finder.tell_added(improved, *std::move(pairs)), improved, built);
        }
        built.mesh = whole_mesh(*domain_.whole, improved);
        built.sites = improved.mesh.points;
    }

private:
    // How many vertices the result is to have: as many as were asked for, or one for each given
    // site that owns a part of the surface. Counts the other given sites.
    Index find_target() {
        const auto& [options, result] = context_;
        num_other_copies_ = placed_.num_other_copies(domain_);
        Index num_wanted = options.num_samples;
        if (options.sites) {
            const auto num_copies = static_cast<Index>(placed_.curves.sites.size());
            const auto num_owning =
                std::count(dual_.has_cell.begin() + num_copies, dual_.has_cell.end(), 1);
            num_wanted = num_copies + static_cast<Index>(num_owning) - num_other_copies_;
            result.sites_dropped = static_cast<Index>(options.sites->size()) - num_wanted;
        }
        if (options.vertex_count == VertexCount::Add)
            num_wanted = std::max(num_wanted, num_vertices());
        return num_wanted;
    }

    // Of the result.
    [[nodiscard]] Index num_vertices() const {
        return static_cast<Index>(dual_.points.size()) - num_other_copies_;
    }

    // Gives the dual its number of vertices and its edges. Edges that would coincide where patches
    // are joined get a vertex in the middle, for which another one goes.
    // \return the number of vertices; more than wanted if it failed.
    Index fix_edges() {
        for (int round = 0; round < most_split_rounds; ++round) {
            if (num_vertices() > num_wanted_) reduce();
            if (num_vertices() > num_wanted_) return num_vertices();
            if (!context_.options.sites) {
                add_vertices(domain_, points_of_vertices(), num_wanted_ - num_vertices(), dual_);
            }
            flip_edges();
            if (split_repeated(domain_, placed_.curves, points_of_vertices(), dual_) == 0) {
                return num_vertices();
            }
        }
        return num_wanted_ + 1;
    }

    // Where the vertices of the dual lie on the cleaned surface.
    [[nodiscard]] std::vector<SurfacePoint> points_of_vertices() const {
        std::vector<SurfacePoint> points;
        points.reserve(dual_.site.size());
        for (Index v = 0; v < dual_.site.size(); ++v) {
            const Index site = dual_.site[v];
            points.push_back(site != no_index ? placed_.sites[site]
                                              : domain_.prepared.base.to_input(dual_.points[v]));
        }
        return points;
    }

    [[nodiscard]] std::vector<Vec3> positions_of_vertices() const {
        std::vector<Vec3> positions;
        positions.reserve(dual_.site.size());
        for (const SurfacePoint& point : points_of_vertices()) {
            positions.push_back(position(domain_.whole->mesh.view(), point));
        }
        return positions;
    }

    // Removes vertices until there are as many as wanted or the topology allows no further removal.
    void reduce() {
        std::vector<std::uint8_t> is_last;  // 1: removed last.
        for (Index v = 0; v < dual_.points.size(); ++v) {
            const bool stays = v < dual_.stays.size() && dual_.stays[v] != 0;
            is_last.push_back(stays || dual_.site[v] < placed_.curves.sites.size());
        }
        const std::vector<Vec3> positions = positions_of_vertices();
        const StageClock clock(Stage::Dual, context_.result);
        (void)reduce_vertices(positions, dual_.triangles, num_wanted_ + num_other_copies_, is_last,
                              progress_of(Stage::Dual, context_.options));
        const std::vector<Index> left =
            drop_unused(static_cast<Index>(dual_.points.size()), dual_.triangles);
        dual_.points = take(dual_.points, left);
        dual_.site = take(dual_.site, left);
        if (!dual_.stays.empty()) dual_.stays = take(dual_.stays, left);
    }

    void flip_edges() {
        const auto& [options, result] = context_;
        const StageClock clock(Stage::Delaunay, result);
        const Progress progress = progress_of(Stage::Delaunay, options);
        poll(progress, 0);
        DelaunayResult made =
            make_delaunay(domain_.base(), dual_.points, positions_of_vertices(), dual_.triangles,
                          {.mode = options.delaunay,
                           .may_fold = !dual_.is_of_cells,
                           .num_threads = options.num_threads,
                           .progress = progress});
        poll(progress, 1);
        dual_.triangles = std::move(made.triangles);
        result.delaunay = made.counts;
    }

    void take_mesh(const PlacedDual& placed, BuiltMesh& built) {
        const GluedMesh& glued = placed.patches->glued;
        built.mesh = whole_mesh(*domain_.whole, placed);
        built.sites = take(placed.mesh.points, glued.representative);
        if (domain_.has_junctions()) built.first_of_group = glued.first_of_group;
        if (domain_.plan->given) order_as_given(glued, built);
    }

    // Sorts the vertices in the caller's order of the sites, others last. Before, the vertices of
    // curves come first.
    void order_as_given(const GluedMesh& glued, BuiltMesh& built) {
        const std::vector<Index>& number = domain_.plan->given->number;
        std::vector<std::pair<Index, Index>> order;  // (number of the site, vertex)
        for (Index v = 0; v < glued.representative.size(); ++v) {
            const Index site = dual_.site[glued.representative[v]];
            order.emplace_back(site < number.size() ? number[site] : no_index, v);
        }
        std::sort(order.begin(), order.end());
        std::vector<Index> before, after(order.size());
        for (const auto& [site, v] : order) {
            after[v] = static_cast<Index>(before.size());
            before.push_back(v);
        }
        built.mesh = {take(built.mesh.positions, before),
                      rename_vertices(built.mesh.triangles, after)};
        built.sites = take(built.sites, before);
    }

    Domain& domain_;
    const PlacedSites& placed_;
    const StageContext& context_;
    const std::vector<SurfacePoint> on_base_;  // The sites.
    ValidDual dual_;
    Index num_wanted_ = 0;
    Index num_other_copies_ = 0;  // Of vertices on curves, but for the first of each.
};

}  // namespace

std::optional<PlacedDual> place_mesh(Domain& domain, const PlacedSites& sites, BuiltMesh& built,
                                     const StageContext& context) {
    return MeshBuilder(domain, sites, context).place(built);
}

void finish_mesh(const CurvedSurface& curved, PlacedMesh mesh, InputCrossings& of_input,
                 const StageContext& context, BuiltMesh& built) {
    CrossingFinder finder(curved, of_input, context);
    PlacedDual placed{std::move(mesh), {}};
    take_crossings(unfit_crossings(finder, {}, placed, context.result), placed, built);
    built.mesh = whole_mesh(*curved.whole, placed);
    built.sites = std::move(placed.mesh.points);
}

BuiltMesh build_mesh(Domain& domain, const PlacedSites& sites, InputCrossings& of_input,
                     const StageContext& context) {
    BuiltMesh built;
    MeshBuilder builder(domain, sites, context);
    std::optional<PlacedDual> placed = builder.place(built);
    if (placed) builder.finish(*std::move(placed), of_input, built);
    return built;
}

}  // namespace remesh::detail
