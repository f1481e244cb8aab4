#include "remesh/dual/closed_ball.h"

#include <gtest/gtest.h>

using agvd::Index;
using agvd::no_index;
using agvd::SiteId;

namespace {

// Four cells and an empty one around two Voronoi vertices and one at the boundary:
// 0: cells 0, 1, 2, distance 1; 1: cells 1, 2, 3, distance 2; 2: cells 0, 3 and outside,
// distance 2.
agvd::Diagram five_cells() {
    agvd::Diagram diagram;
    diagram.num_sites = 5;
    diagram.vertices.resize(3);
    diagram.vertex_offsets = {0, 3, 6, 9};
    for (const Index site : {0, 1, 2, 1, 2, 3, 0, 3}) diagram.vertex_sites.emplace_back(site);
    diagram.vertex_sites.emplace_back();
    diagram.vertex_distance = {1, 2, 2};
    diagram.cell_area = {3, 5, 7, 9, 0};
    return diagram;
}

}  // namespace

TEST(FarthestVoronoiVertices, AreTheFirstOfThoseFarthestFromTheSite) {
    EXPECT_EQ(remesh::farthest_voronoi_vertices(five_cells()),
              (std::vector<Index>{2, 1, 1, 1, no_index}));
}

TEST(FarthestVoronoiVertices, OfTheLargestCellsComeFirstAndOnce) {
    const agvd::Diagram diagram = five_cells();
    EXPECT_EQ(remesh::points_in_largest_cells(diagram, 9), (std::vector<Index>{1, 2}));
    EXPECT_EQ(remesh::points_in_largest_cells(diagram, 1), (std::vector<Index>{1}));
    EXPECT_TRUE(remesh::points_in_largest_cells(diagram, 0).empty());
}
