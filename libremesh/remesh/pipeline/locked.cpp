#include "remesh/pipeline/locked.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/core/random.h"
#include "agvd/core/types.h"

namespace remesh::detail {
namespace {

// Numbers of different positions.
class Places {
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
    throw InvalidInput("vertex " + std::to_string(vertex) + " is to stay, but the mesh has only " +
                       std::to_string(given.positions.size()) +
                       " vertices, counted from 0; name one of these");
}

// Where sheets have edges at one place, cleaning has cut the mesh: that is no boundary.
void add_boundary(const Surface& surface, Places& places, std::vector<std::uint64_t>& wanted) {
    const auto position = [&](Index v) -> const Vec3& { return surface.mesh.positions[v]; };
    Places ends;
    for (Index h = 0; h < surface.twin.size(); ++h) {
        if (surface.twin[h] != no_index) continue;
        ends.add(position(surface.tail(h)));
        ends.add(position(surface.head(h)));
    }
    std::vector<std::pair<std::uint64_t, Index>> edges;  // Between these places, and a half-edge.
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
            edge_key(places.add(position(surface.tail(h))), places.add(position(surface.head(h)))));
    }
}

}  // namespace

LockedElements find_locked(const MeshView& given, const RemeshOptions& options,
                           const Surface& surface) {
    LockedElements locked;
    const auto& vertices = options.locked;
    const auto& edges = options.locked_edges;
    if (vertices.empty() && edges.empty() && !options.lock_boundary) return locked;
    Places places;
    const auto place_of = [&](Index v) { return places.find(given.positions[v]); };
    for (const Index v : vertices) {
        require_vertex(given, v);
        places.add(given.positions[v]);
    }
    std::vector<std::uint64_t> wanted;
    for (const auto& [a, b] : edges) {
        require_vertex(given, a);
        require_vertex(given, b);
        wanted.push_back(edge_key(places.add(given.positions[a]), places.add(given.positions[b])));
    }
    if (options.lock_boundary) add_boundary(surface, places, wanted);
    std::ranges::sort(wanted);
    std::vector<Index> place(surface.num_vertices());
    std::vector<bool> is_found(places.size(), false);
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        place[v] = places.find(surface.mesh.positions[v]);
        if (place[v] == no_index) continue;
        locked.vertices.push_back(v);
        is_found[place[v]] = true;
    }
    for (const Index v : vertices) {
        if (is_found[place_of(v)]) continue;
        throw InvalidInput("vertex " + std::to_string(v) +
                           " is to stay, but no face with an area has it as a corner; name "
                           "another vertex");
    }
    if (wanted.empty()) return locked;
    locked.is_edge.assign(surface.num_edges(), 0);
    std::vector<std::uint64_t> found;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        const Index a = place[surface.tail(h)], b = place[surface.head(h)];
        if (a == no_index || b == no_index || !std::ranges::binary_search(wanted, edge_key(a, b)))
            continue;
        locked.is_edge[e] = 1;
        found.push_back(edge_key(a, b));
    }
    std::ranges::sort(found);
    for (const auto& [a, b] : edges) {
        if (std::ranges::binary_search(found, edge_key(place_of(a), place_of(b)))) continue;
        throw InvalidInput("the edge between vertices " + std::to_string(a) + " and " +
                           std::to_string(b) +
                           " is to stay, but is no edge of the cleaned mesh; leave out the "
                           "faces there");
    }
    return locked;
}

bool has_locked(const Surface& surface, const LockedElements& locked, TriangleMesh& mesh) {
    if (locked.empty()) return true;
    Places places;
    std::vector<Vec3> position;
    for (const Index v : locked.vertices) {
        const Vec3& p = surface.mesh.positions[v];
        if (places.add(p) == position.size()) position.push_back(p);
    }
    std::vector<Index> place(mesh.positions.size());
    std::vector<bool> is_found(places.size(), false);
    for (std::size_t v = 0; v < place.size(); ++v) {
        place[v] = places.find(mesh.positions[v]);
        if (place[v] == no_index) continue;
        is_found[place[v]] = true;
        mesh.positions[v] = position[place[v]];
    }
    if (std::find(is_found.begin(), is_found.end(), false) != is_found.end()) return false;
    if (locked.is_edge.empty()) return true;
    std::vector<std::uint64_t> edges;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = place[t[k]], b = place[t[(k + 1) % 3]];
            if (a != no_index && b != no_index) edges.push_back(edge_key(a, b));
        }
    }
    std::ranges::sort(edges);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (!locked.has_edge(e)) continue;
        const Index h = surface.edge_half[e];
        const Index a = places.find(surface.mesh.positions[surface.tail(h)]);
        const Index b = places.find(surface.mesh.positions[surface.head(h)]);
        if (!std::ranges::binary_search(edges, edge_key(a, b))) return false;
    }
    return true;
}

}  // namespace remesh::detail
