#include <gtest/gtest.h>

#include <cmath>

#include "agvd/core/error.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/shapes.h"

using agvd::Vec3;

namespace {

agvd::TriangleMesh moved(agvd::TriangleMesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.positions) p += by;
    return mesh;
}

remesh::RoundingLoss loss_of(const agvd::TriangleMesh& mesh, const char* name = "a.stl") {
    return remesh::rounding_loss({name}, mesh.view());
}

}  // namespace

TEST(RoundingLoss, IsThatOfTheWorstVertex) {
    // Between 2^23 and 2^24 floats are whole numbers.
    const agvd::TriangleMesh mesh{{{9e6, 0, 0}, {9e6 + 0.25, 3, 0}, {9e6, 0, 4}}, {{0, 1, 2}}};
    const remesh::RoundingLoss loss = loss_of(mesh);
    EXPECT_EQ(loss.largest_shift, 0.25);
    EXPECT_EQ(loss.diagonal, std::sqrt(0.25 * 0.25 + 9 + 16));
    EXPECT_EQ(loss.shortest_edge, std::sqrt(0.25 * 0.25 + 9));
    EXPECT_EQ(loss.middle, Vec3(9e6 + 0.125, 1.5, 2));
    EXPECT_EQ(loss.merged, 0u);
    EXPECT_TRUE(loss.matters());
}

TEST(RoundingLoss, CountsVerticesThatFallOntoOthers) {
    const agvd::TriangleMesh mesh{
        {{9e6, 0, 0}, {9e6 + 0.25, 0, 0}, {9e6, 0, 4}, {9e6, 0, 4}, {9e6, 0, 4.5}}, {{0, 1, 2}}};
    EXPECT_EQ(loss_of(mesh).merged, 1u);  // Two lay on one spot before.
    EXPECT_EQ(loss_of({mesh.positions, {{2, 3, 4}}}).shortest_edge, 0.5);
    const remesh::RoundingLoss small{.largest_shift = 1e-9, .diagonal = 1, .shortest_edge = 1};
    EXPECT_FALSE(small.matters());
    remesh::RoundingLoss merging = small;
    merging.merged = 1;
    EXPECT_TRUE(merging.matters());
}

TEST(RoundingLoss, MattersFarFromTheOriginOnly) {
    const agvd::TriangleMesh sphere = shapes::sphere(3);
    EXPECT_FALSE(loss_of(sphere).matters());
    EXPECT_FALSE(loss_of(moved(sphere, {3, 0, -4})).matters());
    EXPECT_TRUE(loss_of(moved(sphere, {500'000, 5'400'000, 100})).matters());
    agvd::TriangleMesh large = sphere;
    for (Vec3& p : large.positions) p *= 1e9;
    EXPECT_FALSE(loss_of(large).matters());
}

TEST(RoundingLoss, MattersWhereAnEdgeIsShortOrTheDiagonal) {
    EXPECT_TRUE((remesh::RoundingLoss{.largest_shift = 1e-8, .diagonal = 1, .shortest_edge = 1e-7})
                    .matters());
    EXPECT_FALSE((remesh::RoundingLoss{.largest_shift = 1e-8, .diagonal = 1, .shortest_edge = 1e-6})
                     .matters());
    EXPECT_TRUE(
        (remesh::RoundingLoss{.largest_shift = 2e-6, .diagonal = 1, .shortest_edge = 1}).matters());
}

TEST(RoundingLoss, ThereIsNoneInDoublePrecision) {
    const agvd::TriangleMesh far = moved(shapes::sphere(2), {1e7, 0, 0});
    for (const char* name : {"a.ply", "a.obj", "a.off"}) {
        EXPECT_EQ(loss_of(far, name).largest_shift, 0) << name;
        EXPECT_EQ(remesh::describe(loss_of(far, name), {name}), "");
    }
    EXPECT_THROW(static_cast<void>(loss_of(far, "a.xyz")), agvd::IoError);
}

TEST(RoundingLoss, TheTextHasFiguresAndARemedy) {
    const remesh::RoundingLoss loss{.largest_shift = 0.25,
                                    .diagonal = 10,
                                    .shortest_edge = 1,
                                    .merged = 7,
                                    .middle = {5e5, 5.4e6, 12}};
    EXPECT_EQ(remesh::describe(loss, {"b/a.stl"}),
              "b/a.stl: stl stores coordinates in single precision: vertices move by up to 0.25, "
              "2.5 % of the diagonal and 25 % of the shortest edge, and 7 fall onto others; write "
              ".ply, .obj or .off, or move the mesh to the origin first (its middle is at "
              "500000 5400000 12)");
    EXPECT_EQ(remesh::describe({}, {"a.stl"}), "");
}
