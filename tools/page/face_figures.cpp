#include "page/face_figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "agvd/mesh/any_mesh.h"

namespace page {
namespace {

using agvd::Index;

constexpr double page_degrees = 180 / std::numbers::pi;  // Per radian.

void count(double value, Histogram& histogram) {
    const double bin = std::max((value - histogram.low) / histogram.width, 0.0);
    const std::size_t last = histogram.counts.size() - 1;
    ++histogram.counts[bin < static_cast<double>(last) ? static_cast<std::size_t>(bin) : last];
}

Histogram bins(double low, double width, std::size_t number) {
    return {low, width, std::vector<std::uint64_t>(number, 0)};
}

}  // namespace

Json to_json(const Histogram& histogram) {
    return {{"low", histogram.low}, {"width", histogram.width}, {"counts", histogram.counts}};
}

Histogram histogram_of(std::span<const double> values, double low, double width,
                       std::size_t num_bins) {
    Histogram histogram = bins(low, width, num_bins);
    for (const double value : values) count(value, histogram);
    return histogram;
}

Histograms histograms_of(const agvd::MeshView& mesh, std::span<const double> targets) {
    Histograms result{bins(0, 5, 36), bins(0, 0.025, 40), bins(0, 0.05, 50), bins(0, 1, 13)};
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const remesh::FaceShape shape = remesh::measure_face(agvd::corners_of(mesh, f));
        count(shape.quality, result.quality);
        for (const double angle : shape.angle) count(angle * page_degrees, result.angle);
    }
    struct Edge {
        Index low, high;
        double length;
    };
    std::vector<Edge> edges;
    agvd::for_each_edge(agvd::sorted_edge_sides(mesh.triangles), [&](const auto& sides) {
        const Index low = sides[0].low(), high = sides[0].high();
        edges.push_back({low, high, (mesh.positions[high] - mesh.positions[low]).norm()});
    });
    double mean = 0;
    std::vector<Index> valence(mesh.positions.size(), 0);
    for (const Edge& edge : edges) {
        mean += edge.length / static_cast<double>(edges.size());
        ++valence[edge.low];
        ++valence[edge.high];
    }
    for (const Edge& edge : edges) {
        const double target = targets.empty() ? mean : (targets[edge.low] + targets[edge.high]) / 2;
        if (target > 0) count(edge.length / target, result.edge);
    }
    for (const Index edges_there : valence) {
        if (edges_there > 0) count(edges_there, result.valence);
    }
    return result;
}

std::vector<Index> worst_faces(const agvd::MeshView& mesh, std::size_t count) {
    std::vector<double> quality;
    quality.reserve(mesh.triangles.size());
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const double q = remesh::measure_face(agvd::corners_of(mesh, f)).quality;
        quality.push_back(std::isfinite(q) ? q : 0);  // Not where areas overflow.
    }
    std::vector<Index> faces(quality.size());
    std::iota(faces.begin(), faces.end(), Index{0});
    const auto end = faces.begin() + static_cast<std::ptrdiff_t>(std::min(count, faces.size()));
    std::partial_sort(faces.begin(), end, faces.end(), [&](Index f, Index g) {
        return quality[f] != quality[g] ? quality[f] < quality[g] : f < g;
    });
    faces.erase(end, faces.end());
    return faces;
}

}  // namespace page
