// From a point below the surface the nearest point is the vertex itself, unless another sheet is
// nearer: the far side of a wall, if it faces the other way. Walls with one side in the result are
// not seen.
#include "remesh/quality/evaluate.h"

#include <algorithm>
#include <cmath>

#include "agvd/core/parallel.h"
#include "agvd/core/union_find.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/scale.h"
#include "remesh/curves/curve_network.h"

namespace remesh {
namespace {

// Cosine of the normals on both sides of a wall: at most this.
constexpr double most_wall_cosine = -0.7;
// The far side counts if it is nearer than the vertex by this share of the depth.
constexpr double clearly_nearer = 0.9;
// Depths at which a wall is looked for, each an eighth of the one before: a far side much nearer
// than the depth is as far from the point as the vertex.
constexpr int num_depths = 4;
// Vertices in a chunk of queries.
constexpr Index query_grain = 512;

// The number of samples in a text: two digits.
Index rounded_up(double count) {
    constexpr double most = 4e9;
    if (!(count < most)) return static_cast<Index>(most);  // Infinite where sides touch.
    double unit = 1;
    while (100 * unit <= count) unit *= 10;
    return static_cast<Index>(std::min(std::ceil(count / unit) * unit, most));
}

struct VertexShape {
    Vec3 normal = Vec3::Zero();  // Unit, weighted by area.
    double edge_length = 0;      // Mean of its edges.
};

std::vector<VertexShape> vertex_shapes(const MeshView& mesh) {
    std::vector<VertexShape> shapes(mesh.positions.size());
    std::vector<Index> num_edges(mesh.positions.size(), 0);
    for (const Triangle& triangle : mesh.triangles) {
        const Vec3 area = doubled_normal(mesh.positions, triangle);
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = triangle[k];
            const Vec3& next = mesh.positions[triangle[(k + 1) % 3]];
            shapes[v].normal += area;
            shapes[v].edge_length += (next - mesh.positions[v]).norm();
            ++num_edges[v];
        }
    }
    for (Index v = 0; v < shapes.size(); ++v) {
        shapes[v].normal.normalize();
        if (num_edges[v] > 0) shapes[v].edge_length /= num_edges[v];
    }
    return shapes;
}

double mean_edge_length(const MeshView& mesh) {
    double sum = 0;
    for (const Triangle& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            sum += (mesh.positions[triangle[(k + 1) % 3]] - mesh.positions[triangle[k]]).norm();
        }
    }
    return sum / (3 * static_cast<double>(mesh.triangles.size()));
}

// The wall at a vertex.
struct Wall {
    double thickness = infinity;  // Infinity: there is no wall.
    Index far_face = 0;           // On its other side.
    [[nodiscard]] bool exists() const { return std::isfinite(thickness); }
};

// Finds walls of .1 to 1.9 times the depth.
Wall wall_at_depth(const MeshView& mesh, const ClosestPointTree& tree, Index vertex,
                   const Vec3& outward, double depth) {
    const Vec3& position = mesh.positions[vertex];
    const ClosestPoint nearest = tree.query(position - depth * outward);
    if (!(std::sqrt(nearest.distance_sq) < clearly_nearer * depth)) return {};
    const Index face = nearest.point.face.value();
    const Triangle& triangle = mesh.triangles[face];
    if (std::find(triangle.begin(), triangle.end(), vertex) != triangle.end()) return {};
    if (doubled_normal(mesh.positions, triangle).normalized().dot(outward) > most_wall_cosine)
        return {};
    return {(position - nearest.position).norm(), face};
}

// Walls thinner than the edges there are long.
std::vector<Wall> find_walls(const MeshView& mesh, const ClosestPointTree& tree,
                             const std::vector<VertexShape>& shapes, int num_threads,
                             Poller& poller) {
    std::vector<Wall> walls(shapes.size());
    const auto find = [&](Index v) {
        double depth = shapes[v].edge_length / 2;
        for (int i = 0; i < num_depths && !walls[v].exists(); ++i, depth /= 8) {
            walls[v] = wall_at_depth(mesh, tree, v, shapes[v].normal, depth);
        }
    };
    parallel_each(static_cast<Index>(shapes.size()), query_grain, num_threads, find, poller);
    return walls;
}

// Vertices are on one wall if an edge joins them, or if one lies behind the other.
void judge_walls(const MeshView& mesh, const std::vector<VertexShape>& shapes,
                 const std::vector<Wall>& walls, Verdict& verdict) {
    UnionFind joined(shapes.size());
    const auto join = [&](Index a, Index b) {
        if (walls[a].exists() && walls[b].exists()) joined.unite(a, b);
    };
    for (const Triangle& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) join(triangle[k], triangle[(k + 1) % 3]);
    }
    for (Index v = 0; v < walls.size(); ++v) {
        if (!walls[v].exists()) continue;
        for (const Index behind : mesh.triangles[walls[v].far_face]) join(v, behind);
    }
    double most_times = 1;  // As many vertices.
    verdict.thinnest_wall = infinity;
    for (Index v = 0; v < shapes.size(); ++v) {
        if (!walls[v].exists()) continue;
        if (joined.is_root(v)) ++verdict.thin_walls;
        verdict.thinnest_wall = std::min(verdict.thinnest_wall, walls[v].thickness);
        const double times = shapes[v].edge_length / walls[v].thickness;
        most_times = std::max(most_times, times * times);
    }
    if (verdict.thin_walls == 0) {
        verdict.thinnest_wall = 0;
        return;
    }
    verdict.samples_for_walls = rounded_up(most_times * static_cast<double>(shapes.size()));
}

// By half-edge: see NarrowFaces.
std::vector<std::uint8_t> find_sharp(const MeshView& mesh, Ticker ticker) {
    constexpr double most_angle = 40 * degree;
    std::vector<std::uint8_t> is_sharp(3 * mesh.triangles.size(), 1);
    const std::vector<EdgeSide> sides = sorted_edge_sides(mesh.triangles, ticker);
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        if (edge.size() != 2) return;
        const auto normal = [&](const EdgeSide& side) {
            return doubled_normal(mesh.positions, mesh.triangles[side.face()]);
        };
        if (angle_between(normal(edge[0]), normal(edge[1])) > most_angle) return;
        for (const EdgeSide& side : edge) is_sharp[side.half_edge] = 0;
    });
    return is_sharp;
}

void judge_narrow_faces(const MeshView& mesh, const std::vector<Wall>& walls, Poller& poller,
                        NarrowFaces& narrow) {
    constexpr double most_angle = 30 * degree;
    const std::vector<std::uint8_t> is_sharp = find_sharp(mesh, Ticker(poller));
    std::vector<std::uint8_t> is_on_crease(mesh.positions.size(), 0);
    for (Index h = 0; h < is_sharp.size(); ++h) {
        if (is_sharp[h] == 0) continue;
        for (const Index end : {h, next_half_edge(h)}) {
            is_on_crease[mesh.triangles[end / 3][end % 3]] = 1;
        }
    }
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle& t = mesh.triangles[f];
        bool is_narrow = false, is_acute = false;
        for (Index k = 0; k < 3; ++k) {
            const Vec3& corner = mesh.positions[t[k]];
            const Index before = (k + 2) % 3;
            if (angle_between(mesh.positions[t[(k + 1) % 3]] - corner,
                              mesh.positions[t[before]] - corner) >= most_angle) {
                continue;
            }
            is_narrow = true;
            is_acute = is_acute || (is_sharp[3 * f + k] != 0 && is_sharp[3 * f + before] != 0);
        }
        if (!is_narrow) continue;
        ++narrow.count;
        if (is_acute) {
            ++narrow.at_acute_corners;
        } else if (std::any_of(t.begin(), t.end(), [&](Index v) { return walls[v].exists(); })) {
            ++narrow.at_thin_walls;
        } else if (std::all_of(t.begin(), t.end(), [&](Index v) { return is_on_crease[v] != 0; })) {
            ++narrow.between_creases;
        }
    }
}

void judge_components(const MeshView& mesh, const Topology& topology, Verdict& verdict) {
    std::vector<Index> num_vertices(topology.components.size(), 0);
    std::vector<std::uint8_t> is_counted(mesh.positions.size(), 0);
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        for (const Index v : mesh.triangles[f]) {
            if (is_counted[v] != 0) continue;
            is_counted[v] = 1;
            ++num_vertices[topology.face_component[f]];
        }
    }
    double most_times = 1;
    for (const Index count : num_vertices) {
        if (count >= least_component_vertices) continue;
        ++verdict.small_components;
        most_times = std::max(most_times, static_cast<double>(least_component_vertices) / count);
    }
    if (verdict.small_components == 0) return;
    verdict.samples_for_components =
        rounded_up(most_times * static_cast<double>(mesh.positions.size()));
}

void judge_distance(const MeshView& input, const ClosestPointTree& tree, int num_threads,
                    Poller& poller, Verdict& verdict) {
    const auto num_vertices = static_cast<Index>(input.positions.size());
    const Index count = std::min(num_vertices, most_compared_vertices);
    const auto chosen = [&](Index i) {
        return static_cast<Index>(std::uint64_t{num_vertices} * i / count);
    };
    struct Farthest {
        double distance_sq = -1;
        Index vertex = 0;
    };
    std::vector<Farthest> of_chunk(num_chunks(count, query_grain));
    parallel_chunks(
        count, query_grain, num_threads,
        [&](Index chunk, Index begin, Index end) {
            Farthest& farthest = of_chunk[chunk];
            for (Index i = begin; i < end; ++i) {
                const Vec3& point = input.positions[chosen(i)];
                // Nearly all are nearer than the farthest so far, which is quick to see.
                if (farthest.distance_sq > 0 &&
                    tree.is_within(point, std::sqrt(farthest.distance_sq))) {
                    continue;
                }
                const double distance_sq = tree.query(point).distance_sq;
                if (distance_sq > farthest.distance_sq) farthest = {distance_sq, chosen(i)};
            }
        },
        poller);
    const auto farthest = std::max_element(
        of_chunk.begin(), of_chunk.end(),
        [](const Farthest& a, const Farthest& b) { return a.distance_sq < b.distance_sq; });
    verdict.largest_distance = std::sqrt(farthest->distance_sq);
    verdict.farthest = input.positions[farthest->vertex];
}

}  // namespace

Verdict judge_result(const MeshView& input, const MeshView& result, const Topology& topology,
                     int num_threads, const Progress& progress) {
    Poller poller(progress);
    Verdict verdict;
    verdict.spacing = mean_edge_length(result);
    const MeshBox box = box_of(input, num_threads);
    verdict.diagonal = (box.high - box.low).norm();
    const TriangleQuality triangles = measure_triangles(result, poller.progress());
    verdict.min_angle = triangles.min_angle;
    verdict.small_angle_share = triangles.small_angle_share;
    verdict.faces_without_area = triangles.faces_without_area;
    judge_components(result, topology, verdict);
    verdict.bodies = count_bodies(result, topology, Ticker(poller));
    const ClosestPointTree tree(result, poller.progress());
    const std::vector<VertexShape> shapes = vertex_shapes(result);
    const std::vector<Wall> walls = find_walls(result, tree, shapes, num_threads, poller);
    judge_walls(result, shapes, walls, verdict);
    if (verdict.small_angle_share > 0) judge_narrow_faces(result, walls, poller, verdict.narrow);
    judge_distance(input, tree, num_threads, poller, verdict);
    return verdict;
}

}  // namespace remesh
