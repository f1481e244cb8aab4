#include "remesh/pipeline/sized_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/core/number_text.h"
#include "agvd/mesh/any_mesh.h"
#include "remesh/clean/carry.h"
#include "remesh/placement/shape_quality.h"

namespace remesh::detail {
namespace {

// However long an edge is, it is divided into no more parts.
constexpr double most_parts = 256;

Index parts_of(double length, double step) {
    return static_cast<Index>(std::clamp(std::ceil(length / step), 1.0, most_parts));
}

// Adds the points that divide the sides of a face into so many parts, and those between.
void add_face(Index face, Index parts, std::vector<SurfacePoint>& points) {
    for (Index i = 0; i <= parts; ++i) {
        for (Index j = 0; i + j <= parts; ++j) {
            const double a = static_cast<double>(i) / parts, b = static_cast<double>(j) / parts;
            points.push_back({FaceId(face), {a, b, std::max(1 - a - b, 0.0)}});
        }
    }
}

// Adds points of edges, in the first face of each.
void add_edges(const MeshView& mesh, const std::vector<std::array<Index, 2>>& edges, double step,
               std::vector<SurfacePoint>& points) {
    std::vector<std::array<Index, 2>> wanted = edges;
    for (auto& [from, to] : wanted) {
        if (from > to) std::swap(from, to);
    }
    wanted = distinct(std::move(wanted));
    std::vector<std::uint8_t> is_found(wanted.size(), 0);
    if (wanted.empty()) return;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle& t = mesh.triangles[f];
        for (std::size_t k = 0; k < 3; ++k) {
            const Index from = t[k], to = t[(k + 1) % 3];
            const std::array edge{std::min(from, to), std::max(from, to)};
            const auto at = std::ranges::lower_bound(wanted, edge);
            if (at == wanted.end() || *at != edge) continue;
            if (std::exchange(is_found[static_cast<Index>(at - wanted.begin())], 1) != 0) continue;
            const Index parts = parts_of((mesh.positions[to] - mesh.positions[from]).norm(), step);
            for (Index i = 0; i <= parts; ++i) {
                SurfacePoint point{FaceId(f), {0, 0, 0}};
                point.barycentric[k] = 1 - static_cast<double>(i) / parts;
                point.barycentric[(k + 1) % 3] = 1 - point.barycentric[k];
                points.push_back(point);
            }
        }
    }
    const auto missing = std::ranges::find(is_found, 0);
    if (missing == is_found.end()) return;
    const auto& [from, to] = wanted[static_cast<Index>(missing - is_found.begin())];
    throw InvalidInput("a place of given length: vertices " + index_text(from) + " and " +
                       index_text(to) + " are not joined by an edge; use edges of the mesh");
}

}  // namespace

std::vector<SizedPoint> points_of_places(const CleanedInput& cleaned,
                                         const std::vector<SizedPlace>& places) {
    const MeshView& mesh = cleaned.given;
    std::vector<SurfacePoint> points;
    std::vector<SizedPoint> result;
    for (const SizedPlace& place : places) {
        const double step = place.length / 2;
        points.insert(points.end(), place.points.begin(), place.points.end());
        add_edges(mesh, place.edges, step, points);
        for (const Index f : place.faces) {
            if (f >= mesh.triangles.size()) {
                throw InvalidInput("a place of given length: there is no face " + index_text(f) +
                                   "; use 0 to " + std::to_string(mesh.triangles.size() - 1));
            }
            add_face(f, parts_of(longest_edge_of(corners_of(mesh, f)), step), points);
        }
        result.resize(points.size(), {{}, place.length, place.radius});
    }
    if (points.empty()) return result;
    points = to_cleaned(points, mesh, {cleaned.surface.mesh.view(), cleaned.face_origin});
    for (std::size_t i = 0; i < points.size(); ++i) result[i].at = points[i];
    return result;
}

}  // namespace remesh::detail
