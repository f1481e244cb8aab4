// Meshes by formula: grid, tetrahedron, cube, icosahedron, sphere, torus and tubes, and operations
// on meshes: subdivide, move vertices, put them in another order, join two meshes, insert vertices
// without curvature.
// Coordinates and numbering are the same in every run, so that tests can state exact values.
#include "support/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "agvd/core/random.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/surface_points.h"
#include "support/dice.h"

namespace shapes {

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;

namespace {

// Quads (i, j) of an n x m net of vertices, wrapped around where asked; `id` names the vertex.
template <typename VertexOf>
void add_quads(TriangleMesh& mesh, Index n, Index m, const VertexOf& id) {
    for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j < m; ++j) {
            const Index a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), d = id(i, j + 1);
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
    }
}

}  // namespace

TriangleMesh grid(Index n) {
    TriangleMesh mesh;
    for (Index i = 0; i <= n; ++i) {
        for (Index j = 0; j <= n; ++j) {
            mesh.positions.emplace_back(static_cast<double>(i) / n, static_cast<double>(j) / n, 0);
        }
    }
    add_quads(mesh, n, n, [n](Index i, Index j) { return i * (n + 1) + j; });
    return mesh;
}

TriangleMesh tetrahedron() {
    return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
            {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

TriangleMesh cube() {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

TriangleMesh icosahedron() {
    const double g = std::numbers::phi;
    TriangleMesh mesh{
        {{-1, g, 0},
         {1, g, 0},
         {-1, -g, 0},
         {1, -g, 0},
         {0, -1, g},
         {0, 1, g},
         {0, -1, -g},
         {0, 1, -g},
         {g, 0, -1},
         {g, 0, 1},
         {-g, 0, -1},
         {-g, 0, 1}},
        {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
         {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
         {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    for (Vec3& p : mesh.positions) p.normalize();
    return mesh;
}

TriangleMesh sphere(int levels) {
    TriangleMesh mesh = icosahedron();
    for (int i = 0; i < levels; ++i) {
        mesh = subdivide(mesh);
        for (Vec3& p : mesh.positions) p.normalize();
    }
    return mesh;
}

TriangleMesh torus(Index n, Index m, double tube_radius) {
    TriangleMesh mesh;
    for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j < m; ++j) {
            const double u = 2 * std::numbers::pi * i / n;
            const double v = 2 * std::numbers::pi * j / m;
            const double r = 1 + tube_radius * std::cos(v);
            mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u),
                                        tube_radius * std::sin(v));
        }
    }
    add_quads(mesh, n, m, [n, m](Index i, Index j) { return (i % n) * m + j % m; });
    return mesh;
}

TriangleMesh tube(Index n, Index m) {
    TriangleMesh mesh;
    for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j <= m; ++j) {
            const double u = 2 * std::numbers::pi * i / n;
            mesh.positions.emplace_back(std::cos(u), std::sin(u), 2.0 * j / m);
        }
    }
    add_quads(mesh, n, m, [n, m](Index i, Index j) { return (i % n) * (m + 1) + j; });
    return mesh;
}

TriangleMesh lips(Index n, Index m, Index teeth) {
    TriangleMesh mesh;
    std::vector<Index> number(n * (m + 1), agvd::no_index);
    const auto vertex = [&](Index i, Index j) {
        Index& v = number[(i % n) * (m + 1) + j];
        if (v == agvd::no_index) {
            v = static_cast<Index>(mesh.positions.size());
            const double u = 2 * std::numbers::pi * (i % n) / n, z = 2.0 * j / m;
            const double r = 1 + 0.15 * std::sin(3 * u) * std::sin(3 * z);
            mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), z);
        }
        return v;
    };
    for (Index j = 0; j < m; ++j) {
        for (Index i = 0; i < n; ++i) {
            if (4 * j >= 3 * m && i < 2 * teeth && i % 2 == 1) continue;
            const Index a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                        d = vertex(i, j + 1);
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
    }
    return mesh;
}

TriangleMesh subdivide(const TriangleMesh& mesh) {
    TriangleMesh fine{mesh.positions, {}};
    std::map<std::pair<Index, Index>, Index> midpoint;
    const auto middle = [&](Index a, Index b) {
        const auto [it, is_new] =
            midpoint.try_emplace(std::minmax(a, b), static_cast<Index>(fine.positions.size()));
        if (is_new) fine.positions.push_back((mesh.positions[a] + mesh.positions[b]) / 2);
        return it->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        fine.triangles.insert(fine.triangles.end(),
                              {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return fine;
}

TriangleMesh jitter(TriangleMesh mesh, double amount, std::uint64_t seed) {
    for (Index v = 0; v < mesh.positions.size(); ++v) {
        for (int k = 0; k < 3; ++k) {
            const double unit = agvd::random_unit(seed, static_cast<std::uint64_t>(k), v);
            mesh.positions[v][k] += amount * (2 * unit - 1);
        }
    }
    return mesh;
}

TriangleMesh join(const TriangleMesh& a, const TriangleMesh& b) {
    TriangleMesh both = a;
    const auto offset = static_cast<Index>(a.positions.size());
    both.positions.insert(both.positions.end(), b.positions.begin(), b.positions.end());
    for (const auto& [i, j, k] : b.triangles) {
        both.triangles.push_back({i + offset, j + offset, k + offset});
    }
    return both;
}

namespace {

// Splits the faces at an edge from m to their apexes, unless an edge would exist twice.
void cut_edge(TriangleMesh& mesh, Index u, Index v, const Vec3& m) {
    std::vector<std::pair<Index, std::size_t>> sides;  // Faces, and which of their sides it is.
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const agvd::Triangle& t = mesh.triangles[f];
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::minmax(t[k], t[(k + 1) % 3]) == std::minmax(u, v)) sides.emplace_back(f, k);
        }
    }
    const auto apex = [&](std::size_t i) {
        return mesh.triangles[sides[i].first][(sides[i].second + 2) % 3];
    };
    if (sides.size() == 2 && apex(0) == apex(1)) return;
    const auto middle = static_cast<Index>(mesh.positions.size());
    mesh.positions.push_back(m);
    for (const auto& [f, k] : sides) {
        const agvd::Triangle t = mesh.triangles[f];
        const Index a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
        mesh.triangles[f] = {a, middle, c};
        mesh.triangles.push_back({middle, b, c});
    }
}

}  // namespace

void add_flat_vertices(TriangleMesh& mesh, Index count, std::uint64_t seed) {
    Dice dice(seed);
    for (Index i = 0; i < count; ++i) {
        const Index f = dice.count(0, static_cast<Index>(mesh.triangles.size()) - 1);
        const auto [a, b, c] = mesh.triangles[f];
        const auto& p = mesh.positions;
        if (dice.one_in(2)) {
            const double at = dice.number(0.1, 0.9);
            cut_edge(mesh, a, b, (1 - at) * p[a] + at * p[b]);
            continue;
        }
        const double s = dice.number(0.1, 0.5), t = dice.number(0.1, 0.4);
        const auto m = static_cast<Index>(p.size());
        mesh.positions.push_back((1 - s - t) * p[a] + s * p[b] + t * p[c]);
        mesh.triangles[f] = {a, b, m};
        mesh.triangles.insert(mesh.triangles.end(), {{b, c, m}, {c, a, m}});
    }
}

TriangleMesh shuffle(const TriangleMesh& mesh) {
    const auto order = [](std::size_t count, std::uint64_t seed) {
        std::vector<Index> result(count);
        std::iota(result.begin(), result.end(), Index{0});
        for (std::size_t i = count - 1; i > 0; --i) {
            std::swap(result[i], result[agvd::random_bits(seed, 0, i) % (i + 1)]);
        }
        return result;
    };
    const std::vector<Index> vertices = order(mesh.positions.size(), 1);
    const std::vector<Index> faces = order(mesh.triangles.size(), 2);
    return {agvd::take(mesh.positions, vertices),
            agvd::take(agvd::rename_vertices(mesh.triangles, agvd::places_in(vertices)), faces)};
}

double signed_volume(const TriangleMesh& mesh) {
    double volume = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        volume += mesh.positions[a].dot(mesh.positions[b].cross(mesh.positions[c])) / 6;
    }
    return volume;
}

TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.positions) p += by;
    return mesh;
}

double longest_edge(const agvd::Surface& surface) {
    return *std::max_element(surface.length.begin(), surface.length.end());
}

}  // namespace shapes
