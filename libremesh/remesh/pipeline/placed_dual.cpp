#include "remesh/pipeline/placed_dual.h"

#include <algorithm>
#include <map>
#include <utility>

#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/curves/walk.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/place_sites.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/pipeline/valid_dual.h"

namespace remesh::detail {
namespace {

// As a share of the spacing: lengths up to this are rounding.
constexpr double rounding = 1e-10;
// Edges this much shorter than the longest one are not divided in the same round.
constexpr double length_ratio = 1.4;

// The numbers of the copies on curves; the other vertices of the dual get numbers from `next` on.
std::vector<Index> numbers_of(const ValidDual& dual, std::span<const Index> of_copies, Index next) {
    std::vector<Index> numbers;
    numbers.reserve(dual.site.size());
    for (const Index site : dual.site) {
        numbers.push_back(site < of_copies.size() ? of_copies[site] : next++);
    }
    return numbers;
}

JoinedPatches join_patches(const ValidDual& dual, const CurveSites& curves) {
    JoinedPatches patches;
    patches.group = numbers_of(dual, groups_of_copies(curves), curves.num_groups());
    patches.glued =
        glue(dual.triangles, patches.group, numbers_of(dual, curves.vertex, curves.num_vertices));
    return patches;
}

// #V of the base: the vertex of the dual in whose cell each lies; no_index: none.
std::vector<Index> nearest_vertices(const ValidDual& dual) {
    std::vector<Index> vertex(dual.has_cell.size(), no_index);
    for (Index v = 0; v < dual.site.size(); ++v) {
        if (dual.site[v] != no_index) vertex[dual.site[v]] = v;
    }
    std::vector<Index> nearest;
    nearest.reserve(dual.nearest_site.size());
    for (const Index site : dual.nearest_site) {
        nearest.push_back(site != no_index ? vertex[site] : no_index);
    }
    return nearest;
}

void fit_on_curves(const Domain& domain, const CurveSites& curves, Boundary boundary,
                   PlacedDual& placed) {
    const std::vector<Vec3> offsets =
        fit_curves(*domain.whole, domain.plan->network.network, curves, boundary);
    const std::vector<Index>& group = placed.patches->group;
    for (Index v = 0; v < group.size(); ++v) {
        if (group[v] < offsets.size()) placed.mesh.offsets[v] = offsets[group[v]];
    }
}

// Fits the vertices to the surface and moves those of bad triangles.
void place_vertices(Domain& domain, const CurveSites& curves, const ValidDual& dual,
                    PlacedDual& placed, const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Place, result);
    poll(progress_of(Stage::Place, options), 0);
    const std::vector<Index> nearest = nearest_vertices(dual);
    // Vertices at nodes. Those inside faces of the surface are locked; all others are on its
    // boundary.
    std::vector<std::uint8_t> stays;
    for (const Index site : dual.site) {
        stays.push_back(site < curves.first_copy[curves.num_nodes()] ? 1 : 0);
    }
    if (options.fit.value_or(is_relaxed(options))) {
        const Progress start = progress_at(Stage::Place, options, 0);
        const auto num_vertices = static_cast<Index>(placed.mesh.points.size());
        PreparedSurface& prepared = domain.prepared;
        prepared.find_pieces(options.num_threads, start);
        std::vector<CellSample> samples = sample_cells(prepared, nearest, num_vertices, start);
        prepared.pieces.reset();  // They are large.
        fit_on_curves(domain, curves, options.boundary, placed);
        fit_vertices(prepared.base, nearest, std::move(samples), placed.mesh, options.num_threads,
                     start, rounding * domain.spacing, stays);
    }
    poll(progress_of(Stage::Place, options), 1);
}

std::vector<Vec3> positions_of(const Surface& whole, const PlacedMesh& mesh) {
    std::vector<Vec3> positions;
    positions.reserve(mesh.points.size());
    for (Index v = 0; v < mesh.points.size(); ++v) {
        positions.push_back(mesh.position(whole.mesh.view(), v));
    }
    return positions;
}

// Divides an inner edge of a dual that is not placed yet.
// \param h, g    its two sides.
// \param points  #V, on the cleaned surface.
void split_edge(const Domain& domain, Index h, Index g, std::vector<SurfacePoint>& points,
                ValidDual& dual) {
    const Surface& surface = domain.prepared.input();
    const Index t = h / 3, u = g / 3;
    std::vector<Triangle>& triangles = dual.triangles;
    const Index a = triangles[t][h % 3], b = triangles[t][(h + 1) % 3];
    const Index c = triangles[t][(h + 2) % 3], d = triangles[u][(g + 2) % 3];
    const auto at = [&](Index v) { return position(surface.mesh.view(), points[v]); };
    const SurfacePoint middle = walk_straight(surface, points[a], (at(b) - at(a)) / 2).end;
    const auto added = static_cast<Index>(points.size());
    dual.stays.resize(added, 0);
    dual.stays.push_back(1);
    points.push_back(middle);
    dual.points.push_back(domain.prepared.base.to_intrinsic(middle));
    dual.site.push_back(no_index);
    triangles[t] = {a, added, c};
    triangles[u] = {b, added, d};
    triangles.push_back({added, b, c});
    triangles.push_back({added, a, d});
}

}  // namespace

bool has_chain(const Domain& domain, std::span<const ChainEdge> chain, const ValidDual& dual) {
    if (chain.empty()) return true;
    std::map<DirectedEdge, bool> may_be_divided;
    for (const ChainEdge& edge : chain) {
        const Curve& curve = domain.plan->network.network.curves[edge.curve];
        may_be_divided[{edge.from, edge.to}] = curve.sides.size() == 1 && !curve.is_locked;
    }
    std::map<Index, Index> next;  // Along the rim.
    for (const auto& [from, to] : rim_of(dual.triangles)) next[from] = to;
    std::size_t num_found = 0;
    for (const auto& [from, to] : next) {
        if (dual.site[from] == no_index) continue;
        Index end = to;
        while (dual.site[end] == no_index) end = next.at(end);
        const auto edge = may_be_divided.find({dual.site[from], dual.site[end]});
        if (edge == may_be_divided.end() || (end != to && !edge->second)) return false;
        ++num_found;
    }
    return num_found == chain.size();
}

Index split_repeated(const Domain& domain, const CurveSites& curves,
                     std::vector<SurfacePoint> points, ValidDual& dual) {
    const GluedMesh glued = join_patches(dual, curves).glued;
    const std::vector<InnerEdge> repeated = repeated_edges(glued);
    if (repeated.empty()) return 0;
    dual.triangles = glued.in_patches;
    std::vector<bool> is_changed(dual.triangles.size(), false);
    Index count = 0;
    for (const auto& [h, g] : repeated) {
        if (is_changed[h / 3] || is_changed[g / 3]) continue;
        is_changed[h / 3] = is_changed[g / 3] = true;
        split_edge(domain, h, g, points, dual);
        ++count;
    }
    return count;
}

void add_vertices(const Domain& domain, std::vector<SurfacePoint> points, Index count,
                  ValidDual& dual) {
    const MeshView surface = domain.prepared.input().mesh.view();
    while (count > 0) {
        std::vector<std::pair<double, std::pair<Index, Index>>> edges;
        for_each_edge(sorted_edge_sides(dual.triangles), [&](std::span<const EdgeSide> sides) {
            if (sides.size() != 2) return;
            const Vec3 a = position(surface, points[sides[0].low()]),
                       b = position(surface, points[sides[0].high()]);
            edges.push_back({-(a - b).norm(), {sides[0].half_edge, sides[1].half_edge}});
        });
        if (edges.empty()) return;
        std::sort(edges.begin(), edges.end());
        std::vector<bool> is_changed(dual.triangles.size(), false);
        const double least = edges.front().first / length_ratio;  // Negative, as the lengths are.
        for (const auto& [length, sides] : edges) {
            const auto& [h, g] = sides;
            if (count == 0 || length > least) break;
            if (is_changed[h / 3] || is_changed[g / 3]) continue;
            is_changed[h / 3] = is_changed[g / 3] = true;
            split_edge(domain, h, g, points, dual);
            --count;
        }
    }
}

PlacedDual place_dual(Domain& domain, const CurveSites& curves, const ValidDual& dual,
                      std::vector<SurfacePoint> points, const StageContext& context) {
    std::vector<Vec3> offsets(points.size(), Vec3::Zero());
    PlacedDual placed{{std::move(points), std::move(offsets), dual.triangles}, {}};
    placed.patches = join_patches(dual, curves);
    place_vertices(domain, curves, dual, placed, context);
    flip_flat_faces(whole_mesh(*domain.whole, placed).positions, placed.patches->glued.triangles);
    return placed;
}

TriangleMesh whole_mesh(const Surface& whole, const PlacedDual& placed) {
    std::vector<Vec3> positions = positions_of(whole, placed.mesh);
    if (!placed.patches) return {std::move(positions), placed.mesh.triangles};
    const GluedMesh& glued = placed.patches->glued;
    return {take(positions, glued.first_of_group), glued.triangles};
}

TriangleMesh welded_mesh(const CurvedSurface& curved, const PlacedDual& placed) {
    TriangleMesh mesh;
    if (curved.has_junctions()) {
        const GluedMesh& glued = placed.patches->glued;
        mesh = {positions_of(*curved.whole, placed.mesh),
                rename_vertices(glued.triangles, glued.first_of_group)};
    } else {
        mesh = whole_mesh(*curved.whole, placed);
    }
    if (curved.has_locked()) mesh.triangles = join_positions(mesh);
    return mesh;
}

std::vector<Triangle> join_positions(const MeshView& mesh) {
    Ticker none;
    return rename_vertices(mesh.triangles, first_at_position(mesh.positions, none));
}

}  // namespace remesh::detail
