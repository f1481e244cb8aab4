#include "remesh/quality/topology.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

#include "agvd/core/bucket_sort.h"
#include "remesh/quality/edge_sides.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Triangle;

Index find_root(std::vector<Index>& parent, Index i) {
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

void unite(std::vector<Index>& parent, Index a, Index b) {
    a = find_root(parent, a);
    b = find_root(parent, b);
    parent[std::max(a, b)] = std::min(a, b);
}

bool has_bad_faces(const agvd::MeshView& mesh, agvd::Ticker& ticker) {
    std::vector<Triangle> sorted(mesh.triangles.begin(), mesh.triangles.end());
    ticker.poll();
    for (Triangle& t : sorted) {
        ticker.tick();
        std::sort(t.begin(), t.end());
        if (t[0] == t[1] || t[1] == t[2]) return true;
    }
    sorted = agvd::sort_in_buckets(
        sorted, static_cast<Index>(mesh.positions.size()), [](const Triangle& t) { return t[0]; },
        std::less<>(), ticker);
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

// One umbrella per vertex: the corners at a vertex hang together through the edges at it.
bool has_one_umbrella_each(const agvd::MeshView& mesh, const std::vector<EdgeSide>& sides,
                           agvd::Ticker& ticker) {
    std::vector<Index> corner(3 * mesh.triangles.size());
    std::iota(corner.begin(), corner.end(), Index{0});
    ticker.poll();
    const auto corner_of = [&](Index face, Index vertex) {
        const Triangle& t = mesh.triangles[face];
        return 3 * face + (t[0] == vertex ? 0u : t[1] == vertex ? 1u : 2u);
    };
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        ticker.tick();
        if (sides[i].ends != sides[i + 1].ends) continue;
        for (const Index v : {sides[i].low(), sides[i].high()}) {
            unite(corner, corner_of(sides[i].face(), v), corner_of(sides[i + 1].face(), v));
        }
    }
    std::vector<Index> umbrella(mesh.positions.size(), no_index);
    for (Index c = 0; c < corner.size(); ++c) {
        ticker.tick();
        Index& seen = umbrella[mesh.triangles[c / 3][c % 3]];
        const Index root = find_root(corner, c);
        if (seen != no_index && seen != root) return false;
        seen = root;
    }
    return true;
}

}  // namespace

int Topology::genus() const {
    return std::accumulate(components.begin(), components.end(), 0,
                           [](int sum, const ComponentTopology& c) { return sum + c.genus; });
}

int Topology::boundary_loops() const {
    return std::accumulate(
        components.begin(), components.end(), 0,
        [](int sum, const ComponentTopology& c) { return sum + c.boundary_loops; });
}

Topology analyze_topology(const agvd::MeshView& mesh, const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    agvd::Ticker ticker(poller);
    Topology result;
    const std::vector<EdgeSide> sides = sorted_edge_sides(mesh.triangles, ticker);
    const auto num_faces = static_cast<Index>(mesh.triangles.size());

    std::vector<Index> parent(num_faces);
    std::iota(parent.begin(), parent.end(), Index{0});
    result.is_manifold = !has_bad_faces(mesh, ticker);
    result.is_oriented = true;
    for_each_edge(sides, [&](const EdgeSide* begin, const EdgeSide* end) {
        ticker.tick();
        for (const EdgeSide* side = begin; side != end; ++side) {
            unite(parent, begin->face(), side->face());
        }
        if (end - begin > 2) result.is_manifold = false;
        if (end - begin == 2 && begin[0].forward == begin[1].forward) result.is_oriented = false;
    });
    if (result.is_manifold) result.is_manifold = has_one_umbrella_each(mesh, sides, ticker);

    std::vector<Index> component_of_root(num_faces, no_index);
    result.face_component.resize(num_faces);
    for (Index f = 0; f < num_faces; ++f) {
        ticker.tick();
        Index& id = component_of_root[find_root(parent, f)];
        if (id == no_index) {
            id = static_cast<Index>(result.components.size());
            result.components.emplace_back();
        }
        result.face_component[f] = id;
        ComponentTopology& c = result.components[id];
        ++c.faces;
        ++c.euler;
        const auto& [a, b, d] = mesh.triangles[f];
        c.area += 0.5 * (mesh.positions[b] - mesh.positions[a])
                            .cross(mesh.positions[d] - mesh.positions[a])
                            .norm();
    }

    // A vertex counts once for each component that meets there.
    std::vector<Index> by_component(num_faces);
    std::iota(by_component.begin(), by_component.end(), Index{0});
    if (result.components.size() > 1) {
        by_component = agvd::sort_in_buckets(
            by_component, static_cast<Index>(result.components.size()),
            [&](Index face) { return result.face_component[face]; }, std::less<>(), ticker);
    }
    std::vector<Index> last_component(mesh.positions.size(), no_index);
    for (const Index f : by_component) {
        ticker.tick();
        for (const Index v : mesh.triangles[f]) {
            if (last_component[v] == result.face_component[f]) continue;
            last_component[v] = result.face_component[f];
            ++result.components[last_component[v]].euler;
        }
    }

    // Boundary loops: the connected pieces of the graph of boundary edges.
    std::vector<Index> boundary(mesh.positions.size());
    std::iota(boundary.begin(), boundary.end(), Index{0});
    std::vector<std::pair<Index, Index>> boundary_ends;  // (lower vertex, face)
    for_each_edge(sides, [&](const EdgeSide* begin, const EdgeSide* end) {
        ticker.tick();
        --result.components[result.face_component[begin->face()]].euler;
        if (end - begin != 1) return;
        unite(boundary, begin->low(), begin->high());
        boundary_ends.emplace_back(begin->low(), begin->face());
    });
    ticker.poll();
    std::vector<bool> counted(mesh.positions.size(), false);
    for (const auto& [vertex, face] : boundary_ends) {
        ticker.tick();
        const Index root = find_root(boundary, vertex);
        if (counted[root]) continue;
        counted[root] = true;
        ++result.components[result.face_component[face]].boundary_loops;
    }
    for (ComponentTopology& c : result.components) c.genus = (2 - c.euler - c.boundary_loops) / 2;
    return result;
}

bool same_topology(const Topology& a, const Topology& b) {
    const auto types = [](const Topology& t) {
        std::map<std::pair<int, int>, int> count;
        for (const ComponentTopology& c : t.components) ++count[{c.genus, c.boundary_loops}];
        return count;
    };
    return types(a) == types(b);
}

}  // namespace remesh
