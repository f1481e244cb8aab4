// Groups the sides of faces by edge to check that a mesh is manifold and oriented, and counts
// vertices, edges, faces and boundary loops of each component. With known connectivity the checks
// are not needed.
#include "agvd/mesh/topology.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

#include "agvd/core/bucket_sort.h"
#include "agvd/core/half_edge.h"
#include "agvd/core/parallel.h"
#include "agvd/core/union_find.h"
#include "agvd/mesh/components.h"
#include "agvd/mesh/edge_sides.h"

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
    sorted = sort_in_buckets(
        sorted, static_cast<Index>(mesh.positions.size()), [](const Triangle& t) { return t[0]; },
        std::less<>(), ticker);
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

double face_area(const MeshView& mesh, Index face) {
    const auto& [a, b, c] = mesh.triangles[face];
    const Vec3& origin = mesh.positions[a];
    return 0.5 * (mesh.positions[b] - origin).cross(mesh.positions[c] - origin).norm();
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
    std::vector<Index> by_component(mesh.triangles.size());
    std::iota(by_component.begin(), by_component.end(), Index{0});
    if (result.components.size() > 1) {
        by_component = sort_in_buckets(
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

// Adds to boundary_loops of the components.
void count_boundary_loops(const MeshView& mesh, const Connectivity& connectivity, Poller& poller,
                          Topology& result) {
    const std::vector<Index>& twin = connectivity.twin;
    Ticker ticker(poller);
    std::vector<bool> is_seen(twin.size(), false);
    poller.poll();
    const auto next_open = [&](auto from) { return std::find(from, twin.end(), no_index); };
    for (auto open = next_open(twin.begin()); open != twin.end(); open = next_open(open + 1)) {
        const auto start = static_cast<Index>(open - twin.begin());
        if (is_seen[start]) continue;
        ++result.components[result.face_component[start / 3]].boundary_loops;
        for (Index h = start; !is_seen[h];) {
            ticker.tick();
            is_seen[h] = true;
            h = connectivity.outgoing[mesh.triangles[h / 3][next_half_edge(h) % 3]];
        }
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
    Topology result;
    const std::vector<EdgeSide> sides = sorted_edge_sides(mesh.triangles, ticker);
    const auto num_faces = static_cast<Index>(mesh.triangles.size());

    UnionFind parent(num_faces);
    result.is_manifold = !has_bad_faces(mesh, ticker);
    result.is_oriented = true;
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        ticker.tick();
        for (const EdgeSide& side : edge) parent.unite(edge[0].face(), side.face());
        if (edge.size() > 2) result.is_manifold = false;
        if (edge.size() == 2 && edge[0].forward == edge[1].forward) result.is_oriented = false;
    });
    if (result.is_manifold) result.is_manifold = has_one_umbrella_each(mesh, sides, ticker);

    std::vector<Index> component_of_root(num_faces, no_index);
    result.face_component.resize(num_faces);
    for (Index f = 0; f < num_faces; ++f) {
        ticker.tick();
        Index& id = component_of_root[parent.root(f)];
        if (id == no_index) {
            id = static_cast<Index>(result.components.size());
            result.components.emplace_back();
        }
        result.face_component[f] = id;
        ComponentTopology& c = result.components[id];
        ++c.faces;
        ++c.euler;
        c.area += face_area(mesh, f);
    }

    count_vertices(mesh, ticker, result);
    count_edges(sides, mesh.positions.size(), ticker, result);
    for (ComponentTopology& c : result.components) c.genus = (2 - c.euler - c.boundary_loops) / 2;
    return result;
}

Topology analyze_topology(const MeshView& mesh, const Connectivity& connectivity, int num_threads,
                          const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    const std::vector<Index>& twin = connectivity.twin;
    const std::vector<Index>& outgoing = connectivity.outgoing;
    FaceLabels labels = label_components(twin, num_threads, poller);
    const std::vector<int> euler = euler_of_components(twin, outgoing, labels, num_threads, poller);
    Topology result{true, true, std::vector<ComponentTopology>(labels.count),
                    std::move(labels.of_face)};
    const std::vector<Index>& label = result.face_component;
    const auto num_faces = static_cast<Index>(label.size());
    std::vector<double> area(num_faces);
    poller.poll();
    const auto measure = [&](Index, Index begin, Index end) {
        for (Index f = begin; f < end; ++f) area[f] = face_area(mesh, f);
    };
    parallel_chunks(num_faces, pass_grain, num_threads, measure, poller);
    for (Index f = 0; f < num_faces; ++f) {  // Sums run in the order of the faces.
        ticker.tick();
        ComponentTopology& c = result.components[label[f]];
        ++c.faces;
        c.area += area[f];
    }
    count_boundary_loops(mesh, connectivity, poller, result);
    for (Index i = 0; i < euler.size(); ++i) {
        ComponentTopology& c = result.components[i];
        c.euler = euler[i];
        c.genus = (2 - c.euler - c.boundary_loops) / 2;
    }
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

}  // namespace agvd
