#include "support/developable.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agvd/mesh/closest_point.h"

namespace developable {

using namespace agvd;

namespace {

double to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
    const auto in_space = [](const Vec2& at) { return Vec3(at.x(), at.y(), 0); };
    return distance_to_segment(in_space(p), in_space(a), in_space(b));
}

Vec2 turned(const Vec2& p, double angle) {
    return {std::cos(angle) * p.x() - std::sin(angle) * p.y(),
            std::sin(angle) * p.x() + std::cos(angle) * p.y()};
}

// From 0 to 2 pi.
double angle_of(const Vec2& p) {
    const double angle = std::atan2(p.y(), p.x());
    return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

Vec3 on_circle(Index k, Index n) {
    const double angle = 2 * std::numbers::pi * k / n;
    return {std::cos(angle), std::sin(angle), 0};
}

}  // namespace

Vec2 Unrolled::place(const SurfacePoint& point) const {
    Vec2 p(0, 0);
    for (std::size_t k = 0; k < 3; ++k) {
        p += point.barycentric[k] * corners[point.face.value()][k];
    }
    return p;
}

double Unrolled::distance(const SiteShape& shape, const SurfacePoint& point) const {
    const Vec2 p = place(point);
    double least = infinity;
    for (const Index edge : shape.edges) {
        const Index h = surface.edge_half[edge];
        const auto& at = corners[Surface::face(h)];
        const double between =
            angle > 0 ? angle_of(p) - angle_of((at[h % 3] + at[(h + 1) % 3]) / 2) : 0;
        for (const double times : {-1.0, 0.0, 1.0}) {
            // Around the apex no straight way turns by more.
            if (std::abs(between + times * angle) > std::numbers::pi) continue;
            const Vec2 moved = turned(p, times * angle) + times * shift;
            least = std::min(least, to_segment(moved, at[h % 3], at[(h + 1) % 3]));
        }
    }
    return least;
}

SiteShape Unrolled::line(const std::vector<Index>& vertices, Index site) const {
    SiteShape line{.site = site};
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
        for_each_edge_at(surface, vertices[i], [&](Index h, Index v) {
            if (v == vertices[i + 1]) line.edges.push_back(surface.edge[h]);
        });
    }
    return line;
}

Unrolled prism(Index n, Index m) {
    TriangleMesh mesh;
    Unrolled result;
    const double side = 2 * std::sin(std::numbers::pi / n), step = 2.0 / m;
    result.shift = {n * side, 0};
    for (Index j = 0; j <= m; ++j) {
        for (Index k = 0; k < n; ++k) {
            mesh.positions.push_back(on_circle(k, n) + Vec3(0, 0, step * j));
        }
    }
    for (Index j = 0; j < m; ++j) {
        for (Index k = 0; k < n; ++k) {
            const Index a = j * n + k, b = j * n + (k + 1) % n;
            mesh.triangles.push_back({a, b, b + n});
            mesh.triangles.push_back({a, b + n, a + n});
            const Vec2 p(side * k, step * j), q(side * (k + 1), step * (j + 1));
            result.corners.push_back({p, Vec2(q.x(), p.y()), q});
            result.corners.push_back({p, q, Vec2(p.x(), q.y())});
        }
    }
    result.surface = build_surface(mesh.view());
    return result;
}

Unrolled pyramid(Index n, Index m) {
    TriangleMesh mesh;
    Unrolled result;
    const double slope = std::sqrt(2.0);
    const double angle = 2 * std::asin(std::sin(std::numbers::pi / n) / slope);
    result.angle = n * angle;
    mesh.positions.push_back({0, 0, 1});
    for (Index j = 0; j < m; ++j) {
        const double share = (j + 1.0) / m;
        for (Index k = 0; k < n; ++k) {
            mesh.positions.push_back(share * on_circle(k, n) + Vec3(0, 0, 1 - share));
        }
    }
    const auto place = [&](Index ring, Index ridge) {
        return turned({slope * (ring + 1.0) / m, 0}, angle * ridge);
    };
    for (Index k = 0; k < n; ++k) {
        mesh.triangles.push_back({0, 1 + k, 1 + (k + 1) % n});
        result.corners.push_back({Vec2(0, 0), place(0, k), place(0, k + 1)});
        for (Index j = 0; j + 1 < m; ++j) {
            const Index a = 1 + j * n + k, b = 1 + j * n + (k + 1) % n;
            mesh.triangles.push_back({a, a + n, b + n});
            mesh.triangles.push_back({a, b + n, b});
            result.corners.push_back({place(j, k), place(j + 1, k), place(j + 1, k + 1)});
            result.corners.push_back({place(j, k), place(j + 1, k + 1), place(j, k + 1)});
        }
    }
    result.surface = build_surface(mesh.view());
    return result;
}

}  // namespace developable
