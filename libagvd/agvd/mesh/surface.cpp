// Builds a surface from a mesh: checks the elements, pairs half-edges, numbers edges, and computes
// lengths, layouts of faces, and the vertices at which geodesics may bend.
#include "agvd/mesh/surface.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "agvd/core/error.h"
#include "agvd/core/number_text.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/scale.h"

namespace agvd {
namespace {

constexpr const char* remedy = "; repair the mesh first (remesh::clean_input)";
constexpr const char* twice = " names a vertex twice";

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
                throw InvalidInput("face " + std::to_string(f) + " names vertex " + index_text(v) +
                                   ", but the mesh has only " +
                                   std::to_string(mesh.positions.size()) +
                                   " vertices, counted from 0; correct or delete the face");
            }
        }
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
            throw InvalidInput("face " + std::to_string(f) + twice + remedy);
        }
    }
}

// Pairs the sides of each edge, and walks around each vertex.
// \param reason  gets why there is no result: the first faulty edge, or the first faulty vertex.
std::optional<Connectivity> pair_sides(const MeshView& mesh, Ticker& ticker, std::string& reason) {
    const auto tail = [&](Index h) { return mesh.triangles[h / 3][h % 3]; };
    Connectivity result{std::vector<Index>(3 * mesh.triangles.size(), no_index),
                        std::vector<Index>(mesh.positions.size(), no_index)};
    std::vector<Index>&twin = result.twin, &outgoing = result.outgoing;
    for_each_edge(sorted_edge_sides(mesh.triangles, ticker), [&](std::span<const EdgeSide> edge) {
        ticker.tick(edge.size());
        const Index h = edge[0].half_edge;
        if (!reason.empty()) return;
        if (edge[0].low() == edge[0].high()) {
            reason = "face " + std::to_string(h / 3) + twice;
        } else if (edge.size() > 2) {
            reason = "the edge from vertex " + std::to_string(tail(h)) + " to " +
                     std::to_string(tail(next_half_edge(h))) + " has " +
                     std::to_string(edge.size()) + " faces";
        } else if (edge.size() == 2 && edge[0].forward == edge[1].forward) {
            reason = "faces " + std::to_string(h / 3) + " and " +
                     std::to_string(edge[1].half_edge / 3) + " are oriented differently";
        } else if (edge.size() == 2) {
            twin[h] = edge[1].half_edge;
            twin[edge[1].half_edge] = h;
        }
    });
    if (!reason.empty()) return std::nullopt;
    std::vector<Index> num_left(mesh.positions.size(), 0);  // Half-edges that no walk has passed.
    for (Index h = 0; h < twin.size(); ++h) {
        ticker.tick();
        const Index v = tail(h);
        ++num_left[v];
        if (outgoing[v] == no_index || twin[h] == no_index) outgoing[v] = h;
    }
    for (Index v = 0; v < outgoing.size(); ++v) {
        ticker.tick(num_left[v]);
        for (Index h = outgoing[v]; h != no_index;) {
            --num_left[v];
            h = twin[previous_half_edge(h)];
            if (h == outgoing[v]) break;
        }
        if (num_left[v] == 0) continue;
        reason = "the faces around vertex " + std::to_string(v) + " do not form one fan";
        return std::nullopt;
    }
    return result;
}

// Edges are numbered in the order of their lower half-edge, so that neighbours stay close.
void number_edges(Surface& surface, Ticker& ticker) {
    surface.edge.resize(surface.twin.size());
    ticker.poll();
    surface.edge_half.reserve(surface.twin.size() / 2);
    for (Index h = 0; h < surface.twin.size(); ++h) {
        ticker.tick();
        const Index twin = surface.twin[h];
        if (twin < h) {
            surface.edge[h] = surface.edge[twin];
        } else {
            surface.edge[h] = surface.num_edges();
            surface.edge_half.push_back(h);
        }
    }
    surface.edge_half.shrink_to_fit();
}

void measure_edges(Surface& surface, int num_threads, Poller& poller) {
    surface.length.resize(surface.num_edges());
    const auto measure_edge = [&](Index e) {
        surface.length[e] = surface.length_in_space(surface.edge_half[e]);
    };
    parallel_each(surface.num_edges(), pass_grain, num_threads, measure_edge, poller);
}

// \param side_length  by half-edge.
void take_lengths(Surface& surface, std::span<const double> side_length, Ticker& ticker) {
    constexpr double agreement = 1e-12, least = 1e-60, most = 1e60;
    surface.has_own_lengths = true;
    surface.length.resize(surface.num_edges());
    const auto name = [&](Index h) {
        return "the edge from vertex " + std::to_string(surface.tail(h)) + " to " +
               std::to_string(surface.head(h));
    };
    for (Index e = 0; e < surface.num_edges(); ++e) {
        ticker.tick();
        const Index h = surface.edge_half[e], twin = surface.twin[h];
        const double length = side_length[h];
        if (!(length > 0 && std::isfinite(length))) {
            throw InvalidInput(name(h) + " has the length " + number_text(length) +
                               "; use a number above 0");
        }
        if (length < least || length > most) {
            throw InvalidInput(name(h) + " has the length " + number_text(length) +
                               ", but lengths are raised to the fourth power; multiply all by a "
                               "number that brings them between " +
                               number_text(least) + " and " + number_text(most));
        }
        if (twin != no_index && !(std::abs(side_length[twin] - length) <= agreement * length)) {
            throw InvalidInput(name(h) + " has the lengths " + number_text(length) + " and " +
                               number_text(side_length[twin]) +
                               " in its two faces; give it one length");
        }
        surface.length[e] = length;
    }
}

// The apex from the three lengths; the height by Kahan's formula, exact to some roundings of the
// longest side.
Vec2 apex_by_lengths(const Surface& surface, Index h) {
    const double base = surface.length_of(h), right = surface.length_of(Surface::next(h)),
                 left = surface.length_of(Surface::previous(h));
    std::array sides{base, right, left};
    std::sort(sides.begin(), sides.end());
    const auto [c, b, a] = sides;
    const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    const double height = product > 0 ? std::sqrt(product) / (2 * base) : 0;
    return {((left - right) * ((left + right) / base) + base) / 2, height};
}

// Whether the face has the lengths that it has in space.
bool lies_in_space(const Surface& surface, Index face) {
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const Index along = surface.edge_half[surface.edge[h]];
        if (surface.length_of(h) != surface.length_in_space(along)) return false;
    }
    return true;
}

void find_all_apexes(Surface& surface, int num_threads, Poller& poller) {
    surface.apex.resize(surface.twin.size());
    poller.poll();
    const auto num_half_edges = static_cast<Index>(surface.twin.size());
    std::vector<Index> degenerate(num_chunks(num_half_edges, pass_grain), no_index);
    const auto find_apexes = [&](Index chunk, Index begin, Index end) {
        for (Index h = begin; h < end; ++h) {
            surface.apex[h] = surface.has_own_lengths && !lies_in_space(surface, h / 3)
                                  ? apex_by_lengths(surface, h)
                                  : surface.apex_in_space(h);
            const double height = surface.apex[h].y();
            const bool has_area = height > 0 && std::isfinite(height);
            if (!has_area) degenerate[chunk] = std::min(degenerate[chunk], h);
        }
    };
    parallel_chunks(num_half_edges, pass_grain, num_threads, find_apexes, poller);
    const auto first = std::min_element(degenerate.begin(), degenerate.end());
    if (first != degenerate.end() && *first != no_index) {
        const Index h = *first / 3 * 3;
        const std::string face = "face " + std::to_string(*first / 3);
        if (!surface.has_own_lengths) throw InvalidInput(face + " has no area" + remedy);
        throw InvalidInput(face + " has sides of the lengths " + number_text(surface.length_of(h)) +
                           ", " + number_text(surface.length_of(h + 1)) + " and " +
                           number_text(surface.length_of(h + 2)) +
                           ", which make no triangle; correct them");
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
    const auto find = [&](Index v) {
        ConeAngle cone;
        for_each_outgoing(surface, v, [&](Index h) { cone.add(surface.apex[h].normalized()); });
        const bool can_be_pseudo_source =
            surface.is_boundary_vertex(v) ? cone.exceeds_pi() : cone.exceeds_two_pi();
        surface.can_be_pseudo_source[v] = can_be_pseudo_source ? 1 : 0;
    };
    parallel_each(surface.num_vertices(), pass_grain, num_threads, find, poller);
}

}  // namespace

std::optional<Connectivity> find_connectivity(const MeshView& mesh, const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    std::string reason;
    return pair_sides(mesh, ticker, reason);
}

Surface build_surface(const MeshView& mesh, int num_threads, const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    check_elements(mesh, ticker);
    check_scale(box_of(mesh, num_threads));
    std::string reason;
    std::optional<Connectivity> connectivity = pair_sides(mesh, ticker, reason);
    if (!connectivity) throw InvalidInput(reason + remedy);
    return build_surface({{mesh.positions.begin(), mesh.positions.end()},
                          {mesh.triangles.begin(), mesh.triangles.end()}},
                         *std::move(connectivity), num_threads, progress);
}

Surface build_surface(const MeshView& mesh, std::span<const double> side_length, int num_threads,
                      const Progress& progress) {
    if (side_length.size() != 3 * mesh.triangles.size()) {
        throw InvalidInput("there are " + std::to_string(side_length.size()) + " lengths for " +
                           std::to_string(mesh.triangles.size()) +
                           " faces; give one for each side of each face");
    }
    Poller poller(progress);
    Ticker ticker(poller);
    check_elements(mesh, ticker);
    std::string reason;
    std::optional<Connectivity> connectivity = pair_sides(mesh, ticker, reason);
    if (!connectivity) throw InvalidInput(reason + remedy);
    return build_surface({{mesh.positions.begin(), mesh.positions.end()},
                          {mesh.triangles.begin(), mesh.triangles.end()}},
                         *std::move(connectivity), side_length, num_threads, progress);
}

Surface build_surface(TriangleMesh mesh, Connectivity connectivity, int num_threads,
                      const Progress& progress) {
    return build_surface(std::move(mesh), std::move(connectivity), {}, num_threads, progress);
}

Surface build_surface(TriangleMesh mesh, Connectivity connectivity,
                      std::span<const double> side_length, int num_threads,
                      const Progress& progress) {
    Poller poller(progress);
    Surface surface;
    surface.mesh = std::move(mesh);
    surface.twin = std::move(connectivity.twin);
    surface.outgoing = std::move(connectivity.outgoing);
    Ticker ticker(poller);
    number_edges(surface, ticker);
    if (side_length.empty()) {
        measure_edges(surface, num_threads, poller);
    } else {
        take_lengths(surface, side_length, ticker);
    }
    find_all_apexes(surface, num_threads, poller);
    find_pseudo_sources(surface, num_threads, poller);
    return surface;
}

Surface surface_of_part(const Surface& whole, std::span<const Index> faces, Ticker ticker) {
    const auto distinct = [&](std::vector<Index>& values) {
        sort_ticked(values, ticker, std::less<>());
        values.erase(std::unique(values.begin(), values.end()), values.end());
    };
    std::vector<Index> vertices, edges;
    for (const Index f : faces) {
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            vertices.push_back(whole.tail(h));
            edges.push_back(whole.edge[h]);
        }
    }
    distinct(vertices);
    distinct(edges);
    const auto moved = [&](Index half_edge) {
        if (half_edge == no_index) return no_index;
        return 3 * rank_of(faces, Surface::face(half_edge)) + half_edge % 3;
    };
    Surface part;
    for (const Index f : faces) {
        ticker.tick(8);
        Triangle& t = part.mesh.triangles.emplace_back(whole.mesh.triangles[f]);
        for (Index& v : t) v = rank_of(vertices, v);
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            part.twin.push_back(moved(whole.twin[h]));
            part.edge.push_back(rank_of(edges, whole.edge[h]));
            part.apex.push_back(whole.apex[h]);
        }
    }
    for (const Index v : vertices) {
        part.mesh.positions.push_back(whole.mesh.positions[v]);
        part.outgoing.push_back(moved(whole.outgoing[v]));
        part.can_be_pseudo_source.push_back(whole.can_be_pseudo_source[v]);
    }
    for (const Index e : edges) {
        part.edge_half.push_back(moved(whole.edge_half[e]));
        part.length.push_back(whole.length[e]);
    }
    return part;
}

std::vector<std::vector<Index>> boundary_loops(const Surface& surface) {
    return boundary_loops(surface.mesh.triangles, surface.twin, surface.outgoing, {});
}

std::vector<std::vector<Index>> boundary_loops(std::span<const Triangle> triangles,
                                               std::span<const Index> twin,
                                               std::span<const Index> outgoing, Ticker ticker) {
    std::vector<std::vector<Index>> loops;
    const auto next_open = [&](auto from) { return std::find(from, twin.end(), no_index); };
    auto open = next_open(twin.begin());
    if (open == twin.end()) return loops;
    std::vector<bool> seen(twin.size(), false);
    for (; open != twin.end(); open = next_open(open + 1)) {
        const auto start = static_cast<Index>(open - twin.begin());
        if (seen[start]) continue;
        std::vector<Index>& loop = loops.emplace_back();
        for (Index h = start; !seen[h];) {
            ticker.tick();
            seen[h] = true;
            loop.push_back(h);
            h = outgoing[triangles[h / 3][next_half_edge(h) % 3]];
        }
    }
    return loops;
}

SurfacePoint point_at(const Surface& surface, Index vertex) {
    const Index h = surface.outgoing[vertex];
    SurfacePoint point{FaceId(Surface::face(h)), {0, 0, 0}};
    point.barycentric[h % 3] = 1;
    return point;
}

}  // namespace agvd
