// What is asked of the whole: the mesh has the topology of the input and the vertices asked for,
// whatever order, threads and interruptions its tiles saw.
#include "remesh/tilefiles/tile_jobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "agvd/core/error.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/quality/evaluate.h"
#include "remesh/tilefiles/tile_file.h"
#include "support/files.h"
#include "support/shapes.h"

namespace fs = std::filesystem;
using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;

namespace {

constexpr Index num_samples = 2000, per_tile = 500;
const remesh::SplitOptions options{.num_samples = num_samples, .samples_per_tile = per_tile};

std::vector<Index> all_tiles(const remesh::TilePlan& plan) {
    std::vector<Index> tiles(plan.num_tiles());
    std::iota(tiles.begin(), tiles.end(), Index{0});
    return tiles;
}

class TileJobs : public testing::Test {
protected:
    fs::path put(const std::string& name, const TriangleMesh& mesh) {
        remesh::write_mesh(folder_ / name, mesh.view());
        return folder_ / name;
    }
    // Splits, meshes and joins.
    TriangleMesh run(const fs::path& file, const std::string& name) {
        const auto plan = remesh::split_into_tiles(file, folder_ / name, options);
        (void)remesh::mesh_tiles(folder_ / name, all_tiles(plan));
        return remesh::join_tiles(folder_ / name).mesh;
    }
    [[nodiscard]] std::string bytes(const fs::path& path) const {
        std::ifstream file(folder_ / path.string(), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void overwrite(const fs::path& path, const std::string& bytes) {
        std::ofstream(folder_ / path.string(), std::ios::binary) << bytes;
    }

    files::TemporaryFolder folder_;
};

// What a call throws.
template <typename Error, typename Call>
std::string complaint(const Call& call) {
    try {
        (void)call();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST_F(TileJobs, MeasureCreasesWhichTheyDoNotKeep) {
    TriangleMesh mesh = shapes::cube();
    const double edge = std::cbrt(shapes::signed_volume(mesh));
    for (int i = 0; i < 5; ++i) mesh = shapes::subdivide(mesh);
    const auto cube = remesh::split_into_tiles(put("cube.ply", mesh), folder_ / "c", options);
    EXPECT_LE(cube.crease_length, 12 * edge * (1 + 1e-9));
    EXPECT_GT(cube.crease_length, 0.9 * 12 * edge);
    EXPECT_EQ(remesh::read_tile_plan(folder_ / "c").crease_length, cube.crease_length);
    const auto sphere =
        remesh::split_into_tiles(put("s.ply", shapes::sphere(5)), folder_ / "s", options);
    EXPECT_EQ(sphere.crease_length, 0);
}

TEST_F(TileJobs, KeepTheTopologyAndTheNumberOfVertices) {
    const std::vector<TriangleMesh> meshes{
        shapes::sphere(5),
        shapes::torus(90, 60),
        shapes::tube(80, 60),
        shapes::lips(96, 60, 3),
        shapes::join(shapes::sphere(4), shapes::moved(shapes::sphere(4), {3, 0, 0})),
        shapes::jitter(shapes::torus(150, 80), 0.002, 1)};
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        SCOPED_TRACE(i);
        const TriangleMesh& mesh = meshes[i];
        const std::string name = std::to_string(i);
        const fs::path file = put(name + ".ply", mesh);
        const auto plan = remesh::split_into_tiles(file, folder_ / name, options);
        EXPECT_EQ(plan.num_faces, mesh.triangles.size());
        EXPECT_EQ(plan.num_tiles(), num_samples / per_tile);
        for (const Index count : plan.num_vertices) EXPECT_LE(count, 5 * per_tile / 4);
        EXPECT_EQ(remesh::mesh_tiles(folder_ / name, all_tiles(plan)).made, plan.num_tiles());
        const remesh::JoinedTiles joined = remesh::join_tiles(folder_ / name);
        EXPECT_EQ(joined.mesh.positions.size(), num_samples);
        const agvd::Topology topology = agvd::analyze_topology(joined.mesh.view());
        EXPECT_TRUE(topology.is_manifold);
        EXPECT_TRUE(topology.is_oriented);
        EXPECT_TRUE(same_topology(topology, agvd::analyze_topology(mesh.view())));
        EXPECT_TRUE(same_topology(topology, joined.topology));
        EXPECT_EQ(joined.self_intersections.value_or(0), 0u);
        const remesh::TriangleQuality quality = remesh::measure_triangles(joined.mesh.view());
        EXPECT_GT(quality.min_angle, 22 * agvd::degree);
        EXPECT_GT(quality.mean_quality, 0.9);
        if (i != 0) continue;
        // Twice as far as a chord of a spacing is from the sphere: fitted vertices lie outside.
        for (const Vec3& p : joined.mesh.positions) {
            EXPECT_NEAR(p.norm(), 1, plan.spacing * plan.spacing / 4);
        }
    }
}

TEST_F(TileJobs, LeaveNothingButTheFilesThatAreTold) {
    const fs::path file = put("a.ply", shapes::sphere(5));
    const auto plan = remesh::split_into_tiles(file, folder_ / "a", options);
    const auto count = [&] {
        return static_cast<Index>(
            std::distance(fs::directory_iterator(folder_ / "a"), fs::directory_iterator()));
    };
    EXPECT_EQ(count(), plan.num_tiles() + 1);
    (void)remesh::mesh_tiles(folder_ / "a", all_tiles(plan));
    EXPECT_EQ(count(), 2 * plan.num_tiles() + 1);
    EXPECT_TRUE(remesh::is_meshed(folder_ / "a", plan.num_tiles() - 1));
    EXPECT_FALSE(remesh::is_meshed(folder_ / "a", plan.num_tiles()));
}

TEST_F(TileJobs, OrderAndThreadsDoNotCount) {
    const fs::path file = put("a.ply", shapes::torus(120, 80));
    const TriangleMesh expected = run(file, "a");
    remesh::SplitOptions one_thread = options;
    one_thread.num_threads = 1;
    const auto plan = remesh::split_into_tiles(file, folder_ / "b", one_thread);
    ASSERT_EQ(plan.num_tiles(), 4u);
    for (Index t = plan.num_tiles(); t-- > 0;) {
        const std::vector<Index> tile{t};
        EXPECT_EQ(remesh::mesh_tiles(folder_ / "b", tile, {.num_threads = 3}).made, 1u);
    }
    const TriangleMesh joined = remesh::join_tiles(folder_ / "b", {.num_threads = 1}).mesh;
    EXPECT_EQ(joined.positions, expected.positions);
    EXPECT_EQ(joined.triangles, expected.triangles);
}

// Vertices do not follow sharp edges, so some triangles there are bad before they are improved.
TEST_F(TileJobs, TrianglesOnSharpEdgesAreImproved) {
    TriangleMesh plate = shapes::cube();
    for (int i = 0; i < 5; ++i) plate = shapes::subdivide(plate);
    for (Vec3& p : plate.positions) p.z() *= 0.05;
    const fs::path file = put("a.ply", plate);
    const remesh::TriangleQuality quality = remesh::measure_triangles(run(file, "a").view());
    EXPECT_GT(quality.min_angle, 25 * agvd::degree);
}

// A torus with deep bumps: borders run through its saddles.
TriangleMesh bumpy_torus(int around, int along, int twisted) {
    TriangleMesh mesh = shapes::torus(140, 60, 0.4);
    for (Vec3& p : mesh.positions) {
        const double v = std::atan2(p.y(), p.x());
        const Vec3 middle(std::cos(v), std::sin(v), 0);
        const double u = std::atan2(p.z(), std::hypot(p.x(), p.y()) - 1);
        const double bump =
            std::sin(around * v + 1) * std::cos(along * u) + std::sin(twisted * v + along * u + 2);
        p = middle + (1 + 0.3 * bump) * (p - middle);
    }
    return mesh;
}

// How many edges of borders begin at a vertex where another one of this tile begins.
Index num_meetings(const fs::path& folder, const remesh::TilePlan& plan) {
    Index count = 0;
    for (Index t = 0; t < plan.num_tiles(); ++t) {
        const remesh::TileFile tile = remesh::read_tile(folder, t, remesh::identity_of(plan));
        std::vector<Index> begins;
        for (const auto& edge : tile.border) begins.push_back(edge[0]);
        count += static_cast<Index>(begins.size() - agvd::distinct(begins).size());
    }
    return count;
}

TEST_F(TileJobs, ABorderThatMeetsItselfCostsNoVertex) {
    const std::array<TriangleMesh, 2> shapes{bumpy_torus(4, 5, 5), bumpy_torus(5, 2, 6)};
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const std::string name = std::to_string(i);
        const fs::path file = put(name + ".ply", shapes[i]);
        const auto plan = remesh::split_into_tiles(file, folder_ / name,
                                                   {.num_samples = 4000, .samples_per_tile = 500});
        ASSERT_GE(num_meetings(folder_ / name, plan), 1u) << i;
        (void)remesh::mesh_tiles(folder_ / name, all_tiles(plan));
        EXPECT_EQ(remesh::join_tiles(folder_ / name).mesh.positions.size(), 4000u) << i;
    }
}

// What a plane cuts off that is much smaller than a tile goes to its neighbour.
TEST_F(TileJobs, NoSmallPartHasABorder) {
    Index num_parts = 0, num_tiles = 0;
    for (int around = 2; around < 8; ++around) {
        SCOPED_TRACE(around);
        const std::string name = std::to_string(around);
        const fs::path file = put(name + ".ply", bumpy_torus(around, 9 - around, around + 3));
        const auto plan = remesh::split_into_tiles(file, folder_ / name,
                                                   {.num_samples = 6000, .samples_per_tile = 500});
        for (Index t = 0; t < plan.num_tiles(); ++t) {
            const remesh::TileFile tile =
                remesh::read_tile(folder_ / name, t, remesh::identity_of(plan));
            const agvd::Topology topology = agvd::analyze_topology(tile.mesh.view());
            // The torus is connected, so each part has a border.
            for (const agvd::ComponentTopology& part : topology.components) {
                EXPECT_GT(part.area, plan.area / 12 / 8);
                ++num_parts;
            }
        }
        num_tiles += plan.num_tiles();
    }
    EXPECT_GE(num_parts, num_tiles);
    EXPECT_EQ(num_tiles, 6u * 12u);
}

// The faces at an edge are read 65 536 faces apart, and cut there at the same points.
TEST_F(TileJobs, FacesThatComeFarApartFit) {
    TriangleMesh mesh = shapes::moved(shapes::sphere(6), {0.1, 0.2, 0.3});
    ASSERT_GT(mesh.triangles.size(), 65'536u);
    std::vector<agvd::Triangle> mixed;
    for (std::size_t f = 0; f < mesh.triangles.size(); f += 2) mixed.push_back(mesh.triangles[f]);
    for (std::size_t f = 1; f < mesh.triangles.size(); f += 2) mixed.push_back(mesh.triangles[f]);
    mesh.triangles = std::move(mixed);
    const fs::path file = put("a.ply", mesh);
    const auto plan = remesh::split_into_tiles(file, folder_ / "a", options);
    EXPECT_EQ(plan.num_tiles(), 4u);
    // Three planes across a ball: their circles are shorter than three of its own.
    EXPECT_GT(plan.num_sites * plan.spacing, 2 * std::numbers::pi);
    EXPECT_LT(plan.num_sites * plan.spacing, 6 * std::numbers::pi);
    // The sphere has no boundary: all of the rim of a tile is border.
    for (Index t = 0; t < plan.num_tiles(); ++t) {
        const remesh::TileFile tile =
            remesh::read_tile(folder_ / "a", t, remesh::identity_of(plan));
        EXPECT_EQ(tile.border.size(), remesh::rim_of(tile.mesh.triangles).size()) << t;
    }
}

// A file of faces without shared vertices gives the same as one with them.
TEST_F(TileJobs, StlGivesWhatPlyGives) {
    TriangleMesh mesh = shapes::sphere(5);
    for (Vec3& p : mesh.positions) p = p.cast<float>().cast<double>();
    const TriangleMesh a = run(put("a.ply", mesh), "a"), b = run(put("b.stl", mesh), "b");
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.triangles, b.triangles);
}

TEST_F(TileJobs, GoOnWhereTheyWere) {
    const fs::path file = put("a.ply", shapes::sphere(5));
    const TriangleMesh expected = run(file, "a");
    const auto plan = remesh::read_tile_plan(folder_ / "a");
    // The plan is kept, and so are the tiles.
    const auto before = fs::last_write_time(folder_ / "a" / "00001.tile");
    EXPECT_EQ(remesh::split_into_tiles(file, folder_ / "a", options).num_vertices,
              plan.num_vertices);
    EXPECT_EQ(fs::last_write_time(folder_ / "a" / "00001.tile"), before);
    fs::remove(folder_ / "a" / "00001.mesh");
    EXPECT_NE(complaint<remesh::IoError>([&] {
                  return remesh::join_tiles(folder_ / "a");
              }).find("00001.mesh: is not there"),
              std::string::npos);
    const remesh::MeshedTiles meshed = remesh::mesh_tiles(folder_ / "a", all_tiles(plan));
    EXPECT_EQ(meshed.made, 1u);
    EXPECT_EQ(meshed.there, plan.num_tiles() - 1);
    EXPECT_EQ(remesh::join_tiles(folder_ / "a").mesh.positions, expected.positions);
}

TEST_F(TileJobs, AStopLeavesNoPlanOrNoMesh) {
    const fs::path file = put("a.ply", shapes::sphere(5));
    remesh::SplitOptions stopped = options;
    int polls = 0;
    stopped.progress = [&](double fraction) {
        EXPECT_GE(fraction, 0);
        EXPECT_LE(fraction, 1);
        return ++polls < 3;
    };
    EXPECT_THROW((void)remesh::split_into_tiles(file, folder_ / "a", stopped), remesh::Cancelled);
    EXPECT_THROW((void)remesh::read_tile_plan(folder_ / "a"), remesh::IoError);
    EXPECT_TRUE(fs::is_empty(folder_ / "a"));
    const auto plan = remesh::split_into_tiles(file, folder_ / "a", options);
    polls = 0;
    EXPECT_THROW((void)remesh::mesh_tiles(
                     folder_ / "a", all_tiles(plan),
                     {.num_threads = 1, .progress = [&](double) { return ++polls < 3; }}),
                 remesh::Cancelled);
    EXPECT_FALSE(remesh::is_meshed(folder_ / "a", 0));
}

TEST_F(TileJobs, FewVerticesAreOneTile) {
    const fs::path file = put("a.ply", shapes::torus(60, 40));
    const auto plan = remesh::split_into_tiles(file, folder_ / "a",
                                               {.num_samples = 400, .samples_per_tile = 500});
    EXPECT_EQ(plan.num_vertices, std::vector<Index>{400});
    EXPECT_EQ(plan.num_sites, 0u);
    (void)remesh::mesh_tiles(folder_ / "a", all_tiles(plan));
    const remesh::JoinedTiles joined = remesh::join_tiles(folder_ / "a");
    EXPECT_EQ(joined.mesh.positions.size(), 400u);
    EXPECT_EQ(joined.topology.genus(), 1);
}

TEST_F(TileJobs, FilesOfAnotherPlanAreRefused) {
    const fs::path file = put("a.ply", shapes::sphere(4));
    (void)run(file, "a");
    remesh::SplitOptions other = options;
    other.seed = 2;
    EXPECT_NE(complaint<remesh::InvalidOption>([&] {
                  return remesh::split_into_tiles(file, folder_ / "a", other);
              }).find("has the tiles of another file or of other options"),
              std::string::npos);
    const auto plan = remesh::split_into_tiles(file, folder_ / "b", other);
    (void)remesh::mesh_tiles(folder_ / "b", all_tiles(plan));
    fs::copy_file(folder_ / "a" / "00000.mesh", folder_ / "b" / "00000.mesh",
                  fs::copy_options::overwrite_existing);
    EXPECT_NE(complaint<remesh::IoError>([&] {
                  return remesh::join_tiles(folder_ / "b");
              }).find("00000.mesh: belongs to another plan"),
              std::string::npos);
    EXPECT_NE(complaint<remesh::InvalidOption>([&] {
                  return remesh::mesh_tiles(folder_ / "b", std::vector<Index>{99});
              }).find("there is no tile 99; the last one of"),
              std::string::npos);
}

TEST_F(TileJobs, DamagedFilesAreNamed) {
    const fs::path file = put("a.ply", shapes::sphere(4));
    (void)run(file, "a");
    const std::string whole = bytes("a/00000.mesh");
    int num_refused = 0;
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{5}, std::size_t{30}, whole.size() / 2, whole.size() - 1}) {
        overwrite("a/00000.mesh", whole.substr(0, size));
        const std::string text =
            complaint<remesh::IoError>([&] { return remesh::join_tiles(folder_ / "a"); });
        EXPECT_NE(text.find("00000.mesh: "), std::string::npos) << size;
        ++num_refused;
    }
    EXPECT_EQ(num_refused, 5);
    overwrite("a/00000.mesh", whole);
    const std::string plan = bytes("a/plan.json");
    overwrite("a/plan.json", plan.substr(0, plan.size() / 2));
    EXPECT_NE(complaint<remesh::IoError>([&] {
                  return remesh::join_tiles(folder_ / "a");
              }).find("plan.json: is damaged"),
              std::string::npos);
}

// Where two sheets share an edge, or faces run both ways, no tile can end.
TEST_F(TileJobs, BordersMustBeClean) {
    TriangleMesh turned = shapes::sphere(5);
    for (std::size_t f = 0; f < turned.triangles.size(); f += 2) {
        std::swap(turned.triangles[f][0], turned.triangles[f][1]);
    }
    const std::string text = complaint<remesh::InvalidInput>([&] {
        const auto plan = remesh::split_into_tiles(put("a.ply", turned), folder_ / "a", options);
        return remesh::mesh_tiles(folder_ / "a", all_tiles(plan));
    });
    EXPECT_TRUE(text.find("do not run the same way") != std::string::npos ||
                text.find("is not clean at its border near (") != std::string::npos)
        << text;
    TriangleMesh doubled = shapes::join(shapes::sphere(5), shapes::sphere(5));
    EXPECT_NE(complaint<remesh::InvalidInput>([&] {
                  return remesh::split_into_tiles(put("b.ply", doubled), folder_ / "b", options);
              }).find("more than two faces meet"),
              std::string::npos);
    EXPECT_TRUE(fs::is_empty(folder_ / "b"));
}

// Dirt inside tiles is cleaned.
TEST_F(TileJobs, FacesWithoutAreaAndHolesOfTilesAreCleaned) {
    TriangleMesh mesh = shapes::sphere(5);
    const auto count = static_cast<Index>(mesh.triangles.size());
    for (Index f = 0; f < count; f += 97) {
        const auto [a, b, c] = mesh.triangles[f];
        mesh.triangles.push_back({a, a, b});
        mesh.triangles.push_back({c, b, c});
    }
    const TriangleMesh joined = run(put("a.ply", mesh), "a");
    EXPECT_EQ(joined.positions.size(), num_samples);
    EXPECT_EQ(agvd::analyze_topology(joined.view()).boundary_loops(), 0);
}

TEST_F(TileJobs, OptionsAreChecked) {
    const fs::path file = put("a.ply", shapes::sphere(3));
    EXPECT_THROW((void)remesh::split_into_tiles(file, folder_ / "a", {.num_samples = 0}),
                 remesh::InvalidOption);
    EXPECT_THROW((void)remesh::split_into_tiles(file, folder_ / "a", {.samples_per_tile = 499}),
                 remesh::InvalidOption);
    EXPECT_THROW((void)remesh::split_into_tiles(file, folder_ / "a", {.relax_steps = 0}),
                 remesh::InvalidOption);
    EXPECT_FALSE(fs::exists(folder_ / "a"));
}

}  // namespace
