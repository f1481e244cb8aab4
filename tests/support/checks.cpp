#include "support/checks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace checks {

using namespace agvd;

namespace {

void expect_edges_fit(const Diagram& d) {
    ASSERT_EQ(d.edge_points.size(), d.edges.size() + 1);
    ASSERT_EQ(d.points.size(), d.point_distance.size());
    for (Index e = 0; e < d.edges.size(); ++e) {
        const VoronoiEdge& edge = d.edges[e];
        ASSERT_TRUE(edge.left.is_valid());
        EXPECT_NE(edge.left, edge.right);
        EXPECT_EQ(edge.tail == no_index, edge.head == no_index);
        EXPECT_GE(d.edge_points[e + 1] - d.edge_points[e], 2u);
    }
}

void expect_vertices_fit(const Diagram& d) {
    ASSERT_EQ(d.vertex_offsets.size(), d.vertices.size() + 1);
    std::vector<int> uses(2 * d.edges.size(), 0);
    for (Index v = 0; v < d.vertices.size(); ++v) {
        const Index begin = d.vertex_offsets[v];
        const Index degree = d.vertex_offsets[v + 1] - begin;
        ASSERT_GE(degree, 3u);
        for (Index i = 0; i < degree; ++i) {
            const EdgeEnd& end = d.vertex_ends[begin + i];
            ASSERT_LT(end.edge, d.edges.size());
            const VoronoiEdge& edge = d.edges[end.edge];
            ++uses[2 * end.edge + end.is_tail];
            EXPECT_EQ(end.is_tail ? edge.tail : edge.head, v);
            const SiteId before = d.vertex_sites[begin + (i + degree - 1) % degree];
            EXPECT_EQ(end.is_tail ? edge.left : edge.right, d.vertex_sites[begin + i]);
            EXPECT_EQ(end.is_tail ? edge.right : edge.left, before);
        }
    }
    for (Index e = 0; e < d.edges.size(); ++e) {
        const int expected = d.edges[e].tail == no_index ? 0 : 1;
        EXPECT_EQ(uses[2 * e], expected);
        EXPECT_EQ(uses[2 * e + 1], expected);
    }
}

void expect_loops_close(const Diagram& d) {
    const Cells cells = build_cells(d);
    for (Index l = 0; l + 1 < cells.loop_edges.size(); ++l) {
        const Index begin = cells.loop_edges[l];
        const Index size = cells.loop_edges[l + 1] - begin;
        for (Index i = 0; i < size; ++i) {
            const DirectedEdge& a = cells.edges[begin + i];
            const DirectedEdge& b = cells.edges[begin + (i + 1) % size];
            const VoronoiEdge& ea = d.edges[a.edge];
            const VoronoiEdge& eb = d.edges[b.edge];
            EXPECT_EQ(a.reversed ? ea.tail : ea.head, b.reversed ? eb.head : eb.tail);
            EXPECT_EQ(a.reversed ? ea.right : ea.left, b.reversed ? eb.right : eb.left);
        }
    }
}

}  // namespace

void expect_valid_complex(const Surface& surface, const Diagram& d) {
    expect_edges_fit(d);
    expect_vertices_fit(d);
    expect_loops_close(d);

    double surface_area = 0;
    int surface_euler = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        if (!d.nearest_site[surface.mesh.triangles[f][0]].is_valid()) continue;
        ++surface_euler;
        surface_area += surface.length_of(3 * f) * surface.apex[3 * f].y() / 2;
    }
    for (Index e = 0; e < surface.num_edges(); ++e) {
        surface_euler -= d.nearest_site[surface.tail(surface.edge_half[e])].is_valid() ? 1 : 0;
    }
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        surface_euler += surface.outgoing[v] != no_index && d.nearest_site[v].is_valid() ? 1 : 0;
    }

    double cell_area = 0;
    int complex_euler = 0;
    for (Index s = 0; s < d.num_sites; ++s) {
        EXPECT_GE(d.cell_area[s], -1e-12 * surface_area) << "cell " << s;
        cell_area += d.cell_area[s];
        complex_euler += d.cell_euler[s];
    }
    EXPECT_NEAR(cell_area, surface_area, 1e-9 * surface_area);
    for (const VoronoiEdge& e : d.edges) {
        if (e.right.is_valid() && e.tail != no_index) --complex_euler;
    }
    for (Index v = 0; v < d.vertices.size(); ++v) {
        bool is_inner = true;
        for (Index i = d.vertex_offsets[v]; i < d.vertex_offsets[v + 1]; ++i) {
            is_inner = is_inner && d.vertex_sites[i].is_valid();
        }
        complex_euler += is_inner ? 1 : 0;
    }
    EXPECT_EQ(complex_euler, surface_euler);
}

}  // namespace checks
