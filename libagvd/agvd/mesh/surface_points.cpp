
#include "agvd/mesh/surface_points.h"

#include <algorithm>
#include <string>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/core/random.h"

namespace agvd {
namespace {

constexpr double at_vertex = 1e-12;      // A share of the edge length.
constexpr double edge_rounding = 1e-12;  // A share of the height of the face.
constexpr double on_edge_slope = 1e-3;   // A share of the position along the edge.

// Barycentric coordinates that come from files or float sums; checked against 1.
constexpr double barycentric_tolerance = 1e-6;

void check_site(const Surface& surface, const SurfacePoint& site, std::size_t index) {
    const auto refuse = [&](const std::string& why) {
        throw InvalidSites("site " + std::to_string(index) + why);
    };
    if (site.face.value() >= surface.num_faces()) {
        refuse(" names a face that does not exist; use one of the " +
               std::to_string(surface.num_faces()) + " faces, counted from 0");
    }
    double sum = 0;
    for (const double b : site.barycentric) {
        if (!(b >= 0)) {
            refuse(" has barycentric coordinates of which one is negative; correct them");
        }
        sum += b;
    }
    if (!(std::abs(sum - 1) <= barycentric_tolerance)) {
        refuse(" has barycentric coordinates that do not sum to 1; correct them");
    }
}

}  // namespace

std::optional<Index> vertex_of(const Surface& surface, const SurfacePoint& point) {
    const std::optional<Index> corner = corner_of(surface, point);
    return corner ? std::optional(surface.tail(*corner)) : std::nullopt;
}

std::optional<Index> corner_of(const Surface& surface, const SurfacePoint& point) {
    const auto& b = point.barycentric;
    for (Index k = 0; k < 3; ++k) {
        const double to_next = b[(k + 1) % 3], to_last = b[(k + 2) % 3];
        // A quick test without the edges' lengths.
        if (to_next + to_last > at_vertex) continue;
        const Index h = 3 * point.face.value() + k;
        if (to_next == 0 && to_last == 0) return h;
        const double next = surface.length_of(h), last = surface.length_of(Surface::previous(h));
        if (to_next * next + to_last * last <= at_vertex * std::min(next, last)) return h;
    }
    return std::nullopt;
}

std::optional<Index> half_edge_of(const SurfacePoint& point) {
    const auto& b = point.barycentric;
    for (Index k = 0; k < 3; ++k) {
        const double height = b[(k + 2) % 3];
        const double along = std::min(b[k], b[(k + 1) % 3]);
        if (along > 0 && height <= std::min(edge_rounding, on_edge_slope * along)) {
            return 3 * point.face.value() + k;
        }
    }
    return std::nullopt;
}

SurfacePoint across_edge(const Surface& surface, const SurfacePoint& point, Index half_edge) {
    const Index twin = surface.twin[half_edge];
    SurfacePoint result{FaceId(Surface::face(twin)), {0, 0, 0}};
    result.barycentric[twin % 3] = point.barycentric[(half_edge + 1) % 3];
    result.barycentric[(twin + 1) % 3] = point.barycentric[half_edge % 3];
    return result;
}

std::optional<SurfacePoint> seen_from(const Surface& surface, const SurfacePoint& point,
                                      Index face) {
    if (point.face.value() == face) return point;
    std::optional<SurfacePoint> seen;
    for_each_view(surface, point, [&](const SurfacePoint& view) {
        if (!seen && view.face.value() == face) seen = view;
    });
    return seen;
}

CommonFaces common_faces(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    CommonFaces found;
    for_each_view(surface, a, [&](const SurfacePoint& view) {
        const Index face = view.face.value();
        if (face == found.first || found.second != no_index) return;
        if (!seen_from(surface, b, face)) return;
        (found.first == no_index ? found.first : found.second) = face;
    });
    return found;
}

bool is_on_boundary(const Surface& surface, const SurfacePoint& point) {
    if (const auto vertex = vertex_of(surface, point)) return surface.is_boundary_vertex(*vertex);
    const auto half_edge = half_edge_of(point);
    return half_edge && surface.twin[*half_edge] == no_index;
}

Vec2 position_in_frame(const Surface& surface, const SurfacePoint& point, Index half_edge) {
    assert(Surface::face(half_edge) == point.face.value());
    const Index k = half_edge % 3;
    const double head = point.barycentric[(k + 1) % 3];
    const double apex = point.barycentric[(k + 2) % 3];
    return apex * surface.apex[half_edge] + Vec2(head * surface.length_of(half_edge), 0);
}

SurfacePoint snapped(const Surface& surface, const SurfacePoint& point) {
    SurfacePoint result = point;
    auto& b = result.barycentric;
    if (const std::optional<Index> corner = corner_of(surface, point)) {
        b = {0, 0, 0};
        b[*corner % 3] = 1;
    } else if (const std::optional<Index> h = half_edge_of(point)) {
        b[(*h + 2) % 3] = 0;
        const double sum = b[*h % 3] + b[(*h + 1) % 3];
        b[*h % 3] /= sum;
        b[(*h + 1) % 3] = 1 - b[*h % 3];
    }
    return result;
}

SurfaceKey key_of(const Surface& surface, const SurfacePoint& point) {
    const std::uint64_t num_vertices = surface.num_vertices();
    if (const auto vertex = vertex_of(surface, point)) return {*vertex, {}};
    if (const auto h = half_edge_of(point)) {
        const Index low = std::min(*h, surface.twin[*h]);  // no_index is higher.
        double tail = point.barycentric[*h % 3], head = point.barycentric[Surface::next(*h) % 3];
        if (low != *h) std::swap(tail, head);
        return {num_vertices + low, {tail, head, 0}};
    }
    return {num_vertices + surface.twin.size() + point.face.value(), point.barycentric};
}

std::vector<Index> distinct_points(const Surface& surface, std::span<const SurfacePoint> points) {
    std::vector<std::pair<SurfaceKey, Index>> keys;
    keys.reserve(points.size());
    for (Index i = 0; i < points.size(); ++i) keys.emplace_back(key_of(surface, points[i]), i);
    std::sort(keys.begin(), keys.end());
    const auto end = std::unique(keys.begin(), keys.end(),
                                 [](const auto& a, const auto& b) { return a.first == b.first; });
    std::vector<Index> distinct;
    distinct.reserve(points.size());
    for (auto key = keys.begin(); key != end; ++key) distinct.push_back(key->second);
    std::sort(distinct.begin(), distinct.end());
    return distinct;
}

void check_sites(const Surface& surface, std::span<const SurfacePoint> sites) {
    for (Index s = 0; s < sites.size(); ++s) check_site(surface, sites[s], s);
}

std::vector<SurfacePoint> uniform_points(const Surface& surface, Index count, std::uint64_t seed) {
    std::vector<double> area_up_to(surface.num_faces());
    double area = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        area += face_area(surface, f);
        area_up_to[f] = area;
    }
    std::vector<SurfacePoint> points(area_up_to.empty() ? 0 : count);
    for (Index i = 0; i < points.size(); ++i) {
        const double share = random_unit(seed, 0, i) * area;
        const auto found = std::upper_bound(area_up_to.begin(), area_up_to.end(), share);
        const auto face = std::min(found - area_up_to.begin(), std::ssize(area_up_to) - 1);
        points[i] = {FaceId(static_cast<Index>(face)),
                     uniform_barycentric(1 - random_unit(seed, 1, i), random_unit(seed, 2, i))};
    }
    return points;
}

}  // namespace agvd
