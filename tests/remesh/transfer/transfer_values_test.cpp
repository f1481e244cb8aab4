#include "remesh/transfer/transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "agvd/core/error.h"
#include "agvd/mesh/mesh.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "support/files.h"
#include "support/shapes.h"

using agvd::FaceId;
using agvd::Index;
using agvd::SurfacePoint;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::FaceSamples;
using remesh::transfer_face_values;
using remesh::transfer_vertex_values;
using remesh::ValueKind;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

double linear_field(const Vec3& p) { return 3 * p.x() - 2 * p.y() + 5 * p.z() + 1; }

std::vector<double> field_on(const TriangleMesh& mesh) {
    std::vector<double> values;
    for (const Vec3& p : mesh.positions) values.push_back(linear_field(p));
    return values;
}

struct FieldError {
    double rms = 0, largest = 0, range = 0;
};

// Remeshes with N vertices, transfers the linear field, and compares it with the field there.
FieldError field_error(const TriangleMesh& mesh, Index num_samples) {
    const auto made = remesh::remesh(mesh.view(), {.num_samples = num_samples});
    const auto map = remesh::map_to_input(mesh.view(), made.mesh.view(), made.sites);
    const std::vector<double> given = field_on(mesh), wanted = field_on(made.mesh);
    const std::vector<double> values =
        transfer_vertex_values(given, mesh.view(), map.vertices, ValueKind::Number);
    FieldError error;
    for (std::size_t v = 0; v < values.size(); ++v) {
        const double difference = std::abs(values[v] - wanted[v]);
        error.rms += difference * difference / static_cast<double>(values.size());
        error.largest = std::max(error.largest, difference);
    }
    error.rms = std::sqrt(error.rms);
    const auto [low, high] = std::minmax_element(given.begin(), given.end());
    error.range = *high - *low;
    return error;
}

TriangleMesh triangle_mesh() { return {{{0, 0, 0}, {4, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}; }

}  // namespace

TEST(TransferVertexValues, LinearFieldsOnAPlaneComeOutExactly) {
    TriangleMesh plane = shapes::grid(40);
    for (Vec3& p : plane.positions) {  // Vertices off any line, the boundary as it is.
        const bool is_inner = p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1;
        if (is_inner) p += 0.008 * Vec3(std::sin(90 * p.y()), std::sin(70 * p.x()), 0);
    }
    const FieldError error = field_error(plane, 500);
    EXPECT_LT(error.largest, 1e-12);
    EXPECT_GT(error.range, 4);
}

TEST(TransferVertexValues, LinearFieldsOnBunnyAreWithinAThousandthOfTheirRange) {
    const auto path = files::find_mesh("bunny.off");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
    const FieldError error = field_error(remesh::read_mesh(path).mesh, 2000);
    RecordProperty("rms_over_range", std::to_string(error.rms / error.range));
    std::printf("bunny: RMS %.2e, largest %.2e of the range\n", error.rms / error.range,
                error.largest / error.range);
    EXPECT_LT(error.rms, 1e-3 * error.range);
}

TEST(TransferVertexValues, NumbersAreInterpolatedAndLabelsAreOfTheNearestCorner) {
    const TriangleMesh mesh = triangle_mesh();
    const std::vector<double> values{10, 20, 40};
    const std::vector<SurfacePoint> places{
        {FaceId(0), {0.25, 0.5, 0.25}}, {FaceId(0), {0.4, 0.25, 0.35}}, {FaceId(0), {0, 0, 1}}};
    EXPECT_EQ(transfer_vertex_values(values, mesh.view(), places, ValueKind::Number),
              (std::vector<double>{22.5, 23, 40}));
    // The second place is at (1, .35): corner 0 is nearest. The first, at (2, .25), is as near to
    // corner 1.
    EXPECT_EQ(transfer_vertex_values(values, mesh.view(), places, ValueKind::Label),
              (std::vector<double>{10, 10, 40}));
}

TEST(TransferVertexValues, CornersOfWeightZeroDoNotCountAndEqualValuesStay) {
    const TriangleMesh mesh = triangle_mesh();
    const std::vector<SurfacePoint> places{{FaceId(0), {0.5, 0.5, 0}},
                                           {FaceId(0), {0.1, 0.2, 0.7}}};
    const auto values = transfer_vertex_values(std::vector{1.0, 2.0, no_number}, mesh.view(),
                                               places, ValueKind::Number);
    EXPECT_EQ(values[0], 1.5);
    EXPECT_TRUE(std::isnan(values[1]));
    const double third = 1.0 / 3;
    EXPECT_EQ(transfer_vertex_values(std::vector{third, third, third}, mesh.view(), places,
                                     ValueKind::Number),
              (std::vector<double>{third, third}));
}

TEST(TransferFaceValues, NumbersAreMeansAndLabelsHaveTheLargestPart) {
    FaceSamples faces{};  // 7 times face 0, 5 times face 1, 4 times face 2.
    std::fill(faces.begin() + 7, faces.begin() + 12, Index{1});
    std::fill(faces.begin() + 12, faces.end(), Index{2});
    const std::vector<FaceSamples> samples{faces};
    EXPECT_EQ(transfer_face_values(std::vector{1.0, 2.0, 3.0}, samples, ValueKind::Number),
              std::vector<double>{29.0 / 16});
    EXPECT_EQ(transfer_face_values(std::vector{9.0, 5.0, 7.0}, samples, ValueKind::Label),
              std::vector<double>{9});
    // Two faces of one label outweigh a third.
    EXPECT_EQ(transfer_face_values(std::vector{9.0, 5.0, 5.0}, samples, ValueKind::Label),
              std::vector<double>{5});
    EXPECT_THROW(
        static_cast<void>(transfer_face_values(std::vector{1.0, 2.0}, samples, ValueKind::Label)),
        agvd::InvalidOption);
}

TEST(TransferFaceValues, EqualPartsGiveTheLeastLabel) {
    FaceSamples faces{};
    std::fill(faces.begin() + 8, faces.end(), Index{1});
    const std::vector<FaceSamples> samples{faces};
    EXPECT_EQ(transfer_face_values(std::vector{8.0, 3.0}, samples, ValueKind::Label),
              std::vector<double>{3});
}

TEST(TransferVertexValues, TheNumberOfValuesIsChecked) {
    const TriangleMesh mesh = triangle_mesh();
    EXPECT_THROW(static_cast<void>(transfer_vertex_values(std::vector{1.0, 2.0}, mesh.view(), {},
                                                          ValueKind::Number)),
                 agvd::InvalidOption);
}

TEST(VertexNormals, TheyAreThoseOfASphereAndOfACubesCorners) {
    const TriangleMesh sphere = shapes::sphere(4);
    const auto normals = remesh::vertex_normals(sphere.view());
    ASSERT_EQ(normals.size(), sphere.positions.size());
    for (std::size_t v = 0; v < normals.size(); ++v) {
        EXPECT_GT(normals[v].dot(sphere.positions[v]), 0.9999);
        EXPECT_NEAR(normals[v].norm(), 1, 1e-14);
    }
    // Weights by angles: how the sides are cut does not matter.
    const TriangleMesh cube = shapes::cube();
    const auto corners = remesh::vertex_normals(cube.view());
    for (std::size_t v = 0; v < corners.size(); ++v) {
        for (const double x : corners[v]) EXPECT_NEAR(std::abs(x), 1 / std::sqrt(3.0), 1e-14);
    }
}
