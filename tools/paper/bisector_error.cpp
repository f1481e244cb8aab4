#include "paper/bisector_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// Exactly half way; none if the points name faces without a common edge.
std::optional<SurfacePoint> middle(const Surface& surface, const SurfacePoint& a,
                                   const SurfacePoint& b) {
    const Index face = common_faces(surface, a, b).first;
    if (face == no_index) return std::nullopt;
    auto p = seen_from(surface, a, face);
    const auto q = seen_from(surface, b, face);
    for (std::size_t k = 0; k < 3; ++k) {
        p->barycentric[k] = (p->barycentric[k] + q->barycentric[k]) / 2;
    }
    return p;
}

}  // namespace

std::vector<BisectorSample> bisector_samples(const Surface& surface, const Diagram& diagram) {
    std::vector<BisectorSample> samples;
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const VoronoiEdge& edge = diagram.edges[e];
        if (!edge.left.is_valid() || !edge.right.is_valid()) continue;
        const Index begin = diagram.edge_points[e];
        const Index end = diagram.edge_points[e + 1];
        for (Index i = begin; i < end; ++i) {
            const double distance = diagram.point_distance[i];
            samples.push_back({diagram.points[i], edge.left, edge.right, distance});
            const bool is_last = i + 1 == end;
            if (is_last && edge.tail != no_index) break;
            const Index next = is_last ? begin : i + 1;
            if (const auto between = middle(surface, diagram.points[i], diagram.points[next])) {
                samples.push_back({*between, edge.left, edge.right,
                                   std::max(distance, diagram.point_distance[next])});
            }
        }
    }
    return samples;
}

BisectorError summarize(std::vector<double> errors) {
    BisectorError result{.num_points = static_cast<Index>(errors.size())};
    if (errors.empty()) return result;
    std::sort(errors.begin(), errors.end());
    double sum = 0;
    for (const double error : errors) sum += error;
    result.mean = sum / static_cast<double>(errors.size());
    result.p95 = errors[(errors.size() - 1) * 95 / 100];
    result.max = errors.back();
    return result;
}

double mean_cell_radius(const Surface& surface, std::size_t num_sites) {
    return std::sqrt(surface_area(surface) / (std::numbers::pi * static_cast<double>(num_sites)));
}

}  // namespace agvd
