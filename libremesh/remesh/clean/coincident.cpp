// Patches are compared in the order of a number that coincident ones share. They coincide where
// each has its vertices on the other, and the middles of its faces near it: diagonals of curved
// quads may differ.
#include "remesh/clean/coincident.h"

#include <algorithm>
#include <cmath>

#include "agvd/core/union_find.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/scale.h"

namespace remesh::detail {
namespace {

// In sides of the mesh: see find_common_positions.
constexpr double rounding = 1e-6;
// Largest difference of areas, and distance of the middle of a face in its longest sides.
constexpr double most_area = 0.05, most_distance = 0.1;
// Faces whose apexes lie on one side of their edge, at a smaller angle, are folded there.
constexpr double fold_cosine = 0.9;

struct PlacedPatch {
    std::vector<Index> faces = {};
    MeshBox box = {};
    double area = 0;
    double key = 0;  // A sum of the box's coordinates.
};

Vec3 middle_of(const MeshView& mesh, const Triangle& t) {
    return (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
}

// By lowest face.
std::vector<PlacedPatch> list_patches(const MeshView& mesh, UnionFind& sets, Ticker& ticker) {
    std::vector<PlacedPatch> patches(mesh.triangles.size());
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        PlacedPatch& patch = patches[sets.root(f)];
        patch.faces.push_back(f);
        for (const Index v : mesh.triangles[f]) patch.box.add(mesh.positions[v]);
        patch.area += doubled_normal(mesh.positions, mesh.triangles[f]).norm() / 2;
    }
    std::erase_if(patches, [](const PlacedPatch& patch) { return patch.faces.empty(); });
    for (PlacedPatch& patch : patches) {
        patch.key = Vec3(1, 0.7, 0.4).dot(patch.box.low) + Vec3(0.9, 0.6, 0.3).dot(patch.box.high);
    }
    return patches;
}

TriangleMesh part_of(const MeshView& mesh, const PlacedPatch& patch) {
    TriangleMesh part;
    for (const Index f : patch.faces) part.triangles.push_back(mesh.triangles[f]);
    const std::vector<Index> used =
        drop_unused(static_cast<Index>(mesh.positions.size()), part.triangles);
    for (const Index v : used) part.positions.push_back(mesh.positions[v]);
    return part;
}

// Whether a part lies on another one.
// \param[out] facing  above 0 if most of it faces the same way.
bool lies_on(const TriangleMesh& part, const TriangleMesh& other, double reach, double& facing) {
    const ClosestPointTree tree(other.view());
    facing = 0;
    return std::ranges::all_of(part.positions,
                               [&](const Vec3& p) { return tree.is_within(p, reach); }) &&
           std::ranges::all_of(part.triangles, [&](const Triangle& t) {
               const std::span<const Vec3> p = part.positions;
               const double longest =
                   std::max({(p[t[1]] - p[t[0]]).norm(), (p[t[2]] - p[t[1]]).norm(),
                             (p[t[0]] - p[t[2]]).norm()});
               const ClosestPoint near = tree.query(middle_of(part.view(), t));
               facing += doubled_normal(p, t).dot(
                   doubled_normal(other.positions, other.triangles[near.point.face.value()])
                       .normalized());
               return std::sqrt(near.distance_sq) <= std::max(reach, most_distance * longest);
           });
}

}  // namespace

bool is_folded(const MeshView& mesh, Index a, Index b) {
    const auto corner = [&](Index h) -> const Vec3& {
        return mesh.positions[mesh.triangles[h / 3][h % 3]];
    };
    const Vec3 along = (corner(next_half_edge(a)) - corner(a)).normalized();
    const auto across = [&](Index h) -> Vec3 {
        const Vec3 way = corner(previous_half_edge(h)) - corner(a);
        return way - along.dot(way) * along;
    };
    const Vec3 p = across(a), q = across(b);
    return p.dot(q) > fold_cosine * p.norm() * q.norm();
}

std::vector<CoincidentPatch> find_coincident(const MeshView& mesh, std::span<const EdgeSide> sides,
                                             Ticker& ticker) {
    UnionFind sets(mesh.triangles.size());
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        ticker.tick();
        if (edge.size() != 2 || is_folded(mesh, edge[0].half_edge, edge[1].half_edge)) return;
        (void)sets.unite(edge[0].face(), edge[1].face());
    });
    const std::vector<PlacedPatch> patches = list_patches(mesh, sets, ticker);
    const double reach = rounding * box_of(mesh).longest_side();
    std::vector<Index> order(patches.size());
    for (Index i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, [&](Index i) { return std::pair(patches[i].key, i); });
    std::vector<bool> is_copy(patches.size(), false);
    std::vector<CoincidentPatch> found;
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t j = i + 1;
             j < order.size() && patches[order[j]].key - patches[order[i]].key <= 4 * reach; ++j) {
            const auto& [first, second] = std::minmax(order[i], order[j]);
            const PlacedPatch &p = patches[first], &q = patches[second];
            ticker.tick();
            if (is_copy[first] || is_copy[second] || p.faces.size() + q.faces.size() == 2 ||
                (p.box.low - q.box.low).norm() > reach ||
                (p.box.high - q.box.high).norm() > reach ||
                std::abs(p.area - q.area) > most_area * p.area) {
                continue;
            }
            const TriangleMesh a = part_of(mesh, p), b = part_of(mesh, q);
            double facing = 0;
            if (!lies_on(a, b, reach, facing) || !lies_on(b, a, reach, facing)) continue;
            is_copy[second] = true;
            found.push_back({p.faces, q.faces, facing < 0});
        }
    }
    return found;
}

}  // namespace remesh::detail
