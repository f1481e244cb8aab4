// Faces with the same corners: repeated by mistake, or the walls of bodies that touch.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "agvd/core/random.h"
#include "agvd/mesh/topology.h"
#include "remesh/clean/clean_input.h"
#include "remesh/curves/curve_network.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Triangle;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::CleanResult;

namespace {

std::uint64_t below(std::uint64_t limit, std::uint64_t seed, std::uint64_t stream,
                    std::uint64_t i = 0) {
    return agvd::random_bits(seed, stream, i) % limit;
}

// A block of bodies that fill it: in each layer along x one body, or one for each cell. Their
// vertices are those of a lattice, moved at random.
struct Block {
    std::array<int, 3> size;
    TriangleMesh mesh;
    std::vector<double> volumes;  // Of the bodies.
    Index num_wall_faces = 0;     // Faces between two bodies, each counted once.

    explicit Block(std::uint64_t seed) {
        for (std::size_t k = 0; k < 3; ++k) size[k] = 1 + static_cast<int>(below(3, seed, 1, k));
        for (int i = 0; i < (size[0] + 1) * (size[1] + 1) * (size[2] + 1); ++i) {
            const std::array<int, 3> at{i % (size[0] + 1), i / (size[0] + 1) % (size[1] + 1),
                                        i / (size[0] + 1) / (size[1] + 1)};
            Vec3 p(at[0], at[1], at[2]);
            for (int k = 0; k < 3; ++k) {
                p[k] += .2 * (static_cast<double>(below(1000, seed, 2, 3 * i + k)) / 1000 - .5);
            }
            mesh.positions.push_back(p);
        }
        std::map<int, TriangleMesh> bodies;
        for_each_cell(
            [&](std::array<int, 3> cell) { add_cell(cell, seed, bodies[body(cell, seed)]); });
        for (auto& [name, body_mesh] : bodies) {
            body_mesh.positions = mesh.positions;
            volumes.push_back(shapes::signed_volume(body_mesh));
            mesh.triangles.insert(mesh.triangles.end(), body_mesh.triangles.begin(),
                                  body_mesh.triangles.end());
        }
        std::sort(volumes.begin(), volumes.end());
    }

    template <typename Visit>
    void for_each_cell(const Visit& visit) const {
        for (int i = 0; i < size[0]; ++i) {
            for (int j = 0; j < size[1]; ++j) {
                for (int k = 0; k < size[2]; ++k) visit({i, j, k});
            }
        }
    }
    [[nodiscard]] int body(std::array<int, 3> cell, std::uint64_t seed) const {
        const bool is_whole = below(2, seed, 3, static_cast<std::uint64_t>(cell[0])) == 0;
        return 100 * cell[0] + (is_whole ? 0 : 10 * cell[1] + cell[2]);
    }
    [[nodiscard]] bool has(std::array<int, 3> cell) const {
        return std::equal(cell.begin(), cell.end(), size.begin(),
                          [](int c, int n) { return 0 <= c && c < n; });
    }
    void add_cell(std::array<int, 3> cell, std::uint64_t seed, TriangleMesh& to) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int side : {0, 1}) {
                std::array<int, 3> next = cell;
                next[axis] += 2 * side - 1;
                const bool is_wall = has(next);
                if (is_wall && body(next, seed) == body(cell, seed)) continue;
                if (is_wall && side == 1) num_wall_faces += 2;
                const auto corner = [&](int u, int v) {
                    std::array<int, 3> at = cell;
                    at[axis] += side;
                    at[(axis + 1) % 3] += u;
                    at[(axis + 2) % 3] += v;
                    return static_cast<Index>(at[0] +
                                              (size[0] + 1) * (at[1] + (size[1] + 1) * at[2]));
                };
                const std::array<Triangle, 2> faces{
                    Triangle{corner(0, 0), corner(1, 0), corner(1, 1)},
                    Triangle{corner(0, 0), corner(1, 1), corner(0, 1)}};
                for (auto [a, b, c] : faces) {
                    if (side == 0) std::swap(b, c);
                    to.triangles.push_back({a, b, c});
                }
            }
        }
    }
};

// Of the components of a closed mesh, ascending.
std::vector<double> volumes_of(const TriangleMesh& mesh) {
    const remesh::Topology topology = remesh::analyze_topology(mesh.view());
    EXPECT_EQ(topology.boundary_loops(), 0);
    EXPECT_EQ(topology.genus(), 0);
    std::vector<double> volumes;
    for (Index i = 0; i < topology.components.size(); ++i) {
        TriangleMesh part{mesh.positions, {}};
        for (Index f = 0; f < mesh.triangles.size(); ++f) {
            if (topology.face_component[f] == i) part.triangles.push_back(mesh.triangles[f]);
        }
        volumes.push_back(shapes::signed_volume(part));
    }
    std::sort(volumes.begin(), volumes.end());
    return volumes;
}

}  // namespace

TEST(DuplicateFaces, BodiesThatTouchStayClosed) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        Block block(seed);
        std::vector<Triangle>& faces = block.mesh.triangles;
        const bool is_inside_out = below(4, seed, 4) == 0;
        if (is_inside_out) {
            for (Triangle& t : faces) std::swap(t[1], t[2]);
            for (double& volume : block.volumes) volume = -volume;
            std::reverse(block.volumes.begin(), block.volumes.end());
        }
        const auto num_repeated = static_cast<Index>(below(5, seed, 5));
        for (Index i = 0; i < num_repeated; ++i) {
            const auto& [a, b, c] = faces[below(faces.size(), seed, 6, i)];
            faces.push_back({b, c, a});
        }
        for (std::size_t i = faces.size(); i > 1; --i) {
            std::swap(faces[i - 1], faces[below(i, seed, 7, i)]);
        }
        const CleanResult clean = remesh::clean_input(block.mesh.view());
        EXPECT_EQ(clean.counts.touching_faces, block.num_wall_faces);
        EXPECT_EQ(clean.counts.duplicate_faces, num_repeated);
        const std::vector<double> volumes = volumes_of(clean.mesh);
        ASSERT_EQ(volumes.size(), block.volumes.size());
        for (std::size_t i = 0; i < volumes.size(); ++i) {
            EXPECT_NEAR(volumes[i], block.volumes[i], 1e-12);
        }
    }
}

TEST(DuplicateFaces, ASheetDrawnFromBothSidesIsOneSheet) {
    TriangleMesh mesh = shapes::grid(4);
    const std::vector<Triangle> front = mesh.triangles;
    for (const auto& [a, b, c] : front) mesh.triangles.push_back({a, c, b});
    const CleanResult clean = remesh::clean_input(mesh.view());
    EXPECT_EQ(clean.mesh.triangles, front);
    EXPECT_EQ(clean.counts, remesh::CleanCounts{.duplicate_faces = 32});
}

// Two sheets with one rim. At two corners a triangle has two edges of the rim: both sheets have it.
TEST(DuplicateFaces, FlapsOnABodyThatIsClosedWithoutThemGo) {
    const Index n = 6;
    TriangleMesh mesh = shapes::grid(n);
    const std::vector<Triangle> front = mesh.triangles;
    std::vector<Index> below(mesh.positions.size());
    for (Index v = 0; v < below.size(); ++v) {
        const Vec3 p = mesh.positions[v];
        const double height = p.x() * (1 - p.x()) * p.y() * (1 - p.y());
        below[v] = v;
        if (height < 1e-9) continue;
        mesh.positions[v].z() = height;
        below[v] = static_cast<Index>(mesh.positions.size());
        mesh.positions.emplace_back(p.x(), p.y(), -height);
    }
    for (const auto& [a, b, c] : front) mesh.triangles.push_back({below[a], below[c], below[b]});
    const CleanResult clean = remesh::clean_input(mesh.view());
    EXPECT_EQ(clean.counts, (remesh::CleanCounts{.duplicate_faces = 4, .isolated_vertices = 2}));
    EXPECT_EQ(volumes_of(clean.mesh).size(), 1u);
}

// Of other vertices, or other diagonals: turned over, or the same way.
TEST(DuplicateFaces, SurfacesInOnePlaceAreOne) {
    const auto bent = [](TriangleMesh mesh) {
        for (Vec3& p : mesh.positions) p.z() = 0.05 * p.x() * p.x() - 0.1 * p.x() * p.y();
        return mesh;
    };
    const TriangleMesh sheet = bent(shapes::grid(8));
    TriangleMesh other = sheet;
    for (std::size_t f = 0; f < other.triangles.size(); f += 2) {
        Triangle &t = other.triangles[f], &u = other.triangles[f + 1];  // (a, b, c), (a, c, d)
        const Index a = t[0], b = t[1], c = t[2], d = u[2];
        t = {a, b, d};
        u = {b, c, d};
    }
    const TriangleMesh fine_cube = shapes::subdivide(shapes::cube());
    const TriangleMesh flat = shapes::grid(4), fine = shapes::grid(8);
    for (const bool is_turned : {false, true}) {
        for (const auto& [one, two] : {std::pair{sheet, other},
                                       {shapes::cube(), fine_cube},
                                       {flat, fine},
                                       {fine_cube, fine_cube}}) {
            SCOPED_TRACE(one.triangles.size());
            TriangleMesh mesh = two;
            if (is_turned) {
                for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
            }
            mesh = shapes::join(one, mesh);
            const CleanResult clean = remesh::clean_input(mesh.view());
            EXPECT_EQ(clean.counts.duplicate_faces, two.triangles.size());
            const auto topology = remesh::analyze_topology(clean.mesh.view());
            EXPECT_TRUE(same_topology(topology, remesh::analyze_topology(one.view())));
        }
    }
}

TEST(DuplicateFaces, BodiesWhoseCommonWallHasOtherDiagonalsStayClosed) {
    // The walls have vertices in common.
    TriangleMesh mesh = shapes::cube();
    const TriangleMesh cube = mesh;
    for (const Triangle& t : cube.triangles) {
        Triangle beside;
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3 p = cube.positions[t[k]];
            p.x() = 2 - p.x();
            const auto at = std::ranges::find(mesh.positions, p);
            beside[k] = static_cast<Index>(at - mesh.positions.begin());
            if (at == mesh.positions.end()) mesh.positions.push_back(p);
        }
        std::swap(beside[1], beside[2]);
        mesh.triangles.push_back(beside);
    }
    // Mirrored walls have the same diagonal.
    const auto is_wall = [&](const Triangle& t) {
        return std::ranges::all_of(t, [&](Index v) { return mesh.positions[v].x() == 1; });
    };
    const auto first = std::find_if(mesh.triangles.begin() + 12, mesh.triangles.end(), is_wall);
    const auto second = std::find_if(first + 1, mesh.triangles.end(), is_wall);
    std::vector<Index> corners(first->begin(), first->end());
    const auto apex =
        std::ranges::find_if(*second, [&](Index v) { return std::ranges::count(corners, v) == 0; });
    const auto lone =
        std::ranges::find_if(*first, [&](Index v) { return std::ranges::count(*second, v) == 0; });
    const Index from = *lone, to = *apex;
    std::ranges::rotate(*first, lone);
    const Index b = (*first)[1], c = (*first)[2];
    *first = {from, b, to};
    *second = {from, to, c};
    const CleanResult clean = remesh::clean_input(mesh.view());
    EXPECT_EQ(clean.counts.duplicate_faces, 0u);
    const std::vector<double> volumes = volumes_of(clean.mesh);
    ASSERT_EQ(volumes.size(), 2u);
    for (const double volume : volumes) EXPECT_NEAR(volume, 1, 1e-12);
}

TEST(DuplicateFaces, AWallOfAClosedBodyRepeatedFromItsOtherSideIsDropped) {
    TriangleMesh mesh = shapes::subdivide(shapes::cube());
    const std::vector<Triangle> front = mesh.triangles;
    for (const auto& [a, b, c] : front) {
        const auto is_low = [&](Index v) { return mesh.positions[v].z() == 0; };
        if (is_low(a) && is_low(b) && is_low(c)) mesh.triangles.push_back({a, c, b});
    }
    const CleanResult clean = remesh::clean_input(mesh.view());
    EXPECT_EQ(clean.mesh.triangles, front);
    EXPECT_EQ(clean.counts, remesh::CleanCounts{.duplicate_faces = 8});
}

TEST(DuplicateFaces, OnlyTheRimOfAWallIsAJunction) {
    // Two cubes of 48 faces each; their wall has a rim of 8 edges.
    TriangleMesh mesh = shapes::subdivide(shapes::cube());
    mesh = shapes::join(mesh, shapes::moved(mesh, {1, 0, 0}));
    std::vector<Index> first(mesh.positions.size());
    for (Index v = 0; v < first.size(); ++v) {
        first[v] = static_cast<Index>(std::ranges::find(mesh.positions, mesh.positions[v]) -
                                      mesh.positions.begin());
    }
    for (Triangle& t : mesh.triangles) t = {first[t[0]], first[t[1]], first[t[2]]};
    const CleanResult clean = remesh::clean_input(mesh.view());
    const agvd::Surface surface = agvd::build_surface(clean.mesh.view());
    const remesh::JunctionSet junctions = remesh::find_junctions(surface, clean.vertex_origin);
    EXPECT_EQ(junctions.edges.size(), 8u);
    EXPECT_EQ(junctions.vertices.size(), 8u);
}
