// One pass over the faces for shapes and angles, one over the edges for the Delaunay condition and
// lengths, one for valences.
#include "remesh/quality/evaluate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agvd/core/portable_math.h"
#include "agvd/mesh/any_mesh.h"
#include "remesh/placement/placement.h"

namespace remesh {
namespace {

// Radians. Right angles on both sides of a diagonal are Delaunay; read from float files they are
// off by 1e-7.
constexpr double angle_sum_tolerance = 1e-6;
constexpr double small_angle = std::numbers::pi / 6;

// Fills the figures of the faces and returns the angle opposite each half-edge.
std::vector<double> measure_faces(const MeshView& mesh, Ticker& ticker, TriangleQuality& result) {
    std::vector<double> opposite(3 * mesh.triangles.size());
    result.min_quality = 1;
    result.min_angle = std::numbers::pi;
    Index small = 0;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick(4);
        const FaceShape shape = measure_face(corners_of(mesh, f));
        const auto [lowest, highest] = std::minmax_element(shape.angle.begin(), shape.angle.end());
        result.mean_quality += shape.quality;
        result.min_quality = std::min(result.min_quality, shape.quality);
        result.mean_min_angle += *lowest;
        result.min_angle = std::min(result.min_angle, *lowest);
        result.max_angle = std::max(result.max_angle, *highest);
        small += *lowest < small_angle ? 1 : 0;
        result.faces_without_area += is_flat(mesh.positions, mesh.triangles[f]) ? 1 : 0;
        for (std::size_t k = 0; k < 3; ++k) opposite[3 * f + k] = shape.angle[(k + 2) % 3];
    }
    const auto faces = static_cast<double>(mesh.triangles.size());
    result.mean_quality /= faces;
    result.mean_min_angle /= faces;
    result.small_angle_share = small / faces;
    return opposite;
}

void measure_edges(const MeshView& mesh, const std::vector<EdgeSide>& sides,
                   const std::vector<double>& opposite, Ticker& ticker, TriangleQuality& result) {
    std::vector<double> lengths;
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        ticker.tick();
        lengths.push_back((mesh.positions[edge[0].high()] - mesh.positions[edge[0].low()]).norm());
        if (edge.size() != 2) return;
        const double sum = opposite[edge[0].half_edge] + opposite[edge[1].half_edge];
        if (sum > std::numbers::pi + angle_sum_tolerance) ++result.non_delaunay_edges;
    });
    result.edges = static_cast<Index>(lengths.size());
    double mean = 0, variance = 0;
    for (const double length : lengths) mean += length / result.edges;
    for (const double length : lengths)
        variance += (length - mean) * (length - mean) / result.edges;
    if (mean > 0) result.edge_length_variation = std::sqrt(variance) / mean;
}

void measure_valences(const MeshView& mesh, const std::vector<EdgeSide>& sides, Ticker& ticker,
                      TriangleQuality& result) {
    std::vector<Index> valence(mesh.positions.size(), 0);
    std::vector<bool> on_boundary(mesh.positions.size(), false);
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        ticker.tick();
        for (const Index v : {edge[0].low(), edge[0].high()}) {
            ++valence[v];
            if (edge.size() == 1) on_boundary[v] = true;
        }
    });
    Index used = 0, regular = 0;
    for (std::size_t v = 0; v < valence.size(); ++v) {
        used += valence[v] > 0 ? 1 : 0;
        regular += valence[v] == (on_boundary[v] ? 4u : 6u) ? 1 : 0;
    }
    result.regular_share = static_cast<double>(regular) / used;
}

}  // namespace

FaceShape measure_face(const std::array<Vec3, 3>& corners) {
    const std::array<Vec3, 3>& p = corners;
    const std::array<Vec3, 3> side = {p[1] - p[0], p[2] - p[1], p[0] - p[2]};
    const double doubled_area = side[0].cross(side[1]).norm();
    FaceShape shape;
    double perimeter = 0, longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        // Exact enough for the thinnest needle.
        shape.angle[k] = portable::atan2(doubled_area, -side[k].dot(side[(k + 2) % 3]));
        perimeter += side[k].norm();
        longest = std::max(longest, side[k].norm());
    }
    if (doubled_area > 0) {
        shape.quality = 6 / std::numbers::sqrt3 * doubled_area / (perimeter * longest);
    }
    return shape;
}

TriangleQuality measure_triangles(const MeshView& mesh, const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    TriangleQuality result;
    if (mesh.triangles.empty()) return result;
    const std::vector<double> opposite = measure_faces(mesh, ticker, result);
    const std::vector<EdgeSide> sides = sorted_edge_sides(mesh.triangles, ticker);
    measure_edges(mesh, sides, opposite, ticker, result);
    measure_valences(mesh, sides, ticker, result);
    return result;
}

}  // namespace remesh
