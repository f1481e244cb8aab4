// First, edges with a Voronoi edge get a path through its point nearest to the sites, a gate. Then
// other edges get theirs from two edges of a triangle, in rounds, or by a search. Each path is a
// strip of faces that is straightened at once.
#include "remesh/dual/edge_paths.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "agvd/core/parallel.h"
#include "agvd/core/types.h"
#include "remesh/dual/site_paths.h"

namespace remesh {

namespace {

// Few tasks, as a search in a task needs memory for each vertex of the surface: with 128 paths a
// task 100 000 vertices took 10 to 20 s, with these 1 to 2 s.
constexpr Index most_tasks = 64, fewest_paths_per_task = 128;
// Relative to the longest side, as lengths are sums of a few square roots.
constexpr double length_tolerance = 1e-12;
// Paths along two edges that cross more edges are searched instead, or not made to mend a triangle:
// joined paths may double from round to round. Those of an armadillo with spikes grew to 27 000
// crossings and took 41 s, with this 2 s.
constexpr std::size_t longest_joined = 4000;
// Most passes over the triangles while sides become shorter.
constexpr int max_passes = 100;

Index paths_per_task(Index num_paths) {
    return std::max(fewest_paths_per_task, num_paths / most_tasks);
}

// The point where two cells meet nearest to their sites.
struct Gate {
    std::uint64_t ends;  // Vertices of the two cells.
    double distance;
    Index point;

    [[nodiscard]] bool operator<(const Gate& other) const {
        return std::tie(ends, distance, point) < std::tie(other.ends, other.distance, other.point);
    }
};

// Sorted by vertices; of two vertices the first gate is the nearest.
std::vector<Gate> find_gates(const DualVertices& vertices) {
    const Diagram& diagram = vertices.diagram;
    std::vector<Index> vertex(diagram.num_sites, no_index);  // By site.
    for (Index v = 0; v < vertices.site.size(); ++v) {
        if (vertices.site[v] != no_index) vertex[vertices.site[v]] = v;
    }
    std::vector<Gate> gates;
    gates.reserve(diagram.edges.size());
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const VoronoiEdge& edge = diagram.edges[e];
        if (!edge.right.is_valid()) continue;
        const Index a = vertex[edge.left.value()], b = vertex[edge.right.value()];
        if (a == no_index || b == no_index) continue;
        const auto begin = diagram.point_distance.begin() + diagram.edge_points[e];
        const auto end = diagram.point_distance.begin() + diagram.edge_points[e + 1];
        const auto nearest = std::min_element(begin, end);
        gates.push_back({edge_key(a, b), *nearest,
                         static_cast<Index>(nearest - diagram.point_distance.begin())});
    }
    std::sort(gates.begin(), gates.end());
    return gates;
}

// The half-edge of an edge in a triangle whose other two edges have paths; no_index if there is
// none.
Index find_way_round(const FlippableMesh& mesh, const std::vector<EdgePath>& paths, Index edge) {
    for (const Index h : mesh.sides(edge)) {
        if (h == no_index) continue;
        if (paths[mesh.edge(FlippableMesh::next(h))].from == no_index) continue;
        if (paths[mesh.edge(FlippableMesh::previous(h))].from == no_index) continue;
        return h;
    }
    return no_index;
}

// How many edges the paths of the other two edges in the half-edge's triangle cross.
std::size_t num_crossed_round(const FlippableMesh& mesh, const std::vector<EdgePath>& paths,
                              Index half_edge) {
    return paths[mesh.edge(FlippableMesh::next(half_edge))].strip.crossed.size() +
           paths[mesh.edge(FlippableMesh::previous(half_edge))].strip.crossed.size();
}

FaceStrip strip_from(const Surface& surface, const EdgePath& path, Index vertex) {
    return path.from == vertex ? path.strip : reversed(surface, path.strip);
}

// The path straightened from a strip that starts at vertex `from`.
EdgePath path_in(FaceStrip strip, Index from, PathStraightener& straightener) {
    const GeodesicPath path = straightener.straighten(strip);
    return {from, std::move(strip), path.length, path.is_locally_shortest};
}

// The path straightened from those of two edges, from one vertex over another.
EdgePath path_along(const Surface& surface, const EdgePath& first, const EdgePath& second,
                    Index from, Index over, PathStraightener& straightener) {
    FaceStrip strip =
        joined(surface, strip_from(surface, first, from), strip_from(surface, second, over));
    return path_in(std::move(strip), from, straightener);
}

// The path straightened from those of the other two edges in the half-edge's triangle.
EdgePath path_round(const Surface& surface, const FlippableMesh& mesh,
                    const std::vector<EdgePath>& paths, Index half_edge,
                    PathStraightener& straightener) {
    const Index next = FlippableMesh::next(half_edge);
    const Index previous = FlippableMesh::previous(half_edge);
    return path_along(surface, paths[mesh.edge(next)], paths[mesh.edge(previous)], mesh.tail(next),
                      mesh.tail(previous), straightener);
}

// The ends of an edge, the lower one first.
std::array<Index, 2> ends_of(const FlippableMesh& mesh, Index edge) {
    const Index h = mesh.sides(edge)[0];
    return {mesh.tail(h), mesh.tail(FlippableMesh::next(h))};
}

// Finds the paths of edges with a Voronoi edge.
void find_paths_through_gates(const Surface& surface, const DualVertices& vertices,
                              const FlippableMesh& mesh, int num_threads, Poller& poller,
                              std::vector<EdgePath>& paths) {
    const std::vector<Gate> gates = find_gates(vertices);
    const auto find = [&](Index, Index begin, Index end) {
        PathStraightener straightener(surface, Ticker(poller));
        SitePaths site_paths(surface, vertices, Ticker(poller));
        auto gate = gates.begin();
        for (Index e = begin; e < end; ++e) {
            const auto [a, b] = ends_of(mesh, e);
            // Both are sorted by their ends.
            if (e == begin) gate = std::lower_bound(gate, gates.end(), Gate{edge_key(a, b), -1, 0});
            while (gate != gates.end() && gate->ends < edge_key(a, b)) ++gate;
            if (gate == gates.end() || gate->ends != edge_key(a, b)) continue;
            const Index face = vertices.diagram.points[gate->point].face.value();
            paths[e] = path_in(site_paths.through(a, face, b), a, straightener);
        }
    };
    parallel_chunks(mesh.num_edges(), paths_per_task(mesh.num_edges()), num_threads, find, poller);
}

// Finds the other paths in rounds, each from the paths of earlier rounds along two edges of a
// triangle. A search finds those that would be long, and when a round finds none, all that are
// left.
void find_missing_paths(const Surface& surface, const DualVertices& vertices,
                        const FlippableMesh& mesh, int num_threads, Poller& poller,
                        std::vector<EdgePath>& paths) {
    std::vector<Index> missing;
    for (Index e = 0; e < paths.size(); ++e) {
        if (paths[e].from == no_index) missing.push_back(e);
    }
    for (bool is_stuck = false; !missing.empty();) {
        const auto num_missing = static_cast<Index>(missing.size());
        std::vector<EdgePath> found(num_missing);
        const auto find = [&](Index, Index begin, Index end) {
            PathStraightener straightener(surface, Ticker(poller));
            SitePaths site_paths(surface, vertices, Ticker(poller));
            for (Index i = begin; i < end; ++i) {
                const Index h = find_way_round(mesh, paths, missing[i]);
                if (h != no_index && num_crossed_round(mesh, paths, h) <= longest_joined) {
                    found[i] = path_round(surface, mesh, paths, h, straightener);
                } else if (h != no_index || is_stuck) {
                    const auto [a, b] = ends_of(mesh, missing[i]);
                    found[i] = path_in(site_paths.between(a, b), a, straightener);
                }
            }
        };
        parallel_chunks(num_missing, paths_per_task(num_missing), num_threads, find, poller);
        std::vector<Index> still_missing;
        for (Index i = 0; i < num_missing; ++i) {
            if (found[i].from == no_index) {
                still_missing.push_back(missing[i]);
            } else {
                paths[missing[i]] = std::move(found[i]);
            }
        }
        is_stuck = still_missing.size() == missing.size();
        missing = std::move(still_missing);
    }
}

}  // namespace

std::vector<EdgePath> find_edge_paths(const Surface& surface, const DualVertices& vertices,
                                      const FlippableMesh& mesh, int num_threads, Poller& poller) {
    std::vector<EdgePath> paths(mesh.num_edges());
    find_paths_through_gates(surface, vertices, mesh, num_threads, poller, paths);
    find_missing_paths(surface, vertices, mesh, num_threads, poller, paths);
    return paths;
}

EdgePath path_across(const Surface& surface, const FlippableMesh& mesh,
                     const std::vector<EdgePath>& paths, Index edge,
                     PathStraightener& straightener) {
    const auto [h, g] = mesh.sides(edge);
    const Index c = mesh.tail(FlippableMesh::previous(h));
    const auto path = [&](Index half_edge) -> const EdgePath& {
        return paths[mesh.edge(half_edge)];
    };
    const EdgePath& ca = path(FlippableMesh::previous(h));
    const EdgePath& ad = path(FlippableMesh::next(g));
    const EdgePath& cb = path(FlippableMesh::next(h));
    const EdgePath& bd = path(FlippableMesh::previous(g));
    if (ca.length + ad.length <= cb.length + bd.length) {
        return path_along(surface, ca, ad, c, mesh.tail(h), straightener);
    }
    return path_along(surface, cb, bd, c, mesh.tail(g), straightener);
}

bool is_triangle(double a, double b, double c) {
    const double longest = std::max({a, b, c});
    return longest <= (a + b + c - longest) + length_tolerance * longest;
}

void mend_triangles(const Surface& surface, const FlippableMesh& mesh, Ticker ticker,
                    std::vector<EdgePath>& paths) {
    PathStraightener straightener(surface, ticker);
    const auto length = [&](Index half_edge) { return paths[mesh.edge(half_edge)].length; };
    const auto is_sound = [&](Index t) {
        return is_triangle(length(3 * t), length(3 * t + 1), length(3 * t + 2));
    };
    bool is_changed = true;
    for (int pass = 0; is_changed && pass < max_passes; ++pass) {
        is_changed = false;
        for (Index t = 0; t < mesh.triangles().size(); ++t) {
            ticker.tick();
            if (is_sound(t)) continue;
            Index longest = 3 * t;
            for (const Index h : {3 * t + 1, 3 * t + 2}) {
                if (length(h) > length(longest)) longest = h;
            }
            if (num_crossed_round(mesh, paths, longest) > longest_joined) continue;
            EdgePath shorter = path_round(surface, mesh, paths, longest, straightener);
            if (!(shorter.length < length(longest))) continue;
            paths[mesh.edge(longest)] = std::move(shorter);
            is_changed = true;
        }
    }
}

}  // namespace remesh
