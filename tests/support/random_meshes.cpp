// Each family of meshes is one function of random numbers: plane and bumpy grids, needles, saddles,
// cones of any angle, prisms, slit and reflex boundaries, folded sheets, solids and stacked faces.
// They are small, so that thousands can be compared with exact distances, and each has what is hard
// for some step: saddles, boundaries that bend paths, slivers, ties or sheets that touch.
#include "support/random_meshes.h"

#include <algorithm>
#include <numbers>
#include <string_view>

#include "support/dice.h"
#include "support/shapes.h"

namespace random_meshes {
namespace {

using agvd::Index;
using agvd::Triangle;
using agvd::TriangleMesh;
using agvd::Vec3;

constexpr double pi = std::numbers::pi;

// n x m unit squares; vertex (i, j) is i (m + 1) + j. `rises(i, j)` chooses the diagonal of a
// square.
template <typename Rises>
TriangleMesh plane(Index n, Index m, const Rises& rises) {
    TriangleMesh mesh;
    for (Index i = 0; i <= n; ++i) {
        for (Index j = 0; j <= m; ++j) mesh.positions.emplace_back(i, j, 0);
    }
    for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j < m; ++j) {
            const Index a = i * (m + 1) + j, b = a + m + 1, c = b + 1, d = a + 1;
            if (rises(i, j)) {
                mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
            } else {
                mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
            }
        }
    }
    return mesh;
}

TriangleMesh plane(Dice& dice, Index n, Index m) {
    const Index pattern = dice.count(0, 2);
    return plane(n, m, [&](Index i, Index j) {
        return pattern == 0 || (pattern == 1 ? (i + j) % 2 == 0 : dice.one_in(2));
    });
}

// Less than half a square, so that no face of a plane turns over.
void shake(Dice& dice, TriangleMesh& mesh, double in_plane, double height) {
    for (Vec3& p : mesh.positions) {
        p += Vec3(dice.number(-in_plane, in_plane), dice.number(-in_plane, in_plane),
                  dice.number(-height, height));
    }
}

void stretch(TriangleMesh& mesh, const Vec3& factors) {
    for (Vec3& p : mesh.positions) p = p.cwiseProduct(factors);
}

TriangleMesh flat_grid(Dice& dice) { return plane(dice, dice.count(1, 9), dice.count(1, 9)); }

TriangleMesh jittered_grid(Dice& dice) {
    TriangleMesh mesh = plane(dice, dice.count(2, 9), dice.count(2, 9));
    shake(dice, mesh, dice.number(0, 0.24), dice.one_in(2) ? 0 : dice.number(0, 1));
    return mesh;
}

TriangleMesh needles(Dice& dice) {
    TriangleMesh mesh = plane(dice, dice.count(2, 8), dice.count(1, 8));
    shake(dice, mesh, dice.number(0, 0.2), dice.one_in(2) ? 0 : dice.number(0, 0.5));
    stretch(mesh, {dice.magnitude(1e-4, 0.1), 1, dice.one_in(2) ? 1 : 0.01});
    return mesh;
}

TriangleMesh saddle(Dice& dice) {
    const Index n = dice.count(2, 8);
    TriangleMesh mesh = plane(dice, n, n);
    shake(dice, mesh, dice.one_in(2) ? 0 : 0.2, 0);
    const double bend = dice.magnitude(0.1, 5);
    const bool is_monkey = dice.one_in(3);  // Three ways down instead of two.
    for (Vec3& p : mesh.positions) {
        const double x = 2 * p.x() / n - 1, y = 2 * p.y() / n - 1;
        p = {x, y, bend * (is_monkey ? x * x * x - 3 * x * y * y : x * x - y * y)};
    }
    return mesh;
}

// A fan of triangles around a vertex of any cone angle, alternately up and down if this is above 2
// pi; then subdivided: the cone stays, all new vertices have no curvature.
TriangleMesh cone_fan(Dice& dice, Index rim, double depth) {
    TriangleMesh mesh;
    mesh.positions.emplace_back(0, 0, 0);
    for (Index i = 0; i < rim; ++i) {
        const double u = 2 * pi * i / rim;
        mesh.positions.emplace_back(std::cos(u), std::sin(u), depth * (i % 2 == 0 ? 1 : -1));
        mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % rim});
    }
    for (Index i = dice.count(0, 2); i > 0 && mesh.triangles.size() < 100; --i) {
        mesh = shapes::subdivide(mesh);
    }
    return mesh;
}

TriangleMesh hyperbolic(Dice& dice) {
    TriangleMesh mesh = cone_fan(dice, 2 * dice.count(2, 6), dice.magnitude(0.2, 3));
    if (dice.one_in(3)) shake(dice, mesh, 0.02, 0.02);
    return mesh;
}

// Open, or closed by its base; from a flat disc to a spike.
TriangleMesh cone(Dice& dice) {
    const Index rim = dice.count(3, 16);
    TriangleMesh mesh = cone_fan(dice, rim, 0);
    const double height = dice.one_in(4) ? 0 : dice.magnitude(0.01, 30);
    for (Vec3& p : mesh.positions) p.z() = -height * std::hypot(p.x(), p.y());
    if (mesh.triangles.size() == rim && dice.one_in(2)) {
        for (Index i = 1; i + 1 < rim; ++i) mesh.triangles.push_back({1, 1 + i + 1, 1 + i});
    }
    return mesh;
}

TriangleMesh prism(Dice& dice) {
    const Index n = dice.count(3, 12), layers = dice.count(1, 4);
    const double height = dice.magnitude(0.01, 100);
    TriangleMesh mesh;
    for (Index layer = 0; layer <= layers; ++layer) {
        for (Index i = 0; i < n; ++i) {
            const double u = 2 * pi * i / n;
            mesh.positions.emplace_back(std::cos(u), std::sin(u), height * layer / layers);
        }
    }
    for (Index layer = 0; layer < layers; ++layer) {
        for (Index i = 0; i < n; ++i) {
            const Index a = layer * n + i, b = layer * n + (i + 1) % n;
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, b + n}, {a, b + n, a + n}});
        }
    }
    const Index top = layers * n;
    for (Index i = 1; i + 1 < n; ++i) {  // Fans: slivers.
        mesh.triangles.insert(mesh.triangles.end(), {{0, i + 1, i}, {top, top + i, top + i + 1}});
    }
    if (dice.one_in(3)) shake(dice, mesh, 0.02, 0.02 * std::min(height, 1.0) / layers);
    return mesh;
}

// Removes the squares (two faces each) of an n x n plane that `is_out`.
template <typename IsOut>
void cut_out(TriangleMesh& mesh, Index n, const IsOut& is_out) {
    std::vector<Triangle> left;
    for (Index square = 0; square < n * n; ++square) {
        if (is_out(square / n, square % n)) continue;
        left.push_back(mesh.triangles[2 * square]);
        left.push_back(mesh.triangles[2 * square + 1]);
    }
    mesh.triangles = std::move(left);
}

// Cuts along the column from the lower rim: the faces on its right get vertices of their own.
void slit(TriangleMesh& mesh, Index n, Index column, Index depth) {
    const Index copies = static_cast<Index>(mesh.positions.size());
    const auto first = column * (n + 1);
    for (Index j = 0; j < depth; ++j) {
        const Vec3 place = mesh.positions[first + j];
        mesh.positions.push_back(place);
    }
    for (Index square = column * n; square < n * n; ++square) {
        for (std::size_t t = 2 * std::size_t{square}; t < 2 * std::size_t{square} + 2; ++t) {
            for (Index& v : mesh.triangles[t]) {
                if (v >= first && v < first + depth) v = copies + v - first;
            }
        }
    }
}

TriangleMesh reflex_boundary(Dice& dice) {
    const Index n = dice.count(4, 9);
    TriangleMesh mesh = plane(dice, n, n);
    const double rough = dice.one_in(2) ? 0 : 0.2;
    shake(dice, mesh, rough, dice.one_in(2) ? 0 : rough);
    const Index a = dice.count(1, n - 2), b = dice.count(a + 1, n - 1);
    const Index c = dice.count(1, n - 2), d = dice.count(c + 1, n - 1);
    switch (dice.count(0, 4)) {
        case 0:  // An L.
            cut_out(mesh, n, [&](Index i, Index j) { return i >= a && j >= c; });
            break;
        case 1:  // A hole.
            cut_out(mesh, n, [&](Index i, Index j) { return i >= a && i < b && j >= c && j < d; });
            break;
        case 2:  // A comb, or a meander.
            cut_out(mesh, n, [&](Index i, Index j) {
                return i % 2 == 1 && (i % 4 == 1 || a % 2 == 0 ? j < d : j >= c);
            });
            break;
        default:
            slit(mesh, n, a, c);
            if (b > a && dice.one_in(2)) {  // Two of them: around both corners.
                const Index column = b;
                slit(mesh, n, column, d);
            }
    }
    return mesh;
}

// The same positions twice: two sheets apart, joined along a fold, or all around.
TriangleMesh two_sheets(Dice& dice) {
    const Index n = 2 * dice.count(1, 4);
    const Index kind = dice.count(0, 2);
    if (kind == 0) {
        TriangleMesh mesh = plane(dice, n, n);
        shake(dice, mesh, 0.2, 0.2);
        return shapes::join(mesh, mesh);
    }
    if (kind == 1) {
        TriangleMesh mesh = plane(dice, n, n);
        for (Vec3& p : mesh.positions) p.x() = std::min(p.x(), n - p.x());
        return mesh;
    }
    // Diagonals leave the corners: no inner edge joins two vertices of the rim.
    TriangleMesh mesh = plane(n, n, [&](Index i, Index j) { return (2 * i < n) == (2 * j < n); });
    const auto num_vertices = static_cast<Index>(mesh.positions.size());
    std::vector<Index> other(num_vertices);
    for (Index v = 0; v < num_vertices; ++v) {
        const Vec3 p = mesh.positions[v];
        const bool is_rim = p.x() == 0 || p.x() == n || p.y() == 0 || p.y() == n;
        other[v] = is_rim ? v : static_cast<Index>(mesh.positions.size());
        if (!is_rim) mesh.positions.push_back(p);
    }
    for (std::size_t t = 0, front = mesh.triangles.size(); t < front; ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        mesh.triangles.push_back({other[a], other[c], other[b]});
    }
    return mesh;
}

TriangleMesh octahedron() {
    return {
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

TriangleMesh solid(Dice& dice) {
    const Index kind = dice.count(0, 3);
    TriangleMesh mesh = kind == 0   ? shapes::tetrahedron()
                        : kind == 1 ? shapes::cube()
                        : kind == 2 ? octahedron()
                                    : shapes::icosahedron();
    for (Index i = dice.count(0, 2); i > 0; --i) mesh = shapes::subdivide(mesh);
    if (dice.one_in(3)) {
        stretch(mesh, {1, dice.magnitude(0.1, 10), dice.magnitude(0.01, 10)});
    }
    return mesh;
}

TriangleMesh curved(Dice& dice) {
    TriangleMesh mesh;
    switch (dice.count(0, 2)) {
        case 0:
            mesh = shapes::sphere(static_cast<int>(dice.count(1, 2)));
            break;
        case 1:
            mesh = shapes::torus(dice.count(4, 14), dice.count(3, 9), dice.number(0.1, 0.8));
            break;
        default:
            mesh = shapes::tube(dice.count(3, 14), dice.count(1, 8));
    }
    const double amount = dice.one_in(3) ? 0 : dice.number(0, 0.04);
    shake(dice, mesh, amount, amount);
    return mesh;
}

// Splits faces in three at random places: obtuse, then nearly degenerate ones.
TriangleMesh stacked(Dice& dice) {
    TriangleMesh mesh = dice.one_in(2)
                            ? TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0.3, 0.8, 0}}, {{0, 1, 2}}}
                            : shapes::tetrahedron();
    const double thinnest = dice.magnitude(1e-5, 0.3);
    for (Index i = dice.count(2, 60); i > 0; --i) {
        const auto face = dice.count(0, static_cast<Index>(mesh.triangles.size()) - 1);
        const auto [a, b, c] = mesh.triangles[face];
        const auto& p = mesh.positions;
        const double longest =
            std::max({(p[a] - p[b]).norm(), (p[b] - p[c]).norm(), (p[c] - p[a]).norm()});
        if ((p[b] - p[a]).cross(p[c] - p[a]).norm() < 1e-3 * thinnest * longest * longest) continue;
        const double u = dice.magnitude(thinnest, 1), v = dice.magnitude(thinnest, 1),
                     w = dice.magnitude(thinnest, 1);
        const Vec3 place = (u * p[a] + v * p[b] + w * p[c]) / (u + v + w);
        const auto d = static_cast<Index>(mesh.positions.size());
        mesh.positions.push_back(place);
        mesh.triangles[face] = {a, b, d};
        mesh.triangles.insert(mesh.triangles.end(), {{b, c, d}, {c, a, d}});
    }
    return mesh;
}

TriangleMesh components(Dice& dice);

struct Family {
    const char* name;
    TriangleMesh (*make)(Dice&);
};

constexpr Family all_families[] = {
    {"flat_grid", flat_grid},
    {"jittered_grid", jittered_grid},
    {"needles", needles},
    {"stacked", stacked},
    {"saddle", saddle},
    {"hyperbolic", hyperbolic},
    {"cone", cone},
    {"prism", prism},
    {"reflex_boundary", reflex_boundary},
    {"two_sheets", two_sheets},
    {"solid", solid},
    {"curved", curved},
    {"components", components},
};
constexpr std::size_t num_families = std::size(all_families);

constexpr auto names = [] {
    std::array<const char*, num_families> result{};
    for (std::size_t i = 0; i < num_families; ++i) result[i] = all_families[i].name;
    return result;
}();

TriangleMesh components(Dice& dice) {
    TriangleMesh mesh = flat_grid(dice);
    for (Index i = dice.count(1, 2); i > 0; --i) {
        const Index family = dice.count(0, static_cast<Index>(num_families) - 2);  // Not itself.
        mesh = shapes::join(mesh, all_families[family].make(dice));
    }
    return mesh;
}

void place_at_random(Dice& dice, TriangleMesh& mesh) {
    const Eigen::Vector4d q(dice.number(-1, 1), dice.number(-1, 1), dice.number(-1, 1), 0.1);
    const Eigen::Matrix3d turn = Eigen::Quaterniond(q.normalized()).toRotationMatrix();
    const double scale = dice.magnitude(1e-3, 1e3);
    const Vec3 shift(dice.number(-5, 5), dice.number(-5, 5), dice.number(-5, 5));
    for (Vec3& p : mesh.positions) p = scale * (turn * p + shift);
}

}  // namespace

std::span<const char* const> families() { return names; }

TriangleMesh make(std::string_view family, std::uint64_t seed) {
    const auto* const found = std::find_if(std::begin(all_families), std::end(all_families),
                                           [&](const Family& f) { return f.name == family; });
    Dice dice(seed);
    TriangleMesh mesh = found->make(dice);
    if (dice.one_in(2)) place_at_random(dice, mesh);
    return mesh;
}

}  // namespace random_meshes
