#include "agvd/mesh/cut_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "agvd/core/error.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "agvd/paths/geodesic_path.h"
#include "agvd/propagation/propagate.h"
#include "support/line_sites.h"
#include "support/points.h"
#include "support/random_meshes.h"

using namespace agvd;

namespace {

using Line = std::vector<SurfacePoint>;

// Shortest ways from each random point to the next one.
std::vector<Line> random_lines(const Surface& surface, Index num_lines, Index num_points,
                               std::uint64_t seed) {
    std::vector<Line> lines;
    for (Index i = 0; i < num_lines; ++i) {
        const Line corners = points::scattered(surface, num_points, seed * 8 + i);
        Line line;
        for (Index k = 0; k + 1 < num_points; ++k) {
            try {
                const Line way = path_between(surface, corners[k], corners[k + 1]).points;
                line.insert(line.end(), way.begin(), way.end());
            } catch (const InvalidInput&) {  // On another component.
            }
        }
        if (line.size() > 1) lines.push_back(line);
    }
    return lines;
}

double length_of(const Surface& surface, const Line& line) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Index face = common_faces(surface, line[i], line[i + 1]).first;
        sum += face_distance(surface, *seen_from(surface, line[i], face),
                             *seen_from(surface, line[i + 1], face));
    }
    return sum;
}

}  // namespace

TEST(InsertLines, MakesLinesEdgesOfTheSameSurface) {
    int count = 0;
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 0; seed < 6; ++seed) {
            SCOPED_TRACE(std::string(family) + " seed " + std::to_string(seed));
            const Surface surface = build_surface(random_meshes::make(family, seed).view());
            const std::vector<Line> lines = random_lines(surface, 3, 2, seed);
            const MeshWithLines with = insert_lines(surface, lines);
            ASSERT_EQ(with.chains.size(), lines.size());
            ASSERT_EQ(with.cut.points.size(), with.cut.mesh.positions.size());
            ASSERT_EQ(with.cut.face_origin.size(), with.cut.mesh.triangles.size());
            const auto connectivity = find_connectivity(with.cut.mesh.view());
            ASSERT_TRUE(connectivity);
            for (std::size_t i = 0; i < lines.size(); ++i) {
                double length = 0;
                for (std::size_t k = 0; k + 1 < with.chains[i].size(); ++k) {
                    length += (with.cut.mesh.positions[with.chains[i][k]] -
                               with.cut.mesh.positions[with.chains[i][k + 1]])
                                  .norm();
                }
                EXPECT_NEAR(length, length_of(surface, lines[i]), 1e-9 * (1 + length));
                ++count;
            }
        }
    }
    EXPECT_GT(count, 150);
}

TEST(InsertLines, GivesDistancesFromSegmentsInThePlane) {
    int count = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Surface flat = line_sites::uneven_square(9, seed);
        const std::vector<Line> lines = random_lines(flat, 3, 3, seed);
        const MeshWithLines with = insert_lines(flat, lines);
        const Surface surface = build_surface(with.cut.mesh.view());
        EXPECT_NEAR(surface_area(surface), 1, 1e-12);
        for (const auto& chain : with.chains) {
            const SiteShape line{.edges = edges_along(surface, chain)};
            const Propagation found = propagate(surface, {}, {.shapes = {line}, .max_error = 0});
            for (Index v = 0; v < surface.num_vertices(); ++v) {
                const double expected =
                    line_sites::in_plane(surface, line, surface.mesh.positions[v]);
                ASSERT_NEAR(found.vertex_distance[v], expected, 1e-11) << v;
                ++count;
            }
        }
    }
    EXPECT_GT(count, 5000);
}

TEST(InsertLines, GivesLinesThatCrossACommonVertex) {
    const Surface surface =
        build_surface(TriangleMesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}}.view());
    const auto at = [](double x, double y) {
        return SurfacePoint{FaceId(0), {1 - x / 4 - y / 4, x / 4, y / 4}};
    };
    const std::vector<Line> lines{{at(0.5, 1), at(2, 1)},   // Crosses the next one,
                                  {at(1, 0.5), at(1, 2)},   //
                                  {at(1, 0), at(1, 0.5)},   // from an edge,
                                  {at(0, 0), at(2, 0)},     // along it,
                                  {at(2, 1), at(1.5, 1)}};  // and on the first.
    const MeshWithLines with = insert_lines(surface, lines);
    const Surface cut = build_surface(with.cut.mesh.view());
    EXPECT_NEAR(surface_area(cut), 8, 1e-12);
    const auto has = [&](std::size_t line, double x, double y) {
        return std::any_of(with.chains[line].begin(), with.chains[line].end(), [&](Index v) {
            return (with.cut.mesh.positions[v] - Vec3(x, y, 0)).norm() < 1e-12;
        });
    };
    EXPECT_TRUE(has(0, 1, 1) && has(1, 1, 1));
    EXPECT_TRUE(has(2, 1, 0) && has(3, 1, 0));
    EXPECT_TRUE(has(0, 1.5, 1) && has(4, 1.5, 1));
    std::vector<std::size_t> sizes;
    for (const auto& chain : with.chains) {
        sizes.push_back(chain.size());
        EXPECT_EQ(edges_along(cut, chain).size(), chain.size() - 1);
    }
    EXPECT_EQ(sizes, (std::vector<std::size_t>{4, 3, 2, 3, 2}));
}

TEST(InsertLines, RefusesPointsThatShareNoFace) {
    const Surface surface = line_sites::uneven_square(3, 1);
    const std::vector<Line> lines{{point_at(surface, 0), point_at(surface, 15)}};
    EXPECT_THROW((void)insert_lines(surface, lines), InvalidInput);
    const std::vector<Index> chain{0, 15};
    EXPECT_THROW((void)edges_along(surface, chain), InvalidInput);
}
