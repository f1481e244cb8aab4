#include "remesh/pipeline/thin_lengths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "agvd/mesh/surface.h"
#include "remesh/sites/target_lengths.h"

namespace remesh::detail {
namespace {

constexpr double vertices_around = 5;
constexpr double shortest_of_spacing = 0.125;
// Cells that wrap around a rod lie next to cells that fit: all within so many spacings are looked
// at.
constexpr double reach_of_place = 3;
// Patches that measure curvature have to be narrower than the rod.
constexpr double patches_per_site = 32;
constexpr double most_of_sites = 0.25;

}  // namespace

std::vector<double> thin_lengths(const IntrinsicTriangulation& base,
                                 std::span<const SurfacePoint> places,
                                 std::span<const std::pair<Index, Index>> joined, double spacing,
                                 double num_sites, Ticker& ticker) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Surface& surface = base.surface();
    std::vector<double> distance(surface.num_vertices(), infinity);
    for (const SurfacePoint& place : base.to_intrinsic(places)) {
        for (const Index v : surface.mesh.triangles[place.face.value()]) {
            distance[v] = std::numeric_limits<double>::min();
        }
    }
    limit_growth(surface, joined, 1, Paths::Edges, distance, ticker);
    const std::vector<double> curvature = patch_curvature(
        base, static_cast<Index>(std::clamp(patches_per_site * num_sites, 1.0, 1e9)), ticker);
    std::vector<double> length(surface.num_vertices(), infinity);
    for (Index v = 0; v < length.size(); ++v) {
        if (distance[v] > reach_of_place * spacing) continue;
        // Of a cylinder the root mean square of both curvatures is 1 / (sqrt(2) r).
        const double radius = 1 / (std::numbers::sqrt2 * curvature[v]);
        length[v] = 2 * std::numbers::pi * radius / vertices_around;
        if (length[v] >= spacing) length[v] = infinity;
        length[v] = std::max(length[v], shortest_of_spacing * spacing);
    }
    double num_thin = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        for (const Index v : surface.mesh.triangles[f]) {
            num_thin += face_area(surface, f) / 3 / (length[v] * length[v]);
        }
    }
    num_thin *= 2 / std::numbers::sqrt3;
    const double excess = num_thin / (most_of_sites * num_sites);
    if (excess > 1) {
        for (double& l : length) l *= std::sqrt(excess);
    }
    return length;
}

}  // namespace remesh::detail
