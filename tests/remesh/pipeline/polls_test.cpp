// Every stage lets its progress callback stop it, and asks it often: counted by work, not by time.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <map>

#include "agvd/diagram/diagram.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/propagation/propagate.h"
#include "paper/compare_diagrams.h"
#include "remesh/curves/find_creases.h"
#include "remesh/dual/reduce_vertices.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/sites.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace {

using agvd::Cancelled;
using agvd::Index;
using agvd::Progress;
using agvd::TriangleMesh;
using remesh::Stage;

// Calls the stage, which must poll at least so often; then again, stopped at the first, a middle
// and the last of these polls: each time it must throw, and not call back any more.
template <typename Run>
void expect_polls(const char* name, int least, const Run& run) {
    SCOPED_TRACE(name);
    int polls = 0;
    run([&](double fraction) {
        EXPECT_GE(fraction, 0);
        EXPECT_LE(fraction, 1);
        ++polls;
        return true;
    });
    EXPECT_GE(polls, least);
    for (const int last : {1, polls / 2, polls}) {
        if (last < 1) continue;
        int count = 0;
        EXPECT_THROW(run([&](double) { return ++count < last; }), Cancelled) << last;
        EXPECT_EQ(count, last);
    }
}

TriangleMesh sphere() { return shapes::jitter(shapes::sphere(6), 1e-4, 1); }  // 81 920 faces.

struct Scene {
    explicit Scene(Index num_sites) : surface(agvd::build_surface(sphere().view())) {
        sites = remesh::sample_sites(surface, {.num_samples = num_sites, .num_threads = 1});
        propagation = agvd::propagate(surface, sites, {.num_threads = 1});
        diagram = agvd::build_diagram(surface, sites, propagation, {.num_threads = 1});
    }
    agvd::Surface surface;
    std::vector<agvd::SurfacePoint> sites;
    agvd::Propagation propagation;
    agvd::Diagram diagram;
};

// Some half of what there were: a loop that lost its polls shows.
const std::map<Stage, int> least_polls{
    {Stage::Clean, 100}, {Stage::Relax, 300},  {Stage::Propagate, 50}, {Stage::Diagram, 50},
    {Stage::Dual, 4},    {Stage::Delaunay, 5}, {Stage::Place, 20},     {Stage::Check, 8}};
// With an error the cells are found.
const remesh::EngineOptions with_error{.max_error = 1e-4};

std::map<Stage, int> count_polls(const TriangleMesh& mesh, remesh::RemeshOptions options) {
    std::map<Stage, int> polls;
    options.progress = [&](Stage stage, double) {
        ++polls[stage];
        return true;
    };
    (void)remesh::remesh(mesh.view(), options);
    return polls;
}

TEST(Polls, AreInEveryStageOfRemesh) {
    std::map<Stage, int> polls = count_polls(
        sphere(),
        {.num_samples = 3000, .relax_steps = 20, .propagation = with_error, .num_threads = 1});
    for (const auto& [stage, count] : least_polls) {
        EXPECT_GE(polls[stage], count) << remesh::stage_name(stage);
    }
}

TEST(Polls, StopEveryStageOfRemesh) {
    const TriangleMesh mesh = shapes::jitter(shapes::sphere(4), 1e-4, 1);
    remesh::RemeshOptions options{
        .num_samples = 500, .relax_steps = 20, .propagation = with_error, .num_threads = 1};
    std::map<Stage, int> polls = count_polls(mesh, options);
    for (const auto& [stage, least] : least_polls) {
        for (const int last : {1, polls[stage] / 2, polls[stage]}) {
            int calls = 0;
            bool is_stopped = false;
            options.progress = [&](Stage at, double) {
                EXPECT_FALSE(is_stopped) << remesh::stage_name(stage);
                is_stopped = at == stage && ++calls >= last;
                return !is_stopped;
            };
            EXPECT_THROW((void)remesh::remesh(mesh.view(), options), Cancelled)
                << remesh::stage_name(stage) << last;
        }
    }
}

TEST(Polls, AreInSamplingWhateverTheStart) {
    const agvd::Surface surface = agvd::build_surface(sphere().view());
    for (const auto init :
         {remesh::Init::Random, remesh::Init::BlueNoise, remesh::Init::Farthest}) {
        const int least = init == remesh::Init::Random ? 10 : 40;
        expect_polls(remesh::init_name(init), least, [&](const Progress& progress) {
            (void)remesh::sample_sites(
                surface,
                {.num_samples = 2000, .init = init, .num_threads = 1, .progress = progress});
        });
    }
}

TEST(Polls, AreInTheRunOfASingleSiteAndInAllEngines) {
    const agvd::Surface surface = agvd::build_surface(sphere().view());
    const std::vector<agvd::SurfacePoint> sites{{agvd::FaceId(0), {0.2, 0.3, 0.5}}};
    for (const auto engine : {agvd::Engine::Window, agvd::Engine::Steiner}) {
        const std::map<agvd::Engine, int> least{{agvd::Engine::Window, 80},
                                                {agvd::Engine::Steiner, 40}};
        expect_polls(agvd::engine_name(engine), least.at(engine), [&](const Progress& progress) {
            (void)agvd::propagate(
                surface, sites,
                {.engine = engine, .steiner_points = 2, .num_threads = 1, .progress = progress});
        });
    }
}

TEST(Polls, AreInUnevenStartsOfRelaxation) {
    const agvd::Surface surface = agvd::build_surface(sphere().view());
    const std::vector<agvd::SurfacePoint> sites(500, {agvd::FaceId(0), {0.2, 0.3, 0.5}});
    const remesh::PreparedSurface prepared(surface, remesh::mean_spacing(surface, sites.size()), 1);
    expect_polls("relax", 40, [&](const Progress& progress) {
        (void)remesh::relax_sites(prepared, sites,
                                  {.steps = 2, .num_threads = 1, .progress = progress});
    });
}

TEST(Polls, AreInTheStagesOnTheirOwn) {
    const TriangleMesh mesh = sphere();
    expect_polls("take what is clean", 40, [&](const Progress& progress) {
        (void)remesh::clean_input(mesh.view(), {.num_threads = 1, .progress = progress});
    });
    TriangleMesh dirty = mesh;
    dirty.triangles.push_back(mesh.triangles[0]);
    expect_polls("clean", 100, [&](const Progress& progress) {
        (void)remesh::clean_input(dirty.view(), {.num_threads = 1, .progress = progress});
    });
    expect_polls("topology", 30, [&](const Progress& progress) {
        (void)remesh::analyze_topology(mesh.view(), progress);
    });
    const std::optional<agvd::Connectivity> connectivity = agvd::find_connectivity(mesh.view());
    ASSERT_TRUE(connectivity);
    expect_polls("topology of what is connected", 20, [&](const Progress& progress) {
        (void)remesh::analyze_topology(mesh.view(), *connectivity, progress);
    });
    expect_polls("surface", 30, [&](const Progress& progress) {
        (void)agvd::build_surface(mesh.view(), 1, progress);
    });
    expect_polls("no surface", 60, [&](const Progress& progress) {
        try {
            (void)agvd::build_surface(dirty.view(), 1, progress);
        } catch (const agvd::InvalidInput&) {
        }
    });
    const agvd::Surface surface = agvd::build_surface(mesh.view());
    const agvd::Surface noisy = agvd::build_surface(shapes::jitter(mesh, 0.01, 1).view());
    expect_polls("creases", 60, [&](const Progress& progress) {
        (void)remesh::find_creases(surface,
                                   {.spacing = 0.05, .num_threads = 1, .progress = progress});
    });
    expect_polls("creases of noise", 70, [&](const Progress& progress) {
        (void)remesh::find_creases(noisy,
                                   {.spacing = 0.05, .num_threads = 1, .progress = progress});
    });
    expect_polls("feature coverage", 100, [&](const Progress& progress) {
        (void)remesh::feature_coverage(noisy.mesh.view(), noisy.mesh.view(), progress);
    });
    expect_polls("reduce", 20, [&](const Progress& progress) {
        std::vector<agvd::Triangle> triangles = mesh.triangles;
        (void)remesh::reduce_vertices(mesh.positions, triangles, 30'000, {}, progress);
    });
    if (remesh::find_self_intersections(shapes::cube().view())) {
        // Of 280: the search for pairs polls 60 times.
        expect_polls("self-intersections", 250, [&](const Progress& progress) {
            (void)remesh::find_self_intersections(mesh.view(), 1, progress);
        });
        const TriangleMesh result = shapes::sphere(3);
        expect_polls("evaluate", 200, [&](const Progress& progress) {
            (void)remesh::evaluate(mesh.view(), result.view(),
                                   {.samples = 5000, .num_threads = 1, .progress = progress});
        });
    }
}

TEST(Polls, AreInTheIntrinsicTriangulationAndWhatIsMadeOfIt) {
    const agvd::Surface even = agvd::build_surface(sphere().view());
    expect_polls("edges", 18, [&](const Progress& progress) {
        const agvd::IntrinsicTriangulation base(even, {.num_threads = 1, .progress = progress});
    });
    expect_polls("splits", 130, [&](const Progress& progress) {
        const agvd::IntrinsicTriangulation base(
            even, {.max_length = 0.018, .num_threads = 1, .progress = progress});
    });
    TriangleMesh needles = shapes::sphere(5);
    for (agvd::Vec3& p : needles.positions) p.x() *= 20;
    const agvd::Surface surface = agvd::build_surface(needles.view());
    expect_polls("flips", 20, [&](const Progress& progress) {
        const agvd::IntrinsicTriangulation base(surface, {.num_threads = 1, .progress = progress});
    });
    const agvd::IntrinsicTriangulation base(surface);
    expect_polls("pieces", 80, [&](const Progress& progress) {
        const agvd::FacePieces pieces(base, 0.01, 1, progress);
    });
    expect_polls("prepared", 150, [&](const Progress& progress) {
        const remesh::PreparedSurface prepared(surface, 0.5, 1, progress);
    });
}

TEST(Polls, AreInDiagramsAndTheirMeasures) {
    const Scene scene(4000);
    expect_polls("diagram", 40, [&](const Progress& progress) {
        (void)agvd::build_diagram(scene.surface, scene.sites, scene.propagation,
                                  {.num_threads = 1, .progress = progress});
    });
    const agvd::IntrinsicTriangulation base(scene.surface);
    const std::vector<agvd::SurfacePoint> on_base = base.to_intrinsic(scene.sites);
    const agvd::Diagram intrinsic = agvd::build_diagram(
        base.surface(), on_base, agvd::propagate(base.surface(), on_base, {.num_threads = 1}),
        {.num_threads = 1});
    expect_polls("diagram on the input", 30, [&](const Progress& progress) {
        (void)agvd::diagram_on_input(base, intrinsic, progress);
    });
    expect_polls("compare", 40, [&](const Progress& progress) {
        (void)agvd::compare_diagrams(
            scene.surface, scene.diagram, scene.diagram,
            {.spacing = 0.2, .area_samples = 5000, .num_threads = 1, .progress = progress});
    });
    const std::array<const agvd::Diagram*, 1> diagrams{&scene.diagram};
    expect_polls("bisectors", 40, [&](const Progress& progress) {
        (void)agvd::exact_bisector_errors(
            scene.surface, scene.sites, diagrams,
            {.max_points = 200, .num_threads = 1, .progress = progress});
    });
}

class FilePolls : public Scratch {};

// Nobody ever writes to it.
TEST_F(FilePolls, AreInWaitingForAPipe) {
    ASSERT_EQ(mkfifo(at("pipe.off").c_str(), 0600), 0);
    int polls = 0;
    const Progress progress = [&](double) { return ++polls < 5; };
    EXPECT_THROW((void)remesh::read_mesh(at("pipe.off"), progress), Cancelled);
    EXPECT_EQ(polls, 5);
}

TEST_F(FilePolls, AreInReadingAndWriting) {
    const TriangleMesh mesh = sphere();
    for (const char* name : {"mesh.ply", "mesh.obj", "mesh.off", "mesh.stl"}) {
        put(name, "old");
        const auto old_stays = [&](const Progress& progress) {
            try {
                remesh::write_mesh(at(name), mesh.view(), progress);
            } catch (const Cancelled&) {
                EXPECT_EQ(bytes(name), "old");
                throw;
            }
            put(name, "old");
        };
        expect_polls(name, 5, old_stays);
        put(name, mesh);
        expect_polls(name, 10, [&](const Progress& progress) {
            (void)remesh::read_mesh(at(name), progress);
        });
    }
    EXPECT_EQ(num_files(), 4u);  // No temporary is left.
    std::string sites;
    for (int i = 0; i < 3000; ++i) sites += "p 1 0 0\n";
    put("sites.txt", sites);
    expect_polls("sites", 3, [&](const Progress& progress) {
        (void)remesh::read_sites(at("sites.txt"), mesh.view(), progress);
    });
}

// Writing alone, of a text that is there already.
TEST_F(FilePolls, AreInWritingALongText) {
    const std::string text(60'000'000, 'x');
    expect_polls("text", 10, [&](const Progress& progress) {
        remesh::write_file_atomically(at("text"), text, progress);
    });
}

TEST_F(FilePolls, AreInReadingAndWritingDiagrams) {
    const Scene scene(1000);
    for (const char* name : {"d.vtp", "d.obj", "d.ply", "d.agvd"}) {
        expect_polls(name, 3, [&](const Progress& progress) {
            remesh::write_diagram(at(name), scene.surface, scene.sites, scene.diagram, progress);
        });
    }
    expect_polls("read", 20, [&](const Progress& progress) {
        (void)remesh::read_diagram(at("d.agvd"), progress);
    });
}

}  // namespace
