#include "remesh/repair/carry_sites.h"

#include <gtest/gtest.h>

#include "agvd/core/error.h"
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
    EXPECT_NE(complaint({FaceId(0), {1, 0, 0}}).find("face 0"), std::string::npos);
}
