// Paths of edges that have no Voronoi edge, on a strip so long that they cross thousands of edges.
#include "remesh/dual/edge_paths.h"

#include <gtest/gtest.h>

#include "agvd/diagram/build_diagram.h"
#include "agvd/propagation/propagate.h"

using namespace agvd;
using remesh::EdgePath;
using remesh::FlippableMesh;

namespace {

// A strip of unit squares, each cut in two, and three sites on it in a row: left, middle and right.
// They are a triangle; its edges are numbered by their ends: left-middle, left-right, middle-right.
struct Strip {
    Surface surface;
    std::vector<SurfacePoint> sites;
    std::vector<Vec3> positions;
    std::vector<Index> site{0, 1, 2};
    Diagram diagram;
    FlippableMesh triangle{std::vector<Triangle>{{0, 1, 2}}};
    double length;  // From left to right.

    explicit Strip(Index num_squares) : length(num_squares - 1.0) {
        TriangleMesh mesh;
        for (Index i = 0; i <= num_squares; ++i) {
            mesh.positions.emplace_back(i, 0, 0);
            mesh.positions.emplace_back(i, 1, 0);
        }
        for (Index v = 0; v < 2 * num_squares; v += 2) {
            mesh.triangles.push_back({v, v + 2, v + 3});
            mesh.triangles.push_back({v, v + 3, v + 1});
        }
        surface = build_surface(mesh.view());
        for (const Index square : {Index{0}, num_squares / 2, num_squares - 1}) {
            sites.push_back({FaceId(2 * square), {0.5, 0.25, 0.25}});
            positions.push_back(position(surface.mesh.view(), sites.back()));
        }
        diagram = build_diagram(surface, sites, propagate(surface, sites, {.num_threads = 1}),
                                {.num_threads = 1});
    }

    [[nodiscard]] std::vector<EdgePath> paths() const {
        Poller poller{Progress()};
        return remesh::find_edge_paths(surface, {sites, site, diagram, positions}, triangle, 1,
                                       poller);
    }
};

}  // namespace

// The cells of the left and the right site do not meet: their path is made from the other two, or
// searched where these cross more than 4000 edges.
TEST(EdgePaths, OfCellsApartAreShortestHoweverLong) {
    for (const Index num_squares : {500u, 1500u, 2500u}) {
        const Strip strip(num_squares);
        const std::vector<EdgePath> paths = strip.paths();
        ASSERT_EQ(paths.size(), 3u);
        const Index middle = num_squares / 2;
        const auto half = static_cast<double>(middle);
        const double lengths[] = {half, strip.length, strip.length - half};
        for (std::size_t e = 0; e < 3; ++e) {
            EXPECT_NEAR(paths[e].length, lengths[e], 1e-9 * strip.length) << e;
            EXPECT_TRUE(paths[e].is_locally_shortest);
        }
        // A joined path starts at the left site, a searched one at the right.
        EXPECT_EQ(paths[1].from, num_squares == 2500 ? 2u : 0u);
        EXPECT_NEAR(static_cast<double>(paths[1].strip.crossed.size()), 2 * strip.length, 2);
    }
}

// A path that is too long is replaced by the other two of its triangle, but not where these cross
// more than 4000 edges: such paths might double from pass to pass.
TEST(EdgePaths, VeryLongOnesDoNotMendTriangles) {
    for (const Index num_squares : {1500u, 2500u}) {
        const Strip strip(num_squares);
        std::vector<EdgePath> paths = strip.paths();
        paths[1].length = 3 * strip.length;
        Poller poller{Progress()};
        remesh::mend_triangles(strip.surface, strip.triangle, Ticker(poller), paths);
        const double expected = num_squares == 1500 ? strip.length : 3 * strip.length;
        EXPECT_NEAR(paths[1].length, expected, 1e-9 * strip.length);
    }
}
