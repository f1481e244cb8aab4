#include "remesh/pipeline/whole_mesh.h"

#include <algorithm>
#include <unordered_map>

#include "agvd/core/random.h"
#include "remesh/curves/glue.h"

namespace remesh::detail {
namespace {

// The numbers of the copies on curves; the other vertices of the dual get numbers from `next` on.
std::vector<Index> numbers_of(const ValidDual& dual, std::span<const Index> of_copies, Index next) {
    std::vector<Index> numbers;
    numbers.reserve(dual.site.size());
    for (const Index site : dual.site) {
        numbers.push_back(site < of_copies.size() ? of_copies[site] : next++);
    }
    return numbers;
}

}  // namespace

bool has_chain(const ValidDual& dual, std::span<const ChainEdge> chain) {
    std::vector<DirectedEdge> rim = rim_of(dual.mesh.triangles), wanted = ends_of(chain);
    for (auto& [from, to] : rim) {
        from = dual.site[from];
        to = dual.site[to];
    }
    std::sort(rim.begin(), rim.end());
    std::sort(wanted.begin(), wanted.end());
    return rim == wanted;
}

JoinedPatches join_patches(const ValidDual& dual, const CurveSites& curves) {
    JoinedPatches patches;
    patches.group = numbers_of(dual, groups_of_copies(curves), curves.num_groups());
    patches.glued = glue(dual.mesh.triangles, patches.group,
                         numbers_of(dual, curves.vertex, curves.num_vertices));
    return patches;
}

std::vector<Vec3> positions_of(const Surface& whole, const PlacedMesh& mesh) {
    std::vector<Vec3> positions;
    positions.reserve(mesh.points.size());
    for (Index v = 0; v < mesh.points.size(); ++v) {
        positions.push_back(mesh.position(whole.mesh.view(), v));
    }
    return positions;
}

TriangleMesh whole_mesh(const Surface& whole, const PlacedDual& placed) {
    std::vector<Vec3> positions = positions_of(whole, placed.mesh);
    if (!placed.patches) return {std::move(positions), placed.mesh.triangles};
    const GluedMesh& glued = placed.patches->glued;
    return {take(positions, glued.first_of_group), glued.triangles};
}

TriangleMesh welded_mesh(const Domain& domain, const PlacedDual& placed) {
    TriangleMesh mesh;
    if (domain.has_junctions()) {
        const GluedMesh& glued = placed.patches->glued;
        mesh = {positions_of(*domain.whole, placed.mesh),
                rename_vertices(glued.triangles, glued.first_of_group)};
    } else {
        mesh = whole_mesh(*domain.whole, placed);
    }
    if (domain.has_locked()) mesh.triangles = join_positions(mesh.positions, mesh.triangles);
    return mesh;
}

std::vector<Triangle> join_positions(std::span<const Vec3> positions,
                                     std::span<const Triangle> triangles) {
    std::unordered_map<Vec3, Index, PositionHash> first_at;
    std::vector<Index> first;
    first.reserve(positions.size());
    for (Index v = 0; v < positions.size(); ++v) {
        first.push_back(first_at.try_emplace(positions[v], v).first->second);
    }
    return rename_vertices(triangles, first);
}

}  // namespace remesh::detail
