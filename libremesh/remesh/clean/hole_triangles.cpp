#include "remesh/clean/soup.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include <iterator>

namespace remesh::detail {
namespace {

using HoleKernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Larger holes are not searched in cubic time: a thousand edges would take a minute.
constexpr std::size_t most_for_cubic_time = 200;

std::vector<HoleKernel::Point_3> to_cgal(std::span<const Vec3> positions) {
    std::vector<HoleKernel::Point_3> points;
    for (const Vec3& p : positions) points.emplace_back(p.x(), p.y(), p.z());
    return points;
}

}  // namespace

std::optional<std::vector<Triangle>> triangulate_hole(std::span<const Vec3> rim,
                                                      std::span<const Vec3> beyond) {
    std::vector<CGAL::Triple<int, int, int>> found;
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
        to_cgal(rim), to_cgal(beyond), std::back_inserter(found),
        CGAL::parameters::do_not_use_cubic_algorithm(rim.size() > most_for_cubic_time));
    std::vector<Triangle> triangles;
    triangles.reserve(found.size());
    for (const auto& t : found) {
        triangles.push_back({static_cast<Index>(t.first), static_cast<Index>(t.second),
                             static_cast<Index>(t.third)});
    }
    return triangles;
}

}  // namespace remesh::detail
