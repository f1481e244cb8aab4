// An edge of the boundary is a chain of pieces between the vertices that lie on it. Those are kept
// that end a piece which another edge has as well: weld_cracks joins these.
#include <algorithm>

#include "agvd/core/types.h"
#include "agvd/mesh/point_grid.h"
#include "agvd/mesh/scale.h"
#include "remesh/clean/soup.h"

namespace remesh::detail {
namespace {

// Vertices of the boundary within the reach of open edges, and these edges' own ends.
std::vector<Division> find_chains(const MeshView& mesh, std::span<const Index> open,
                                  double tolerance, Ticker& ticker) {
    const std::span<const Vec3> p = mesh.positions;
    const auto tail = [&](Index h) { return mesh.triangles[h / 3][h % 3]; };
    std::vector<bool> is_boundary(p.size(), false);
    double length = 0;
    for (const Index h : open) {
        const Index a = tail(h), b = tail(Surface::next(h));
        is_boundary[a] = is_boundary[b] = true;
        length += (p[b] - p[a]).norm();
    }
    const CommonPositions common = find_common_positions(mesh, is_boundary, ticker, tolerance);
    // Points along an edge are less than half a cell apart; larger cells would hold many vertices.
    const double cell = length / static_cast<double>(open.size());
    const double limit = std::min(common.limit, cell / 5);
    if (!(cell > 0)) return {};
    PointGrid grid(box_of(mesh).low, cell, open.size());
    for (Index v = 0; v < p.size(); ++v) {
        if (common.first[v] == v) grid.add(p[v], v);
    }
    std::vector<Division> chains;
    for (const Index h : open) {
        const Index from = common.first[tail(h)], to = common.first[tail(Surface::next(h))];
        const Index apex = common.first[tail(Surface::previous(h))];
        const Vec3 way = p[to] - p[from];
        chains.push_back({h, 0, from});
        chains.push_back({h, 1, to});
        if (from == to) continue;
        const auto num_points = static_cast<Index>(2.5 * way.norm() / cell) + 1;
        for (Index i = 0; i < num_points; ++i) {
            ticker.tick();
            grid.visit_near(p[from] + (i + 0.5) / num_points * way, 0.45 * cell, [&](Index v) {
                const double share = way.dot(p[v] - p[from]) / way.squaredNorm();
                if (!(share > 0 && share < 1) || v == from || v == to || v == apex) return;
                const double reach = std::min({limit, common.reach[v], common.share * way.norm()});
                if ((p[from] + share * way - p[v]).norm() <= reach) chains.push_back({h, share, v});
            });
        }
    }
    return distinct(std::move(chains));
}

}  // namespace

std::vector<Division> find_divisions(const MeshView& mesh, std::span<const Index> open,
                                     double tolerance, Ticker& ticker) {
    if (open.empty()) return {};
    const std::vector<Division> chains = find_chains(mesh, open, tolerance, ticker);
    if (chains.size() <= 2 * open.size()) return {};
    const auto piece = [&](std::size_t i) {
        return edge_key(chains[i].vertex, chains[i + 1].vertex);
    };
    const auto ends_chain = [&](std::size_t i) {
        return i + 1 == chains.size() || chains[i].half_edge != chains[i + 1].half_edge;
    };
    std::vector<std::uint64_t> pieces;
    for (std::size_t i = 0; i < chains.size(); ++i) {
        if (!ends_chain(i)) pieces.push_back(piece(i));
    }
    std::sort(pieces.begin(), pieces.end());
    const auto is_shared = [&](std::size_t i) {
        const auto [first, last] = std::equal_range(pieces.begin(), pieces.end(), piece(i));
        return last - first > 1;
    };
    std::vector<Division> kept;
    for (std::size_t i = 1; i < chains.size(); ++i) {
        const bool is_inside = !ends_chain(i) && !ends_chain(i - 1);
        if (is_inside && (is_shared(i - 1) || is_shared(i))) kept.push_back(chains[i]);
    }
    return kept;
}

bool divide_edges(Soup& soup, std::span<const EdgeSide> sides, double tolerance) {
    std::vector<Index> open;
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        if (edge.size() == 1) open.push_back(edge[0].half_edge);
    });
    std::vector<Triangle>& triangles = soup.mesh.triangles;
    const std::vector<Division> found = find_divisions(soup.mesh, open, tolerance, soup.ticker);
    Index face = no_index;
    std::array<Index, 3> rest{};  // Where the sides of the face, behind what was cut off, are now.
    for (const auto& [h, share, vertex] : found) {
        if (h / 3 != face) {
            face = h / 3;
            rest = {3 * face, 3 * face + 1, 3 * face + 2};
        }
        // The face (a, b, c) becomes (a, vertex, c), and (vertex, b, c) is added.
        const Index side = rest[h % 3], next = Surface::next(side);
        const auto added = static_cast<Index>(triangles.size());
        triangles.push_back({vertex, soup.head(side), soup.apex(side)});
        soup.face_origin.push_back(Index{soup.face_origin[face]});
        triangles[next / 3][next % 3] = vertex;
        std::ranges::replace(rest, next, 3 * added + 1);
        rest[h % 3] = 3 * added;
    }
    soup.counts.divided_edges += static_cast<Index>(found.size());
    return !found.empty();
}

}  // namespace remesh::detail
