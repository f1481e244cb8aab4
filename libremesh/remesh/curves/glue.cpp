// Vertices of a group become one. Edges of patches that would coincide after that are flipped
// before, in rounds, as a flip can cause another repetition.
#include "remesh/curves/glue.h"

#include <algorithm>
#include <set>

#include "agvd/core/types.h"

namespace remesh {
namespace {

// Most rounds of flips.
constexpr int most_flip_rounds = 10;

using Ends = std::pair<Index, Index>;

struct HalfEdge {
    Ends ends;        // Glued vertices, ascending.
    Ends own;         // Vertices of the patch: tail, head.
    Index half_edge;  // 3 t + k
};

std::vector<HalfEdge> sorted_half_edges(std::span<const Triangle> triangles,
                                        std::span<const Index> vertex) {
    std::vector<HalfEdge> all;
    all.reserve(3 * triangles.size());
    for (Index i = 0; i < triangles.size(); ++i) {
        for (Index k = 0; k < 3; ++k) {
            const Index a = triangles[i][k], b = triangles[i][(k + 1) % 3];
            all.push_back({std::minmax({vertex[a], vertex[b]}), {a, b}, 3 * i + k});
        }
    }
    std::sort(all.begin(), all.end(), [](const HalfEdge& x, const HalfEdge& y) {
        return std::pair(x.ends, x.half_edge) < std::pair(y.ends, y.half_edge);
    });
    return all;
}

// Flips inner edges of patches that would occur twice in the glued mesh. Returns false if nothing
// was flipped.
bool flip_repeated(std::vector<Triangle>& triangles, std::span<const Index> vertex) {
    const std::vector<HalfEdge> all = sorted_half_edges(triangles, vertex);
    std::set<Ends> added;
    std::vector<bool> is_changed(triangles.size(), false);
    const auto exists = [&](const Ends& ends) {
        const auto found =
            std::lower_bound(all.begin(), all.end(), ends,
                             [](const HalfEdge& h, const Ends& value) { return h.ends < value; });
        return (found != all.end() && found->ends == ends) || added.contains(ends);
    };
    bool has_flipped = false;
    for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
        while (last < all.size() && all[last].ends == all[first].ends) ++last;
        if (last - first <= 2) continue;
        for (std::size_t i = first; i < last; ++i) {
            for (std::size_t j = i + 1; j < last; ++j) {
                const Ends& own = all[i].own;
                if (all[j].own != Ends(own.second, own.first)) continue;
                const Index t = all[i].half_edge / 3, u = all[j].half_edge / 3;
                const Index c = triangles[t][(all[i].half_edge % 3 + 2) % 3];
                const Index d = triangles[u][(all[j].half_edge % 3 + 2) % 3];
                const Ends ends = std::minmax({vertex[c], vertex[d]});
                if (is_changed[t] || is_changed[u] || vertex[c] == vertex[d] || exists(ends)) {
                    continue;
                }
                triangles[t] = {c, d, own.second};
                triangles[u] = {d, c, own.first};
                is_changed[t] = is_changed[u] = true;
                added.insert(ends);
                has_flipped = true;
                i = j = last;  // One flip for each edge and round.
            }
        }
    }
    return has_flipped;
}

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

}  // namespace

GluedMesh glue(std::span<const Triangle> triangles, std::span<const Index> group,
               std::span<const Index> vertex) {
    GluedMesh result;
    result.triangles.assign(triangles.begin(), triangles.end());
    const Numbering groups = number_sets(group);
    for (int round = 0; round < most_flip_rounds; ++round) {
        if (!flip_repeated(result.triangles, groups.number)) break;
    }
    Numbering vertices = vertex.empty() ? groups : number_sets(vertex);
    result.vertex = std::move(vertices.number);
    result.representative = std::move(vertices.first);
    for (const Index v : result.representative) {
        result.first_of_group.push_back(groups.first[groups.number[v]]);
    }
    for (Triangle& t : result.triangles) {
        for (Index& v : t) v = result.vertex[v];
    }
    return result;
}

}  // namespace remesh
