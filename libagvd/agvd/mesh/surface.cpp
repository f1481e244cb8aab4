#include "agvd/mesh/surface.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "agvd/core/bucket_sort.h"
#include "agvd/core/error.h"
#include "agvd/core/poller.h"

namespace agvd {
namespace {

constexpr const char* remedy = "; repair the mesh first (remesh::clean_input)";

void check_elements(const MeshView& mesh, Ticker& ticker) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        ticker.tick();
        if (!mesh.positions[v].allFinite()) {
            throw InvalidInput("vertex " + std::to_string(v) +
                               " has a coordinate that is not finite" + remedy);
        }
    }
    if (mesh.triangles.size() > no_index / 3) {
        throw InvalidInput("the mesh has more than 2^32 / 3 faces; split it into parts");
    }
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        const Triangle& t = mesh.triangles[f];
        for (const Index v : t) {
            if (v >= mesh.positions.size()) {
                throw InvalidInput("face " + std::to_string(f) + " names vertex " +
                                   std::to_string(v) + ", but there are only " +
                                   std::to_string(mesh.positions.size()) + remedy);
            }
        }
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
            throw InvalidInput("face " + std::to_string(f) + " repeats a corner" + remedy);
        }
    }
}

// Pairs half-edges by sorting them under their undirected key.
void connect(Surface& surface, Ticker& ticker) {
    struct Key {
        std::uint64_t ends;
        Index half_edge;
    };
    const auto num_half_edges = static_cast<Index>(3 * surface.mesh.triangles.size());
    std::vector<Key> keys(num_half_edges);
    ticker.poll();
    for (Index h = 0; h < num_half_edges; ++h) {
        ticker.tick();
        const Index a = surface.tail(h);
        const Index b = surface.head(h);
        keys[h] = {std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), h};
    }
    keys = sort_in_buckets(
        keys, surface.num_vertices(),
        [](const Key& key) { return static_cast<Index>(key.ends >> 32); },
        [](const Key& a, const Key& b) {
            return a.ends != b.ends ? a.ends < b.ends : a.half_edge < b.half_edge;
        },
        ticker);
    ticker.poll();
    surface.twin.assign(num_half_edges, no_index);
    for (std::size_t i = 0; i < keys.size();) {
        std::size_t end = i + 1;
        while (end < keys.size() && keys[end].ends == keys[i].ends) ++end;
        ticker.tick();
        const Index h = keys[i].half_edge;
        if (end - i > 2) {
            throw InvalidInput("the edge from vertex " + std::to_string(surface.tail(h)) + " to " +
                               std::to_string(surface.head(h)) + " has " + std::to_string(end - i) +
                               " faces" + remedy);
        }
        if (end - i == 2) {
            const Index other = keys[i + 1].half_edge;
            if (surface.tail(h) == surface.tail(other)) {
                throw InvalidInput("faces " + std::to_string(h / 3) + " and " +
                                   std::to_string(other / 3) + " are oriented differently" +
                                   remedy);
            }
            surface.twin[h] = other;
            surface.twin[other] = h;
        }
        i = end;
    }
    // Edges are numbered in the order of their lower half-edge, so that neighbours stay close.
    surface.edge.assign(num_half_edges, no_index);
    ticker.poll();
    for (Index h = 0; h < num_half_edges; ++h) {
        ticker.tick();
        if (surface.edge[h] != no_index) continue;
        surface.edge[h] = surface.num_edges();
        if (surface.twin[h] != no_index) surface.edge[surface.twin[h]] = surface.num_edges();
        surface.edge_half.push_back(h);
    }
}

void find_outgoing(Surface& surface, Ticker& ticker) {
    const Index num_vertices = surface.num_vertices();
    std::vector<Index> degree(num_vertices, 0);
    surface.outgoing.assign(num_vertices, no_index);
    ticker.poll();
    for (Index h = 0; h < surface.twin.size(); ++h) {
        ticker.tick();
        const Index v = surface.tail(h);
        ++degree[v];
        if (surface.outgoing[v] == no_index || surface.twin[h] == no_index) surface.outgoing[v] = h;
    }
    for (Index v = 0; v < num_vertices; ++v) {
        if (surface.outgoing[v] == no_index) continue;
        Index seen = 0;
        Index h = surface.outgoing[v];
        do {
            ++seen;
            h = surface.twin[Surface::previous(h)];
        } while (h != no_index && h != surface.outgoing[v]);
        ticker.tick(seen);
        if (seen != degree[v]) {
            throw InvalidInput("the faces around vertex " + std::to_string(v) +
                               " do not form one fan" + remedy);
        }
    }
}

void measure(Surface& surface, Ticker& ticker) {
    surface.length.resize(surface.num_edges());
    for (Index e = 0; e < surface.num_edges(); ++e) {
        ticker.tick();
        const Index h = surface.edge_half[e];
        surface.length[e] =
            (surface.mesh.positions[surface.head(h)] - surface.mesh.positions[surface.tail(h)])
                .norm();
    }
    surface.apex.resize(surface.twin.size());
    ticker.poll();
    for (Index h = 0; h < surface.apex.size(); ++h) {
        ticker.tick();
        const Vec3& origin = surface.mesh.positions[surface.tail(h)];
        const Vec3 along = surface.mesh.positions[surface.head(h)] - origin;
        const Vec3 up = surface.mesh.positions[surface.tail(Surface::previous(h))] - origin;
        const double length = surface.length_of(h);
        const double doubled_area = along.cross(up).norm();
        if (!(doubled_area > 0) || !std::isfinite(doubled_area)) {
            throw InvalidInput("face " + std::to_string(h / 3) + " has no area" + remedy);
        }
        surface.apex[h] = {along.dot(up) / length, doubled_area / length};
    }
}

// The angle around a vertex as a unit vector and a number of full turns: corner angles are below
// pi, so a product that comes back to the upper half plane from the lower one has passed 2 pi.
struct ConeAngle {
    Vec2 direction{1, 0};
    Index turns = 0;

    void add(const Vec2& corner) {
        const Vec2 sum(direction.x() * corner.x() - direction.y() * corner.y(),
                       direction.x() * corner.y() + direction.y() * corner.x());
        if (direction.y() < 0 && sum.y() >= 0) ++turns;
        direction = sum;
    }
    [[nodiscard]] bool exceeds_pi() const {
        return turns > 0 ||
               (direction.y() < 0 && (direction.x() > 0 || direction.y() < -tolerance));
    }
    [[nodiscard]] bool exceeds_two_pi() const {
        return turns > 1 || (turns == 1 &&
                             (direction.x() < 0 || direction.y() < 0 || direction.y() > tolerance));
    }

    static constexpr double tolerance = 1e-9;
};

void find_turning_vertices(Surface& surface, Ticker& ticker) {
    std::vector<ConeAngle> cones(surface.num_vertices());
    ticker.poll();
    for (Index h = 0; h < surface.twin.size(); ++h) {
        ticker.tick();
        cones[surface.tail(h)].add(surface.apex[h].normalized());
    }
    surface.can_turn.resize(surface.num_vertices());
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        ticker.tick();
        const bool can_turn =
            surface.is_boundary_vertex(v) ? cones[v].exceeds_pi() : cones[v].exceeds_two_pi();
        surface.can_turn[v] = can_turn ? 1 : 0;
    }
}

}  // namespace

Surface build_surface(const MeshView& mesh, const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    check_elements(mesh, ticker);
    Surface surface;
    surface.mesh.positions.assign(mesh.positions.begin(), mesh.positions.end());
    surface.mesh.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    ticker.poll();
    connect(surface, ticker);
    find_outgoing(surface, ticker);
    measure(surface, ticker);
    find_turning_vertices(surface, ticker);
    return surface;
}

std::vector<std::vector<Index>> boundary_loops(const Surface& surface) {
    std::vector<std::vector<Index>> loops;
    std::vector<bool> seen(surface.twin.size(), false);
    for (Index start = 0; start < surface.twin.size(); ++start) {
        if (surface.twin[start] != no_index || seen[start]) continue;
        std::vector<Index>& loop = loops.emplace_back();
        Index h = start;
        do {
            seen[h] = true;
            loop.push_back(h);
            h = surface.outgoing[surface.head(h)];
        } while (h != start);
    }
    return loops;
}

}  // namespace agvd
