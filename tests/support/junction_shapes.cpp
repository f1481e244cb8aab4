// Meshes whose sheets meet in edges of more than two faces. They are built from patches that are
// welded where their points agree (Patchwork), so that junctions arise by themselves. Most shapes
// come with the numbers of faces, sheets and edges that cleaning must find.
#include "support/junction_shapes.h"

#include <cmath>
#include <numbers>

#include "support/patchwork.h"

namespace shapes {
namespace {

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using parts::Patchwork;

constexpr double pi = std::numbers::pi;

void add_sheet(Patchwork& mesh, Index n, Index m, const Vec3& corner, const Vec3& along,
               const Vec3& up) {
    mesh.add(n, m, [&](double u, double v) -> Vec3 { return corner + u * along + v * up; });
}

// Without the wall at its least x unless is_whole.
void add_cube(Patchwork& mesh, Index n, const Vec3& at, bool is_whole = true) {
    const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    mesh.add_square(n, at, y, x);
    mesh.add_square(n, at + z, x, y);
    mesh.add_square(n, at, x, z);
    mesh.add_square(n, at + y, z, x);
    mesh.add_square(n, at + x, y, z);
    if (is_whole) mesh.add_square(n, at, z, y);
}

Vec3 on_circle(double turns, double radius, double height) {
    return {radius * std::cos(2 * pi * turns), radius * std::sin(2 * pi * turns), height};
}

}  // namespace

JunctionShape tee() {
    Patchwork mesh;
    add_sheet(mesh, 16, 8, {-1, 0, 0}, {2, 0, 0}, {0, 2, 0});
    add_sheet(mesh, 8, 8, {0, 0, 0}, {0, 2, 0}, {0, 0, 1});
    return {"tee", mesh.take(), {{{0, 0, 0}, {0, 2, 0}}}, 3, 2, 8};
}

JunctionShape pages(Index count) {
    Patchwork mesh;
    for (Index i = 0; i < count; ++i) {
        add_sheet(mesh, 6, 12, {0, 0, 0}, on_circle(double(i) / count, 1, 0), {0, 0, 2});
    }
    return {"pages", mesh.take(), {{{0, 0, 0}, {0, 0, 2}}}, count, count, 12};
}

JunctionShape cubes_with_an_edge() {
    Patchwork mesh;
    add_cube(mesh, 6, {0, 0, 0});
    add_cube(mesh, 6, {1, 1, 0});
    return {"cubes with an edge", mesh.take(), {{{1, 1, 0}, {1, 1, 1}}}, 4, 2, 6};
}

JunctionShape cubes_with_a_wall() {
    Patchwork mesh;
    add_cube(mesh, 6, {0, 0, 0});
    add_cube(mesh, 6, {1, 0, 0}, false);
    const Vec3 a(1, 0, 0), b(1, 1, 0), c(1, 1, 1), d(1, 0, 1);
    return {"cubes with a wall", mesh.take(), {{a, b}, {b, c}, {c, d}, {d, a}}, 3, 2, 24};
}

JunctionShape pipe_on_plate() {
    Patchwork mesh;
    add_sheet(mesh, 16, 16, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
    const Vec3 a(-1, -1, 0), b(1, -1, 0), c(1, 1, 0), d(-1, 1, 0);
    const std::vector<std::pair<Vec3, Vec3>> lines{{a, b}, {b, c}, {c, d}, {d, a}};
    for (const auto& [from, to] : lines) add_sheet(mesh, 8, 4, from, to - from, {0, 0, 1});
    return {"pipe on plate", mesh.take(), lines, 3, 2, 32};
}

JunctionShape fan_on_plate() {
    Patchwork mesh;
    add_sheet(mesh, 16, 16, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
    mesh.add(8, 4, [](double u, double v) -> Vec3 { return {(2 * u - 1) * (1 + 2 * v), 0, v}; });
    return {"fan on plate", mesh.take(), {{{-1, 0, 0}, {1, 0, 0}}}, 3, 2, 8};
}

JunctionShape three_planes() {
    Patchwork mesh;
    const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), o(0, 0, 0);
    add_sheet(mesh, 12, 12, -x - y, 2 * x, 2 * y);
    add_sheet(mesh, 12, 12, -y - z, 2 * y, 2 * z);
    add_sheet(mesh, 12, 12, -z - x, 2 * z, 2 * x);
    return {
        "three planes", mesh.take(), {{o, x}, {o, -x}, {o, y}, {o, -y}, {o, z}, {o, -z}}, 4, 2, 36};
}

std::vector<JunctionShape> straight_junctions() {
    return {
        tee(),           pages(3),       pages(5),      cubes_with_an_edge(), cubes_with_a_wall(),
        pipe_on_plate(), fan_on_plate(), three_planes()};
}

TriangleMesh round_pipe_on_plate(Index sides) {
    Patchwork mesh;
    mesh.add(8, sides, [](double u, double v) { return on_circle(v, 2 * u, 0); });
    mesh.add(sides, 4, [](double u, double v) { return on_circle(u, 1, v); });
    return mesh.take();
}

TriangleMesh three_lobes(Index sides, double height) {
    Patchwork mesh;
    for (const double up : {0., height, -1.}) {
        mesh.add(sides / 4, sides, [=](double u, double v) {
            const double radius = 1 + 0.4 * std::cos(6 * pi * v);
            return on_circle(v, u * radius, up * (1 - u * u));
        });
    }
    return mesh.take();
}

TriangleMesh twisted_pages(Index sides) {
    Patchwork mesh;
    for (const double page : {0., 1., 2.}) {
        mesh.add(sides, 6, [page](double u, double v) -> Vec3 {
            const double tilt = (u + page) / 3;
            return on_circle(u, 3 + v * std::cos(2 * pi * tilt), v * std::sin(2 * pi * tilt));
        });
    }
    return mesh.take();
}

TriangleMesh pages_that_change_partners(Index n) {
    Patchwork mesh;
    const auto at = [](double degrees, double radius, double v) {
        return on_circle(degrees / 360, radius, 2 * v - 1);
    };
    mesh.add(n, 2 * n, [&](double u, double v) { return at(0, u, v); });
    mesh.add(n, 2 * n, [&](double u, double v) { return at(60, u, v); });
    mesh.add(n, 2 * n, [&](double u, double v) { return at(180 + 40 * v, 1 - u, v); });
    mesh.add(n, 2 * n, [&](double u, double v) { return at(140 + 40 * v, 1 - u, v); });
    return mesh.take();
}

TriangleMesh cones_at_a_point(Index sides) {
    Patchwork mesh;
    mesh.add(6, sides, [](double u, double v) { return on_circle(v, u, u); });
    mesh.add(sides, 6, [](double u, double v) { return on_circle(u, v, -v); });
    return mesh.take();
}

}  // namespace shapes
