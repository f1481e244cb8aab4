#include "paper/cell_at.h"

#include <gtest/gtest.h>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "support/points.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

TEST(CellLocator, FindsTheNearestSiteInThePlane) {
    for (const Index n : {20u, 33u}) {
        const Surface surface = build_surface(shapes::grid(n).view());
        const auto sites = uniform_points(surface, 40, n);
        const Propagation propagation = propagate(surface, sites, {.max_error = 0});
        const Diagram diagram = build_diagram(surface, sites, propagation);
        const CellLocator cell(surface, diagram);
        const auto samples = uniform_points(surface, 2000, 7);
        for (const SurfacePoint& sample : samples) {
            const Vec3 p = position(surface.mesh.view(), sample);
            double best = 10, second = 10;
            SiteId nearest;
            for (Index s = 0; s < sites.size(); ++s) {
                const double d = (position(surface.mesh.view(), sites[s]) - p).norm();
                if (d < best) {
                    second = best;
                    best = d;
                    nearest = SiteId(s);
                } else if (d < second) {
                    second = d;
                }
            }
            if (second - best > 1e-3) {
                EXPECT_EQ(cell(sample), nearest) << n << ": " << p.transpose();
            }
        }
    }
}

TEST(CellLocator, KnowsCellsThatMeetAlongEdges) {
    // The unit square cut along its diagonal, which is the bisector; both its ends are said to lie
    // in the left cell.
    const Surface surface = build_surface(shapes::grid(1).view());
    Diagram diagram;
    diagram.num_sites = 2;
    const Triangle& corners = surface.mesh.triangles[0];
    const auto corner_at = [&](const Vec3& p) {
        SurfacePoint point{FaceId(0), {0, 0, 0}};
        for (std::size_t k = 0; k < 3; ++k) {
            point.barycentric[k] = surface.mesh.positions[corners[k]] == p ? 1 : 0;
        }
        return point;
    };
    diagram.points = {corner_at({0, 0, 0}), corner_at({1, 1, 0})};
    diagram.edge_points = {0, 2};
    diagram.edges = {{SiteId(0), SiteId(1), 0, 1}};
    for (const Vec3& p : surface.mesh.positions) {
        diagram.nearest_site.push_back(SiteId(p.x() > p.y() ? 1 : 0));
    }
    const CellLocator cell(surface, diagram);
    for (const SurfacePoint& sample : uniform_points(surface, 200, 3)) {
        const Vec3 p = position(surface.mesh.view(), sample);
        EXPECT_EQ(cell(sample), SiteId(p.x() > p.y() ? 1 : 0)) << p.transpose();
    }
}

TEST(CellLocator, CurvesThatOnlyTouchACornerLeaveTheFaceWhole) {
    // The corner (0, 0) is a cell of its own; its border is too short to
    // show on which side the rest lies.
    const Surface surface = build_surface(shapes::grid(1).view());
    Diagram diagram;
    diagram.num_sites = 2;
    diagram.points = {{FaceId(0), {1, 0, 0}}, {FaceId(0), {1 - 1e-12, 1e-12, 0}}};
    diagram.edge_points = {0, 2};
    diagram.edges = {{SiteId(1), SiteId(0), 0, 1}};
    const Index touched = surface.mesh.triangles[0][0];
    diagram.nearest_site.assign(surface.num_vertices(), SiteId(0));
    diagram.nearest_site[touched] = SiteId(1);
    const CellLocator cell(surface, diagram);
    for (const SurfacePoint& sample : uniform_points(surface, 200, 3)) {
        EXPECT_EQ(cell(sample), SiteId(0)) << position(surface.mesh.view(), sample).transpose();
    }
}

TEST(CellLocator, WhereNoSiteReachesThereIsNone) {
    const Surface surface = build_surface(shapes::join(shapes::grid(2), shapes::sphere(0)).view());
    const std::vector sites{point_at(surface, 0)};
    const Diagram diagram = build_diagram(surface, sites, propagate(surface, sites));
    const CellLocator cell(surface, diagram);
    EXPECT_EQ(cell({FaceId(0), {0.2, 0.3, 0.5}}), SiteId(0));
    EXPECT_FALSE(cell({FaceId(surface.num_faces() - 1), {0.2, 0.3, 0.5}}).is_valid());
}

}  // namespace
