// Decides which faces belong together at non-manifold edges and vertices: the flattest pairs.
// Vertices are then copied until vertex indices alone give these pairs. Among equally flat pairs
// the one that bounds a convex wedge is taken, so that boxes that touch along an edge stay apart.
#include <algorithm>
#include <tuple>

#include "remesh/clean/soup.h"

namespace remesh::detail {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Vec3;

// All faces at an edge of more faces than this are cut apart: the number of pairs grows with the
// square.
constexpr std::size_t most_sheets = 64;

// Between equally flat pairs the one that bounds a convex wedge wins, so that two boxes that touch
// along an edge stay two boxes. Far above rounding, far below differences that flatness should
// decide.
constexpr double convex_bonus = 1e-3;

void join(std::vector<Index>& twin, Index a, Index b) {
    twin[a] = b;
    twin[b] = a;
}

// Cosine between the normals of two faces that traverse their common edge in opposite directions.
double flatness(const Soup& soup, Index a, Index b) {
    const Vec3& origin = soup.positions[soup.tail(a)];
    const Vec3 along = soup.positions[soup.head(a)] - origin;
    const Vec3 normal_a = along.cross(soup.positions[soup.apex(a)] - origin).normalized();
    const Vec3 up_b = soup.positions[soup.apex(b)] - origin;
    const Vec3 normal_b = up_b.cross(along).normalized();
    return normal_a.dot(normal_b) + (normal_a.dot(up_b) < 0 ? convex_bonus : 0);
}

void pair_flattest(const Soup& soup, std::span<const EdgeSide> edge, std::vector<Index>& twin) {
    if (edge.size() > most_sheets) return;
    struct Pair {
        double flatness;
        Index a, b;
    };
    std::vector<Pair> pairs;
    for (const EdgeSide& up : edge) {
        if (!soup.runs_up(up.half_edge)) continue;
        for (const EdgeSide& down : edge) {
            if (soup.runs_up(down.half_edge)) continue;
            const Index a = up.half_edge, b = down.half_edge;
            pairs.push_back({flatness(soup, a, b), a, b});
        }
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
        return std::tie(q.flatness, p.a, p.b) < std::tie(p.flatness, q.a, q.b);
    });
    for (const Pair& pair : pairs) {
        if (twin[pair.a] == no_index && twin[pair.b] == no_index) join(twin, pair.a, pair.b);
    }
}

// Gives each fan of faces its own vertex; the first fan keeps the old one.
void separate_fans(Soup& soup, const std::vector<Index>& twin) {
    std::vector<bool> is_taken(soup.positions.size(), false);
    std::vector<bool> is_done(soup.num_half_edges(), false);
    for (Index start = 0; start < soup.num_half_edges(); ++start) {
        soup.ticker.tick();
        if (is_done[start]) continue;
        Index vertex = soup.tail(start);
        if (is_taken[vertex]) {
            soup.positions.push_back(Vec3(soup.positions[vertex]));
            soup.vertex_origin.push_back(soup.vertex_origin[vertex]);
            vertex = static_cast<Index>(soup.positions.size() - 1);
            ++soup.counts.split_vertices;
        } else {
            is_taken[vertex] = true;
        }
        const auto take = [&](Index h) {
            is_done[h] = true;
            soup.triangles[h / 3][h % 3] = vertex;
        };
        Index h = start;
        do {
            take(h);
            h = twin[agvd::Surface::previous(h)];
        } while (h != no_index && h != start);
        if (h == start) continue;
        for (h = twin[start]; h != no_index; h = twin[h]) {  // An open fan: the other way too.
            h = agvd::Surface::next(h);
            take(h);
        }
    }
}

// Whether vertex indices alone give the twins at `edge`.
bool is_told_by_indices(const Soup& soup, std::span<const EdgeSide> edge) {
    if (edge.size() == 1) return true;
    return edge.size() == 2 && soup.runs_up(edge[0].half_edge) != soup.runs_up(edge[1].half_edge);
}

}  // namespace

std::vector<Index> pair_sheets(Soup& soup, std::span<const EdgeSide> sides) {
    std::vector<Index> twin(soup.num_half_edges(), no_index);
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        soup.ticker.tick(edge.size());
        if (edge.size() == 2) join(twin, edge[0].half_edge, edge[1].half_edge);
        if (edge.size() <= 2) return;
        ++soup.counts.split_edges;
        pair_flattest(soup, edge, twin);
    });
    return twin;
}

// A sheet may meet itself along an edge while its faces are connected around both ends. Then it
// keeps one vertex at each end, and the edge stays double. The first round cuts such edges open, so
// that indices may pair their faces the other way. Later rounds cut all edges of faces that are
// still in conflict: these share no edge any more.
void split_vertices(Soup& soup, std::vector<Index>& twin) {
    separate_fans(soup, twin);
    const CleanCounts& counts = soup.counts;  // Without these no edge is double.
    if (counts.split_edges + counts.absorbed_faces + counts.degenerate_faces == 0) return;
    for (bool is_first_round = true;; is_first_round = false) {
        bool is_clear = true;
        for_each_edge(
            sorted_edge_sides(soup.triangles, soup.ticker), [&](std::span<const EdgeSide> edge) {
                soup.ticker.tick();
                if (is_told_by_indices(soup, edge)) return;
                is_clear = false;
                for (const EdgeSide& side : edge) {
                    const Index first = 3 * (side.half_edge / 3);
                    for (Index h = first; h < first + 3; ++h) {
                        if ((is_first_round && h != side.half_edge) || twin[h] == no_index)
                            continue;
                        twin[twin[h]] = no_index;
                        twin[h] = no_index;
                    }
                }
            });
        if (is_clear) return;
        separate_fans(soup, twin);
    }
}

}  // namespace remesh::detail
