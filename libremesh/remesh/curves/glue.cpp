// Vertices of a group become one. Edges of patches that would coincide after that are flipped
// before, in rounds, as a flip can cause another repetition.
#include "remesh/curves/glue.h"

#include <algorithm>
#include <set>

#include "agvd/core/groups.h"
#include "agvd/core/types.h"

namespace remesh {
namespace {

// Most rounds of flips.
constexpr int most_flip_rounds = 10;

// Sets, numbered in order of their first elements.
struct Numbering {
    std::vector<Index> number;  // Of each element: its set.
    std::vector<Index> first;   // Of each set: its first element.
};

Numbering number_sets(std::span<const Index> sets) {
    Numbering result;
    std::vector<Index> number(sets.empty() ? 0 : *std::max_element(sets.begin(), sets.end()) + 1,
                              no_index);
    for (Index v = 0; v < sets.size(); ++v) {
        Index& of_set = number[sets[v]];
        if (of_set == no_index) {
            of_set = static_cast<Index>(result.first.size());
            result.first.push_back(v);
        }
        result.number.push_back(of_set);
    }
    return result;
}

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

// Whether an edge joins a vertex with itself.
bool is_loop(const EdgeSide& side) { return side.low() == side.high(); }

// A round: one flip for each repeated edge.
// \param[out] has_repeated  whether there were any before.
// \return whether there was a flip.
bool flip_round(std::vector<Triangle>& triangles, std::span<const Index> vertex,
                const std::function<bool(std::span<const EdgeSide>)>& is_repeated,
                const std::function<bool(std::uint64_t)>& is_taken, bool& has_repeated) {
    const std::vector<EdgeSide> all = sorted_edge_sides(rename_vertices(triangles, vertex));
    std::set<std::uint64_t> added;
    std::vector<bool> is_changed(triangles.size(), false);
    const auto exists = [&](std::uint64_t ends) {
        return std::ranges::binary_search(all, ends, {}, &EdgeSide::ends) || added.contains(ends) ||
               is_taken(ends);
    };
    // Tries the flip of the edge between two sides; they may belong to different patches.
    const auto try_flip = [&](Index h, Index g) {
        const Index t = h / 3, u = g / 3;
        const Index a = triangles[t][h % 3], b = triangles[t][(h + 1) % 3];
        if (triangles[u][g % 3] != b || triangles[u][(g + 1) % 3] != a) return false;
        const Index c = triangles[t][(h + 2) % 3], d = triangles[u][(g + 2) % 3];
        const std::uint64_t ends = edge_key(vertex[c], vertex[d]);
        if (is_changed[t] || is_changed[u] || vertex[c] == vertex[d] || exists(ends)) return false;
        triangles[t] = {c, d, b};
        triangles[u] = {d, c, a};
        is_changed[t] = is_changed[u] = true;
        added.insert(ends);
        return true;
    };
    bool has_flipped = has_repeated = false;
    for_each_edge(all, [&](std::span<const EdgeSide> edge) {
        if (!is_repeated(edge)) return;
        has_repeated = true;
        for (std::size_t i = 0; i < edge.size(); ++i) {
            for (std::size_t j = i + 1; j < edge.size(); ++j) {
                if (!try_flip(edge[i].half_edge, edge[j].half_edge)) continue;
                has_flipped = true;
                return;  // One flip for each edge and round.
            }
        }
    });
    return has_flipped;
}

}  // namespace

bool flip_repeated(std::vector<Triangle>& triangles, std::span<const Index> vertex,
                   const std::function<bool(std::span<const EdgeSide>)>& is_repeated,
                   const std::function<bool(std::uint64_t)>& is_taken) {
    bool has_repeated = true;
    for (int round = 0; round < most_flip_rounds && has_repeated; ++round) {
        if (!flip_round(triangles, vertex, is_repeated, is_taken, has_repeated)) break;
    }
    return !has_repeated;
}

bool flip_repeated(std::vector<Triangle>& triangles, std::span<const Index> group) {
    const auto is_repeated = [](std::span<const EdgeSide> sides) {
        return sides.size() > 2 || is_loop(sides.front());
    };
    return flip_repeated(triangles, group, is_repeated, [](std::uint64_t) { return false; });
}

GluedMesh glue(std::span<const Triangle> triangles, std::span<const Index> group) {
    Numbering glued = number_sets(group);
    return {rename_vertices(triangles, glued.number), std::move(glued.number),
            std::move(glued.first)};
}

std::vector<Index> first_of_groups(std::span<const Index> group) {
    Numbering groups = number_sets(group);
    for (Index& number : groups.number) number = groups.first[number];
    return std::move(groups.number);
}

std::vector<InnerEdge> repeated_edges(std::span<const Triangle> patches,
                                      std::span<const Index> group) {
    std::vector<InnerEdge> repeated;
    const std::vector<Triangle> glued = rename_vertices(patches, group);
    for_each_edge(sorted_edge_sides(glued), [&](std::span<const EdgeSide> sides) {
        const bool joins_one = is_loop(sides.front());
        if (sides.size() <= 2 && !joins_one) return;
        std::vector<InnerEdge> inner;
        for (std::size_t i = 0; i < sides.size(); ++i) {
            for (std::size_t j = i + 1; j < sides.size(); ++j) {
                const Index h = sides[i].half_edge, g = sides[j].half_edge;
                if (patches[h / 3][h % 3] == patches[g / 3][(g + 1) % 3] &&
                    patches[h / 3][(h + 1) % 3] == patches[g / 3][g % 3]) {
                    inner.push_back({h, g});
                }
            }
        }
        const bool has_rim = joins_one || sides.size() > 2 * inner.size();
        repeated.insert(repeated.end(), inner.begin() + (has_rim || inner.empty() ? 0 : 1),
                        inner.end());
    });
    return repeated;
}

std::vector<DirectedEdge> rim_of(std::span<const Triangle> triangles) {
    std::size_t num_vertices = 0;
    for (const Triangle& t : triangles) {
        num_vertices = std::max(num_vertices, std::size_t{std::max({t[0], t[1], t[2]})} + 1);
    }
    const Groups tails(num_vertices, [&](const auto& add) {
        for (const Triangle& t : triangles) {
            for (std::size_t k = 0; k < 3; ++k) add(t[(k + 1) % 3], t[k]);
        }
    });
    // The heads come in ascending order, so each group is sorted.
    const Groups heads(num_vertices, [&](const auto& add) {
        for (Index head = 0; head < num_vertices; ++head) {
            for (const Index tail : tails.of(head)) add(tail, head);
        }
    });
    std::vector<DirectedEdge> rim;
    for (Index from = 0; from < num_vertices; ++from) {
        for (const Index to : heads.of(from)) {
            if (!std::ranges::binary_search(heads.of(to), from)) rim.emplace_back(from, to);
        }
    }
    return rim;
}

void close_rim(std::span<const DirectedEdge> chain, std::vector<Triangle>& triangles) {
    const std::vector<DirectedEdge> rim = rim_of(triangles);
    std::vector<DirectedEdge> wanted(chain.begin(), chain.end());
    std::sort(wanted.begin(), wanted.end());
    std::vector<Index> used;
    for (const Triangle& t : triangles) used.insert(used.end(), t.begin(), t.end());
    std::sort(used.begin(), used.end());
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

Index num_branched_edges(std::span<const Triangle> triangles) {
    Index count = 0;
    for_each_edge(sorted_edge_sides(triangles), [&](std::span<const EdgeSide> edge) {
        if (edge.size() > 2) ++count;
    });
    return count;
}

}  // namespace remesh
