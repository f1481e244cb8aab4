// Surfaces given by the lengths of their edges.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "agvd/core/error.h"
#include "agvd/diagram/diagram.h"
#include "agvd/mesh/cut_surface.h"
#include "agvd/paths/distances.h"
#include "agvd/propagation/propagate.h"
#include "support/checks.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

std::vector<double> sides_of(const Surface& surface) {
    std::vector<double> lengths;
    for (Index h = 0; h < surface.twin.size(); ++h) lengths.push_back(surface.length_of(h));
    return lengths;
}

// The unit square bent to a part of a cylinder around y, without a change of lengths.
TriangleMesh rolled(TriangleMesh flat) {
    for (Vec3& p : flat.positions)
        p = Vec3(std::sin(2 * p.x()) / 2, p.y(), std::cos(2 * p.x()) / 2);
    return flat;
}

}  // namespace

TEST(SurfaceByLengths, OwnLengthsGiveTheSameBits) {
    for (const char* family : random_meshes::families()) {
        SCOPED_TRACE(family);
        const TriangleMesh mesh = random_meshes::make(family, 2);
        const Surface by_positions = build_surface(mesh.view());
        const Surface by_lengths = build_surface(mesh.view(), sides_of(by_positions));
        EXPECT_TRUE(by_lengths.has_own_lengths);
        checks::expect_same(by_positions, by_lengths);
        const auto sites = points::scattered(by_positions, 7, 1);
        for (const Engine engine : {Engine::Window, Engine::Steiner}) {
            const PropagationOptions options{.engine = engine};
            const Propagation expected = propagate(by_positions, sites, options);
            const Propagation found = propagate(by_lengths, sites, options);
            checks::expect_same(expected, found);
            checks::expect_same(build_diagram(by_positions, sites, expected),
                                build_diagram(by_lengths, sites, found));
        }
    }
}

TEST(SurfaceByLengths, PositionsSayNothing) {
    const TriangleMesh flat = shapes::grid(12);
    const Surface by_positions = build_surface(flat.view());
    TriangleMesh no_place = flat;
    for (Vec3& p : no_place.positions) p = Vec3::Zero();
    const auto sites = points::scattered(by_positions, 9, 4);
    for (const TriangleMesh& mesh : {rolled(flat), no_place}) {
        const Surface surface = build_surface(mesh.view(), sides_of(by_positions));
        for (const std::optional<double> error : {std::optional<double>(), std::optional(1e-3)}) {
            const PropagationOptions options{.engine = Engine::Steiner, .max_error = error};
            const Propagation expected = propagate(by_positions, sites, options);
            const Propagation found = propagate(surface, sites, options);
            for (Index v = 0; v < flat.positions.size(); ++v) {
                EXPECT_NEAR(found.vertex_distance[v], expected.vertex_distance[v],
                            error.value_or(1e-12));
            }
        }
        const Propagation exact = propagate(surface, sites, {.max_error = 0});
        for (Index v = 0; v < flat.positions.size(); ++v) {
            double least = infinity;
            for (const SurfacePoint& site : sites) {
                const Vec3 p = position(flat.view(), site);
                least = std::min(least, (p - flat.positions[v]).norm());
            }
            EXPECT_NEAR(exact.vertex_distance[v], least, 1e-12) << v;
        }
        const Diagram diagram = build_diagram(surface, sites, exact);
        checks::expect_valid_complex(surface, diagram);
        EXPECT_NEAR(std::accumulate(diagram.cell_area.begin(), diagram.cell_area.end(), 0.0), 1,
                    1e-12);
        const Distances near = find_distances(surface, sites, {}, {.max_distance = 0.2});
        for (std::size_t i = 0; i < near.vertices.size(); ++i) {
            EXPECT_NEAR(near.vertex_distance[i], exact.vertex_distance[near.vertices[i]], 1e-4);
        }
        EXPECT_EQ(near.vertices.size(),
                  static_cast<std::size_t>(std::count_if(exact.vertex_distance.begin(),
                                                         exact.vertex_distance.end(),
                                                         [](double d) { return d <= 0.2; })));
    }
}

// Two right triangles of 3, 4 and 5, mirrored at the side of 5. The positions are those of a
// square.
TEST(SurfaceByLengths, NeedNotFitIntoSpace) {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    const Surface surface = build_surface(mesh.view(), std::vector<double>{3, 4, 5, 5, 4, 3});
    EXPECT_DOUBLE_EQ(surface_area(surface), 12);
    EXPECT_DOUBLE_EQ(surface.apex[0].x(), 3);
    EXPECT_DOUBLE_EQ(surface.apex[0].y(), 4);
    const std::vector<SurfacePoint> sites{point_at(surface, 1)};
    const Propagation propagation = propagate(surface, sites, {.max_error = 0});
    EXPECT_DOUBLE_EQ(propagation.vertex_distance[3], 4.8);
}

TEST(SurfaceByLengths, AreKeptByCuts) {
    const TriangleMesh flat = shapes::grid(4);
    const std::vector<double> lengths = sides_of(build_surface(flat.view()));
    const Surface surface = build_surface(rolled(flat).view(), lengths);
    std::vector<std::uint8_t> is_cut(surface.num_edges(), 0);
    is_cut[surface.edge[3]] = 1;
    const Surface cut = cut_along(surface, is_cut).surface;
    EXPECT_EQ(sides_of(cut), sides_of(surface));
    EXPECT_EQ(cut.apex, surface.apex);
}

TEST(SurfaceByLengths, BadLengthsAreNamed) {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    const auto expect_error = [&](const std::vector<double>& lengths, const std::string& part) {
        try {
            (void)build_surface(mesh.view(), lengths);
            FAIL() << "no error: " << part;
        } catch (const InvalidInput& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    };
    expect_error({3, 4, 5}, "there are 3 lengths for 2 faces");
    expect_error({3, 4, 5, 6, 4, 3}, "vertex 2 to 0 has the lengths 5 and 6 in its two faces");
    expect_error({3, 4, 5, 5, 4, 0}, "vertex 3 to 0 has the length 0");
    expect_error({3, 4, 5, 5, 4, -1}, "has the length -1");
    expect_error({3, 4, 5, 5, 4, std::nan("")}, "has the length nan");
    expect_error({1, 4, 5, 5, 4, 3},
                 "face 0 has sides of the lengths 1, 4 and 5, which make no triangle");
    expect_error({3, 4, 5, 5, 9, 3}, "face 1 has sides of the lengths 5, 9 and 3, which make no");
    expect_error({3e150, 4e150, 5e150, 5e150, 4e150, 3e150}, "has the length 3e+150, but");
    expect_error({3e-150, 4e-150, 5e-150, 5e-150, 4e-150, 3e-150}, "between 1e-60 and 1e+60");
}
