#include "agvd/mesh/surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/checks.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

// Its last vertex is in every face.
TriangleMesh umbrella(Index num_faces) {
    TriangleMesh mesh;
    for (Index i = 0; i < num_faces; ++i) {
        const double angle = 2 * std::acos(-1.0) * i / num_faces;
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
        mesh.triangles.push_back({i, (i + 1) % num_faces, num_faces});
    }
    mesh.positions.emplace_back(0, 0, 1);
    return mesh;
}

bool is_found(const TriangleMesh& mesh) { return find_connectivity(mesh.view()).has_value(); }

}  // namespace

TEST(Connectivity, TwinsAreTheHalfEdgesThatRunBack) {
    for (const TriangleMesh& mesh :
         {shapes::sphere(3), shapes::torus(9, 7), shapes::tube(12, 5), shapes::grid(6)}) {
        const auto found = find_connectivity(mesh.view());
        ASSERT_TRUE(found);
        const auto end = [&](Index h) { return mesh.triangles[h / 3][next_half_edge(h) % 3]; };
        const auto tail = [&](Index h) { return mesh.triangles[h / 3][h % 3]; };
        for (Index h = 0; h < 3 * mesh.triangles.size(); ++h) {
            Index twin = no_index;
            for (Index g = 0; g < 3 * mesh.triangles.size(); ++g) {
                if (tail(g) == end(h) && end(g) == tail(h)) twin = g;
            }
            EXPECT_EQ(found->twin[h], twin);
        }
        for (Index v = 0; v < mesh.positions.size(); ++v) {
            const Index h = found->outgoing[v];
            EXPECT_EQ(tail(h), v);
            if (found->twin[h] == no_index) continue;
            for (Index g = 0; g < found->twin.size(); ++g) {
                const bool is_boundary = tail(g) == v && found->twin[g] == no_index;
                EXPECT_FALSE(is_boundary) << "the boundary comes first";
            }
        }
    }
}

TEST(Connectivity, IsolatedVerticesHaveNoHalfEdge) {
    TriangleMesh mesh = shapes::tetrahedron();
    mesh.positions.emplace_back(5, 5, 5);
    EXPECT_EQ(find_connectivity(mesh.view())->outgoing[4], no_index);
}

TEST(Connectivity, HubsOfThousandsOfFacesAreFine) {
    TriangleMesh high = umbrella(5000);
    EXPECT_TRUE(is_found(high));
    // The same with the hub as vertex 0, where all its edges run up.
    TriangleMesh low = high;
    std::swap(low.positions.front(), low.positions.back());
    for (Triangle& t : low.triangles) {
        for (Index& v : t) v = v == 5000 ? 0 : v == 0 ? 5000 : v;
    }
    EXPECT_TRUE(is_found(low));
    low.triangles.push_back(low.triangles[17]);
    EXPECT_FALSE(is_found(low));
}

TEST(Connectivity, ThereIsNoneOfWhatIsNotAnOrientedManifold) {
    const auto pages = [](std::vector<Triangle> triangles) {
        TriangleMesh made;
        for (int i = 0; i < 6; ++i) made.positions.emplace_back(i, i * i, i * i * i);
        made.triangles = std::move(triangles);
        return made;
    };
    EXPECT_FALSE(is_found(pages({{0, 1, 1}}))) << "a repeated corner";
    EXPECT_TRUE(is_found(pages({{0, 1, 2}, {1, 0, 3}})));
    EXPECT_FALSE(is_found(pages({{0, 1, 2}, {0, 1, 3}}))) << "both run up";
    EXPECT_FALSE(is_found(pages({{1, 0, 2}, {1, 0, 3}}))) << "both run down";
    EXPECT_FALSE(is_found(pages({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}))) << "three faces";
    EXPECT_FALSE(is_found(pages({{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}))) << "three faces";
    EXPECT_FALSE(is_found(pages({{0, 1, 2}, {0, 3, 4}}))) << "two fans";
    // A tetrahedron with a flap, whose faces could be taken for one fan around each vertex.
    const std::vector<Triangle> up{{0, 1, 4}, {0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    const std::vector<Triangle> down{{1, 0, 2}, {1, 2, 3}, {1, 3, 0}, {0, 3, 2}, {1, 0, 4}};
    EXPECT_FALSE(is_found(pages(up)));
    EXPECT_FALSE(is_found(pages(down)));
}

TEST(Connectivity, GivesTheSurfaceThatTheMeshAloneGives) {
    for (const TriangleMesh& mesh : {shapes::jitter(shapes::sphere(4), 0.01, 3),
                                     shapes::jitter(shapes::tube(40, 20), 0.01, 5)}) {
        const Surface expected = build_surface(mesh.view(), 1);
        for (const int threads : {1, 2, 8}) {
            const Surface s = build_surface(mesh, *find_connectivity(mesh.view()), threads);
            checks::expect_same(s, expected);
        }
    }
}
