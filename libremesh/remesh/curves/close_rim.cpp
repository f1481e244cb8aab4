#include "remesh/curves/close_rim.h"

#include <algorithm>

namespace remesh {
namespace {

// Most edges between two sites that are to be joined.
constexpr std::size_t most_edges_between = 8;

// The site after another one on the rim; no_index unless there is exactly one.
Index next_on(const std::vector<DirectedEdge>& rim, Index site) {
    const auto found = std::lower_bound(rim.begin(), rim.end(), DirectedEdge(site, 0));
    if (found == rim.end() || found->first != site) return no_index;
    const auto other = found + 1;
    return other != rim.end() && other->first == site ? no_index : found->second;
}

bool has(const std::vector<DirectedEdge>& edges, const DirectedEdge& edge) {
    return std::binary_search(edges.begin(), edges.end(), edge);
}

// The sites from one along edges to the first that is an end; empty if it is too far or there is
// none.
template <typename IsEnd>
std::vector<Index> way_on(const std::vector<DirectedEdge>& edges, Index from, const IsEnd& is_end) {
    std::vector<Index> way{from};
    do {
        way.push_back(next_on(edges, way.back()));
        if (way.back() == no_index || way.size() > most_edges_between + 1) return {};
    } while (!is_end(way.back()));
    return way;
}

// The corners of all triangles, ascending.
std::vector<Index> corners_of(std::span<const Triangle> triangles) {
    std::vector<Index> corners;
    for (const Triangle& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
    std::sort(corners.begin(), corners.end());
    return corners;
}

}  // namespace

std::vector<DirectedEdge> rim_of(std::span<const Triangle> triangles) {
    std::vector<DirectedEdge> edges, rim;
    edges.reserve(3 * triangles.size());
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
    }
    std::sort(edges.begin(), edges.end());
    for (const auto& [from, to] : edges) {
        const DirectedEdge back(to, from);
        if (!std::binary_search(edges.begin(), edges.end(), back)) rim.emplace_back(from, to);
    }
    return rim;
}

void close_rim(std::span<const DirectedEdge> chain, std::vector<Triangle>& triangles) {
    const std::vector<DirectedEdge> rim = rim_of(triangles);
    std::vector<DirectedEdge> wanted(chain.begin(), chain.end());
    std::sort(wanted.begin(), wanted.end());
    const std::vector<Index> used = corners_of(triangles);
    for (const DirectedEdge& edge : wanted) {
        if (has(rim, edge)) continue;
        const Index from = edge.first, to = edge.second;
        const std::vector<Index> way = way_on(rim, from, [&](Index site) { return site == to; });
        for (std::size_t i = way.size(); i-- > 2;) {
            triangles.push_back({from, way[i], way[i - 1]});
        }
        if (!way.empty() || std::binary_search(used.begin(), used.end(), to)) continue;
        const std::vector<Index> past = way_on(wanted, from, [&](Index site) {
            return has(rim, {from, site});
        });
        for (std::size_t i = 2; i < past.size(); ++i) {
            triangles.push_back({from, past[i - 1], past[i]});
        }
    }
}

}  // namespace remesh
