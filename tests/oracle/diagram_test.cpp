// Distances and diagrams of the engine against exact geodesics.

#include <gtest/gtest.h>

#include <filesystem>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "paper/compare.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/files.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// One error for each number of Steiner points.
std::vector<DiagramError> errors_of(const Surface& surface, const std::vector<SurfacePoint>& sites,
                                    const std::vector<int>& steiner_points) {
    std::vector<Propagation> propagations;
    std::vector<Diagram> diagrams;
    for (const int m : steiner_points) {
        propagations.push_back(
            propagate(surface, sites, {.engine = Engine::Steiner, .steiner_points = m}));
        diagrams.push_back(build_diagram(surface, sites, propagations.back()));
    }
    std::vector<Approximation> approximations;
    for (std::size_t i = 0; i < diagrams.size(); ++i) {
        approximations.push_back({propagations[i], diagrams[i]});
    }
    return compare_with_exact(surface, sites, approximations, {.area_samples = 2000});
}

// Distances of real paths, in double.
constexpr double path_rounding = 1e-12;

struct DiagramShape {
    const char* name;
    TriangleMesh (*make)();
};

class SmallMeshes : public testing::TestWithParam<DiagramShape> {
protected:
    Surface surface = build_surface(GetParam().make().view());
};

const DiagramShape small_meshes[] = {
    {"sphere", [] { return shapes::sphere(3); }},
    {"jittered_sphere", [] { return shapes::jitter(shapes::sphere(3), 0.02, 1); }},
    {"torus", [] { return shapes::torus(36, 16); }},
    {"jittered_torus", [] { return shapes::jitter(shapes::torus(36, 16), 0.02, 2); }},
    {"open_grid", [] { return shapes::grid(16); }},
    {"jittered_grid", [] { return shapes::jitter(shapes::grid(16), 0.02, 3); }},
    {"open_tube", [] { return shapes::tube(30, 12); }},
    {"cube",
     [] { return shapes::subdivide(shapes::subdivide(shapes::subdivide(shapes::cube()))); }},
};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Oracle, SmallMeshes, testing::ValuesIn(small_meshes),
                         [](const auto& test) { return test.param.name; });

TEST_P(SmallMeshes, DistancesAreNeverBelowTheExactOnes) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const auto sites = points::scattered(surface, 3 + 9 * static_cast<Index>(seed), seed);
        for (const DiagramError& error : errors_of(surface, sites, {0, 1, 2, 5, 8})) {
            EXPECT_GE(error.min_relative_distance, -path_rounding) << "seed " << seed;
        }
    }
}

TEST_P(SmallMeshes, ErrorsFallWithMoreSteinerPoints) {
    const auto errors = errors_of(surface, points::scattered(surface, 15, 7), {2, 6, 18});
    for (std::size_t i = 1; i < errors.size(); ++i) {
        EXPECT_LT(errors[i].bisectors.mean, errors[i - 1].bisectors.mean);
        EXPECT_LT(errors[i].mean_relative_distance, errors[i - 1].mean_relative_distance);
        EXPECT_LE(errors[i].wrong_label_area, errors[i - 1].wrong_label_area);
    }
}

TEST_P(SmallMeshes, EightSteinerPointsKeepTheBisectorErrorBelowFourThousandths) {
    surface = build_surface(shapes::subdivide(surface.mesh).view());
    const DiagramError error = errors_of(surface, points::scattered(surface, 12, 4), {8})[0];
    EXPECT_GT(error.bisectors.num_points, 50u);
    EXPECT_LT(error.bisectors.mean, 4e-3);
    EXPECT_LT(error.wrong_label_area, 1e-2);
}

namespace {

class RealMeshes : public testing::TestWithParam<const char*> {};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Oracle, RealMeshes,
                         testing::Values("data/shell.obj", "rocker-arm.obj", "fandisk.off",
                                         "fertility.off"),
                         [](const auto& test) {
                             std::string name = std::filesystem::path(test.param).stem();
                             std::erase(name, '-');
                             return name;
                         });

TEST_P(RealMeshes, DiagramsAreCloseToTheExactOne) {
    const std::filesystem::path path = files::find_mesh(GetParam());
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << path << " is absent; set AGVD_MESHES to the folder that has it";
    }
    const Surface surface = build_surface(remesh::read_mesh(path).mesh.view());
    std::vector<SurfacePoint> sites;
    for (Index i = 0; i < 30; ++i) {
        sites.push_back(point_at(surface, i * (surface.num_vertices() / 30)));
    }
    const auto errors = errors_of(surface, sites, {2, 8});
    for (const DiagramError& error : errors) EXPECT_GE(error.min_relative_distance, -path_rounding);
    EXPECT_LT(errors[1].bisectors.mean, errors[0].bisectors.mean);
    EXPECT_LT(errors[1].bisectors.p95, errors[0].bisectors.p95);
    EXPECT_LT(errors[1].wrong_label_area, errors[0].wrong_label_area);
    EXPECT_LT(errors[1].bisectors.mean, 4e-3);
}
