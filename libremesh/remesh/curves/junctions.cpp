// Edges with the same origins at both ends were one before cleaning. A union-find joins their ends;
// all other copies met in a point only.
#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "agvd/core/union_find.h"
#include "agvd/mesh/cut_surface.h"
#include "agvd/mesh/surface.h"
#include "remesh/curves/curve_network.h"

namespace remesh {
namespace {

// #V: whether another vertex has the same origin.
std::vector<bool> find_copied(std::span<const Index> origin) {
    std::vector<Index> count(
        origin.empty() ? 0 : std::size_t{*std::max_element(origin.begin(), origin.end())} + 1, 0);
    for (const Index v : origin) ++count[v];
    std::vector<bool> is_copied(origin.size());
    for (std::size_t v = 0; v < origin.size(); ++v) is_copied[v] = count[origin[v]] > 1;
    return is_copied;
}

struct NamedEdge {
    Index low, high;  // Origins of its ends.
    Index edge;
};

std::vector<NamedEdge> edges_at_copies(const Surface& surface, std::span<const Index> origin) {
    const std::vector<bool> is_copied = find_copied(origin);
    std::vector<NamedEdge> edges;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index a = surface.tail(surface.edge_half[e]), b = surface.head(surface.edge_half[e]);
        if (!is_copied[a] && !is_copied[b]) continue;
        const auto [low, high] = std::minmax({origin[a], origin[b]});
        edges.push_back({low, high, e});
    }
    std::sort(edges.begin(), edges.end(), [](const NamedEdge& x, const NamedEdge& y) {
        return std::tie(x.low, x.high, x.edge) < std::tie(y.low, y.high, y.edge);
    });
    return edges;
}

// Whether the edges have the same faces beside them: inside the wall of two bodies that touch.
bool are_inside_wall(const Surface& surface, std::span<const Index> origin,
                     const std::vector<Index>& edges) {
    const auto apexes = [&](Index e) {
        const Index h = surface.edge_half[e], twin = surface.twin[h];
        const auto apex = [&](Index side) { return origin[surface.tail(Surface::previous(side))]; };
        std::array<Index, 2> result{apex(h), twin == no_index ? no_index : apex(twin)};
        if (result[0] > result[1]) std::swap(result[0], result[1]);
        return result;
    };
    return std::all_of(edges.begin() + 1, edges.end(),
                       [&](Index e) { return apexes(e) == apexes(edges.front()); });
}

// The sets of vertices that are one end of the same junction edges.
std::vector<std::vector<Index>> join_ends(const Surface& surface, std::span<const Index> origin,
                                          const std::vector<std::vector<Index>>& edges) {
    UnionFind joined(surface.num_vertices());
    for (const std::vector<Index>& group : edges) {
        const auto ends = [&](Index e) {
            const Index h = surface.edge_half[e];
            std::array<Index, 2> result{surface.tail(h), surface.head(h)};
            if (origin[result[0]] > origin[result[1]]) std::swap(result[0], result[1]);
            return result;
        };
        for (const Index e : group) {
            for (const std::size_t k : {0u, 1u}) {
                joined.unite(ends(group[0])[k], ends(e)[k]);
            }
        }
    }
    std::vector<std::vector<Index>> sets(surface.num_vertices());
    for (Index v = 0; v < sets.size(); ++v) sets[joined.root(v)].push_back(v);
    std::erase_if(sets, [](const std::vector<Index>& set) { return set.size() < 2; });
    return sets;
}

}  // namespace

JunctionSet find_junctions(const Surface& surface, std::span<const Index> vertex_origin) {
    if (vertex_origin.empty()) return {};
    const std::vector<NamedEdge> named = edges_at_copies(surface, vertex_origin);
    JunctionSet junctions;
    for (std::size_t i = 0, end = 0; i < named.size(); i = end) {
        std::vector<Index> group;
        for (; end < named.size() && named[end].low == named[i].low &&
               named[end].high == named[i].high;
             ++end) {
            group.push_back(named[end].edge);
        }
        if (group.size() > 1 && !are_inside_wall(surface, vertex_origin, group)) {
            junctions.edges.push_back(std::move(group));
        }
    }
    if (!junctions.empty()) {
        std::sort(junctions.edges.begin(), junctions.edges.end());
        junctions.vertices = join_ends(surface, vertex_origin, junctions.edges);
    }
    return junctions;
}

void drop_short_junctions(const Surface& surface, double least_length, JunctionSet& junctions) {
    const std::vector<Index> first = first_copies(junctions, surface.num_vertices());
    const auto ends = [&](const std::vector<Index>& copies) {
        const Index h = surface.edge_half[copies.front()];
        return std::array{first[surface.tail(h)], first[surface.head(h)]};
    };
    UnionFind joined(surface.num_vertices());
    for (const std::vector<Index>& copies : junctions.edges) {
        joined.unite(ends(copies)[0], ends(copies)[1]);
    }
    std::vector<double> length(surface.num_vertices(), 0);  // Of a connected junction, at its root.
    for (const std::vector<Index>& copies : junctions.edges) {
        length[joined.root(ends(copies)[0])] += surface.length[copies.front()];
    }
    const auto is_short = [&](Index vertex) {
        return length[joined.root(first[vertex])] < least_length;
    };
    std::erase_if(junctions.edges,
                  [&](const std::vector<Index>& copies) { return is_short(ends(copies)[0]); });
    std::erase_if(junctions.vertices,
                  [&](const std::vector<Index>& copies) { return is_short(copies.front()); });
}

std::vector<std::uint8_t> edges_to_cut(const JunctionSet& junctions,
                                       std::vector<std::uint8_t> is_crease) {
    for (const std::vector<Index>& copies : junctions.edges) {
        for (const Index e : copies) is_crease[e] = 1;
    }
    return is_crease;
}

std::vector<Index> first_copies(const JunctionSet& junctions, Index num_vertices) {
    std::vector<Index> first(num_vertices);
    std::iota(first.begin(), first.end(), Index{0});
    for (const std::vector<Index>& copies : junctions.vertices) {
        for (const Index v : copies) first[v] = copies.front();
    }
    return first;
}

CutSurface cut_surface(const Surface& surface, std::span<const std::uint8_t> is_cut,
                       int num_threads, const Progress& progress) {
    std::vector<Index> original(surface.num_vertices());
    std::iota(original.begin(), original.end(), Index{0});
    bool is_whole = true;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (is_cut[e] != 0 && surface.twin[surface.edge_half[e]] != no_index) is_whole = false;
    }
    if (is_whole) return {&surface, {}, std::move(original), surface.num_vertices()};
    agvd::OpenedSurface opened = agvd::cut_along(surface, is_cut, num_threads, progress);
    return {&surface, std::move(opened.surface), std::move(opened.original),
            surface.num_vertices()};
}

}  // namespace remesh
