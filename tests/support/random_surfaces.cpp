// Surfaces of high genus, with thin tubes, spikes, many components and boundary loops. Plates with
// holes and frames of rods are boundaries of sets of cubes; tubes, cones and knots are rings of
// vertices joined in order. Loops are opened by removing faces far from each other.
#include "support/random_surfaces.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <string_view>

#include "support/dice.h"
#include "support/shapes.h"

namespace random_surfaces {
namespace {

using agvd::Index;
using agvd::Triangle;
using agvd::TriangleMesh;
using agvd::Vec3;

constexpr double pi = std::numbers::pi;

// The boundary of a set of unit cubes; manifold if no two cubes meet in an edge or corner alone.
TriangleMesh boundary_of(const std::vector<std::array<int, 3>>& cubes) {
    std::map<std::array<int, 3>, Index> vertex;
    std::map<std::array<int, 3>, bool> is_full;
    for (const auto& c : cubes) is_full[c] = true;
    TriangleMesh mesh;
    const auto at = [&](const std::array<int, 3>& p) {
        const auto [found, is_new] = vertex.emplace(p, static_cast<Index>(mesh.positions.size()));
        if (is_new) mesh.positions.emplace_back(p[0], p[1], p[2]);
        return found->second;
    };
    for (const auto& c : cubes) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int side : {0, 1}) {
                auto beyond = c;
                beyond[axis] += side == 1 ? 1 : -1;
                if (is_full.contains(beyond)) continue;
                std::array<Index, 4> q{};
                for (int i = 0; i < 4; ++i) {
                    auto p = c;
                    p[axis] += side;
                    p[(axis + 1) % 3] += i == 1 || i == 2 ? 1 : 0;
                    p[(axis + 2) % 3] += i >= 2 ? 1 : 0;
                    q[static_cast<std::size_t>(i)] = at(p);
                }
                if (side == 0) std::swap(q[1], q[3]);
                mesh.triangles.push_back({q[0], q[1], q[2]});
                mesh.triangles.push_back({q[0], q[2], q[3]});
            }
        }
    }
    return mesh;
}

// Rings of `sides` vertices around given centres; the ends closed by a fan to a point, or open.
struct Ring {
    Vec3 centre, u, v;  // u and v: half axes.
};
TriangleMesh skin(const std::vector<Ring>& rings, Index sides, const Vec3* first, const Vec3* last,
                  bool is_closed) {
    TriangleMesh mesh;
    for (const Ring& ring : rings) {
        for (Index k = 0; k < sides; ++k) {
            const double angle = 2 * pi * k / sides;
            mesh.positions.emplace_back(ring.centre + std::cos(angle) * ring.u +
                                        std::sin(angle) * ring.v);
        }
    }
    const auto count = static_cast<Index>(rings.size());
    for (Index i = 0; i < (is_closed ? count : count - 1); ++i) {
        for (Index k = 0; k < sides; ++k) {
            const Index a = i * sides + k, b = i * sides + (k + 1) % sides;
            const Index next = (i + 1) % count;
            const Index c = next * sides + (k + 1) % sides, d = next * sides + k;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
    }
    if (first != nullptr) {
        const auto tip = static_cast<Index>(mesh.positions.size());
        mesh.positions.push_back(*first);
        for (Index k = 0; k < sides; ++k) mesh.triangles.push_back({tip, (k + 1) % sides, k});
    }
    if (last != nullptr) {
        const auto tip = static_cast<Index>(mesh.positions.size());
        mesh.positions.push_back(*last);
        const Index row = (count - 1) * sides;
        for (Index k = 0; k < sides; ++k) {
            mesh.triangles.push_back({tip, row + k, row + (k + 1) % sides});
        }
    }
    return mesh;
}

TriangleMesh holed_plate(Dice& dice) {
    const Index genus = dice.count(0, 20);
    const Index n = 3 + 2 * dice.count(genus > 8 ? 3 : 1, 6), m = 3 + 2 * dice.count(3, 6);
    std::vector<std::pair<Index, Index>> cells;
    for (Index i = 1; i + 1 < n; i += 2) {
        for (Index j = 1; j + 1 < m; j += 2) cells.emplace_back(i, j);
    }
    while (cells.size() > genus) {
        cells.erase(cells.begin() + dice.count(0, static_cast<Index>(cells.size()) - 1));
    }
    return plate(n, m, cells, n * dice.magnitude(1e-3, 0.3));
}

TriangleMesh lattice_frame(Dice& dice) {
    return lattice(dice.count(1, 3), dice.count(1, 3), dice.count(1, 3));
}

TriangleMesh long_tube(Dice& dice) {
    const Index sides = dice.count(3, 12), steps = dice.count(2, 60);
    const double length = dice.magnitude(1, 1000);
    std::vector<Ring> rings;
    for (Index i = 0; i <= steps; ++i) {
        rings.push_back({{0, 0, length * i / steps}, {1, 0, 0}, {0, dice.one_in(2) ? 1. : 0.3, 0}});
    }
    const Vec3 low(0, 0, -0.5), high(0, 0, length + 0.5);
    const Index ends = dice.count(0, 2);
    return skin(rings, sides, ends >= 1 ? &low : nullptr, ends >= 2 ? &high : nullptr, false);
}

TriangleMesh sharp_cone(Dice& dice) {
    const Index sides = dice.count(3, 30), steps = dice.count(1, 20);
    const double height = dice.magnitude(0.5, 300);
    std::vector<Ring> rings;
    for (Index i = 0; i < steps; ++i) {
        const double r = 1 - static_cast<double>(i) / steps;
        rings.push_back({{0, 0, height * (1 - r)}, {r, 0, 0}, {0, r, 0}});
    }
    const Vec3 base(0, 0, dice.one_in(2) ? 0 : -0.3), tip(0, 0, height);
    return skin(rings, sides, dice.one_in(4) ? nullptr : &base, &tip, false);
}

TriangleMesh flat(Dice& dice) {
    const bool is_strip = dice.one_in(3);
    TriangleMesh mesh = shapes::grid(dice.count(1, is_strip ? 5 : 40));
    const double narrow = dice.magnitude(is_strip ? 1e-3 : 0.1, 1);
    for (Vec3& p : mesh.positions) p.y() *= narrow;
    return mesh;
}

TriangleMesh ball(Dice& dice) {
    TriangleMesh mesh = shapes::jitter(shapes::sphere(static_cast<int>(dice.count(0, 4))), 0.01,
                                       dice.count(0, 1000));
    const Vec3 stretch(dice.magnitude(0.02, 1), dice.magnitude(0.2, 1), 1);
    for (Vec3& p : mesh.positions) p = p.cwiseProduct(stretch);
    return mesh;
}

TriangleMesh ring(Dice& dice) {
    return shapes::torus(dice.count(5, 60), dice.count(3, 20), dice.magnitude(0.01, 0.6));
}

TriangleMesh knot(Dice& dice) {
    return torus_knot(2, 3 + 2 * dice.count(0, 1), dice.count(60, 150), dice.count(4, 8),
                      dice.magnitude(0.02, 0.25));
}

// Removes faces far from each other and from the boundary: each gives a loop.
void open_loops(Dice& dice, TriangleMesh& mesh, Index count) {
    std::map<std::pair<Index, Index>, int> sides;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++sides[std::minmax(t[k], t[(k + 1) % 3])];
        }
    }
    std::vector<bool> is_taken(mesh.positions.size(), false);
    for (const auto& [ends, number] : sides) {
        if (number == 1) is_taken[ends.first] = is_taken[ends.second] = true;
    }
    for (Index tries = 0; count > 0 && tries < 200; ++tries) {
        const Index f = dice.count(0, static_cast<Index>(mesh.triangles.size()) - 1);
        const Triangle t = mesh.triangles[f];
        if (mesh.triangles.size() < 8 || is_taken[t[0]] || is_taken[t[1]] || is_taken[t[2]]) {
            continue;
        }
        for (const Triangle& near : mesh.triangles) {  // So that no two loops touch.
            const bool touches = std::any_of(near.begin(), near.end(), [&](Index v) {
                return v == t[0] || v == t[1] || v == t[2];
            });
            if (!touches) continue;
            for (const Index v : near) is_taken[v] = true;
        }
        mesh.triangles.erase(mesh.triangles.begin() + f);
        --count;
    }
}

struct Family {
    const char* name;
    TriangleMesh (*make)(Dice&);
};
constexpr Family single[] = {{"holed_plate", holed_plate},
                             {"lattice_frame", lattice_frame},
                             {"long_tube", long_tube},
                             {"sharp_cone", sharp_cone},
                             {"flat", flat},
                             {"ball", ball},
                             {"ring", ring},
                             {"knot", knot}};
constexpr const char* names[] = {"holed_plate", "lattice_frame", "long_tube", "sharp_cone", "flat",
                                 "ball",        "ring",          "knot",      "several"};

TriangleMesh make_single(const Family& family, Dice& dice) {
    TriangleMesh mesh = family.make(dice);
    if (dice.one_in(3)) open_loops(dice, mesh, dice.count(1, 6));
    return mesh;
}

}  // namespace

std::span<const char* const> families() { return names; }

TriangleMesh make(std::string_view family, std::uint64_t seed) {
    Dice dice(seed);
    for (const Family& f : single) {
        if (family == f.name) return make_single(f, dice);
    }
    TriangleMesh all;
    const Index count = dice.count(2, 10);
    for (Index i = 0; i < count; ++i) {
        const Family& f = single[dice.count(0, std::size(single) - 1)];
        TriangleMesh mesh = make_single(f, dice);
        Vec3 low = mesh.positions[0], high = low;
        for (const Vec3& p : mesh.positions) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
        const double scale = dice.magnitude(0.01, 1) / (high - low).norm();
        for (Vec3& p : mesh.positions) p = scale * (p - low) + Vec3(2 * i, 0, 0);
        all = i == 0 ? std::move(mesh) : shapes::join(all, mesh);
    }
    return all;
}

TriangleMesh torus_knot(Index p, Index q, Index steps, Index sides, double radius) {
    const auto curve = [&](double t) {
        const double r = 2 + std::cos(q * t);
        return Vec3(r * std::cos(p * t), r * std::sin(p * t), std::sin(q * t));
    };
    std::vector<Ring> rings;
    for (Index i = 0; i < steps; ++i) {
        const double t = 2 * pi * i / steps;
        const Vec3 here = curve(t);
        const Vec3 along = (curve(t + 1e-4) - curve(t - 1e-4)).normalized();
        // Away from the core circle of the torus: no twist adds up along the knot.
        const Vec3 core = 2 * Vec3(std::cos(p * t), std::sin(p * t), 0);
        const Vec3 u = (here - core - (here - core).dot(along) * along).normalized();
        rings.push_back({here, radius * u, radius * along.cross(u)});
    }
    return skin(rings, sides, nullptr, nullptr, true);
}

TriangleMesh lattice(Index n, Index m, Index k) {
    std::vector<std::array<int, 3>> cubes;
    const std::array<int, 3> size{static_cast<int>(2 * n), static_cast<int>(2 * m),
                                  static_cast<int>(2 * k)};
    for (int x = 0; x <= size[0]; ++x) {
        for (int y = 0; y <= size[1]; ++y) {
            for (int z = 0; z <= size[2]; ++z) {
                if (x % 2 + y % 2 + z % 2 <= 1) cubes.push_back({x, y, z});
            }
        }
    }
    return boundary_of(cubes);
}

TriangleMesh plate(Index n, Index m, const std::vector<std::pair<Index, Index>>& holes,
                   double thickness) {
    std::vector<std::array<int, 3>> cubes;
    for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j < m; ++j) {
            if (std::find(holes.begin(), holes.end(), std::pair(i, j)) != holes.end()) continue;
            cubes.push_back({static_cast<int>(i), static_cast<int>(j), 0});
        }
    }
    TriangleMesh mesh = boundary_of(cubes);
    for (Vec3& p : mesh.positions) p.z() *= thickness;
    return mesh;
}

}  // namespace random_surfaces
