// Builds a surface from a mesh: checks the elements, pairs half-edges, numbers edges, and computes
// lengths, layouts of faces, and the vertices at which geodesics may bend. The quick search for
// pairs only says that the mesh is no oriented 2-manifold; then a second, slower one finds the
// first faulty element for the text of the error.
#include "agvd/mesh/surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/scale.h"

namespace agvd {
namespace {

constexpr const char* remedy = "; repair the mesh first (remesh::clean_input)";

void check_elements(const MeshView& mesh, Ticker& ticker) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        ticker.tick();
        if (!mesh.positions[v].allFinite()) {
            throw InvalidInput(
                "vertex " + std::to_string(v) +
                " has a coordinate that is not finite; correct or delete the vertex");
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
                                   std::to_string(v) + ", but the mesh has only " +
                                   std::to_string(mesh.positions.size()) +
                                   " vertices, counted from 0; correct or delete the face");
            }
        }
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
            throw InvalidInput("face " + std::to_string(f) + " names a vertex twice" + remedy);
        }
    }
}

// The twins; throws at the first edge that has none.
std::vector<Index> pair_or_explain(const MeshView& mesh, Ticker& ticker) {
    struct Side {
        Index low, high, half_edge;
    };
    const auto tail = [&](Index h) { return mesh.triangles[h / 3][h % 3]; };
    std::vector<Side> sides;
    for (Index h = 0; h < 3 * mesh.triangles.size(); ++h) {
        ticker.tick();
        const auto [low, high] = std::minmax({tail(h), tail(next_half_edge(h))});
        sides.push_back({low, high, h});
    }
    sort_ticked(sides, ticker, [](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.half_edge) < std::tie(b.low, b.high, b.half_edge);
    });
    std::vector<Index> twin(sides.size(), no_index);
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
        while (end < sides.size() && sides[end].low == sides[i].low &&
               sides[end].high == sides[i].high) {
            ++end;
        }
        ticker.tick(end - i);
        const Index h = sides[i].half_edge;
        if (end - i > 2) {
            throw InvalidInput("the edge from vertex " + std::to_string(tail(h)) + " to " +
                               std::to_string(tail(next_half_edge(h))) + " has " +
                               std::to_string(end - i) + " faces" + remedy);
        }
        if (end - i < 2) continue;
        const Index other = sides[i + 1].half_edge;
        if (tail(h) == tail(other)) {
            throw InvalidInput("faces " + std::to_string(h / 3) + " and " +
                               std::to_string(other / 3) + " are oriented differently" + remedy);
        }
        twin[h] = other;
        twin[other] = h;
    }
    return twin;
}

// Throws the reason why find_connectivity had no result.
[[noreturn]] void explain(const MeshView& mesh, Ticker& ticker) {
    const std::vector<Index> twin = pair_or_explain(mesh, ticker);
    std::vector<Index> valence(mesh.positions.size(), 0), outgoing(mesh.positions.size(), no_index);
    for (Index h = 0; h < twin.size(); ++h) {
        ticker.tick();
        const Index v = mesh.triangles[h / 3][h % 3];
        ++valence[v];
        if (outgoing[v] == no_index || twin[h] == no_index) outgoing[v] = h;
    }
    Index vertex = 0;
    for (; vertex < valence.size(); ++vertex) {
        if (valence[vertex] == 0) continue;
        Index seen = 0;
        Index h = outgoing[vertex];
        do {
            ++seen;
            h = twin[previous_half_edge(h)];
        } while (h != no_index && h != outgoing[vertex]);
        ticker.tick(seen);
        if (seen != valence[vertex]) break;
    }
    throw InvalidInput("the faces around vertex " + std::to_string(vertex) +
                       " do not form one fan" + remedy);
}

// Edges are numbered in the order of their lower half-edge, so that neighbours stay close.
void number_edges(Surface& surface, int num_threads, Poller& poller) {
    const auto num_half_edges = static_cast<Index>(surface.twin.size());
    // True on the boundary, too, since no_index is the greatest.
    const auto is_first = [&](Index h) { return surface.twin[h] > h; };
    std::vector<Index> begin_of(num_chunks(num_half_edges, pass_grain) + 1, 0);
    const auto count_first = [&](Index chunk, Index begin, Index end) {
        Index count = 0;
        for (Index h = begin; h < end; ++h) count += is_first(h) ? 1 : 0;
        begin_of[chunk + 1] = count;
    };
    parallel_chunks(num_half_edges, pass_grain, num_threads, count_first, poller);
    std::partial_sum(begin_of.begin(), begin_of.end(), begin_of.begin());
    surface.edge.resize(num_half_edges);
    surface.edge_half.resize(begin_of.back());
    poller.poll();
    const auto number = [&](Index chunk, Index begin, Index end) {
        Index edge = begin_of[chunk];
        for (Index h = begin; h < end; ++h) {
            if (!is_first(h)) continue;
            surface.edge[h] = edge;
            if (surface.twin[h] != no_index) surface.edge[surface.twin[h]] = edge;
            surface.edge_half[edge++] = h;
        }
    };
    parallel_chunks(num_half_edges, pass_grain, num_threads, number, poller);
}

void measure(Surface& surface, int num_threads, Poller& poller) {
    surface.length.resize(surface.num_edges());
    const auto measure_edges = [&](Index, Index begin, Index end) {
        for (Index e = begin; e < end; ++e) {
            surface.length[e] = surface.length_in_space(surface.edge_half[e]);
        }
    };
    parallel_chunks(surface.num_edges(), pass_grain, num_threads, measure_edges, poller);
    surface.apex.resize(surface.twin.size());
    poller.poll();
    const auto num_half_edges = static_cast<Index>(surface.twin.size());
    std::vector<Index> degenerate(num_chunks(num_half_edges, pass_grain), no_index);
    const auto find_apexes = [&](Index chunk, Index begin, Index end) {
        for (Index h = begin; h < end; ++h) {
            surface.apex[h] = surface.apex_in_space(h);
            const double height = surface.apex[h].y();
            if (!(height > 0) || !std::isfinite(height))
                degenerate[chunk] = std::min(degenerate[chunk], h);
        }
    };
    parallel_chunks(num_half_edges, pass_grain, num_threads, find_apexes, poller);
    const auto first = std::min_element(degenerate.begin(), degenerate.end());
    if (first != degenerate.end() && *first != no_index) {
        throw InvalidInput("face " + std::to_string(*first / 3) + " has no area" + remedy);
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

void find_pseudo_sources(Surface& surface, int num_threads, Poller& poller) {
    surface.can_be_pseudo_source.resize(surface.num_vertices());
    const auto find = [&](Index, Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            const Index first = surface.outgoing[v];
            ConeAngle cone;
            for (Index h = first; h != no_index;) {
                cone.add(surface.apex[h].normalized());
                h = surface.twin[Surface::previous(h)];
                if (h == first) break;
            }
            const bool can_be_pseudo_source =
                surface.is_boundary_vertex(v) ? cone.exceeds_pi() : cone.exceeds_two_pi();
            surface.can_be_pseudo_source[v] = can_be_pseudo_source ? 1 : 0;
        }
    };
    parallel_chunks(surface.num_vertices(), pass_grain, num_threads, find, poller);
}

}  // namespace

Surface build_surface(const MeshView& mesh, int num_threads, const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    check_elements(mesh, ticker);
    check_scale(box_of(mesh, num_threads));
    std::optional<Connectivity> connectivity = find_connectivity(mesh, num_threads, progress);
    if (!connectivity) explain(mesh, ticker);
    return build_surface({{mesh.positions.begin(), mesh.positions.end()},
                          {mesh.triangles.begin(), mesh.triangles.end()}},
                         *std::move(connectivity), num_threads, progress);
}

Surface build_surface(TriangleMesh mesh, Connectivity connectivity, int num_threads,
                      const Progress& progress) {
    Poller poller(progress);
    Surface surface;
    surface.mesh = std::move(mesh);
    surface.twin = std::move(connectivity.twin);
    surface.outgoing = std::move(connectivity.outgoing);
    number_edges(surface, num_threads, poller);
    measure(surface, num_threads, poller);
    find_pseudo_sources(surface, num_threads, poller);
    return surface;
}

std::vector<std::vector<Index>> boundary_loops(const Surface& surface) {
    std::vector<std::vector<Index>> loops;
    const auto next_open = [&](auto from) { return std::find(from, surface.twin.end(), no_index); };
    auto open = next_open(surface.twin.begin());
    if (open == surface.twin.end()) return loops;
    std::vector<bool> seen(surface.twin.size(), false);
    for (; open != surface.twin.end(); open = next_open(open + 1)) {
        const auto start = static_cast<Index>(open - surface.twin.begin());
        if (seen[start]) continue;
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
