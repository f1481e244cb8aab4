// The whole job keeps the topology, whatever the surface and the number of samples.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <thread>

#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "support/dirty_shapes.h"
#include "support/files.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

void expect_same_topology(const TriangleMesh& mesh, const remesh::RemeshOptions& options) {
    const remesh::RemeshResult result = remesh::remesh(mesh.view(), options);
    const remesh::Topology topology = remesh::analyze_topology(result.mesh.view());
    EXPECT_TRUE(topology.is_manifold);
    EXPECT_TRUE(topology.is_oriented);
    EXPECT_TRUE(same_topology(topology, result.input_topology));
    if (options.vertex_count == remesh::VertexCount::Exact) {
        EXPECT_EQ(result.mesh.positions.size(), options.num_samples);
    } else {
        EXPECT_GE(result.mesh.positions.size(), options.num_samples);
    }
    ASSERT_EQ(result.sites.size(), result.mesh.positions.size());
    for (std::size_t i = 0; i < result.sites.size(); ++i) {
        const Vec3 offset = position(mesh.view(), result.sites[i]) - result.mesh.positions[i];
        EXPECT_LT(offset.norm(), options.fit == false ? 1e-9 : 0.5);  // Half a shape's size.
    }
}

}  // namespace

TEST(Remesh, KeepsTheTopologyOfManySurfaces) {
    const std::vector<TriangleMesh> surfaces = {
        shapes::sphere(3),     shapes::jitter(shapes::sphere(3), 0.03, 1),
        shapes::torus(30, 14), shapes::tube(20, 9),
        shapes::grid(9),       shapes::cube(),
        shapes::tetrahedron(), shapes::join(shapes::sphere(2), shapes::torus(12, 8)),
    };
    const bool is_long = std::getenv("AGVD_LONG") != nullptr;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        for (const Index samples : {40u, 150u, is_long ? 600u : 400u}) {
            for (const auto init :
                 {remesh::Init::BlueNoise, remesh::Init::Random, remesh::Init::Farthest}) {
                for (std::uint64_t seed = 1; seed <= (is_long ? 20u : 1u); ++seed) {
                    SCOPED_TRACE("surface " + std::to_string(i) + ", samples " +
                                 std::to_string(samples) + ", seed " + std::to_string(seed));
                    expect_same_topology(surfaces[i],
                                         {.num_samples = samples, .init = init, .seed = seed});
                    expect_same_topology(surfaces[i], {.num_samples = samples,
                                                       .init = init,
                                                       .seed = seed,
                                                       .relax_steps = 0,
                                                       .fit = false});
                }
            }
        }
    }
}

TEST(Remesh, SamplesMayExceedVerticesAndFaces) {
    expect_same_topology(shapes::cube(), {.num_samples = 500});
    expect_same_topology(shapes::tetrahedron(), {.num_samples = 300});
}

TEST(Remesh, AMeshThatIsGivenAwayChangesNothing) {
    TriangleMesh dirty = shapes::sphere(3);
    dirty.triangles.push_back(dirty.triangles[0]);  // To be repaired: the mesh is kept then.
    for (const TriangleMesh& mesh : {shapes::torus(30, 14), shapes::grid(9), dirty}) {
        const remesh::RemeshOptions options{.num_samples = 200};
        const remesh::RemeshResult kept = remesh::remesh(mesh.view(), options);
        const remesh::RemeshResult given = remesh::remesh_moved(mesh, options);
        EXPECT_EQ(kept.mesh.positions, given.mesh.positions);
        EXPECT_EQ(kept.mesh.triangles, given.mesh.triangles);
        EXPECT_EQ(kept.sites, given.sites);
        EXPECT_EQ(kept.input_topology.face_component, given.input_topology.face_component);
        EXPECT_EQ(given.input_topology.face_component.size(),
                  mesh.triangles.size() - given.cleaned.duplicate_faces);
    }
}

// A number that works is searched for with the mesh as it was.
TEST(Remesh, AMeshThatIsGivenAwayIsThereAgainWhereSamplesAreTooFew) {
    const TriangleMesh mesh = shapes::torus(30, 14);
    const remesh::RemeshOptions options{.num_samples = 3};
    const auto text_of = [](const auto& run) -> std::string {
        try {
            (void)run();
        } catch (const ConstraintUnmet& error) {
            return error.what();
        }
        return "nothing thrown";
    };
    const std::string text = text_of([&] { return remesh::remesh(mesh.view(), options); });
    EXPECT_NE(text.find("work"), std::string::npos) << text;
    EXPECT_EQ(text, text_of([&] { return remesh::remesh_moved(mesh, options); }));
}

// A run with so many vertices would take minutes: their number is told without one.
TEST(Remesh, TooFewSamplesForManyPartsAreRefusedAtOnce) {
    TriangleMesh parts = shapes::unweld(shapes::torus(50, 40));
    for (std::size_t f = 0; f < parts.triangles.size(); ++f) {
        for (const Index v : parts.triangles[f])
            parts.positions[v].z() += 1e-3 * static_cast<double>(f);
    }
    std::string text;
    std::set<remesh::Stage> stages;
    const auto note = [&](remesh::Stage stage, double) {
        stages.insert(stage);
        return true;
    };
    try {
        (void)remesh::remesh(parts.view(), {.num_samples = 100, .progress = note});
    } catch (const ConstraintUnmet& error) {
        text = error.what();
    }
    EXPECT_EQ(
        text,
        "100 samples are too few for the topology of the mesh; use 12000 samples or more; its "
        "4000 faces are 4000 components: if they belong together, weld their vertices first");
    EXPECT_EQ(stages, std::set{remesh::Stage::Clean});
}

TEST(Remesh, TooFewSamplesForTheTopologyAreRefused) {
    EXPECT_THROW((void)remesh::remesh(shapes::torus(20, 10).view(), {.num_samples = 6}),
                 ConstraintUnmet);
    EXPECT_THROW((void)remesh::remesh(shapes::cube().view(), {.num_samples = 0}), InvalidOption);
}

TEST(Remesh, RefusalsNameWhatTheInterfaceNames) {
    const auto text_of = [](const remesh::RemeshOptions& options) {
        try {
            (void)remesh::remesh(shapes::cube().view(), options);
        } catch (const InvalidOption& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    const remesh::Sizing near{.count = remesh::MaxDistance{0.1}};
    EXPECT_EQ(text_of({.wrap = 0.1, .sizing = near}).rfind("wrap excludes MaxDistance", 0), 0U);
    EXPECT_EQ(text_of({.sizing = {.count = remesh::MaxError{0.1}}}),
              "MaxError needs AdaptiveEdges");
    EXPECT_EQ(text_of({.sizing = {.edges = remesh::VertexLengths{{1.0}}}})
                  .rfind("VertexLengths has 1 values", 0),
              0U);
}

TEST(Remesh, EachOptionOfAPropagationThatItHasCounts) {
    const TriangleMesh mesh = shapes::sphere(3);
    const auto bytes_of = [&](const remesh::EngineOptions& how) {
        return remesh::remesh(mesh.view(), {.num_samples = 50, .propagation = how})
            .propagation_bytes;
    };
    std::set<std::size_t> seen{bytes_of({.max_error = 0}), bytes_of({.max_error = 0.3})};
    remesh::EngineOptions steiner{.engine = agvd::Engine::Steiner};
    auto& [engine, max_error, steiner_points, lambda] = steiner;  // There are no others.
    seen.insert(bytes_of(steiner));
    steiner_points = 2;
    seen.insert(bytes_of(steiner));
    lambda = 100;
    seen.insert(bytes_of(steiner));
    EXPECT_EQ(seen.size(), 5u);
}

TEST(Remesh, ANumberThatMayBeRaisedIsRaisedToWhatTheTopologyNeeds) {
    for (const auto may : {remesh::VertexCount::Raise, remesh::VertexCount::Add}) {
        const auto size = [&](const TriangleMesh& mesh, Index count) {
            return remesh::remesh(mesh.view(), {.num_samples = count, .vertex_count = may})
                .mesh.positions.size();
        };
        EXPECT_EQ(size(shapes::grid(8), 1), 4u);
        EXPECT_EQ(size(shapes::sphere(2), 2), 4u);
        EXPECT_EQ(size(shapes::sphere(2), 20), 20u);
    }
}

// Of a mesh that is coarsened by the number of samples.
TEST(Remesh, ANumberOfSamplesThatIsSaidToWorkDoes) {
    const TriangleMesh mesh = remesh::read_mesh(files::find_mesh("data/organic.ply")).mesh;
    for (const std::uint64_t seed : {0, 1}) {
        std::string text;
        try {
            (void)remesh::remesh(mesh.view(), {.num_samples = 5, .seed = seed});
        } catch (const ConstraintUnmet& error) {
            text = error.what();
        }
        ASSERT_NE(text.find(", which were tried and work"), std::string::npos) << text;
        const auto enough = static_cast<Index>(std::stoul(text.substr(text.find("use ") + 4)));
        EXPECT_EQ(remesh::remesh(mesh.view(), {.num_samples = enough, .seed = seed})
                      .mesh.positions.size(),
                  enough);
    }
}

// Some flips from triangles of labels would fold them in between.
// Relaxed sites and those that stay, an input with creases, in tiles, and with narrow parts.
TEST(Remesh, EveryRunTakesTheDualOfItsDiagram) {
    struct Case {
        const char* mesh;
        remesh::RemeshOptions options;
        double least_share;  // Of sites with the triangles of their cells.
    };
    for (const auto& [name, options, least_share] :
         {Case{"data/part.off", {.num_samples = 500}, 0.9},
          Case{"data/part.off", {.num_samples = 500, .relax_steps = 0}, 0.9},
          Case{"data/part.off", {.num_samples = 2000, .samples_per_tile = 500}, 0.95},
          Case{"data/parts.ply", {.num_samples = 500}, 0.8},
          Case{"data/parts.ply", {.num_samples = 1000}, 0.9}}) {
        SCOPED_TRACE(std::string(name) + ' ' + std::to_string(options.num_samples));
        const TriangleMesh mesh = remesh::read_mesh(files::find_mesh(name)).mesh;
        const remesh::RemeshResult result = remesh::remesh(mesh.view(), options);
        EXPECT_GT(result.propagation_bytes, 0u);
        EXPECT_GE(result.certified_error, 0);
        EXPECT_LE(result.certified_error, 1e-4);
        EXPECT_GE(result.dual.sites, options.num_samples);
        EXPECT_GE(result.dual.sites_of_cells, least_share * result.dual.sites);
        EXPECT_LE(result.dual.sites_of_cells + result.dual.narrow_sites, result.dual.sites);
        EXPECT_LE(result.delaunay.failing_after, result.delaunay.failing_before);
        EXPECT_EQ(options.samples_per_tile == 500, result.tiles > 0);
    }
}

TEST(Remesh, AStoppedRunThrows) {
    int calls = 0;
    const remesh::RemeshOptions options{
        .num_samples = 100,
        .progress = [&](remesh::Stage, double) { return ++calls < 6; },
    };
    EXPECT_THROW((void)remesh::remesh(shapes::sphere(3).view(), options), Cancelled);
    EXPECT_EQ(calls, 6);
}

TEST(Remesh, SameBytesForAnyThreadCount) {
    const TriangleMesh mesh = shapes::jitter(shapes::torus(40, 20), 0.01, 3);
    const auto one = remesh::remesh(mesh.view(), {.num_samples = 300, .num_threads = 1});
    for (const int threads : {2, 3, 8}) {
        const auto other =
            remesh::remesh(mesh.view(), {.num_samples = 300, .num_threads = threads});
        EXPECT_EQ(one.mesh.positions, other.mesh.positions);
        EXPECT_EQ(one.mesh.triangles, other.mesh.triangles);
    }
}

TEST(Remesh, RunsInTwoThreadsAtOnceEqualRunsInTurn) {
    struct Job {
        TriangleMesh mesh;
        Index num_samples;
    };
    const std::array jobs{Job{shapes::torus(40, 20), 300}, Job{shapes::sphere(4), 200}};
    const auto run = [](const Job& job) {
        return remesh::remesh(job.mesh.view(), {.num_samples = job.num_samples, .num_threads = 2});
    };
    constexpr std::size_t rounds = 3;
    std::array<std::vector<remesh::RemeshResult>, jobs.size()> results;
    const auto run_all = [&](std::size_t i) {
        for (std::size_t round = 0; round < rounds; ++round) results[i].push_back(run(jobs[i]));
    };
    std::thread other(run_all, 1);
    run_all(0);
    other.join();
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const remesh::RemeshResult expected = run(jobs[i]);
        ASSERT_EQ(results[i].size(), rounds);
        for (const remesh::RemeshResult& result : results[i]) {
            EXPECT_EQ(result.mesh.positions, expected.mesh.positions);
            EXPECT_EQ(result.mesh.triangles, expected.mesh.triangles);
        }
    }
}

TEST(Remesh, RealMeshesKeepTheirTopology) {
    for (const char* name :
         {"data/parts.ply", "data/shell.obj", "data/part.off", "fertility.off", "3holes.off",
          "fandisk.off", "camelhead.off", "spot.obj", "dirty/72214.stl", "hole_capsule.off"}) {
        SCOPED_TRACE(name);
        const auto path = files::find_mesh(name);
        if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real mesh at " << path;
        const TriangleMesh mesh = remesh::read_mesh(path).mesh;
        const remesh::RemeshResult result =
            remesh::remesh(mesh.view(), {.num_samples = 500, .propagation = {.steiner_points = 5}});
        EXPECT_TRUE(
            same_topology(remesh::analyze_topology(result.mesh.view()), result.input_topology));
    }
}
