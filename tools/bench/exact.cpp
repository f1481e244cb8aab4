#include "bench/exact.h"

#include <limits>

#include "bench/workload.h"
#include "paper/oracle.h"

namespace bench {
namespace {

using namespace agvd;

// The vertices that have faces.
std::vector<Index> used_vertices(const Surface& surface) {
    std::vector<Index> vertices;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (surface.outgoing[v] != no_index) vertices.push_back(v);
    }
    return vertices;
}

std::vector<SurfacePoint> points_at(const Surface& surface, std::span<const Index> vertices) {
    std::vector<SurfacePoint> points;
    for (const Index v : vertices) points.push_back(point_at(surface, v));
    return points;
}

// #V: `found` at these vertices, infinity elsewhere.
std::vector<double> spread_out(const Surface& surface, std::span<const Index> vertices,
                               std::span<const double> found) {
    std::vector<double> distance(surface.num_vertices(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < vertices.size(); ++i) distance[vertices[i]] = found[i];
    return distance;
}

}  // namespace

bool has_exact() { return true; }

std::vector<double> exact_vertex_distances(const Surface& surface,
                                           std::span<const SurfacePoint> sites) {
    const std::vector<Index> vertices = used_vertices(surface);
    const auto targets = points_at(surface, vertices);
    return spread_out(surface, vertices, exact_nearest_sites(surface, sites, targets).distance);
}

std::vector<double> vertex_distances_by_one_search(const Surface& surface,
                                                   std::span<const SurfacePoint> sites) {
    const std::vector<Index> vertices = used_vertices(surface);
    const auto targets = points_at(surface, vertices);
    return spread_out(surface, vertices, distances_by_one_search(surface, sites, targets));
}

std::vector<LabelError> exact_label_errors(const Surface& surface,
                                           std::span<const SurfacePoint> sites,
                                           std::span<const SurfacePoint> points,
                                           std::span<const std::vector<SiteId>> labels) {
    return compare_labels(surface, sites, points, labels);
}

}  // namespace bench
