#include "remesh/tiles/tiling.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "agvd/mesh/topology.h"
#include "remesh/sites/shares.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Surface;
using agvd::Ticker;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::Tile;
using remesh::Tiling;

namespace {

constexpr Index num_vertices = 4000, per_tile = 600;

Tiling tiling_of(const Surface& surface, const std::vector<std::uint8_t>& is_crease) {
    return remesh::divide_into_tiles(
        surface, is_crease,
        {.num_vertices = num_vertices,
         .per_tile = per_tile,
         .spacing = remesh::detail::spacing_of(num_vertices, surface_area(surface))});
}

std::vector<Tile> tiles_of(const Tiling& tiling) {
    std::vector<Tile> tiles;
    for (Index t = 0; t < tiling.num_tiles; ++t) {
        std::vector<Index> faces;
        for (Index f = 0; f < tiling.tile.size(); ++f) {
            if (tiling.tile[f] == t) faces.push_back(f);
        }
        tiles.push_back(remesh::take_tile(tiling, faces, Ticker()));
    }
    return tiles;
}

std::vector<TriangleMesh> meshes() {
    return {shapes::sphere(4), shapes::torus(40, 24), shapes::tube(40, 20), shapes::cube(),
            shapes::join(shapes::sphere(3), shapes::moved(shapes::sphere(2), {3, 0, 0}))};
}

// The edges of the cube, but for the diagonals of its faces.
std::vector<std::uint8_t> sharp_edges(const Surface& surface) {
    std::vector<std::uint8_t> is_crease;
    const auto normal = [&](Index h) {
        return agvd::doubled_normal(surface.mesh.positions,
                                    surface.mesh.triangles[Surface::face(h)])
            .normalized();
    };
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e], twin = surface.twin[h];
        const bool is_sharp = twin != agvd::no_index && normal(h).dot(normal(twin)) < 0.5;
        is_crease.push_back(is_sharp ? 1 : 0);
    }
    return is_crease;
}

TEST(Tiling, SharesSurfaceAndVerticesOut) {
    for (const TriangleMesh& mesh : meshes()) {
        SCOPED_TRACE(mesh.triangles.size());
        const Surface surface = agvd::build_surface(mesh.view());
        const Tiling tiling = tiling_of(surface, sharp_edges(surface));
        // Small parts of a cell may leave it, and join others.
        EXPECT_LE(tiling.num_tiles, 7u);
        EXPECT_GE(tiling.num_tiles, 6u);
        Index num_inner = 0;
        for (const Index count : tiling.num_inner) num_inner += count;
        EXPECT_EQ(num_inner + tiling.borders.num_sites, num_vertices);
        std::vector<double> area(tiling.num_tiles, 0);
        for (Index f = 0; f < tiling.tile.size(); ++f) {
            area[tiling.tile[f]] += face_area(tiling.surface, f);
        }
        double sum = 0;
        for (Index t = 0; t < tiling.num_tiles; ++t) {
            sum += area[t];
            const double share = area[t] / surface_area(surface) * num_vertices;
            EXPECT_LT(share, 1.25 * per_tile);
            EXPECT_NEAR(tiling.num_inner[t], share, 0.15 * per_tile);
        }
        EXPECT_NEAR(sum, surface_area(surface), 1e-12 * sum);
    }
}

TEST(Tiling, BothSidesOfABorderHaveItsSites) {
    std::size_t num_shared = 0, num_at_three = 0;
    for (const TriangleMesh& mesh : meshes()) {
        SCOPED_TRACE(mesh.triangles.size());
        const Surface surface = agvd::build_surface(mesh.view());
        const Tiling tiling = tiling_of(surface, sharp_edges(surface));
        std::map<Index, std::vector<Vec3>> places;  // Of a site, in its tiles.
        double area = 0;
        for (const Tile& tile : tiles_of(tiling)) {
            const Surface part = agvd::build_surface(tile.mesh.view());
            area += surface_area(part);
            ASSERT_EQ(tile.border_site.size(), part.num_vertices());
            for (Index v = 0; v < part.num_vertices(); ++v) {
                if (tile.border_site[v] == agvd::no_index) continue;
                EXPECT_TRUE(part.is_boundary_vertex(v));
                places[tile.border_site[v]].push_back(part.mesh.positions[v]);
            }
            for (Index f = 0; f < part.num_faces(); ++f) {
                const agvd::SurfacePoint middle{agvd::FaceId(f), {0.2, 0.3, 0.5}};
                EXPECT_LT((position(mesh.view(), tile.parts.to_whole(middle)) -
                           position(tile.mesh.view(), middle))
                              .norm(),
                          1e-13);
            }
        }
        EXPECT_NEAR(area, surface_area(surface), 1e-12 * area);
        EXPECT_EQ(places.size(), tiling.borders.num_sites);
        for (const auto& [site, at] : places) {
            EXPECT_GE(at.size(), 2u);
            for (const Vec3& p : at) EXPECT_LT((p - at[0]).norm(), 1e-14);
            ++num_shared;
            num_at_three += at.size() > 2 ? 1 : 0;
        }
    }
    EXPECT_GT(num_shared, 500u);
    EXPECT_GT(num_at_three, 10u);
}

// A border's sites are about a spacing apart, and there is one where it meets a crease or boundary.
TEST(Tiling, SitesSuitTheBorder) {
    std::size_t num_crossings = 0;
    for (const TriangleMesh& mesh : meshes()) {
        SCOPED_TRACE(mesh.triangles.size());
        const Surface surface = agvd::build_surface(mesh.view());
        const Tiling tiling = tiling_of(surface, sharp_edges(surface));
        const double spacing = remesh::detail::spacing_of(num_vertices, surface_area(surface));
        double length = 0;
        for (Index e = 0; e < tiling.surface.num_edges(); ++e) {
            if (tiling.is_border[e] != 0) length += tiling.surface.length[e];
        }
        EXPECT_NEAR(length / spacing / tiling.borders.num_sites, 1, 0.15);
        std::vector<std::uint8_t> has_site(tiling.surface.num_vertices(), 0);
        for (const remesh::BorderSite& site : tiling.borders.sites) {
            const Index h = tiling.surface.edge_half[site.edge];
            if (site.share == 0) has_site[tiling.surface.tail(h)] = 1;
            if (site.share == 1) has_site[tiling.surface.head(h)] = 1;
        }
        const std::vector<std::uint8_t> is_crease = sharp_edges(tiling.surface);
        for (Index v = 0; v < tiling.surface.num_vertices(); ++v) {
            int num_borders = 0, num_others = 0;
            for_each_edge_at(tiling.surface, v, [&](Index h, Index) {
                const Index e = tiling.surface.edge[h];
                if (tiling.is_border[e] != 0) {
                    ++num_borders;
                } else if (is_crease[e] != 0 || tiling.surface.twin[h] == agvd::no_index) {
                    ++num_others;
                }
            });
            if (num_borders == 0 || (num_others == 0 && num_borders == 2)) continue;
            EXPECT_EQ(has_site[v], 1);
            ++num_crossings;
        }
    }
    EXPECT_GT(num_crossings, 50u);
}

}  // namespace
