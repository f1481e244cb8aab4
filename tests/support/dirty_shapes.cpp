// Meshes with one defect each (unwelded, one-sided, non-manifold edge or vertex, faces without
// area), and random damage to good meshes. The choices depend on the seed only.
#include "support/dirty_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agvd/core/error.h"
#include "agvd/core/random.h"
#include "support/dice.h"
#include "support/shapes.h"

namespace shapes {

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;

TriangleMesh unweld(const TriangleMesh& mesh) {
    TriangleMesh soup;
    for (const agvd::Triangle& t : mesh.triangles) {
        const auto first = static_cast<Index>(soup.positions.size());
        for (const Index v : t) soup.positions.push_back(mesh.positions[v]);
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    return soup;
}

TriangleMesh moebius(Index n) {
    TriangleMesh mesh;
    for (Index i = 0; i < n; ++i) {
        const double u = 2 * std::numbers::pi * i / n;
        for (const double s : {-0.3, 0.3}) {
            const double r = 1 + s * std::cos(u / 2);
            mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), s * std::sin(u / 2));
        }
    }
    for (Index i = 0; i < n; ++i) {
        const bool is_last = i + 1 == n;  // Where the strip meets its own start upside down.
        const Index a = 2 * i, b = a + 1, c = is_last ? 1 : a + 2, d = is_last ? 0 : a + 3;
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({b, c, d});
    }
    return mesh;
}

TriangleMesh book(Index pages) {
    TriangleMesh mesh{{{0, 0, 0}, {0, 0, 1}}, {}};
    for (Index i = 0; i < pages; ++i) {
        const double u = 2 * std::numbers::pi * i / pages;
        const Index c = 2 + 2 * i, d = c + 1;
        mesh.positions.emplace_back(std::cos(u), std::sin(u), 0);
        mesh.positions.emplace_back(std::cos(u), std::sin(u), 1);
        mesh.triangles.push_back({0, c, d});
        mesh.triangles.push_back({0, d, 1});
    }
    return mesh;
}

TriangleMesh hourglass() {
    TriangleMesh mesh = join(tetrahedron(), tetrahedron());
    for (Index v = 4; v < 8; ++v) mesh.positions[v] = 2 * mesh.positions[0] - mesh.positions[v];
    for (Index f = 4; f < 8; ++f) {
        agvd::Triangle& t = mesh.triangles[f];
        std::swap(t[1], t[2]);  // Mirrored positions: turn the faces outward again.
        for (Index& v : t) v = v == 4 ? 0 : v;
    }
    mesh.positions.erase(mesh.positions.begin() + 4);
    for (Index f = 4; f < 8; ++f) {
        for (Index& v : mesh.triangles[f]) v = v > 4 ? v - 1 : v;
    }
    return mesh;
}

TriangleMesh cubes_on_an_edge() {
    TriangleMesh mesh = join(cube(), cube());
    for (Index v = 8; v < 16; ++v) mesh.positions[v] += Vec3(1, 1, 0);
    for (agvd::Triangle& t : mesh.triangles) {
        for (Index& v : t) v = v == 8 ? 3 : v == 12 ? 7 : v;
    }
    return mesh;
}

TriangleMesh filled_slit(Index n) {
    TriangleMesh mesh{{{0, -1, 0}, {static_cast<double>(n), -1, 0}, {0, 1, 0}}, {}};
    const auto on_line = [](Index i) { return 3 + i; };
    for (Index i = 0; i <= n; ++i) mesh.positions.emplace_back(i, 0, 0);
    mesh.triangles = {{0, 1, on_line(n)}, {0, on_line(n), on_line(0)}};
    for (Index i = 0; i < n; ++i) mesh.triangles.push_back({on_line(i), on_line(i + 1), 2});
    for (Index i = 0; i + 1 < n; ++i) {
        mesh.triangles.push_back({on_line(i), on_line(n), on_line(i + 1)});
    }
    return mesh;
}

TriangleMesh slit_grid(Index n, Index begin, Index end) {
    TriangleMesh mesh = grid(n);
    for (Index i = begin + (begin > 0 ? 1 : 0); i < end + (end < n ? 0 : 1); ++i) {
        const Index below = i * (n + 1) + n / 2;
        const auto above = static_cast<Index>(mesh.positions.size());
        for (agvd::Triangle& t : mesh.triangles) {
            const double height =
                mesh.positions[t[0]].y() + mesh.positions[t[1]].y() + mesh.positions[t[2]].y();
            if (height > 1.5) std::replace(t.begin(), t.end(), below, above);
        }
        mesh.positions.push_back(Vec3(mesh.positions[below]));
    }
    return mesh;
}

TriangleMesh damage(TriangleMesh mesh, Index times, std::uint64_t seed) {
    for (Index i = 0; i < times && !mesh.triangles.empty(); ++i) {
        const auto pick = [&](std::uint64_t stream, std::size_t count) {
            return static_cast<Index>(agvd::random_bits(seed, stream, i) % count);
        };
        const Index face = pick(1, mesh.triangles.size());
        const Index vertex = pick(2, mesh.positions.size());
        agvd::Triangle& t = mesh.triangles[face];
        switch (pick(0, 8)) {
            case 0:
                std::swap(t[0], t[1]);
                break;
            case 1:
                mesh.triangles.push_back(agvd::Triangle(t));
                break;
            case 2:
                mesh.triangles.push_back({t[1], t[0], t[2]});
                break;
            case 3:
                mesh.triangles.erase(mesh.triangles.begin() + face);
                break;
            case 4:
                t[pick(3, 3)] = vertex;
                break;
            case 5:
                mesh.positions.push_back(Vec3(mesh.positions[t[0]]));
                t[0] = static_cast<Index>(mesh.positions.size() - 1);
                break;
            case 6:
                mesh.positions.push_back(Vec3(mesh.positions[vertex]));
                break;
            default:
                mesh.positions[vertex] = Vec3(mesh.positions[t[0]]);
                break;
        }
    }
    return mesh;
}

TriangleMesh random_soup(Index vertices, Index faces, std::uint64_t seed) {
    TriangleMesh mesh;
    for (Index v = 0; v < vertices; ++v) {
        const auto on_lattice = [&](std::uint64_t axis) {
            return static_cast<double>(agvd::random_bits(seed, axis, v) % 4);
        };
        mesh.positions.emplace_back(on_lattice(0), on_lattice(1), on_lattice(2));
    }
    for (Index f = 0; f < faces; ++f) {
        const auto corner = [&](std::uint64_t stream) {
            return static_cast<Index>(agvd::random_bits(seed, stream, f) % vertices);
        };
        mesh.triangles.push_back({corner(3), corner(4), corner(5)});
    }
    return mesh;
}

TriangleMesh dirty_solids(std::uint64_t seed) {
    Dice dice(seed);
    const auto vector = [&](double size) {
        return Vec3(dice.number(-size, size), dice.number(-size, size), dice.number(-size, size));
    };
    const auto size = [&] { return dice.magnitude(0.05, 1); };
    TriangleMesh soup;
    for (Index parts = dice.count(1, 8); parts > 0; --parts) {
        TriangleMesh part;
        switch (dice.count(0, 3)) {
            case 0:
                part = sphere(static_cast<int>(dice.count(0, 2)));
                break;
            case 1:
                part = grid(dice.count(1, 3));
                break;
            case 2:
                for (Index i = dice.count(1, 5); i > 0; --i) {  // Needles.
                    const Vec3 from = vector(1), to = vector(1);
                    const Vec3 beside = to + vector(dice.magnitude(1e-9, 1e-2));
                    part = join(part, {{from, to, beside}, {{0, 1, 2}}});
                }
                break;
            default:
                part = cube();
        }
        if (dice.one_in(3)) part = jitter(unweld(part), dice.magnitude(1e-6, 1e-2), seed);
        const Vec3 scale(size(), size(), size()), axis = vector(1), middle = vector(1);
        const bool is_turned = dice.one_in(2);  // Else boxes may have planes in common.
        const Eigen::AngleAxisd turn(is_turned ? dice.number(0, 3) : 0, axis.normalized());
        for (Vec3& p : part.positions) p = turn * p.cwiseProduct(scale) + middle;
        soup = join(soup, dice.one_in(6) ? join(part, part) : part);
    }
    for (agvd::Triangle& t : soup.triangles) {
        if (dice.one_in(50)) std::swap(t[0], t[1]);
    }
    return soup;
}

TriangleMesh spiked(std::uint64_t seed, agvd::Index most) {
    TriangleMesh mesh = subdivide(cube());
    mesh.triangles.resize(mesh.triangles.size() * 3 / 4);
    Dice dice(seed);
    for (int i = 0; i < 6; ++i) {
        agvd::Vec3& p =
            mesh.positions[dice.count(0, static_cast<agvd::Index>(mesh.positions.size()) - 1)];
        p[dice.count(0, 2)] *= std::pow(10.0, dice.count(0, most));
    }
    return mesh;
}

std::optional<agvd::Surface> spiked_surface(std::uint64_t seed) {
    try {
        return agvd::build_surface(spiked(seed).view());
    } catch (const agvd::InvalidInput&) {
        return std::nullopt;
    }
}

}  // namespace shapes
