#include "agvd/paths/distances.h"

#include <gtest/gtest.h>

#include <cmath>

#include "agvd/core/error.h"
#include "agvd/mesh/patch.h"
#include "agvd/mesh/surface_points.h"
#include "support/line_sites.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

Surface flat_square(Index n) {
    TriangleMesh mesh = shapes::jitter(shapes::grid(n), 0.2 / n, 3);
    const TriangleMesh even = shapes::grid(n);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const Vec3& q = even.positions[v];
        Vec3& p = mesh.positions[v];
        p.z() = 0;
        if (q.x() == 0 || q.x() == 1 || q.y() == 0 || q.y() == 1) p = q;
    }
    return build_surface(mesh.view());
}

}  // namespace

TEST(Distances, OfPointsInASquareAreStraight) {
    const Surface surface = flat_square(12);
    const MeshView mesh = surface.mesh.view();
    const auto sites = points::scattered(surface, 5, 2);
    const auto targets = points::scattered(surface, 300, 7);
    for (const double radius : {infinity, 0.2}) {
        const Distances found =
            find_distances(surface, sites, targets, {.max_distance = radius, .max_error = 0});
        ASSERT_EQ(found.point_site.size(), targets.size());
        Index num_reached = 0;
        for (std::size_t i = 0; i < targets.size(); ++i) {
            Index nearest = 0;
            const auto distance = [&](Index s) {
                return (position(mesh, sites[s]) - position(mesh, targets[i])).norm();
            };
            for (Index s = 1; s < sites.size(); ++s) {
                if (distance(s) < distance(nearest)) nearest = s;
            }
            if (distance(nearest) > radius) {
                EXPECT_FALSE(found.point_site[i].is_valid());
                EXPECT_EQ(found.point_distance[i], infinity);
                continue;
            }
            ++num_reached;
            EXPECT_EQ(found.point_site[i].value(), nearest);
            EXPECT_NEAR(found.point_distance[i], distance(nearest), 1e-13);
        }
        EXPECT_GT(num_reached, 30u);
        EXPECT_EQ(num_reached == targets.size(), radius == infinity);
    }
}

TEST(Distances, WithinARadiusAreThoseEverywhere) {
    for (const TriangleMesh& mesh : {shapes::jitter(shapes::sphere(4), 0.02, 1),
                                     shapes::jitter(shapes::torus(40, 20), 0.05, 2),
                                     shapes::jitter(shapes::grid(20), 0.03, 3)}) {
        const Surface surface = build_surface(mesh.view());
        for (const Index count : {1u, 12u}) {
            const auto sites = points::scattered(surface, count, 5);
            const auto targets = points::scattered(surface, 90, 8);
            const Distances all = find_distances(surface, sites, targets, {.max_error = 0});
            ASSERT_EQ(all.vertices.size(), surface.num_vertices());
            for (const double radius : {0.03, 0.17, 0.6}) {
                const Distances near = find_distances(surface, sites, targets,
                                                      {.max_distance = radius, .max_error = 0});
                std::size_t next = 0;
                for (Index v = 0; v < surface.num_vertices(); ++v) {
                    if (all.vertex_distance[v] > radius) continue;
                    ASSERT_LT(next, near.vertices.size());
                    EXPECT_EQ(near.vertices[next], v);
                    EXPECT_EQ(near.vertex_site[next], all.vertex_site[v]);
                    EXPECT_NEAR(near.vertex_distance[next], all.vertex_distance[v], 1e-13);
                    ++next;
                }
                EXPECT_EQ(next, near.vertices.size());
                for (std::size_t i = 0; i < targets.size(); ++i) {
                    if (all.point_distance[i] > radius) {
                        EXPECT_EQ(near.point_distance[i], infinity);
                    } else {
                        EXPECT_NEAR(near.point_distance[i], all.point_distance[i], 1e-13);
                    }
                }
            }
        }
    }
}

TEST(Distances, WithinARadiusLookAtFewFaces) {
    const Surface surface = build_surface(shapes::grid(100).view());
    const std::array sites{SurfacePoint{FaceId(10'100), {0.3, 0.3, 0.4}}};
    // A disc of radius .05 has 157 of the 20 000 faces, one of two edges more 390.
    EXPECT_LT(faces_within(surface, sites, 0.05).size(), 450u);
    EXPECT_GT(faces_within(surface, sites, 0.05).size(), 157u);
    EXPECT_EQ(faces_within(surface, sites, 10).size(), 20'000u);
}

// Sites close to the middle of an edge: the corners of both faces are far away.
TEST(Distances, WithinARadiusReachFacesWithFarCorners) {
    const Surface surface = build_surface(shapes::tetrahedron().view());
    const double radius = 0.1 * surface.length[0];
    for (Index h = 0; h < surface.twin.size(); ++h) {
        SurfacePoint site{FaceId(Surface::face(h)), {0.49, 0.49, 0.49}};
        site.barycentric[(h + 2) % 3] = 0.02;
        const std::array sites{site};
        const Index twin = surface.twin[h];
        std::array across{point_on(twin, 0.5), SurfacePoint{FaceId(Surface::face(twin)), {}}};
        across[1].barycentric = {0.49, 0.49, 0.49};
        across[1].barycentric[(twin + 2) % 3] = 0.02;
        const Distances all = find_distances(surface, sites, across);
        const Distances near = find_distances(surface, sites, across, {.max_distance = radius});
        EXPECT_EQ(near.point_distance, all.point_distance);
        EXPECT_LT(near.point_distance[1], radius);
    }
}

TEST(Distances, OfZeroRadiusAreTheSites) {
    const Surface surface = build_surface(shapes::sphere(2).view());
    const std::array sites{point_at(surface, 7), point_at(surface, 3)};
    const Distances found = find_distances(surface, sites, sites, {.max_distance = 0});
    EXPECT_EQ(found.vertices, (std::vector<Index>{3, 7}));
    EXPECT_EQ(found.vertex_site, (std::vector<SiteId>{SiteId(1), SiteId(0)}));
    EXPECT_EQ(found.point_distance, (std::vector<double>{0, 0}));
}

TEST(Distances, RefuseWhatIsNoRadiusAndNoPoint) {
    const Surface surface = build_surface(shapes::cube().view());
    const std::array sites{point_at(surface, 0)};
    const std::array wrong{SurfacePoint{FaceId(12), {1, 0, 0}}};
    for (const double radius : {-1.0, std::nan("")}) {
        EXPECT_THROW((void)find_distances(surface, sites, {}, {.max_distance = radius}),
                     InvalidOption);
    }
    EXPECT_THROW((void)find_distances(surface, sites, wrong), InvalidSites);
    EXPECT_THROW((void)find_distances(surface, wrong, {}), InvalidSites);
    EXPECT_THROW((void)propagate(surface, sites, {.engine = Engine::Steiner, .max_distance = 1}),
                 InvalidOption);
    EXPECT_THROW((void)propagate(surface, sites, {.relay_faces = {3, 2}}), InvalidOption);
    EXPECT_THROW((void)propagate(surface, sites, {.relay_faces = {12}}), InvalidOption);
}

// Of a line along the lower side, and a face in the middle.
TEST(Distances, OfPointsFromLinesAndRegions) {
    const Surface surface = flat_square(12);
    const MeshView mesh = surface.mesh.view();
    SiteShape side{.site = 0}, region{.faces = {141, 142}, .site = 1};
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        if (mesh.positions[surface.tail(h)].y() + mesh.positions[surface.head(h)].y() == 0) {
            side.edges.push_back(e);
        }
    }
    ASSERT_EQ(side.edges.size(), 12u);
    const auto targets = points::scattered(surface, 300, 7);
    for (const double radius : {infinity, 0.2}) {
        const Distances found =
            find_distances(surface, {}, targets,
                           {.shapes = {side, region}, .max_distance = radius, .max_error = 0});
        int num_inside = 0;
        for (std::size_t i = 0; i < targets.size(); ++i) {
            const Vec3 p = position(mesh, targets[i]);
            const double expected = std::min(p.y(), line_sites::in_plane(surface, region, p));
            const bool is_reached = expected <= radius;
            EXPECT_EQ(found.point_site[i].is_valid(), is_reached) << i;
            if (is_reached) {
                EXPECT_NEAR(found.point_distance[i], expected, 1e-12) << i;
            }
        }
        for (const Index face : region.faces) {
            const SurfacePoint middle{FaceId(face), {0.25, 0.5, 0.25}};
            const Distances at =
                find_distances(surface, {}, {{middle}}, {.shapes = {side, region}, .max_error = 0});
            EXPECT_EQ(at.point_distance[0], 0);
            EXPECT_EQ(at.point_site[0].value(), 1);
            ++num_inside;
        }
        EXPECT_EQ(num_inside, 2);
    }
}
