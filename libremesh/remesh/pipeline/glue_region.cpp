// Vertices of the remeshed region are recognised as those of the rim by their positions.
#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include "agvd/core/random.h"
#include "remesh/curves/glue.h"
#include "remesh/pipeline/region.h"

namespace remesh::detail {
namespace {

using SharedVertices = std::unordered_map<Vec3, Index, PositionHash>;

// Flips edges of the region that gluing would give other faces than those beside them.
// \param kept    edges of the kept faces.
// \param alone   edges that are left as they are, ascending.
// \param vertex  #V of the region: that of the glued mesh.
// \return whether no such edge is left.
bool part_edges(const std::vector<EdgeSide>& kept, const std::vector<std::uint64_t>& alone,
                std::span<const Index> vertex, std::vector<Triangle>& triangles) {
    const auto ends_of = [&](const EdgeSide& side) {
        const Triangle& t = triangles[side.face()];
        return edge_key(t[side.half_edge % 3], t[(side.half_edge + 1) % 3]);
    };
    // Whether the sides of an edge of the glued mesh come from different edges.
    const auto is_repeated = [&](std::span<const EdgeSide> sides) {
        if (std::ranges::binary_search(alone, sides[0].ends)) return false;
        const bool is_one = std::ranges::all_of(
            sides, [&](const EdgeSide& side) { return ends_of(side) == ends_of(sides[0]); });
        return !is_one || has_sides(kept, sides[0].ends);
    };
    const auto is_kept = [&](std::uint64_t ends) { return has_sides(kept, ends); };
    return flip_repeated(triangles, vertex, is_repeated, is_kept);
}

// Edges of the glued mesh that may have more than two faces, ascending: the rim and what was so
// before.
// \param shared  vertex of the glued mesh by position.
std::vector<std::uint64_t> edges_left_alone(const Region& region, const SharedVertices& shared) {
    std::vector<std::uint64_t> edges;
    for (const auto* some : {&region.rim_edges, &region.branched_edges}) {
        for (const auto& [a, b] : *some) {
            const auto at_a = shared.find(region.mesh.positions[a]);
            const auto at_b = shared.find(region.mesh.positions[b]);
            if (at_a == shared.end() || at_b == shared.end()) continue;
            edges.push_back(edge_key(at_a->second, at_b->second));
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

}  // namespace

GluedRegion glue_region(const MeshView& mesh, const Region& region, const TriangleMesh& remeshed,
                        Ticker& ticker) {
    GluedRegion result;
    MeshPart kept = take_faces(mesh, region.kept, ticker);
    const std::vector<EdgeSide> kept_sides = sorted_edge_sides(kept.mesh.triangles);
    result.kept_vertices = std::move(kept.vertices);
    result.mesh = std::move(kept.mesh);
    SharedVertices shared;
    for (const RimVertex& rim : region.rim) {
        if (rim.shared == no_index) continue;
        shared.emplace(region.mesh.positions[rim.vertex], kept.number[rim.shared]);
    }
    for (const Vec3& position : remeshed.positions) {
        ticker.tick();
        const auto found = shared.find(position);
        if (found != shared.end()) {
            result.vertex.push_back(found->second);
            continue;
        }
        result.vertex.push_back(static_cast<Index>(result.mesh.positions.size()));
        result.mesh.positions.push_back(position);
    }
    std::vector<Triangle> triangles = remeshed.triangles;
    const std::vector<std::uint64_t> alone = edges_left_alone(region, shared);
    if (!part_edges(kept_sides, alone, result.vertex, triangles)) {
        throw ConstraintUnmet(
            std::to_string(remeshed.positions.size()) +
            " samples are too few for the region: an edge of its mesh would join two vertices of "
            "the rim of the region that another edge joins already; use more samples, or a larger "
            "region");
    }
    for (const Triangle& t : rename_vertices(triangles, result.vertex)) {
        result.mesh.triangles.push_back(t);
    }
    return result;
}

}  // namespace remesh::detail
