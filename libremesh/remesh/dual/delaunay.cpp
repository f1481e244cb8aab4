#include "remesh/dual/delaunay.h"

#include "remesh/dual/delaunay_flips.h"
#include "remesh/dual/edge_paths.h"

namespace remesh {

namespace {

Index count_inner(const FlippableMesh& mesh) {
    Index count = 0;
    for (Index e = 0; e < mesh.num_edges(); ++e) count += mesh.is_inner(e) ? 1 : 0;
    return count;
}

void flip(FlippableMesh& mesh, std::vector<double>& length, std::span<const Vec3> positions,
          const Diagonals& diagonals, Ticker ticker, DelaunayCounts& counts) {
    counts.inner_edges = count_inner(mesh);
    const FlipCounts flips = flip_to_delaunay(mesh, length, positions, diagonals, ticker);
    counts.failing_before = flips.failing_before;
    counts.failing_after = flips.failing_after;
    counts.flips = flips.flips;
    counts.is_finished = flips.is_finished;
}

std::vector<double> flip_in_space(FlippableMesh& mesh, std::span<const Vec3> positions,
                                  Ticker ticker, DelaunayCounts& counts) {
    std::vector<double> length(mesh.num_edges());
    for (Index e = 0; e < mesh.num_edges(); ++e) {
        const Index h = mesh.sides(e)[0];
        length[e] = (positions[mesh.tail(h)] - positions[mesh.tail(FlippableMesh::next(h))]).norm();
    }
    const auto measure = [&](Index edge) {
        const auto [h, g] = mesh.sides(edge);
        return (positions[mesh.tail(FlippableMesh::previous(h))] -
                positions[mesh.tail(FlippableMesh::previous(g))])
            .norm();
    };
    flip(mesh, length, positions, {measure, [](Index) {}}, ticker, counts);
    return length;
}

std::vector<double> flip_on_surface(const Surface& surface, const DualVertices& vertices,
                                    int num_threads, Poller& poller, FlippableMesh& mesh,
                                    DelaunayCounts& counts) {
    const Ticker ticker(poller);
    std::vector<SurfacePoint> points;
    points.reserve(vertices.points.size());
    for (const SurfacePoint& point : vertices.points) points.push_back(snapped(surface, point));
    std::vector<EdgePath> paths =
        find_edge_paths(surface, {points, vertices.site, vertices.diagram, vertices.positions},
                        mesh, num_threads, poller);
    mend_triangles(surface, mesh, ticker, paths);
    std::vector<double> length(paths.size());
    for (Index e = 0; e < paths.size(); ++e) length[e] = paths[e].length;

    PathStraightener straightener(surface, ticker);
    EdgePath diagonal;
    const auto measure = [&](Index edge) {
        diagonal = path_across(surface, mesh, paths, edge, straightener);
        return diagonal.length;
    };
    const auto accept = [&](Index edge) { paths[edge] = std::move(diagonal); };
    flip(mesh, length, vertices.positions, {measure, accept}, ticker, counts);
    for (const EdgePath& path : paths) counts.not_locally_shortest += !path.is_locally_shortest;
    return length;
}

}  // namespace

const char* delaunay_name(Delaunay delaunay) {
    switch (delaunay) {
        case Delaunay::Intrinsic:
            return "intrinsic";
        case Delaunay::Extrinsic:
            return "extrinsic";
        case Delaunay::Off:
            return "off";
    }
    return "unknown";
}

DelaunayResult make_delaunay(const Surface& surface, std::span<const SurfacePoint> points,
                             std::span<const Vec3> positions, std::span<const Index> site,
                             const Diagram& diagram, std::span<const Triangle> triangles,
                             const DelaunayOptions& options) {
    DelaunayResult result;
    if (options.mode == Delaunay::Off) {
        result.triangles.assign(triangles.begin(), triangles.end());
        return result;
    }
    Poller poller(options.progress);
    FlippableMesh mesh(triangles, Ticker(poller));
    const std::vector<double> length =
        options.mode == Delaunay::Extrinsic
            ? flip_in_space(mesh, positions, Ticker(poller), result.counts)
            : flip_on_surface(surface, {points, site, diagram, positions}, options.num_threads,
                              poller, mesh, result.counts);
    result.triangles = mesh.triangles();
    result.side_lengths.reserve(result.triangles.size());
    for (Index t = 0; t < result.triangles.size(); ++t) {
        const auto& side = result.side_lengths.emplace_back(std::array{
            length[mesh.edge(3 * t)], length[mesh.edge(3 * t + 1)], length[mesh.edge(3 * t + 2)]});
        if (!is_triangle(side[0], side[1], side[2])) ++result.counts.broken_triangles;
    }
    return result;
}

}  // namespace remesh
