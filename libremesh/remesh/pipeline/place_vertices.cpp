#include <algorithm>
#include <map>
#include <utility>

#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/dual_mesh.h"
#include "remesh/pipeline/place_sites.h"
#include "remesh/pipeline/stage_context.h"

namespace remesh::detail {
namespace {

// As a share of the spacing: lengths up to this are rounding.
constexpr double least_way_share = 1e-10;

// The mesh cut along its curves again: a sample must not find triangles beyond a crease.
struct MeshInPatches {
    PlacedMesh mesh;
    std::vector<Index> vertex;  // #V of the cut mesh: that of the whole one.
    std::vector<Index> copy;    // #V of the cut mesh: its site; no_index: none.
};

// #triangles: the copies at the corners on curves; no_index elsewhere. The edges of chains tell
// them, and other triangles have those of their neighbours.
std::vector<Triangle> find_copies(const DualMesh& dual, const PlacedSites& placed) {
    const std::vector<Triangle>& triangles = dual.mesh.triangles;
    std::vector<Index> vertex(placed.curves.num_vertices, no_index);
    for (Index v = 0; v < dual.site.size(); ++v) {
        if (dual.site[v] < placed.curves.sites.size()) {
            vertex[placed.curves.vertex[dual.site[v]]] = v;
        }
    }
    const auto at = [&](Index copy) { return vertex[placed.curves.vertex[copy]]; };
    std::map<DirectedEdge, DirectedEdge> chain;  // By the vertices at its ends: copies.
    for (const ChainEdge& e : placed.chain) chain[{at(e.from), at(e.to)}] = {e.from, e.to};
    std::vector<Triangle> copies(triangles.size(), Triangle{no_index, no_index, no_index});
    if (chain.empty()) return copies;
    const auto is_on_chain = [&](Index a, Index b) {
        return chain.contains({a, b}) || chain.contains({b, a});
    };
    for (Index t = 0; t < triangles.size(); ++t) {
        for (Index k = 0; k < 3; ++k) {
            const auto edge = chain.find({triangles[t][k], triangles[t][(k + 1) % 3]});
            if (edge == chain.end()) continue;
            copies[t][k] = edge->second.first;
            copies[t][(k + 1) % 3] = edge->second.second;
        }
    }
    const std::vector<EdgeSide> sides = sorted_edge_sides(triangles);
    for (bool is_changed = true; is_changed;) {
        is_changed = false;
        const auto share = [&](Index& a, Index& b) {
            if (a == b || (a != no_index && b != no_index)) return;
            (a == no_index ? a : b) = std::min(a, b);
            is_changed = true;
        };
        for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
            if (edge.size() != 2 || is_on_chain(edge[0].low(), edge[0].high())) return;
            const Index h = edge[0].half_edge, g = edge[1].half_edge;
            share(copies[h / 3][h % 3], copies[g / 3][(g + 1) % 3]);
            share(copies[h / 3][(h + 1) % 3], copies[g / 3][g % 3]);
        });
    }
    return copies;
}

MeshInPatches part_patches(const DualMesh& dual, const PlacedSites& placed) {
    MeshInPatches cut{{{}, {}, find_copies(dual, placed)}, {}, {}};
    std::vector<Index> number(dual.site.size(), no_index);  // Of the first copy.
    std::map<std::pair<Index, Index>, Index> of_other;      // By vertex and copy.
    for (Index t = 0; t < cut.mesh.triangles.size(); ++t) {
        for (Index k = 0; k < 3; ++k) {
            const Index v = dual.mesh.triangles[t][k];
            Index& copy = cut.mesh.triangles[t][k];
            if (copy == no_index) copy = dual.site[v];
            Index& made = copy == dual.site[v]
                              ? number[v]
                              : of_other.emplace(std::pair(v, copy), no_index).first->second;
            if (made == no_index) {
                made = static_cast<Index>(cut.vertex.size());
                cut.vertex.push_back(v);
                cut.copy.push_back(copy);
                cut.mesh.points.push_back(copy != no_index ? placed.sites[copy]
                                                           : dual.mesh.points[v]);
            }
            copy = made;
        }
    }
    cut.mesh.offsets.assign(cut.vertex.size(), Vec3::Zero());
    return cut;
}

// #V: the first vertex at the same place; sheets of a junction have several there.
std::vector<Index> places_of(const DualMesh& dual, const CurveSites& curves) {
    const std::vector<Index> group = groups_of_copies(curves);
    std::vector<Index> places;
    Index next = curves.num_groups();
    for (const Index site : dual.site) places.push_back(site < group.size() ? group[site] : next++);
    return first_of_groups(places);
}

void fit(Domain& domain, const PlacedSites& placed, const DualMesh& dual, PlacedMesh& mesh,
         const StageContext& context) {
    const RemeshOptions& options = context.options;
    const CurveSites& curves = placed.curves;
    const Progress start = progress_at(Stage::Place, options, 0);
    MeshInPatches cut = part_patches(dual, placed);
    const auto num_vertices = static_cast<Index>(cut.vertex.size());
    const std::vector<Index> group = groups_of_copies(curves);
    const std::vector<Vec3> offsets =
        fit_curves(*domain.whole, domain.plan->network.network, curves, options.boundary);
    std::vector<std::uint8_t> stays;
    std::vector<Index> vertex(dual.has_cell.size(), no_index);  // By site.
    for (Index v = 0; v < num_vertices; ++v) {
        const bool is_on_curve = cut.copy[v] < group.size();
        stays.push_back(is_on_curve ? 1 : 0);
        if (is_on_curve) cut.mesh.offsets[v] = offsets[group[cut.copy[v]]];
        if (cut.copy[v] != no_index) vertex[cut.copy[v]] = v;
    }
    // By vertex of the base: in whose cell it lies.
    std::vector<Index> nearest(dual.nearest_site.size(), no_index);
    for (Index v = 0; v < nearest.size(); ++v) {
        if (dual.nearest_site[v] != no_index) nearest[v] = vertex[dual.nearest_site[v]];
    }
    PreparedSurface& prepared = domain.prepared;
    prepared.find_pieces(options.num_threads, start);
    std::vector<CellSample> samples = sample_cells(prepared, nearest, num_vertices, start);
    prepared.pieces.reset();  // They are large.
    fit_vertices(prepared.base, nearest, std::move(samples), cut.mesh, options.num_threads, start,
                 least_way_share * domain.spacing, stays);
    for (Index v = 0; v < num_vertices; ++v) mesh.offsets[cut.vertex[v]] = cut.mesh.offsets[v];
}

}  // namespace

PlacedMesh place_vertices(Domain& domain, const PlacedSites& placed, const DualMesh& dual,
                          const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Place, result);
    poll(progress_of(Stage::Place, options), 0);
    PlacedMesh mesh = dual.mesh;
    if (domain.has_junctions()) mesh.place = places_of(dual, placed.curves);
    if (options.fit.value_or(is_relaxed(options))) fit(domain, placed, dual, mesh, context);
    flip_flat_faces(whole_mesh(*domain.whole, mesh).positions, mesh);
    poll(progress_of(Stage::Place, options), 1);
    return mesh;
}

}  // namespace remesh::detail
