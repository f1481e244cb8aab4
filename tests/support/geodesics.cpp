// Measures paths over a surface. A path is given by points of which consecutive ones lie in one
// face. At each point the faces around it are laid out as sectors of angles; a path is locally
// shortest if it leaves at least pi on both sides of every point between its ends ([xin2007]). All
// angles are computed from positions in space, independently of the library's unfolding.
#include "support/geodesics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "agvd/mesh/surface_points.h"
#include "support/dice.h"

namespace geodesics {

using agvd::Index;
using agvd::no_index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;

namespace {

constexpr double pi = std::numbers::pi;

Vec3 place(const Surface& surface, const SurfacePoint& point) {
    return position(surface.mesh.view(), point);
}

// Faces that contain both points, by exact coordinates; no_index: none, or no second one.
struct SharedFaces {
    Index first = no_index, second = no_index;
};

SharedFaces shared_faces(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    SharedFaces shared;
    const auto add = [&](Index face) {
        if (face == shared.first || shared.second != no_index) return;
        if (!seen_from(surface, a, face) || !seen_from(surface, b, face)) return;
        (shared.first == no_index ? shared.first : shared.second) = face;
    };
    add(a.face.value());
    for (Index h = 3 * a.face.value(); h < 3 * a.face.value() + 3; ++h) {
        if (a.barycentric[(h + 2) % 3] == 0 && surface.twin[h] != no_index) {
            add(Surface::face(surface.twin[h]));
        }
        if (a.barycentric[h % 3] != 1) continue;
        const Index first = surface.outgoing[surface.tail(h)];
        for (Index out = first; out != no_index;) {
            add(Surface::face(out));
            out = surface.twin[Surface::previous(out)];
            if (out == first) break;
        }
    }
    return shared;
}

// A face around a point: from `start` counter-clockwise by `angle`.
struct Sector {
    Index face;
    Vec3 start;
    double angle;
};

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::vector<Sector> sectors_around(const Surface& surface, const SurfacePoint& point) {
    std::vector<Sector> sectors;
    const auto& positions = surface.mesh.positions;
    const auto& b = point.barycentric;
    const auto along = [&](Index h) -> Vec3 {
        return positions[surface.head(h)] - positions[surface.tail(h)];
    };
    for (Index k = 0; k < 3; ++k) {
        const Index h = 3 * point.face.value() + k;
        if (b[k] == 1) {
            for (Index out = surface.outgoing[surface.tail(h)]; out != no_index;) {
                const Index in = Surface::previous(out);
                sectors.push_back(
                    {Surface::face(out), along(out), angle_between(along(out), -along(in))});
                out = surface.twin[in];
                if (out == surface.outgoing[surface.tail(h)]) break;
            }
            return sectors;
        }
    }
    for (Index k = 0; k < 3; ++k) {
        const Index h = 3 * point.face.value() + k;
        if (b[(k + 2) % 3] != 0) continue;
        sectors.push_back({Surface::face(h), along(h), pi});
        const Index twin = surface.twin[h];
        if (twin != no_index) sectors.push_back({Surface::face(twin), along(twin), pi});
        return sectors;
    }
    ADD_FAILURE() << "a path turns inside a face";
    return sectors;
}

bool is_closed(const Surface& surface, const SurfacePoint& point) {
    for (Index k = 0; k < 3; ++k) {
        const Index h = 3 * point.face.value() + k;
        if (point.barycentric[k] == 1) return !surface.is_boundary_vertex(surface.tail(h));
    }
    for (Index k = 0; k < 3; ++k) {
        const Index h = 3 * point.face.value() + k;
        if (point.barycentric[(k + 2) % 3] == 0) return surface.twin[h] != no_index;
    }
    return true;
}

// Counter-clockwise around `point` from its first sector.
double direction(const Surface& surface, const std::vector<Sector>& sectors,
                 const SurfacePoint& point, const SurfacePoint& to) {
    const SharedFaces common = shared_faces(surface, point, to);
    double sum = 0;
    for (const Sector& sector : sectors) {
        if (sector.face == common.first || sector.face == common.second) {
            return sum + angle_between(sector.start, place(surface, to) - place(surface, point));
        }
        sum += sector.angle;
    }
    ADD_FAILURE() << "points in a row share no face";
    return sum;
}

bool is_vertex(const SurfacePoint& point) {
    return std::count(point.barycentric.begin(), point.barycentric.end(), 1.0) == 1;
}

}  // namespace

agvd::GeodesicPath random_path(const Surface& surface, const SurfacePoint& from,
                               const SurfacePoint& to, std::uint64_t seed) {
    Dice dice(seed);
    std::vector<Index> entered(surface.num_faces(), no_index);  // By which half-edge, from outside.
    std::vector<bool> is_seen(surface.num_faces(), false);
    std::vector<Index> open{from.face.value()};
    is_seen[from.face.value()] = true;
    while (!open.empty() && !is_seen[to.face.value()]) {
        const auto pick = dice.count(0, static_cast<Index>(open.size()) - 1);
        const Index face = open[pick];
        open.erase(open.begin() + pick);
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Index twin = surface.twin[h];
            if (twin == no_index || is_seen[Surface::face(twin)]) continue;
            is_seen[Surface::face(twin)] = true;
            entered[Surface::face(twin)] = h;
            open.push_back(Surface::face(twin));
        }
    }
    std::vector<Index> crossed;
    for (Index face = to.face.value(); face != from.face.value();) {
        if (entered[face] == no_index) {
            ADD_FAILURE() << "points on different components";
            return {};
        }
        crossed.push_back(entered[face]);
        face = Surface::face(entered[face]);
    }
    agvd::GeodesicPath path;
    path.points.push_back(from);
    path.faces.push_back(from.face);
    for (auto h = crossed.rbegin(); h != crossed.rend(); ++h) {
        SurfacePoint& middle = path.points.emplace_back();
        middle = {agvd::FaceId(Surface::face(*h)), {0.5, 0.5, 0.5}};
        middle.barycentric[(*h + 2) % 3] = 0;
        path.faces.emplace_back(Surface::face(surface.twin[*h]));
    }
    path.points.push_back(to);
    return path;
}

double length(const Surface& surface, std::span<const SurfacePoint> points) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double step = (place(surface, points[i + 1]) - place(surface, points[i])).norm();
        sum += step;
        if (step > 0) {
            EXPECT_NE(shared_faces(surface, points[i], points[i + 1]).first, no_index);
        }
    }
    return sum;
}

double largest_bend(const Surface& surface, std::span<const SurfacePoint> points) {
    const double short_step = 1e-7 * length(surface, points);
    std::vector<SurfacePoint> path;
    for (const SurfacePoint& point : points) {
        const bool is_same =
            !path.empty() &&
            (place(surface, path.back()) - place(surface, point)).norm() <= short_step;
        if (!is_same) {
            path.push_back(point);
        } else if (path.size() > 1 && is_vertex(point)) {
            path.back() = point;
        }
    }
    double bend = 0;
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
        // Where points were joined, neighbours may share no face any more.
        if (shared_faces(surface, path[i], path[i - 1]).first == no_index) continue;
        if (shared_faces(surface, path[i], path[i + 1]).first == no_index) continue;
        const std::vector<Sector> sectors = sectors_around(surface, path[i]);
        double total = 0;
        for (const Sector& sector : sectors) total += sector.angle;
        double left = direction(surface, sectors, path[i], path[i + 1]) -
                      direction(surface, sectors, path[i], path[i - 1]);
        left = std::abs(left);
        bend = std::max(bend, pi - left);
        if (is_closed(surface, path[i])) bend = std::max(bend, pi - (total - left));
    }
    return bend;
}

}  // namespace geodesics
