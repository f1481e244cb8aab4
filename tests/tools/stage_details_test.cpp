#include "stage_details.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

namespace {

using remesh::Stage;

// What follows the time in the line of a stage.
std::string line_of(const remesh::RemeshResult& result, const std::string& stage) {
    std::istringstream lines(cli::stage_details(result, 12));
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(stage + ' ')) return line.substr(line.find(" s  ") + 4);
    }
    return "";
}

remesh::RemeshResult some_result() {
    remesh::RemeshResult result;
    for (const Stage stage :
         {Stage::Clean, Stage::Sample, Stage::Relax, Stage::Propagate, Stage::Diagram, Stage::Dual,
          Stage::Delaunay, Stage::Place, Stage::Check}) {
        result.seconds.emplace_back(stage, 1.5);
    }
    result.mesh.positions.resize(4);
    result.mesh.triangles.resize(2);
    result.cleaned.duplicate_faces = 1;
    result.input_topology.face_component.resize(11);
    result.refined_faces = 20;
    result.components_dropped = 3;
    result.sizing.num_samples = 5;
    result.relaxation = {{2, {4, 3}}, {5, {8, 7, 6, 5, 4, 4, 4, 4, 4, 4, 2, 1}}};
    result.propagation_bytes = 1000;
    result.certified_error = 0.25;
    result.features.curves = 6;
    result.features.vertices = 7;
    result.dual = {.sites = 30,
                   .sites_of_cells = 28,
                   .narrow_sites = 2,
                   .simplified_parts = 1,
                   .simplified_patches = 0};
    result.sites_dropped = 14;
    result.delaunay.failing_before = 18;
    result.delaunay.flips = 19;
    result.delaunay.failing_after = 21;
    result.self_intersections = 22;
    result.input_self_intersections = 23;
    result.unfitted_vertices = 24;
    return result;
}

TEST(StageDetails, LeaveOutAnEnergyThatIsNoShare) {
    remesh::RemeshResult result = some_result();
    result.relaxation = {{2, {0, 0, 0}}};
    EXPECT_EQ(line_of(result, "relax"), "2 sites, 2 steps");
}

TEST(StageDetails, HasALineForEachStage) {
    const remesh::RemeshResult result = some_result();
    EXPECT_EQ(cli::stage_details(result, 12).substr(0, 32), "clean        1.50 s  12 faces, 1");
    EXPECT_EQ(line_of(result, "clean"),
              "12 faces, 11 when cleaned, 20 in the base; repaired: 1 duplicate face; components "
              "dropped: 3");
    EXPECT_EQ(line_of(result, "sample"), "5 samples asked for");
    EXPECT_EQ(line_of(result, "relax"),
              "2 sites, 1 steps, energy 1 0.75; 5 sites, 11 steps, energy 1 0.25 0.125");
    EXPECT_EQ(line_of(result, "propagate"), "1000 bytes, distances at most 25 % above exact");
    EXPECT_EQ(line_of(result, "diagram"), "creases and boundary: 6 curves with 7 vertices");
    EXPECT_EQ(line_of(result, "dual"),
              "28 of 30 sites with the triangles of their cells; cells that are no discs, or meet "
              "others along several arcs: 2; parts simplified: 1; sites dropped: 14");
    EXPECT_EQ(line_of(result, "delaunay"), "18 edges failed, 19 flips, 21 fail");
    EXPECT_EQ(line_of(result, "place"), "4 vertices, 2 faces");
    EXPECT_EQ(line_of(result, "check"),
              "self-intersections: 22 in the result, 23 in the input; 24 vertices moved back");
}

TEST(StageDetails, SaysWhatWasNotDone) {
    remesh::RemeshResult result = some_result();
    result.relaxation.clear();
    result.certified_error = std::numeric_limits<double>::infinity();
    result.self_intersections.reset();
    EXPECT_EQ(line_of(result, "relax"), "sites stay as sampled");
    EXPECT_EQ(line_of(result, "propagate"), "1000 bytes, distances of unknown error");
    EXPECT_EQ(line_of(result, "check").substr(0, 31), "self-intersections: not counted");
}

}  // namespace
