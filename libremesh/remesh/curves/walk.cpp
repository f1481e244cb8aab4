// A walk unfolds face after face along a straight line ([polthier1998]). The frame of a half-edge
// has its tail as origin and its direction as x axis; the face lies above.
#include "remesh/curves/walk.h"

#include <cmath>

#include "agvd/mesh/surface_points.h"

namespace remesh::detail {
namespace {

// A step has no direction on a face if the cosine of the angle between them is below this.
constexpr double least_cosine = 0.05;
// A walk that meets the boundary goes this share of its last section.
constexpr double stop_share = 0.9;
// Most crossings of a walk. Steps of relaxation stay below this, except at slivers around one
// vertex.
constexpr int most_crossings = 2000;

// Vector `a` in the frame whose first axis is `axis`, of length 1.
Vec2 turned_back(const Vec2& a, const Vec2& axis) { return {axis.dot(a), cross(axis, a)}; }

// A ray in the frame of a half-edge of its face.
struct Ray {
    Index half_edge;
    Vec2 at;
    Vec2 direction;  // Of length 1.
};

// The same ray in the frame of the next half-edge of the face, whose tail is the head of this one.
Ray in_next(const Surface& surface, const Ray& ray) {
    const Vec2 head(surface.length_of(ray.half_edge), 0);
    const Index next = Surface::next(ray.half_edge);
    const Vec2 axis = (surface.apex[ray.half_edge] - head) / surface.length_of(next);
    return {next, turned_back(ray.at - head, axis), turned_back(ray.direction, axis)};
}

SurfacePoint point_at(const Surface& surface, const Ray& ray) {
    const Vec2 apex = surface.apex[ray.half_edge];
    const double length = surface.length_of(ray.half_edge);
    const double up = ray.at.y() / apex.y();
    const double head = (ray.at.x() - up * apex.x()) / length;
    const Index k = ray.half_edge % 3;
    std::array<double, 3> b{};
    b[k] = 1 - head - up;
    b[(k + 1) % 3] = head;
    b[(k + 2) % 3] = up;
    keep_inside(b);
    return {FaceId(Surface::face(ray.half_edge)), b};
}

// Changes to the frame of the half-edge through which the ray leaves its face.
// \param is_inside  the ray may leave through any half-edge; otherwise not through its own, by
//                   which it entered.
void find_exit(const Surface& surface, Ray& ray, bool is_inside) {
    if (is_inside) {
        // The corners on the left of the ray are consecutive; the ray leaves after the last of
        // them.
        for (int k = 0; k < 2; ++k) {
            const Vec2 head(surface.length_of(ray.half_edge), 0);
            if (cross(ray.direction, -ray.at) <= 0 && cross(ray.direction, head - ray.at) > 0) {
                return;
            }
            ray = in_next(surface, ray);
        }
        return;
    }
    const bool is_left = cross(ray.direction, surface.apex[ray.half_edge] - ray.at) > 0;
    ray = in_next(surface, ray);
    if (!is_left) ray = in_next(surface, ray);
}

// The boundary half-edge whose head is `vertex`.
Index boundary_into(const Surface& surface, Index vertex) {
    Index h = surface.outgoing[vertex];
    while (surface.twin[Surface::previous(h)] != no_index) h = surface.twin[Surface::previous(h)];
    return Surface::previous(h);
}

}  // namespace

Walk walk_straight(const Surface& surface, const SurfacePoint& from, const Vec3& step) {
    const Index h = 3 * from.face.value();
    const auto& p = surface.mesh.positions;
    const Triangle& t = surface.mesh.triangles[from.face.value()];
    const double length = surface.length_of(h);
    const Vec3 x_axis = (p[t[1]] - p[t[0]]) / length;
    const Vec3 up = p[t[2]] - p[t[0]];
    const Vec2 apex = surface.apex[h];
    const Vec3 y_axis = (up - apex.x() * x_axis) / apex.y();
    const Vec2 flat(x_axis.dot(step), y_axis.dot(step));
    double left = step.norm();
    const double flat_length = flat.norm();
    if (!(flat_length > least_cosine * left)) return {from};

    Ray ray{h, from.barycentric[2] * apex + Vec2(from.barycentric[1] * length, 0),
            flat / flat_length};
    for (int crossings = 0; crossings < most_crossings; ++crossings) {
        find_exit(surface, ray, crossings == 0);
        const double fall = -ray.direction.y();
        const double stretch = fall > 0 ? std::max(ray.at.y() / fall, 0.0) : left;
        if (stretch >= left) {
            ray.at += left * ray.direction;
            return {point_at(surface, ray), crossings};
        }
        const Index twin = surface.twin[ray.half_edge];
        if (twin == no_index) {
            ray.at += stop_share * stretch * ray.direction;
            return {point_at(surface, ray), crossings};
        }
        const double edge = surface.length_of(ray.half_edge);
        const double along = std::clamp(ray.at.x() + stretch * ray.direction.x(), 0.0, edge);
        ray = {twin, Vec2(edge - along, 0), -ray.direction};
        left -= stretch;
    }
    return {point_at(surface, ray), most_crossings, true};
}

std::optional<Index> boundary_half_edge(const Surface& surface, const SurfacePoint& point) {
    const Index first = 3 * point.face.value();
    for (Index k = 0; k < 3; ++k) {
        const auto& b = point.barycentric;
        if (b[(k + 1) % 3] == 0 && b[(k + 2) % 3] == 0) {
            const Index v = surface.tail(first + k);
            if (surface.is_boundary_vertex(v)) return surface.outgoing[v];
            return std::nullopt;
        }
    }
    for (Index k = 0; k < 3; ++k) {
        if (point.barycentric[(k + 2) % 3] == 0 && surface.twin[first + k] == no_index) {
            return first + k;
        }
    }
    return std::nullopt;
}

SurfacePoint walk_boundary(const Surface& surface, const SurfacePoint& from, Index h,
                           const Vec3& step) {
    const auto& p = surface.mesh.positions;
    const Vec3 axis = (p[surface.head(h)] - p[surface.tail(h)]) / surface.length_of(h);
    const Vec3 offset = position(surface.mesh.view(), from) - p[surface.tail(h)];
    double along = axis.dot(offset) + axis.dot(step);
    for (int passed = 0; passed < most_crossings; ++passed) {
        if (along > surface.length_of(h)) {
            along -= surface.length_of(h);
            h = surface.outgoing[surface.head(h)];
        } else if (along < 0) {
            h = boundary_into(surface, surface.tail(h));
            along += surface.length_of(h);
        } else {
            break;
        }
    }
    const double share =
        std::clamp(along / surface.length_of(h), interior_margin, 1 - interior_margin);
    return point_on(h, share);
}

}  // namespace remesh::detail
