#include "remesh/sites/narrow_lengths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "agvd/mesh/surface.h"
#include "remesh/sites/target_lengths.h"

namespace remesh::detail {
namespace {

// The length is that of so many edges around, but not less than this share of the edges' there.
constexpr double vertices_around = 5, shortest_of_edge = 0.125;
// Cells that wrap around a rod lie next to cells that fit: all within so many spacings are looked
// at.
constexpr double reach_of_point = 3;
// Patches that measure curvature have to be narrower than the rod.
constexpr double patches_per_site = 32;
constexpr double most_of_sites = 0.25;
// While that is too much, lengths grow by this factor.
constexpr double longer = 1.2;

// Whether lengths below that of the others, with the growth from there, take more than a share of
// the sites from where edges stay as they are.
bool takes_too_much(const Surface& surface, std::span<const std::pair<Index, Index>> joined,
                    std::span<const double> length, std::span<const double> edge, double slope,
                    Ticker& ticker) {
    std::vector<double> grown;
    for (Index v = 0; v < length.size(); ++v) grown.push_back(std::min(length[v], edge[v]));
    limit_growth(surface, joined, slope, Paths::Edges, grown, ticker);
    double more = 0, rest = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        for (const Index v : surface.mesh.triangles[f]) {
            const double part = face_area(surface, f) / 3;
            more += part / (grown[v] * grown[v]) - part / (edge[v] * edge[v]);
            if (grown[v] == edge[v]) rest += part / (edge[v] * edge[v]);
        }
    }
    return more > most_of_sites * rest;
}

}  // namespace

std::vector<double> narrow_lengths(const IntrinsicTriangulation& base,
                                   std::span<const SurfacePoint> points,
                                   std::span<const std::pair<Index, Index>> joined,
                                   std::span<const double> edge, double num_sites, double slope,
                                   Ticker& ticker) {
    const Surface& surface = base.surface();
    std::vector<double> distance(surface.num_vertices(), infinity);
    for (const SurfacePoint& point : base.to_intrinsic(points)) {
        for (const Index v : surface.mesh.triangles[point.face.value()]) {
            distance[v] = std::numeric_limits<double>::min();
        }
    }
    limit_growth(surface, joined, 1, Paths::Edges, distance, ticker);
    const std::vector<double> curvature =
        patch_curvature(base, patches_per_site * num_sites, ticker);
    // The length of an edge, by the spacing: a spacing squared is the area of a vertex.
    const double edge_of_spacing = std::sqrt(2 / std::numbers::sqrt3);
    std::vector<double> length(surface.num_vertices(), infinity);
    for (Index v = 0; v < length.size(); ++v) {
        if (distance[v] * edge_of_spacing > reach_of_point * edge[v]) continue;
        // Of a cylinder the root mean square of both curvatures is 1 / (sqrt(2) r).
        const double radius = 1 / (std::numbers::sqrt2 * curvature[v]);
        length[v] = 2 * std::numbers::pi * radius / vertices_around;
        if (length[v] >= edge[v]) length[v] = infinity;
        length[v] = std::max(length[v], shortest_of_edge * edge[v]);
    }
    while (takes_too_much(surface, joined, length, edge, slope, ticker)) {
        for (Index v = 0; v < length.size(); ++v) {
            length[v] = length[v] * longer < edge[v] ? length[v] * longer : infinity;
        }
    }
    return length;
}

}  // namespace remesh::detail
