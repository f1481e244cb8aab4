// The shell, plate, parts, slivers and ring of data/. Shell, plate and ring are grids of points by
// formula; parts and slivers are contours of implicit functions (contour.h), scaled, joined, or cut
// further. The shell's coordinates are rounded to six decimals, which keeps its text file short.
#include "make_data/contour.h"
#include "make_data/data_files.h"
#include "make_data/formula.h"

#include <cmath>

#include "agvd/core/random.h"

namespace make_data {

using agvd::Index;
using agvd::Triangle;
using agvd::TriangleMesh;
using agvd::Vec2;
using agvd::Vec3;

namespace {

double ball(const Vec3& p) { return p.norm() - 1; }

double torus(const Vec3& p) {
    const double ring = p.head<2>().norm() - 1;
    return std::sqrt(ring * ring + p.z() * p.z()) - 0.4;
}

double rounded_cube(const Vec3& p) { return p.cwiseAbs2().squaredNorm() - 1; }

// Eight corners joined along the twelve edges of a cube: genus 5.
double frame(const Vec3& p) {
    const Vec3 square = p.cwiseAbs2();
    return square.squaredNorm() - 5 * square.sum() + 11.8;
}

constexpr Index ring_around = 64, ring_rows = 32;

// Calls add(corners) for each face of the ring; a corner is a column and a row.
template <typename Add>
void for_each_ring_face(const Add& add) {
    using Corner = std::array<Index, 2>;
    for (Index i = 0; i < ring_around; ++i) {
        for (Index j = 0; j < ring_rows; ++j) {
            const Corner a{i, j}, b{i + 1, j}, c{i + 1, j + 1}, d{i, j + 1};
            add(std::array{a, c, b});
            add(std::array{a, d, c});
        }
    }
}

}  // namespace

TriangleMesh shell() {
    constexpr Index around = 96, rows = 32;
    TriangleMesh mesh;
    for (Index j = 0; j <= rows; ++j) {
        const double v = static_cast<double>(j) / rows;
        const double radius = 0.55 + 1.6 * v * (1 - v) * (0.9 - v) + 0.35 * v * v * v * v * v;
        for (Index i = 0; i < around; ++i) {
            // Every other row is shifted by half a step, for triangles close to regular.
            const double turn = (i + 0.5 * (j % 2)) / around;
            const double wave = 1 + (0.02 + 0.12 * v * v) * unit_circle(6 * turn + 0.6 * v).x();
            const Vec2 p = radius * wave * unit_circle(turn);
            mesh.positions.emplace_back(six_decimals(p.x()), six_decimals(2 * v),
                                        six_decimals(p.y()));
        }
    }
    for (Index j = 0; j < rows; ++j) {
        for (Index i = 0; i < around; ++i) {
            const Index next = (i + 1) % around;
            const Index a = j * around + i, b = j * around + next;
            const Index c = a + around, d = b + around;  // above them
            if (j % 2 == 0) {
                mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {b, c, d}});
            } else {
                mesh.triangles.insert(mesh.triangles.end(), {{a, d, b}, {a, c, d}});
            }
        }
    }
    return mesh;
}

TriangleMesh plate() {
    constexpr Index columns = 40, rows = 24;
    constexpr double cell = 2.5, thickness = 0.2;  // 100 x 60 x 0.2
    TriangleMesh mesh;
    const auto vertex = [](Index side, Index i, Index j) {
        return (side * (columns + 1) + i) * (rows + 1) + j;
    };
    const auto add_quad = [&](Index a, Index b, Index c, Index d) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
    };
    for (const Index side : {0U, 1U}) {
        for (Index i = 0; i <= columns; ++i) {
            for (Index j = 0; j <= rows; ++j) {
                Vec2 p(i, j);
                if (i > 0 && i < columns && j > 0 && j < rows) {  // the two sides differ
                    const Index v = vertex(side, i, j);
                    p += 0.5 * Vec2(agvd::random_unit(3, 0, v), agvd::random_unit(3, 1, v));
                    p -= Vec2(0.25, 0.25);
                }
                mesh.positions.emplace_back(cell * p.x(), cell * p.y(), thickness * side);
            }
        }
    }
    for (Index i = 0; i < columns; ++i) {
        for (Index j = 0; j < rows; ++j) {
            add_quad(vertex(0, i, j), vertex(0, i, j + 1), vertex(0, i + 1, j + 1),
                     vertex(0, i + 1, j));
            add_quad(vertex(1, i, j), vertex(1, i + 1, j), vertex(1, i + 1, j + 1),
                     vertex(1, i, j + 1));
        }
    }
    const auto add_rim = [&](Index i, Index j, Index k, Index l) {
        add_quad(vertex(0, i, j), vertex(0, k, l), vertex(1, k, l), vertex(1, i, j));
    };
    for (Index i = 0; i < columns; ++i) {
        add_rim(i, 0, i + 1, 0);
        add_rim(i + 1, rows, i, rows);
    }
    for (Index j = 0; j < rows; ++j) {
        add_rim(columns, j, columns, j + 1);
        add_rim(0, j + 1, 0, j);
    }
    return mesh;
}

TriangleMesh parts() {
    struct Part {
        double (*field)(const Vec3&);
        Vec3 inside;
        double spacing;  // where the field is about 1 in radius
        double scale;
        Vec3 center;
    };
    TriangleMesh mesh;
    for (const Part& part : {Part{ball, {0, 0, 0}, 0.14, 500, {0, 0, 0}},
                             Part{frame, {1.5, 1.5, 1.5}, 0.45, 60, {700, 0, 0}},
                             Part{torus, {1, 0, 0}, 0.16, 15, {880, 0, 0}},
                             Part{rounded_cube, {0, 0, 0}, 0.2, 3, {920, 0, 0}},
                             Part{ball, {0, 0, 0}, 0.3, 0.5, {930, 0, 0}}}) {
        const auto place = [](const Vec3& q) { return q; };
        const TriangleMesh piece =
            contour(part.field, {.place = place, .inside = part.inside, .spacing = part.spacing});
        const auto offset = static_cast<Index>(mesh.positions.size());
        for (const Vec3& p : piece.positions) {
            mesh.positions.push_back(part.center + part.scale * p);
        }
        for (const auto& [a, b, c] : piece.triangles) {
            mesh.triangles.push_back({a + offset, b + offset, c + offset});
        }
    }
    return mesh;
}

TriangleMesh ring() {
    TriangleMesh mesh;
    for (Index i = 0; i < ring_around; ++i) {
        const Vec2 turn = unit_circle(static_cast<double>(i) / ring_around);
        for (Index j = 0; j < ring_rows; ++j) {
            const Vec2 tube = unit_circle(static_cast<double>(j) / ring_rows);
            const double radius = 1 + 0.4 * tube.x();
            mesh.positions.emplace_back(six_decimals(radius * turn.x()),
                                        six_decimals(0.4 * tube.y()),
                                        six_decimals(radius * turn.y()));
        }
    }
    for_each_ring_face([&](const std::array<std::array<Index, 2>, 3>& corners) {
        Triangle triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            triangle[k] = corners[k][0] % ring_around * ring_rows + corners[k][1] % ring_rows;
        }
        mesh.triangles.push_back(triangle);
    });
    return mesh;
}

std::vector<remesh::CornerCoordinates> ring_texture() {
    std::vector<remesh::CornerCoordinates> texture;
    for_each_ring_face([&](const std::array<std::array<Index, 2>, 3>& corners) {
        const auto at = [&](std::size_t k) {
            return Vec2(static_cast<double>(corners[k][0]) / ring_around,
                        static_cast<double>(corners[k][1]) / ring_rows);
        };
        texture.push_back({at(0), at(1), at(2)});
    });
    return texture;
}

TriangleMesh slivers() {
    const auto place = [](const Vec3& q) { return q; };
    const TriangleMesh base =
        contour(torus, {.place = place, .inside = Vec3(1, 0, 0), .spacing = 0.25});
    TriangleMesh mesh{base.positions, {}};
    for (std::size_t f = 0; f < base.triangles.size(); ++f) {
        const auto& [a, b, c] = base.triangles[f];
        if (f % 3 == 2) {
            mesh.triangles.push_back({a, b, c});
            continue;
        }
        // One more corner, by turns very close to an edge (a cap) or to a corner (two needles).
        const Vec3 &p = base.positions[a], &q = base.positions[b], &r = base.positions[c];
        const Vec3 cap = (p + q) / 2 + 1e-5 * (r - (p + q) / 2);
        const Vec3 needle = p + 1e-4 * ((q + r) / 2 - p);
        const auto d = static_cast<Index>(mesh.positions.size());
        mesh.positions.push_back(f % 3 == 0 ? cap : needle);
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}, {c, a, d}});
    }
    return mesh;
}

}  // namespace make_data
