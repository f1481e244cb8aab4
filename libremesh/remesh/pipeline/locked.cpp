#include "remesh/pipeline/locked.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/core/number_text.h"
#include "agvd/core/random.h"
#include "agvd/core/types.h"

namespace remesh::detail {
namespace {

// Numbers of different positions.
class Positions {
public:
    Index add(const Vec3& position) { return number_.try_emplace(position, size()).first->second; }
    [[nodiscard]] Index find(const Vec3& position) const {
        const auto found = number_.find(position);
        return found == number_.end() ? no_index : found->second;
    }
    [[nodiscard]] Index size() const { return static_cast<Index>(number_.size()); }

private:
    std::unordered_map<Vec3, Index, PositionHash> number_;
};

void require_vertex(const MeshView& given, Index vertex) {
    if (vertex < given.positions.size()) return;
    throw InvalidInput("vertex " + index_text(vertex) + " is to stay, but the mesh has only " +
                       std::to_string(given.positions.size()) +
                       " vertices, counted from 0; name one of these");
}

// Where sheets have edges at one position, cleaning has cut the mesh: that is no boundary.
void add_boundary(const Surface& surface, Positions& known, std::vector<std::uint64_t>& wanted) {
    const auto position = [&](Index v) -> const Vec3& { return surface.mesh.positions[v]; };
    Positions ends;
    for (Index h = 0; h < surface.twin.size(); ++h) {
        if (surface.twin[h] != no_index) continue;
        ends.add(position(surface.tail(h)));
        ends.add(position(surface.head(h)));
    }
    std::vector<std::pair<std::uint64_t, Index>>
        edges;  // Between these positions, and a half-edge.
    for (const Index h : surface.edge_half) {
        const Index a = ends.find(position(surface.tail(h)));
        const Index b = ends.find(position(surface.head(h)));
        if (a != no_index && b != no_index) edges.emplace_back(edge_key(a, b), h);
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto& [edge, h] = edges[i];
        const bool is_alone = (i == 0 || edges[i - 1].first != edge) &&
                              (i + 1 == edges.size() || edges[i + 1].first != edge);
        if (!is_alone || surface.twin[h] != no_index) continue;
        wanted.push_back(
            edge_key(known.add(position(surface.tail(h))), known.add(position(surface.head(h)))));
    }
}

}  // namespace

LockedElements find_locked(const MeshView& given, const RemeshOptions& options,
                           const Surface& surface) {
    LockedElements locked;
    const auto& vertices = options.locked;
    const auto& edges = options.locked_edges;
    if (vertices.empty() && edges.empty() && !options.lock_boundary) return locked;
    Positions known;
    const auto index_of = [&](Index v) { return known.find(given.positions[v]); };
    for (const Index v : vertices) {
        require_vertex(given, v);
        known.add(given.positions[v]);
    }
    std::vector<std::uint64_t> wanted;
    for (const auto& [a, b] : edges) {
        require_vertex(given, a);
        require_vertex(given, b);
        wanted.push_back(edge_key(known.add(given.positions[a]), known.add(given.positions[b])));
    }
    if (options.lock_boundary) add_boundary(surface, known, wanted);
    std::ranges::sort(wanted);
    std::vector<Index> index(surface.num_vertices());
    std::vector<bool> is_found(known.size(), false);
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        index[v] = known.find(surface.mesh.positions[v]);
        if (index[v] == no_index) continue;
        locked.vertices.push_back(v);
        is_found[index[v]] = true;
    }
    for (const Index v : vertices) {
        if (is_found[index_of(v)]) continue;
        throw InvalidInput("vertex " + std::to_string(v) +
                           " is to stay, but no face with an area has it as a corner; name "
                           "another vertex");
    }
    if (wanted.empty()) return locked;
    locked.is_edge.assign(surface.num_edges(), 0);
    std::vector<std::uint64_t> found;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        const Index a = index[surface.tail(h)], b = index[surface.head(h)];
        if (a == no_index || b == no_index || !std::ranges::binary_search(wanted, edge_key(a, b)))
            continue;
        locked.is_edge[e] = 1;
        found.push_back(edge_key(a, b));
    }
    std::ranges::sort(found);
    for (const auto& [a, b] : edges) {
        if (std::ranges::binary_search(found, edge_key(index_of(a), index_of(b)))) continue;
        throw InvalidInput("the edge between vertices " + std::to_string(a) + " and " +
                           std::to_string(b) +
                           " is to stay, but is not an edge of the cleaned mesh; leave out the "
                           "faces there");
    }
    return locked;
}

bool has_locked(const Surface& surface, const LockedElements& locked, TriangleMesh& mesh) {
    if (locked.empty()) return true;
    Positions known;
    std::vector<Vec3> position;
    for (const Index v : locked.vertices) {
        const Vec3& p = surface.mesh.positions[v];
        if (known.add(p) == position.size()) position.push_back(p);
    }
    std::vector<Index> index(mesh.positions.size());
    std::vector<bool> is_found(known.size(), false);
    for (std::size_t v = 0; v < index.size(); ++v) {
        index[v] = known.find(mesh.positions[v]);
        if (index[v] == no_index) continue;
        is_found[index[v]] = true;
        mesh.positions[v] = position[index[v]];
    }
    if (std::find(is_found.begin(), is_found.end(), false) != is_found.end()) return false;
    if (locked.is_edge.empty()) return true;
    std::vector<std::uint64_t> edges;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = index[t[k]], b = index[t[(k + 1) % 3]];
            if (a != no_index && b != no_index) edges.push_back(edge_key(a, b));
        }
    }
    std::ranges::sort(edges);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (!locked.has_edge(e)) continue;
        const Index h = surface.edge_half[e];
        const Index a = known.find(surface.mesh.positions[surface.tail(h)]);
        const Index b = known.find(surface.mesh.positions[surface.head(h)]);
        if (!std::ranges::binary_search(edges, edge_key(a, b))) return false;
    }
    return true;
}

}  // namespace remesh::detail
