// A component lies in another one if a ray from one of its faces crosses that an odd number of
// times.
#include <algorithm>
#include <tuple>

#include "agvd/core/union_find.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/scale.h"
#include "remesh/quality/evaluate.h"

namespace remesh {
namespace {

struct Body {
    std::vector<Index> faces;
    MeshBox box;
};

// On which side of a line the origin is; on it, the same for both faces there.
bool is_left(const Vec3& from, const Vec3& to) {
    const auto side = [](const Vec3& a, const Vec3& b) { return a.y() * b.z() - a.z() * b.y(); };
    const auto before = [](const Vec3& p) { return std::tuple(p.y(), p.z(), p.x()); };
    return before(from) < before(to) ? side(from, to) >= 0 : side(to, from) < 0;
}

// Whether the ray from a point along x meets the face.
bool is_crossed(const MeshView& mesh, const Triangle& t, const Vec3& at) {
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.positions[t[k]] - at;
    for (const int axis : {1, 2}) {
        const auto [low, high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
        if (low > 0 || high < 0) return false;
    }
    const bool side = is_left(p[0], p[1]);
    if (is_left(p[1], p[2]) != side || is_left(p[2], p[0]) != side) return false;
    const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
    return normal.x() != 0 && normal.dot(p[0]) / normal.x() > 0;
}

bool is_within(const MeshBox& inner, const MeshBox& outer) {
    return (inner.low.array() > outer.low.array()).all() &&
           (inner.high.array() < outer.high.array()).all();
}

void count_holes(const MeshView& mesh, Ticker& ticker, BodyCounts& counts) {
    UnionFind chains(mesh.positions.size());
    std::vector<bool> is_open(mesh.positions.size(), false);
    for_each_edge(sorted_edge_sides(mesh.triangles, ticker), [&](std::span<const EdgeSide> edge) {
        if (edge.size() != 1) return;
        ++counts.hole_edges;
        (void)chains.unite(edge[0].low(), edge[0].high());
        is_open[edge[0].low()] = is_open[edge[0].high()] = true;
    });
    for (Index v = 0; v < is_open.size(); ++v) {
        if (is_open[v] && chains.is_root(v)) ++counts.holes;
    }
}

// By component; without faces, where it is open.
std::vector<Body> list_bodies(const MeshView& mesh, const Topology& topology) {
    std::vector<Body> bodies(topology.components.size());
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const Index c = topology.face_component[f];
        if (topology.components[c].boundary_loops > 0) continue;
        bodies[c].faces.push_back(f);
        for (const Index v : mesh.triangles[f]) bodies[c].box.add(mesh.positions[v]);
    }
    return bodies;
}

bool is_inside(const MeshView& mesh, const Body& inner, const Body& outer, Ticker& ticker) {
    if (outer.faces.empty() || !is_within(inner.box, outer.box)) return false;
    const auto& [a, b, c] = mesh.triangles[inner.faces[0]];
    const Vec3 at = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3;
    ticker.tick(outer.faces.size());
    return std::ranges::count_if(outer.faces,
                                 [&](Index f) { return is_crossed(mesh, mesh.triangles[f], at); }) %
               2 ==
           1;
}

}  // namespace

std::vector<double> body_volumes(const MeshView& mesh, const Topology& topology) {
    std::vector<double> volumes(topology.components.size(), 0);
    std::vector<Index> first(volumes.size(), no_index);  // A corner, to keep digits.
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const Index label = topology.face_component[f];
        if (topology.components[label].boundary_loops > 0) continue;
        if (first[label] == no_index) first[label] = mesh.triangles[f][0];
        const auto at = [&](std::size_t k) -> Vec3 {
            return mesh.positions[mesh.triangles[f][k]] - mesh.positions[first[label]];
        };
        volumes[label] += at(0).dot(at(1).cross(at(2))) / 6;
    }
    return volumes;
}

BodyCounts count_bodies(const MeshView& mesh, const Topology& topology, Ticker ticker) {
    BodyCounts counts;
    count_holes(mesh, ticker, counts);
    const std::vector<Body> bodies = list_bodies(mesh, topology);
    const std::vector<double> volumes = body_volumes(mesh, topology);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies[i].faces.empty()) continue;
        ++counts.closed;
        const auto depth = std::ranges::count_if(
            bodies, [&](const Body& outer) { return is_inside(mesh, bodies[i], outer, ticker); });
        const bool points_inward = volumes[i] < 0;
        if (depth > 0) ++(points_inward ? counts.cavities : counts.inner_bodies);
        if (depth == 0 && points_inward) ++counts.inside_out;
    }
    return counts;
}

}  // namespace remesh
