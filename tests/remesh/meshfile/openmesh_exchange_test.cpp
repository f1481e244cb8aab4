#include "remesh/meshfile/openmesh_exchange.h"

#include <gtest/gtest.h>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <limits>

#include "agvd/core/random.h"
#include "agvd/mesh/topology.h"
#include "support/shapes.h"

using agvd::FaceId;
using agvd::Index;
using agvd::Triangle;

namespace {

struct FloatTraits : OpenMesh::DefaultTraits {
    VertexAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
};
using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<FloatTraits>;

// Each triangle from its lowest corner on: OpenMesh begins where it likes.
std::vector<Triangle> from_lowest(std::vector<Triangle> triangles) {
    for (Triangle& t : triangles)
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return triangles;
}

std::vector<Index> values(const std::vector<FaceId>& faces) {
    std::vector<Index> result;
    for (const FaceId f : faces) result.push_back(f.value());
    return result;
}

}  // namespace

TEST(OpenMeshExchange, ManifoldsGoThereAndBackUnchanged) {
    for (const agvd::TriangleMesh& mesh :
         {shapes::jitter(shapes::torus(11, 7), 0.01, 1), shapes::tube(8, 3),
          shapes::join(shapes::sphere(2), shapes::grid(4))}) {
        const remesh::ToOpenMesh there = remesh::to_openmesh(mesh.view());
        EXPECT_TRUE(there.missing_faces.empty());
        const remesh::FromOpenMesh back = remesh::from_openmesh(there.mesh);
        EXPECT_EQ(back.mesh.positions, mesh.positions);
        EXPECT_EQ(from_lowest(back.mesh.triangles), from_lowest(mesh.triangles));
        ASSERT_EQ(back.faces.size(), mesh.triangles.size());
        EXPECT_EQ(back.faces[5].idx(), 5);
    }
}

TEST(OpenMeshExchange, ManifoldsFitInWhateverOrderTheirFacesCome) {
    agvd::TriangleMesh mesh = shapes::join(shapes::torus(9, 8), shapes::tube(7, 4));
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        for (Index i = static_cast<Index>(mesh.triangles.size()); i > 1; --i) {
            const auto j = static_cast<std::size_t>(agvd::random_unit(seed, 0, i) * i);
            std::swap(mesh.triangles[i - 1], mesh.triangles[j]);
        }
        EXPECT_TRUE(remesh::to_openmesh(mesh.view()).missing_faces.empty()) << seed;
    }
}

TEST(OpenMeshExchange, PolygonsAreCutAndTrianglesFitIntoMeshesOfPolygons) {
    using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<FloatTraits>;
    PolyMesh mesh;
    std::vector<OpenMesh::VertexHandle> v;
    for (const float x : {0.f, 1.f, 3.f}) {
        for (const float y : {0.f, 1.f}) v.push_back(mesh.add_vertex({x, y, 0}));
    }
    mesh.add_face(v[0], v[2], v[3], v[1]);
    mesh.add_face(v[2], v[4], v[5]);
    mesh.add_face(v[2], v[5], v[3]);
    const remesh::FromOpenMesh triangles = remesh::from_openmesh(mesh);
    const agvd::MeshView view = triangles;
    EXPECT_EQ(view.triangles.size(), 4u);
    EXPECT_EQ(triangles.faces, (std::vector{OpenMesh::FaceHandle(0), OpenMesh::FaceHandle(0),
                                            OpenMesh::FaceHandle(1), OpenMesh::FaceHandle(2)}));
    double area = 0;
    for (const auto& [a, b, c] : view.triangles) {
        const agvd::Vec3 &p = view.positions[a], &q = view.positions[b], &r = view.positions[c];
        area += (q - p).cross(r - p).z() / 2;
    }
    EXPECT_EQ(area, 3);

    const auto back = remesh::to_openmesh<PolyMesh>(triangles.mesh);
    EXPECT_TRUE(back.missing_faces.empty());
    EXPECT_EQ(back.mesh.n_vertices(), 6u);
    EXPECT_EQ(back.mesh.n_faces(), 4u);
    EXPECT_EQ(back.mesh.point(OpenMesh::VertexHandle(4)), PolyMesh::Point(3, 0, 0));
}

TEST(OpenMeshExchange, DeletedElementsAreSkipped) {
    FloatMesh mesh;
    const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({1, 0, 0}),
               c = mesh.add_vertex({1, 1, 0}), d = mesh.add_vertex({0, 1, 0}),
               e = mesh.add_vertex({0.1f, 2, 0});
    mesh.add_face(a, b, c);
    mesh.add_face(a, c, d);
    mesh.add_face(d, c, e);
    mesh.delete_vertex(b);
    const remesh::FromOpenMesh result = remesh::from_openmesh(mesh);
    EXPECT_EQ(from_lowest(result.mesh.triangles), (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
    ASSERT_EQ(result.mesh.positions.size(), 4u);
    EXPECT_EQ(result.mesh.positions[3], agvd::Vec3(0.1f, 2, 0));
    EXPECT_EQ(result.vertices, (std::vector<OpenMesh::VertexHandle>{a, c, d, e}));
    EXPECT_EQ(result.faces, (std::vector{OpenMesh::FaceHandle(1), OpenMesh::FaceHandle(2)}));
    mesh.garbage_collection();
    EXPECT_EQ(remesh::from_openmesh(mesh).mesh.triangles.size(), 2u);
}

TEST(OpenMeshExchange, CoordinatesThatAreNotFiniteAreRefused) {
    OpenMesh::TriMesh mesh;
    mesh.add_vertex({0, 0, std::numeric_limits<double>::infinity()});
    EXPECT_THROW(static_cast<void>(remesh::from_openmesh(mesh)), agvd::InvalidInput);
}

TEST(OpenMeshExchange, FacesThatDoNotFitAreReported) {
    agvd::TriangleMesh fan{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}},
                           {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
    remesh::ToOpenMesh result = remesh::to_openmesh(fan.view());
    EXPECT_EQ(values(result.missing_faces), (std::vector<Index>{2}));
    EXPECT_EQ(result.mesh.n_vertices(), 5u) << "torn";
    EXPECT_EQ(result.mesh.n_faces(), 2u);

    fan.triangles = {{0, 1, 2}, {3, 3, 4}, {0, 1, 3}, {4, 0, 4}};
    EXPECT_EQ(values(remesh::to_openmesh(fan.view()).missing_faces), (std::vector<Index>{1, 2, 3}));

    fan.triangles = {{0, 1, 5}};
    EXPECT_THROW(static_cast<void>(remesh::to_openmesh(fan.view())), agvd::InvalidInput);
}

TEST(OpenMeshExchange, TriangleSoupsAreReportedWithoutAWordOrATear) {
    testing::internal::CaptureStderr();
    std::size_t missing = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        agvd::TriangleMesh soup{shapes::icosahedron().positions, {}};
        for (std::uint64_t i = 0; i < 40; ++i) {
            Triangle t{};
            for (std::uint64_t k = 0; k < 3; ++k) {
                t[k] = static_cast<Index>(agvd::random_unit(seed, k, i) * 12);
            }
            soup.triangles.push_back(t);
        }
        const remesh::ToOpenMesh result = remesh::to_openmesh(soup.view());
        missing += result.missing_faces.size();
        EXPECT_EQ(result.mesh.n_faces() + result.missing_faces.size(), soup.triangles.size());
        const agvd::TriangleMesh back = remesh::from_openmesh(result.mesh).mesh;
        EXPECT_EQ(back.positions.size(), 12u);
        for (const FaceId f : result.missing_faces) soup.triangles[f.value()] = {9, 9, 9};
        std::erase(soup.triangles, Triangle{9, 9, 9});
        EXPECT_EQ(from_lowest(back.triangles), from_lowest(soup.triangles));
    }
    EXPECT_GT(missing, 0u);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}
