#include "remesh/clean/carry.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "agvd/core/error.h"
#include "support/dirty_shapes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// A tetrahedron of separate corners, its first face dropped, its others turned over and shuffled:
// what cleaning may do.
struct Case {
    TriangleMesh mesh;
    remesh::CleanResult clean;
};

Case shuffled_tetrahedron() {
    Case c;
    const TriangleMesh closed = shapes::tetrahedron();
    for (const Triangle& t : closed.triangles) {
        const auto v = static_cast<Index>(c.mesh.positions.size());
        for (const Index corner : t) c.mesh.positions.push_back(closed.positions[corner]);
        c.mesh.triangles.push_back({v, v + 1, v + 2});
    }
    c.clean.mesh.positions = closed.positions;
    for (const Index f : {3u, 1u, 2u}) {
        const auto& [a, b, d] = closed.triangles[f];
        c.clean.mesh.triangles.push_back({d, b, a});
        c.clean.face_origin.push_back(f);
    }
    return c;
}

std::string complaint(const SurfacePoint& site) {
    const Case c = shuffled_tetrahedron();
    try {
        (void)remesh::to_cleaned({{FaceId(1), {1, 0, 0}}, site}, c.mesh.view(), c.clean);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "";
}

// A vertex, a point on each edge and one inside, on every face.
std::vector<SurfacePoint> sites_all_over(const TriangleMesh& mesh) {
    std::vector<SurfacePoint> sites;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        for (const auto& barycentric : std::vector<std::array<double, 3>>{{1, 0, 0},
                                                                          {0, 1, 0},
                                                                          {0, 0, 1},
                                                                          {0.3, 0.7, 0},
                                                                          {0, 0.9, 0.1},
                                                                          {0.6, 0, 0.4},
                                                                          {0.2, 0.5, 0.3}}) {
            sites.push_back({FaceId(f), barycentric});
        }
    }
    return sites;
}

void expect_same_places(const std::vector<SurfacePoint>& a, const TriangleMesh& mesh_of_a,
                        const std::vector<SurfacePoint>& b, const TriangleMesh& mesh_of_b,
                        double tolerance) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double gap =
            (position(mesh_of_a.view(), a[i]) - position(mesh_of_b.view(), b[i])).norm();
        EXPECT_LE(gap, tolerance) << "site " << i;
    }
}

void expect_barycentric(const std::vector<SurfacePoint>& sites) {
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const auto& [a, b, c] = sites[i].barycentric;
        EXPECT_TRUE(a >= 0 && b >= 0 && c >= 0) << "site " << i;
        EXPECT_NEAR(a + b + c, 1, 1e-15) << "site " << i;
    }
}

// The slit is 3 by 2; cleaning splits the face below it at the corners of the flat ones.
constexpr double slit_tolerance = 1e-12 * 3.6;

}  // namespace

TEST(CarrySites, PointsStayInPlaceBothWays) {
    const Case c = shuffled_tetrahedron();
    const std::vector<SurfacePoint> sites{
        {FaceId(1), {0.5, 0.25, 0.25}}, {FaceId(2), {0, 0, 1}}, {FaceId(3), {0, 0.125, 0.875}}};
    const auto cleaned = remesh::to_cleaned(sites, c.mesh.view(), c.clean);
    const auto back = remesh::to_original(cleaned, c.mesh.view(), c.clean);
    ASSERT_EQ(cleaned.size(), sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i) {
        EXPECT_EQ(c.clean.face_origin[cleaned[i].face.value()], sites[i].face.value());
        EXPECT_LT(
            (position(c.clean.mesh.view(), cleaned[i]) - position(c.mesh.view(), sites[i])).norm(),
            1e-15);
        EXPECT_EQ(back[i].face, sites[i].face);
        EXPECT_EQ(back[i].barycentric, sites[i].barycentric);
    }
}

TEST(CarrySites, UnusableSitesAreNamed) {
    EXPECT_EQ(complaint({FaceId(2), {0.5, 0.5, 0}}), "");
    EXPECT_NE(complaint({FaceId(4), {1, 0, 0}}).find("site 1"), std::string::npos);
    EXPECT_NE(complaint({FaceId(), {1, 0, 0}}).find("site 1"), std::string::npos);
    EXPECT_NE(complaint({FaceId(2), {1, 1, -1}}).find("site 1"), std::string::npos);
    EXPECT_NE(complaint({FaceId(2), {0.5, 0.1, 0.1}}).find("sum to 1"), std::string::npos);
    EXPECT_NE(complaint({FaceId(0), {0.5, 0.25, 0.25}}).find("site 1 lies on face 0"),
              std::string::npos);
}

TEST(CarrySites, ADroppedFaceHandsItsRimToItsNeighbours) {
    const Case c = shuffled_tetrahedron();
    const std::vector<SurfacePoint> sites{{FaceId(0), {1, 0, 0}}, {FaceId(0), {0, 0.5, 0.5}}};
    const auto cleaned = remesh::to_cleaned(sites, c.mesh.view(), c.clean);
    expect_same_places(sites, c.mesh, cleaned, c.clean.mesh, 1e-15);
}

TEST(CarrySites, SplitAndAbsorbedFacesKeepTheirSitesInPlace) {
    const TriangleMesh mesh = shapes::filled_slit(3);
    const remesh::CleanResult clean = remesh::clean_input(mesh.view());
    ASSERT_GT(clean.counts.absorbed_faces, 0u);

    const auto sites = sites_all_over(mesh);
    const auto cleaned = remesh::to_cleaned(sites, mesh.view(), clean);
    expect_same_places(sites, mesh, cleaned, clean.mesh, slit_tolerance);
    expect_barycentric(cleaned);
    const auto back = remesh::to_original(cleaned, mesh.view(), clean);
    expect_same_places(sites, mesh, back, mesh, slit_tolerance);
    expect_barycentric(back);
}

TEST(CarrySites, PartsOfAFaceFindTheirPlaceInTheWhole) {
    const TriangleMesh mesh = shapes::filled_slit(3);
    const remesh::CleanResult clean = remesh::clean_input(mesh.view());
    const auto sites = sites_all_over(clean.mesh);
    const auto original = remesh::to_original(sites, mesh.view(), clean);
    expect_same_places(sites, clean.mesh, original, mesh, slit_tolerance);
    expect_barycentric(original);
    for (std::size_t i = 0; i < sites.size(); ++i) {
        EXPECT_EQ(original[i].face.value(), clean.face_origin[sites[i].face.value()]);
    }
    const auto again = remesh::to_cleaned(original, mesh.view(), clean);
    expect_same_places(sites, clean.mesh, again, clean.mesh, slit_tolerance);
}

// Two slits overlap in the plane, one half a unit up, so that nothing is welded.
TEST(CarrySites, ASiteOnASplitFaceStaysOnItsOwnPart) {
    TriangleMesh mesh = shapes::filled_slit(3);
    const TriangleMesh slit = mesh;
    const auto first = static_cast<Index>(slit.positions.size());
    const auto first_face = static_cast<Index>(slit.triangles.size());
    for (const Vec3& p : slit.positions) mesh.positions.emplace_back(p.x(), p.y() + 0.5, p.z());
    for (const auto& [a, b, c] : slit.triangles) {
        mesh.triangles.push_back({a + first, b + first, c + first});
    }
    const remesh::CleanResult clean = remesh::clean_input(mesh.view());
    std::vector<SurfacePoint> sites;
    for (const FaceId face : {FaceId(0), FaceId(1), FaceId(first_face), FaceId(first_face + 1)}) {
        sites.push_back({face, {0.2, 0.5, 0.3}});
    }
    const auto back =
        remesh::to_original(remesh::to_cleaned(sites, mesh.view(), clean), mesh.view(), clean);
    for (std::size_t i = 0; i < sites.size(); ++i) EXPECT_EQ(back[i].face, sites[i].face);
}

TEST(CarrySites, UnsplitFacesKeepEveryBit) {
    const TriangleMesh mesh = shapes::filled_slit(3);
    const remesh::CleanResult clean = remesh::clean_input(mesh.view());
    // Face 0 and the fan above the slit (2 to 4) do not touch what is split.
    const auto sites = sites_all_over(mesh);
    const auto back =
        remesh::to_original(remesh::to_cleaned(sites, mesh.view(), clean), mesh.view(), clean);
    std::size_t unsplit = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const Index face = sites[i].face.value();
        if (face != 0 && (face < 2 || face >= 5)) continue;
        EXPECT_EQ(back[i].face, sites[i].face);
        EXPECT_EQ(back[i].barycentric, sites[i].barycentric);
        ++unsplit;
    }
    EXPECT_EQ(unsplit, 4u * 7u);
}

TEST(CarrySites, DecimalsAreMadeToSumToOne) {
    const Case c = shuffled_tetrahedron();
    const auto cleaned = remesh::to_cleaned(
        {{FaceId(1), {0.3333333, 0.3333333, 0.3333333}}, {FaceId(2), {0, 0.3333333, 0.6666666}}},
        c.mesh.view(), c.clean);
    expect_barycentric(cleaned);
    EXPECT_EQ(std::count(cleaned[1].barycentric.begin(), cleaned[1].barycentric.end(), 0.0), 1);
}

// Faces of the tetrahedron are 3, 1, 2 of the given mesh, whose corners are apart.
TEST(CarryShapes, LinesAndRegionsKeepTheirPlaces) {
    const Case c = shuffled_tetrahedron();
    const Surface surface = build_surface(c.clean.mesh.view());
    // Two edges of face 1, one of them twice; then faces 1 and 3 with an edge of face 2.
    const std::vector<std::array<Index, 2>> line{{3, 4}, {5, 4}, {4, 3}}, other{{6, 7}};
    const std::vector<Index> region{3, 1};
    const std::vector<remesh::ShapeView> given{{line, {}}, {other, region}};
    const auto shapes = remesh::carry_shapes(given, c.mesh.view(), c.clean, surface);
    ASSERT_EQ(shapes.size(), 2u);
    EXPECT_TRUE(shapes[0].faces.empty());
    ASSERT_EQ(shapes[0].edges.size(), 2u);
    ASSERT_EQ(shapes[1].edges.size(), 1u);
    const auto is_edge = [&](Index edge, Index a, Index b) {
        const Index h = surface.edge_half[edge];
        const Vec3 &tail = surface.mesh.positions[surface.tail(h)],
                   &head = surface.mesh.positions[surface.head(h)];
        const Vec3 &p = c.mesh.positions[a], &q = c.mesh.positions[b];
        return (tail == p && head == q) || (tail == q && head == p);
    };
    for (const auto& [a, b] : {line[0], line[1]}) {
        EXPECT_TRUE(is_edge(shapes[0].edges[0], a, b) || is_edge(shapes[0].edges[1], a, b));
    }
    EXPECT_TRUE(is_edge(shapes[1].edges[0], 6, 7));
    EXPECT_EQ(shapes[1].faces, (std::vector<Index>{0, 1}));
}

TEST(CarryShapes, UnusableOnesAreNamed) {
    const Case c = shuffled_tetrahedron();
    const Surface surface = build_surface(c.clean.mesh.view());
    const auto complaint = [&](std::vector<std::array<Index, 2>> line, std::vector<Index> region) {
        try {
            (void)remesh::carry_shapes(std::vector<remesh::ShapeView>{{line, region}},
                                       c.mesh.view(), c.clean, surface);
        } catch (const InvalidInput& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(complaint({{3, 4}}, {1}), "");
    EXPECT_NE(complaint({{3, 4}, {3, 6}}, {}).find("between vertices 3 and 6"), std::string::npos);
    EXPECT_NE(complaint({}, {1, 4}).find("face 4, but the mesh has only 4 faces"),
              std::string::npos);
    EXPECT_NE(complaint({}, {0}).find("dropped all faces of the region with face 0"),
              std::string::npos);
    EXPECT_EQ(complaint({}, {0, 2}), "");
}
