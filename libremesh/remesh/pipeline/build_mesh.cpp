#include "remesh/pipeline/build_mesh.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/dual/reduce_vertices.h"
#include "remesh/pipeline/crossings.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/dual_mesh.h"
#include "remesh/pipeline/improvable_mesh.h"
#include "remesh/pipeline/near_mesh.h"
#include "remesh/pipeline/place_sites.h"
#include "remesh/pipeline/promises.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/placement/shape_quality.h"
#include "remesh/wrap/relax_guarded.h"

namespace remesh::detail {
namespace {

// Degrees. Triangles with other angles are worth some distance from the surface.
constexpr double aimed_min_angle = 15, aimed_max_angle = 150;
// A wrap is as far from its input as that costs.
constexpr double aimed_min_angle_of_wraps = 30;
// Rounds in which creases give way, and how far the mesh may move then unless fewer faces
// intersect, as a share of the spacing.
constexpr double most_change = 0.4;
constexpr int most_freeings = 2;

// The bounds, and those that no run promises.
ShapeBounds with_aims(ShapeBounds bounds) {
    bounds.min_angle = std::max(bounds.min_angle, aimed_min_angle);
    bounds.max_angle = std::min(bounds.max_angle, aimed_max_angle);
    return bounds;
}

void take_crossings(const CrossingFaces& crossings, BuiltMesh& built) {
    built.self_intersections = crossings.counts();
    built.crossing_corners.clear();
    for_each_corner(crossings.added, built.mesh.triangles,
                    [&](Index v) { built.crossing_corners.push_back(built.mesh.points[v]); });
}

// How many vertices the result is to have: as many as were asked for, or one for each given site
// that owns a part of the surface. Counts the other given sites.
Index find_target(const Domain& domain, const PlacedSites& placed, const DualMesh& dual,
                  const StageContext& context) {
    const auto& [options, result] = context;
    Index num_wanted = options.num_samples;
    if (options.sites) {
        const auto num_copies = static_cast<std::ptrdiff_t>(placed.curves.sites.size());
        num_wanted = num_result_vertices(domain.plan->network.network, placed.curves) +
                     static_cast<Index>(
                         std::count(dual.has_cell.begin() + num_copies, dual.has_cell.end(), 1));
        result.sites_dropped = static_cast<Index>(options.sites->size()) - num_wanted;
    }
    return num_wanted;
}

// Sorts the vertices in the caller's order of the sites, others last. Before, the vertices of
// curves come first.
void order_as_given(const std::vector<Index>& number, BuiltMesh& built) {
    std::vector<std::pair<Index, Index>> order;  // (number of the site, vertex)
    for (Index v = 0; v < built.site.size(); ++v) {
        const Index site = built.site[v];
        order.emplace_back(site < number.size() ? number[site] : no_index, v);
    }
    std::sort(order.begin(), order.end());
    std::vector<Index> before, after(order.size());
    for (const auto& [site, v] : order) {
        after[v] = static_cast<Index>(before.size());
        before.push_back(v);
    }
    PlacedMesh& mesh = built.mesh;
    mesh.points = take(mesh.points, before);
    mesh.offsets = take(mesh.offsets, before);
    mesh.triangles = rename_vertices(mesh.triangles, after);
    for (auto& [from, to] : mesh.hard) {
        from = after[from];
        to = after[to];
    }
    if (!mesh.place.empty()) {
        mesh.place = take(mesh.place, before);
        for (Index& v : mesh.place) v = after[v];
    }
    built.site = take(built.site, before);
}

// Of faces that exceed bounds.
std::ptrdiff_t num_beyond(const TriangleMesh& mesh, const ShapeBounds& bounds) {
    const ShapeMeasure shape(bounds);
    return std::ranges::count_if(mesh.triangles, [&](const Triangle& t) {
        const auto& p = mesh.positions;
        return shape(p[t[0]], p[t[1]], p[t[2]]) < low_quality;
    });
}

// Whether two meshes are near each other: the middles of the edges of each one.
bool are_near(const TriangleMesh& a, const TriangleMesh& b, double distance) {
    const auto is_near = [&](const TriangleMesh& from, const TriangleMesh& to) {
        const ClosestPointTree tree(to);
        return std::ranges::all_of(sorted_edge_sides(from.triangles), [&](const EdgeSide& side) {
            return tree.is_within((from.positions[side.low()] + from.positions[side.high()]) / 2,
                                  distance);
        });
    };
    return is_near(a, b) && is_near(b, a);
}

}  // namespace

bool place_mesh(Domain& domain, const PlacedSites& sites, BuiltMesh& built,
                const StageContext& context) {
    const RemeshOptions& options = context.options;
    domain.prepared.pieces.reset();  // Not needed until vertices are placed.
    DualMesh dual = build_dual_mesh(domain, sites, context);
    if (dual.mesh.triangles.empty()) return false;
    const auto num_vertices = static_cast<Index>(dual.mesh.points.size());
    built.num_wanted = find_target(domain, sites, dual, context);
    // By sheets that are welded later.
    const Index num_shared =
        sites.curves.num_vertices - num_result_vertices(domain.plan->network.network, sites.curves);
    if (options.vertex_count == VertexCount::Add) {
        built.num_wanted = std::max(built.num_wanted, num_vertices - num_shared);
    }
    set_vertex_count(domain, built.num_wanted + num_shared, !options.sites, dual, context);
    built.num_vertices = static_cast<Index>(dual.mesh.points.size()) - num_shared;
    if (built.num_vertices > built.num_wanted) return false;
    built.site = dual.site;
    built.mesh = place_vertices(domain, sites, dual, context);
    if (domain.plan->given) order_as_given(domain.plan->given->number, built);
    return true;
}

BuiltMesh mesh_by_collapses(const CurvedSurface& curved, const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Dual, result);
    const TriangleMesh& surface = curved.whole->mesh;
    GuardedMesh mesh(surface);
    reduce_vertices(
        surface.positions, *mesh, options.num_samples,
        [&](Index gone, Index into) {
            return mesh.edit([&](SpaceMesh& edited) { edited.collapse(gone, into); });
        },
        progress_of(Stage::Dual, options));
    // Its guard has cells for longer edges.
    GuardedMesh relaxed({mesh->positions(), mesh->triangles()});
    const auto moved = relax_guarded(relaxed, surface.view(), progress_at(Stage::Dual, options, 1));
    BuiltMesh built{.mesh = {{}, {}, relaxed->triangles()}, .num_wanted = options.num_samples};
    for (const Index v : drop_unused(relaxed->num_vertices(), built.mesh.triangles)) {
        built.mesh.points.push_back(moved[v] ? *moved[v] : point_at(*curved.whole, v));
    }
    built.num_vertices = static_cast<Index>(built.mesh.points.size());
    built.mesh.offsets.assign(built.num_vertices, Vec3::Zero());
    return built;
}

void finish_mesh(const CurvedSurface& curved, InputCrossings& of_input, const StageContext& context,
                 BuiltMesh& built) {
    CrossingFinder finder(curved, of_input, context);
    std::optional<CrossingFaces> crossings = unfit_crossings(finder, built.mesh, context.result);
    const ShapeBounds& bounds = context.options.bounds;
    ShapeBounds aims = with_aims(bounds);
    if (context.options.wrap) aims.min_angle = aimed_min_angle_of_wraps;
    const bool is_one = context.result.tiles == 0;
    const auto repair = [&] {
        if (is_one) {
            part_faces(curved, finder, built.mesh, crossings, context);
            improve(curved, finder, built.mesh, crossings, context);
        }
        improve(curved, finder, built.mesh, crossings, context, &aims);
    };
    if ((is_one || bounds.has_any()) && is_improvable(curved, context.options)) {
        repair();
        for (int round = 0; is_one && round < most_freeings; ++round) {
            const PlacedMesh mesh = built.mesh;
            const auto whole = [&] { return whole_mesh(*curved.whole, built.mesh); };
            const TriangleMesh whole_before = whole();
            const std::optional<CrossingFaces> before = crossings;
            const FeatureCounts features = context.result.features;
            if (!free_creases(curved, crossings, aims, built.mesh, context)) break;
            repair();
            if (before && crossings->added.size() < before->added.size()) continue;
            const TriangleMesh whole_after = whole();
            if (num_beyond(whole_after, aims) < num_beyond(whole_before, aims) &&
                are_near(whole_before, whole_after, most_change * curved.spacing)) {
                continue;
            }
            built.mesh = mesh;
            crossings = before;
            context.result.features = features;
            break;
        }
    }
    if (crossings) take_crossings(*crossings, built);
    if (context.result.tiles == 0 && curved.bound != nullptr && !curved.has_junctions()) {
        built.proved_distance = bring_near(curved, built.mesh, context);
        if (auto pairs = finder.find(built.mesh)) {
            take_crossings(finder.tell_added(built.mesh, *std::move(pairs)), built);
        }
    }
    if (bounds.longest_edge < infinity) {
        built.num_wanted = std::max(built.num_wanted, static_cast<Index>(built.mesh.points.size()));
    }
    built.forced = find_forced_faces(curved, built.mesh, bounds);
}

}  // namespace remesh::detail
