// Groups the sides of faces by edge to check that a mesh is manifold and oriented, and to count.
// With known connectivity the checks are not needed, and all is counted by twins.
#include "agvd/mesh/topology.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

#include "agvd/core/union_find.h"
#include "agvd/mesh/any_mesh.h"

namespace agvd {
namespace {

bool has_bad_faces(const MeshView& mesh, Ticker& ticker) {
    std::vector<Triangle> sorted(mesh.triangles.begin(), mesh.triangles.end());
    ticker.poll();
    for (Triangle& t : sorted) {
        ticker.tick();
        std::sort(t.begin(), t.end());
        if (t[0] == t[1] || t[1] == t[2]) return true;
    }
    sort_ticked(sorted, ticker, std::less<>());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

// One umbrella per vertex: the corners at a vertex are connected through the edges at it.
bool has_one_umbrella_each(const MeshView& mesh, const std::vector<EdgeSide>& sides,
                           Ticker& ticker) {
    UnionFind corner(3 * mesh.triangles.size());
    ticker.poll();
    const auto corner_of = [&](Index face, Index vertex) {
        const Triangle& t = mesh.triangles[face];
        return 3 * face + (t[0] == vertex ? 0u : t[1] == vertex ? 1u : 2u);
    };
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        ticker.tick();
        if (sides[i].ends != sides[i + 1].ends) continue;
        for (const Index v : {sides[i].low(), sides[i].high()}) {
            corner.unite(corner_of(sides[i].face(), v), corner_of(sides[i + 1].face(), v));
        }
    }
    std::vector<Index> umbrella(mesh.positions.size(), no_index);
    for (Index c = 0; c < 3 * mesh.triangles.size(); ++c) {
        ticker.tick();
        Index& seen = umbrella[mesh.triangles[c / 3][c % 3]];
        const Index root = corner.root(c);
        if (seen != no_index && seen != root) return false;
        seen = root;
    }
    return true;
}

// Adds to euler. A vertex counts once for each component that meets there.
void count_vertices(const MeshView& mesh, Ticker& ticker, Topology& result) {
    std::vector<std::pair<Index, Index>> met;  // Component and vertex.
    met.reserve(3 * mesh.triangles.size());
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        for (const Index v : mesh.triangles[f]) met.emplace_back(result.face_component[f], v);
    }
    sort_ticked(met, ticker, std::less<>());
    met.erase(std::unique(met.begin(), met.end()), met.end());
    for (const auto& [component, vertex] : met) ++result.components[component].euler;
}

// Adds to euler and to boundary_loops: the connected pieces of the graph of boundary edges.
void count_edges(const std::vector<EdgeSide>& sides, std::size_t num_vertices, Ticker& ticker,
                 Topology& result) {
    UnionFind boundary(num_vertices);
    std::vector<std::pair<Index, Index>> boundary_ends;  // (lower vertex, face)
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        ticker.tick();
        --result.components[result.face_component[edge[0].face()]].euler;
        if (edge.size() != 1) return;
        boundary.unite(edge[0].low(), edge[0].high());
        boundary_ends.emplace_back(edge[0].low(), edge[0].face());
    });
    ticker.poll();
    std::vector<bool> counted(num_vertices, false);
    for (const auto& [vertex, face] : boundary_ends) {
        ticker.tick();
        const Index root = boundary.root(vertex);
        if (counted[root]) continue;
        counted[root] = true;
        ++result.components[result.face_component[face]].boundary_loops;
    }
}

// The sets of faces, numbered by lowest face, which is the root of a set.
FaceLabels number_sets(UnionFind& sets, Index num_faces, Ticker& ticker) {
    FaceLabels labels{std::vector<Index>(num_faces), 0};
    for (Index f = 0; f < num_faces; ++f) {
        ticker.tick();
        const Index root = sets.root(f);
        labels.of_face[f] = root == f ? labels.count++ : labels.of_face[root];
    }
    return labels;
}

// Without euler and boundary_loops.
Topology measure(const MeshView& mesh, FaceLabels labels, Ticker& ticker) {
    Topology result{true, true, std::vector<ComponentTopology>(labels.count),
                    std::move(labels.of_face)};
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        ComponentTopology& c = result.components[result.face_component[f]];
        ++c.faces;
        c.area += 0.5 * doubled_normal(mesh.positions, mesh.triangles[f]).norm();
    }
    return result;
}

// Sets euler and boundary_loops of components. Vertices without faces do not count.
template <typename Components>
void count_by_twins(std::span<const Triangle> triangles, std::span<const Index> twin,
                    std::span<const Index> outgoing, std::span<const Index> label, Ticker& ticker,
                    Components& components) {
    for (Index f = 0; f < label.size(); ++f) {
        ticker.tick();
        int num_edges = 0;  // An edge counts at its lower half-edge; no_index is higher.
        for (Index h = 3 * f; h < 3 * f + 3; ++h) num_edges += twin[h] > h ? 1 : 0;
        components[label[f]].euler += 1 - num_edges;
    }
    for (const Index h : outgoing) {
        ticker.tick();
        if (h != no_index) ++components[label[h / 3]].euler;
    }
    for (const std::vector<Index>& loop : boundary_loops(triangles, twin, outgoing, ticker)) {
        ++components[label[loop[0] / 3]].boundary_loops;
    }
}

void set_genus(Topology& topology) {
    for (ComponentTopology& c : topology.components) {
        c.genus = (2 - c.euler - c.boundary_loops) / 2;
    }
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

Topology analyze_topology(const MeshView& mesh, const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    const std::vector<EdgeSide> sides = sorted_edge_sides(mesh.triangles, ticker);
    const auto num_faces = static_cast<Index>(mesh.triangles.size());
    UnionFind sets(num_faces);
    bool is_manifold = !has_bad_faces(mesh, ticker), is_oriented = true;
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        ticker.tick();
        for (const EdgeSide& side : edge) sets.unite(edge[0].face(), side.face());
        if (edge.size() > 2) is_manifold = false;
        if (edge.size() == 2 && edge[0].forward == edge[1].forward) is_oriented = false;
    });
    if (is_manifold) is_manifold = has_one_umbrella_each(mesh, sides, ticker);
    Topology result = measure(mesh, number_sets(sets, num_faces, ticker), ticker);
    result.is_manifold = is_manifold;
    result.is_oriented = is_oriented;
    for (ComponentTopology& c : result.components) c.euler = static_cast<int>(c.faces);
    count_vertices(mesh, ticker, result);
    count_edges(sides, mesh.positions.size(), ticker, result);
    set_genus(result);
    return result;
}

Topology analyze_topology(const MeshView& mesh, const Connectivity& connectivity,
                          const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    Topology result = measure(mesh, label_components(connectivity.twin, ticker), ticker);
    count_by_twins(mesh.triangles, connectivity.twin, connectivity.outgoing, result.face_component,
                   ticker, result.components);
    set_genus(result);
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

FaceLabels label_components(std::span<const Index> twin, Ticker ticker) {
    const auto num_faces = static_cast<Index>(twin.size() / 3);
    UnionFind sets(num_faces);
    for (Index h = 0; h < twin.size(); ++h) {
        ticker.tick();
        if (twin[h] < h) sets.unite(h / 3, twin[h] / 3);  // no_index is higher.
    }
    return number_sets(sets, num_faces, ticker);
}

std::vector<Component> find_components(const Surface& surface, const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    const FaceLabels labels = label_components(surface.twin, ticker);
    std::vector<Component> components(labels.count);
    count_by_twins(surface.mesh.triangles, surface.twin, surface.outgoing, labels.of_face, ticker,
                   components);
    for (Index f = 0; f < surface.num_faces(); ++f) {
        ticker.tick();
        Component& component = components[labels.of_face[f]];
        const double before = component.faces.empty() ? 0 : component.area();
        component.faces.push_back(f);
        component.area_up_to.push_back(before + face_area(surface, f));
    }
    return components;
}

}  // namespace agvd
