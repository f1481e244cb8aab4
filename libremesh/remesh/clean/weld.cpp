// Merges vertices at one position: along cracks, and at the ends of zero-length edges.
#include <algorithm>
#include <cmath>

#include "agvd/core/types.h"
#include "agvd/core/union_find.h"
#include "agvd/mesh/point_grid.h"
#include "agvd/mesh/scale.h"
#include "remesh/clean/soup.h"

namespace remesh::detail {
namespace {

constexpr double share_of_size = 1e-6;
constexpr double share_of_edge = 1e-2;
// With a tolerance: below half, so that the ends of an edge are never at one position with a third
// vertex.
constexpr double share_with_tolerance = 0.49;
// Vertices with a smaller share of the median's reach have to be equal: a cell could hold any
// number of them.
constexpr double least_reach = 1.0 / 8;
// Of a grid's cell, in reaches: with 8 a vertex looks at two cells in the mean.
constexpr double cell_size = 8;

// By first vertex: a share of the shortest edge at its position, zero-length ones apart.
std::vector<double> find_reaches(const MeshView& mesh, std::span<const Index> first, double share,
                                 Ticker& ticker) {
    std::vector<double> reach(first.size(), infinity);
    for (const Triangle& t : mesh.triangles) {
        ticker.tick();
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = first[t[k]], b = first[t[(k + 1) % 3]];
            if (a == no_index && b == no_index) continue;
            const double length = (mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]]).norm();
            if (length == 0) continue;
            for (const Index end : {a, b}) {
                if (end != no_index) reach[end] = std::min(reach[end], share * length);
            }
        }
    }
    return reach;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Replaces the vertices of each set by one, and counts those that go.
// \param num_merged  how many unions there were.
bool apply(UnionFind& sets, Index num_merged, Soup& soup) {
    if (num_merged == 0) return false;
    for (Triangle& t : soup.mesh.triangles) {
        soup.ticker.tick();
        for (Index& v : t) v = sets.root(v);
    }
    soup.counts.welded_vertices += num_merged;
    return true;
}

// Vertices of a set that have other positions than its root get that of the root.
void keep_welded_positions(UnionFind& sets, Soup& soup) {
    for (Index v = 0; v < soup.mesh.positions.size(); ++v) {
        const Index root = sets.root(v);
        if (soup.mesh.positions[root] == soup.mesh.positions[v]) continue;
        if (soup.welded_positions.empty()) soup.welded_positions = soup.mesh.positions;
        soup.welded_positions[v] = soup.mesh.positions[root];
    }
}

// The vertex of a boundary edge at one of its two positions.
Index end_at(const Soup& soup, std::span<const Index> position, const EdgeSide& side, Index where) {
    const Index tail = soup.tail(side.half_edge);
    return position[tail] == where ? tail : soup.head(side.half_edge);
}

// The vertices of each part of the mesh: faces that are joined by vertices.
UnionFind find_parts(Soup& soup) {
    UnionFind parts(soup.mesh.positions.size());
    for (const Triangle& t : soup.mesh.triangles) {
        soup.ticker.tick();
        (void)parts.unite(t[0], t[1]);
        (void)parts.unite(t[0], t[2]);
    }
    return parts;
}

// See CleanResult::slit_length. Cracks between parts are no slits, nor are seams of a part that
// closes by welding, as of a sphere from pole to pole.
// \param open  boundary edges, sorted by the positions of their ends.
double longest_slit(Soup& soup, std::span<const EdgeSide> open, std::span<const Index> position) {
    UnionFind parts = find_parts(soup), chains(soup.mesh.positions.size());
    std::vector<bool> is_tip(soup.mesh.positions.size(), false), stays_open = is_tip;
    std::vector<double> length(soup.mesh.positions.size(),
                               0);  // By position, of edges from it upwards.
    std::vector<Index> part(soup.mesh.positions.size(), 0);  // By position.
    for_each_edge(open, [&](std::span<const EdgeSide> edge) {
        soup.ticker.tick();
        const Index low = edge[0].low(), high = edge[0].high();
        const auto first = soup.tail(edge[0].half_edge);
        if (edge.size() == 1) stays_open[parts.root(first)] = true;
        if (edge.size() < 2 || low == high ||
            parts.root(first) != parts.root(soup.tail(edge[1].half_edge))) {
            return;
        }
        (void)chains.unite(low, high);
        part[low] = parts.root(first);
        length[low] += (soup.mesh.positions[high] - soup.mesh.positions[low]).norm();
        for (const Index where : {low, high}) {
            if (end_at(soup, position, edge[0], where) == end_at(soup, position, edge[1], where)) {
                is_tip[where] = true;
            }
        }
    });
    std::vector<double> of_chain(soup.mesh.positions.size(), 0);
    for (Index v = 0; v < length.size(); ++v) {
        if (stays_open[part[v]]) of_chain[chains.root(v)] += length[v];
    }
    double longest = 0;
    for (Index v = 0; v < length.size(); ++v) {
        if (is_tip[v]) longest = std::max(longest, of_chain[chains.root(v)]);
    }
    return longest;
}

}  // namespace

// The first of each set of equal positions goes into a grid, and is compared with those there.
CommonPositions find_common_positions(const MeshView& mesh, const std::vector<bool>& is_wanted,
                                      Ticker& ticker, double tolerance) {
    CommonPositions common;
    common.share = tolerance > 0 ? share_with_tolerance : share_of_edge;
    std::vector<Index>& first = common.first = first_at_position(mesh.positions, ticker, is_wanted);
    const std::vector<double>& reach = common.reach =
        find_reaches(mesh, first, common.share, ticker);
    const MeshBox box = box_of(mesh);
    common.limit = std::max(tolerance, share_of_size * box.longest_side());
    std::vector<double> finite;
    for (const double r : reach) {
        if (r < infinity) finite.push_back(r);
    }
    if (finite.empty()) return common;
    const double most = std::min(median(std::move(finite)), common.limit);
    if (!(most > 0)) return common;

    UnionFind sets(first.size());
    PointGrid grid(box.low, cell_size * most, first.size());
    for (Index v = 0; v < first.size(); ++v) {
        ticker.tick();
        if (first[v] != v || reach[v] < least_reach * most) continue;
        const Vec3& p = mesh.positions[v];
        grid.visit_near(p, most, [&](Index other) {
            const double radius = std::min({reach[v], reach[other], most});
            if ((mesh.positions[other] - p).norm() <= radius) (void)sets.unite(v, other);
        });
        grid.add(p, v);
    }
    for (Index& v : first) {
        if (v != no_index) v = sets.root(v);
    }
    return common;
}

// Only edges are welded, and only boundary edges: parts that touch at a point, and closed parts
// that touch anywhere, are manifold as they are.
bool weld_cracks(Soup& soup, std::span<const EdgeSide> sides, double tolerance) {
    std::vector<EdgeSide> open;
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        soup.ticker.tick();
        if (edge.size() == 1) open.push_back(edge[0]);
    });
    if (open.empty()) return false;

    std::vector<bool> is_boundary(soup.mesh.positions.size(), false);
    for (const EdgeSide& side : open) is_boundary[side.low()] = is_boundary[side.high()] = true;
    const std::vector<Index> position =
        find_common_positions(soup.mesh.view(), is_boundary, soup.ticker, tolerance).first;
    for (EdgeSide& side : open) {
        side.ends = edge_key(position[side.low()], position[side.high()]);
    }
    open = sort_edge_sides(open, static_cast<Index>(soup.mesh.positions.size()), soup.ticker);

    UnionFind sets(soup.mesh.positions.size());
    Index num_merged = 0;
    for_each_edge(open, [&](std::span<const EdgeSide> edge) {
        soup.ticker.tick(edge.size());
        if (edge[0].low() == edge[0].high()) return;
        for (const EdgeSide& side : edge.subspan(1)) {
            for (const Index where : {side.low(), side.high()}) {
                const Index kept = end_at(soup, position, edge[0], where);
                num_merged += sets.unite(kept, end_at(soup, position, side, where)) ? 1 : 0;
            }
        }
    });
    if (num_merged > 0) soup.slit_length = longest_slit(soup, open, position);
    keep_welded_positions(sets, soup);
    return apply(sets, num_merged, soup);
}

bool collapse_zero_edges(Soup& soup, double zero_length) {
    UnionFind sets(soup.mesh.positions.size());
    Index num_merged = 0;
    for (Index h = 0; h < soup.num_half_edges(); ++h) {
        soup.ticker.tick();
        const Index a = soup.tail(h), b = soup.head(h);
        if (a == b) continue;
        if ((soup.mesh.positions[a] - soup.mesh.positions[b]).norm() > zero_length) continue;
        num_merged += sets.unite(a, b) ? 1 : 0;
    }
    keep_welded_positions(sets, soup);
    return apply(sets, num_merged, soup);
}

}  // namespace remesh::detail
