// Mechanical parts whose creases are known: boxes, prisms, cylinders, cones, vaults, plates with
// ribs and folds. They are built from patches of quads that are welded where they meet (Patchwork).
// Needles and rotations change the mesh of such a part, but not its surface.
#include "support/parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "support/dice.h"
#include "support/patchwork.h"

namespace parts {
namespace {

using agvd::Index;
using agvd::Triangle;
using agvd::TriangleMesh;
using agvd::Vec3;

constexpr double pi = std::numbers::pi;

Vec3 circle(double turns, double radius, double z) {
    return {radius * std::cos(2 * pi * turns), radius * std::sin(2 * pi * turns), z};
}

Patchwork walls(const Vec3& size, Index n) {
    Patchwork work;
    const Vec3 x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z()), o(0, 0, 0);
    work.add_square(n, z, x, y);
    work.add_square(n, o, x, z);
    work.add_square(n, y, z, x);
    work.add_square(n, o, z, y);
    work.add_square(n, x, y, z);
    return work;
}

}  // namespace

TriangleMesh open_box(const Vec3& size, Index n) { return walls(size, n).take(); }

TriangleMesh box(const Vec3& size, Index n) {
    Patchwork work = walls(size, n);
    work.add_square(n, Vec3(0, 0, 0), Vec3(0, size.y(), 0), Vec3(size.x(), 0, 0));
    return work.take();
}

TriangleMesh hexagonal_prism(Index n) {
    Patchwork work;
    const Vec3 up(0, 0, 1);
    for (int i = 0; i < 6; ++i) {
        const Vec3 a = circle(i / 6., 1, 0), b = circle((i + 1) / 6., 1, 0);
        work.add_square(n, a, b - a, up);
        // A third of the hexagon.
        if (i % 2 != 0) continue;
        const Vec3 c = circle((i + 2) / 6., 1, 0);
        work.add_square(n, b, a - b, c - b);
        work.add_square(n, b + up, c - b, a - b);
    }
    return work.take();
}

TriangleMesh extruded_l(Index n) {
    Patchwork work;
    const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    for (const Vec3& corner : {Vec3(0, 0, 0), x, y}) {
        work.add_square(n, corner, y, x);
        work.add_square(n, corner + z, x, y);
    }
    const Vec3 outline[] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0},
                            {1, 2, 0}, {0, 2, 0}, {0, 1, 0}, {0, 0, 0}};
    for (int i = 0; i < 8; ++i) work.add_square(n, outline[i], outline[i + 1] - outline[i], z);
    return work.take();
}

TriangleMesh capped_cylinder(Index sides, Index rings) {
    Patchwork work;
    work.add(sides, rings, [](double u, double v) { return circle(u, 1, 2 * v); });
    work.add(sides, rings, [](double u, double v) { return circle(u, 1 - v, 2); });
    work.add(sides, rings, [](double u, double v) { return circle(u, v, 0); });
    return work.take();
}

TriangleMesh cone_on_plate(Index sides, Index rings) {
    Patchwork work;
    work.add(sides, rings, [](double u, double v) { return circle(u, 1 - v, v); });
    work.add(sides, 2 * rings, [](double u, double v) { return circle(u, 3 - 2 * v, 0); });
    return work.take();
}

TriangleMesh crossing_vaults(Index n) {
    Patchwork work;
    // Both vaults are cut into strips along their straight lines; these start at the points where
    // they meet, at rows of equal angle around the small one.
    const auto row = [&](double u) { return std::sin(pi / 2 * u); };
    const auto meet = [](double y) { return std::sqrt(3 + y * y); };
    const auto big = [](double x, double y) -> Vec3 {
        return {x, y, std::sqrt(std::max(0., 4 - x * x))};
    };
    work.add(n, n, [&](double u, double v) {
        return big(2 * std::sin((2 * u - 1) * pi / 3), 6 * v - 3);
    });
    for (const double sx : {-1., 1.}) {
        for (const double sy : {-1., 1.}) {
            const auto beside = [&](double u, double v) {
                const double y = row(u);
                return big(sx * meet(y), sy * (y + v * (3 - y)));
            };
            const auto arm = [&](double u, double v) -> Vec3 {
                const double y = row(u), near = meet(y);
                return {sx * (near + v * (5 - near)), sy * y, std::cos(pi / 2 * u)};
            };
            const auto swapped = [](const auto& at) {
                return [at](double u, double v) { return at(v, u); };
            };
            if (sx * sy > 0) {
                work.add(n / 2, n / 2, beside);
                work.add(n / 2, n / 2, swapped(arm));
            } else {
                work.add(n / 2, n / 2, swapped(beside));
                work.add(n / 2, n / 2, arm);
            }
        }
    }
    return work.take();
}

TriangleMesh folded_plate(Index n, Index m, double half_width,
                          const std::function<double(double)>& degrees) {
    Patchwork work;
    work.add(n, m, [&](double u, double v) -> Vec3 {
        const double x = 8 * u - 4, y = half_width * (2 * v - 1);
        return {x, y, std::tan(degrees(x) / 2 * pi / 180) * std::abs(y)};
    });
    return work.take();
}

TriangleMesh with_slit(TriangleMesh mesh, double at, double reach) {
    std::map<Index, Index> copies;  // For the faces beyond the slit.
    const auto is_inside = [&](const Vec3& p) {
        return std::abs(p.x() - at) < 1e-9 && std::abs(p.y()) < reach - 1e-9;
    };
    for (Triangle& t : mesh.triangles) {
        double middle = 0;
        for (const Index v : t) middle += mesh.positions[v].x() / 3;
        if (middle < at) continue;
        for (Index& v : t) {
            const Vec3 p = mesh.positions[v];
            if (!is_inside(p)) continue;
            const auto [it, is_new] =
                copies.try_emplace(v, static_cast<Index>(mesh.positions.size()));
            if (is_new) mesh.positions.push_back(p);
            v = it->second;
        }
    }
    return mesh;
}

TriangleMesh ribbed_plate(double width, Index n) {
    Patchwork work;
    const double h = width / 2;
    const auto strip = [&](double y0, double z0, double y1, double z1, Index m) {
        work.add(n, m, [=](double u, double v) -> Vec3 {
            return {4 * u - 2, y0 + v * (y1 - y0), z0 + v * (z1 - z0)};
        });
    };
    strip(-2, 0, -h, 0, n / 2);
    strip(-h, 0, -h, width, 1);
    strip(-h, width, h, width, 1);
    strip(h, width, h, 0, 1);
    strip(h, 0, 2, 0, n / 2);
    return work.take();
}

TriangleMesh with_needles(const TriangleMesh& mesh, double aspect, double share,
                          std::uint64_t seed) {
    TriangleMesh result = mesh;
    Dice dice(seed);
    std::map<std::pair<Index, Index>, Index> middle;  // Of an edge: the point next to its end.
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            const Index a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
            if (middle.contains({a, b})) continue;
            const bool is_split = dice.number(0, 1) < share / 2;
            middle[{a, b}] =
                is_split ? static_cast<Index>(result.positions.size()) : agvd::no_index;
            if (!is_split) continue;
            result.positions.push_back((1 - aspect) * mesh.positions[a] +
                                       aspect * mesh.positions[b]);
        }
    }
    std::vector<Triangle> faces;
    for (const Triangle& t : mesh.triangles) {
        std::vector<Index> polygon;
        for (int k = 0; k < 3; ++k) {
            const Index a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
            polygon.push_back(t[k]);
            if (middle[{a, b}] != agvd::no_index) polygon.push_back(middle[{a, b}]);
        }
        // A point close above the middle of a side; all other points are joined to it.
        if (polygon.size() == 3 && dice.number(0, 1) >= share) {
            faces.push_back(t);
            continue;
        }
        const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        const auto centre = static_cast<Index>(result.positions.size());
        result.positions.push_back((1 - aspect) * (a + b) / 2 + aspect * c);
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            faces.push_back({polygon[k], polygon[(k + 1) % polygon.size()], centre});
        }
    }
    result.triangles = std::move(faces);
    return result;
}

TriangleMesh turned(TriangleMesh mesh, std::uint64_t seed) {
    Dice dice(seed);
    Vec3 axis(dice.number(-1, 1), dice.number(-1, 1), dice.number(-1, 1));
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(dice.number(0, 2 * pi), axis.normalized()).toRotationMatrix();
    for (Vec3& p : mesh.positions) p = turn * p;
    return mesh;
}

}  // namespace parts
