// Checks a diagram's complex: every edge has two sides and two ends or none, the cells around each
// Voronoi vertex fit its edges, loops close, areas sum to the surface's, and Euler characteristics
// sum to the surface's (a cell of genus g with b loops has 2 - 2 g - b). Polylines must run from
// face to face; within a face no two of their segments may cross by more than rounding.
#include "support/checks.h"

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"

#include <gtest/gtest.h>

#include <algorithm>
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
        // A closed curve may stay in one face, glued to itself.
        EXPECT_GE(d.edge_points[e + 1] - d.edge_points[e], edge.tail == no_index ? 1u : 2u);
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
            const LoopEdge& a = cells.edges[begin + i];
            const LoopEdge& b = cells.edges[begin + (i + 1) % size];
            const VoronoiEdge& ea = d.edges[a.edge];
            const VoronoiEdge& eb = d.edges[b.edge];
            EXPECT_EQ(a.reversed ? ea.tail : ea.head, b.reversed ? eb.head : eb.tail);
            EXPECT_EQ(a.reversed ? ea.right : ea.left, b.reversed ? eb.right : eb.left);
        }
    }
}

// A connected cell of genus g with b loops has Euler characteristic 2 - 2 g - b.
void expect_cells_fit(const Diagram& d, int most_parts) {
    const Cells cells = build_cells(d);
    for (Index s = 0; s < d.num_sites; ++s) {
        const auto num_loops = static_cast<int>(cells.cell_loops[s + 1] - cells.cell_loops[s]);
        if (num_loops == 0 && d.cell_area[s] == 0) {
            EXPECT_EQ(d.cell_euler[s], 0) << "cell " << s;
            continue;
        }
        const int twice_genus = 2 - num_loops - d.cell_euler[s];
        EXPECT_TRUE(twice_genus >= 2 - 2 * most_parts && twice_genus % 2 == 0)
            << "cell " << s << ": " << num_loops << " loops, Euler characteristic "
            << d.cell_euler[s];
    }
}

// --- Segments of the polylines, face by face -----------------------------------------------------

struct Segment {
    Index face;
    Index edge;
    std::array<double, 2> from, to;
};

// The same point, given in this or another face.
bool is_view(const Surface& surface, const SurfacePoint& view, const SurfacePoint& point) {
    bool is_one = false;
    for_each_view(surface, point,
                  [&](const SurfacePoint& other) { is_one = is_one || other == view; });
    return is_one;
}

void collect_segments(const Surface& surface, const Diagram& d, Index edge,
                      std::vector<Segment>& out) {
    const Index begin = d.edge_points[edge], end = d.edge_points[edge + 1];
    for (Index i = begin; i < end; ++i) {
        if (i + 1 == end && d.edges[edge].tail != no_index) return;
        const CurvePiece piece = curve_piece(surface, d, edge, i);
        const auto& [from, to] = piece;
        EXPECT_EQ(from.face, to.face) << "edge " << edge << " leaps at point " << i;
        EXPECT_TRUE(is_view(surface, from, d.points[i])) << "edge " << edge << ", point " << i;
        EXPECT_TRUE(is_view(surface, to, d.points[i + 1 == end ? begin : i + 1]))
            << "edge " << edge << ", point " << i;
        out.push_back({from.face.value(),
                       edge,
                       {from.barycentric[1], from.barycentric[2]},
                       {to.barycentric[1], to.barycentric[2]}});
    }
}

// The least of the four heights of one segment's ends over the other: positive where they cross.
double crossing_depth(const Segment& s, const Segment& t) {
    const auto height = [](const Segment& base, const std::array<double, 2>& p) {
        const double x = base.to[0] - base.from[0], y = base.to[1] - base.from[1];
        const double length = std::hypot(x, y);
        return length > 0 ? (x * (p[1] - base.from[1]) - y * (p[0] - base.from[0])) / length : 0;
    };
    const auto apart = [](double a, double b) {
        return (a < 0) == (b < 0) ? 0 : std::min(std::abs(a), std::abs(b));
    };
    return std::min(apart(height(s, t.from), height(s, t.to)),
                    apart(height(t, s.from), height(t, s.to)));
}

// The sum of the squares of a face's sides: its area is known to 2^-53 of it.
double square_of_sides(const Surface& surface, Index face) {
    double sum = 0;
    for (Index h = 3 * face; h < 3 * face + 3; ++h) sum += std::pow(surface.length_of(h), 2);
    return sum;
}

void expect_arcs_do_not_cross(const Surface& surface, const Diagram& d) {
    std::vector<Segment> segments;
    for (Index e = 0; e < d.edges.size(); ++e) {
        std::vector<Segment> along_boundary;
        collect_segments(surface, d, e, d.edges[e].right.is_valid() ? segments : along_boundary);
    }
    std::stable_sort(segments.begin(), segments.end(),
                     [](const Segment& a, const Segment& b) { return a.face < b.face; });
    for (std::size_t i = 0; i < segments.size(); ++i) {
        // In barycentric coordinates. Voronoi vertices are found to some 1e-13 of the longest side.
        const Index f = segments[i].face;
        const double rounding = 1e-9 + 1e-13 * square_of_sides(surface, f) / face_area(surface, f);
        for (std::size_t j = i + 1; j < segments.size() && segments[j].face == segments[i].face;
             ++j) {
            EXPECT_LE(crossing_depth(segments[i], segments[j]), rounding)
                << "in face " << segments[i].face << " of edges " << segments[i].edge << " and "
                << segments[j].edge;
        }
    }
}

}  // namespace

void expect_valid_complex(const Surface& surface, const Diagram& d, int most_parts) {
    expect_edges_fit(d);
    expect_vertices_fit(d);
    expect_loops_close(d);
    expect_cells_fit(d, most_parts);
    expect_arcs_do_not_cross(surface, d);

    double whole_area = 0, surface_area = 0, squares = 0;
    int surface_euler = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        whole_area += face_area(surface, f);
        squares += square_of_sides(surface, f);
        if (!d.nearest_site[surface.mesh.triangles[f][0]].is_valid()) continue;
        ++surface_euler;
        surface_area += face_area(surface, f);
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
        EXPECT_GE(d.cell_area[s], -1e-12 * whole_area) << "cell " << s;
        cell_area += d.cell_area[s];
        complex_euler += d.cell_euler[s];
    }
    // Areas of parts are rounded to 2^-61 of the whole one, and coordinates to 2^-53 of the face.
    EXPECT_NEAR(cell_area, surface_area,
                1e-9 * surface_area + 1e-15 * whole_area + 1e-16 * squares);
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

void expect_same(const Surface& a, const Surface& b) {
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    EXPECT_EQ(a.mesh.positions, b.mesh.positions);
    EXPECT_EQ(a.twin, b.twin);
    EXPECT_EQ(a.edge, b.edge);
    EXPECT_EQ(a.edge_half, b.edge_half);
    EXPECT_EQ(a.length, b.length);
    EXPECT_EQ(a.apex, b.apex);
    EXPECT_EQ(a.outgoing, b.outgoing);
    EXPECT_EQ(a.can_be_pseudo_source, b.can_be_pseudo_source);
}

void expect_same(const Propagation& a, const Propagation& b) {
    EXPECT_EQ(a.vertex_site, b.vertex_site);
    EXPECT_EQ(a.vertex_distance, b.vertex_distance);
    EXPECT_EQ(a.vertices_off_windows, b.vertices_off_windows);
    EXPECT_EQ(a.mixed_faces, b.mixed_faces);
    const auto is_same_relay = [](const Relay& r, const Relay& s) {
        return r.x == s.x && r.y == s.y && r.weight == s.weight && r.begin == s.begin &&
               r.end == s.end && r.site == s.site && r.half_edge == s.half_edge;
    };
    ASSERT_EQ(a.relay_ranges.size(), b.relay_ranges.size());
    for (Index i = 0; i < a.relay_ranges.size(); ++i) {
        const auto of_a = relays_of(a, i);
        const auto of_b = relays_of(b, i);
        ASSERT_TRUE(std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), is_same_relay))
            << "face " << a.mixed_faces[i];
    }
    EXPECT_EQ(a.certified_error, b.certified_error);
}

void expect_same(const Diagram& a, const Diagram& b) {
    EXPECT_EQ(a.num_sites, b.num_sites);
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.point_distance, b.point_distance);
    EXPECT_EQ(a.passages, b.passages);
    EXPECT_EQ(a.edge_points, b.edge_points);
    EXPECT_TRUE(std::equal(a.edges.begin(), a.edges.end(), b.edges.begin(), b.edges.end(),
                           [](const VoronoiEdge& e, const VoronoiEdge& f) {
                               return e.left == f.left && e.right == f.right && e.tail == f.tail &&
                                      e.head == f.head;
                           }));
    EXPECT_TRUE(a.arcs == b.arcs);
    EXPECT_EQ(a.edge_arcs, b.edge_arcs);
    EXPECT_EQ(a.vertex_offsets, b.vertex_offsets);
    EXPECT_TRUE(std::equal(a.vertex_ends.begin(), a.vertex_ends.end(), b.vertex_ends.begin(),
                           b.vertex_ends.end(), [](const EdgeEnd& e, const EdgeEnd& f) {
                               return e.edge == f.edge && e.is_tail == f.is_tail;
                           }));
    EXPECT_EQ(a.vertex_sites, b.vertex_sites);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.vertex_distance, b.vertex_distance);
    EXPECT_EQ(a.nearest_site, b.nearest_site);
    EXPECT_EQ(a.nearest_distance, b.nearest_distance);
    EXPECT_EQ(a.cell_area, b.cell_area);
    EXPECT_EQ(a.cell_euler, b.cell_euler);
}

void expect_same_for_threads(const Surface& surface, std::span<const SurfacePoint> sites,
                             PropagationOptions options) {
    options.num_threads = 1;
    const Propagation one = propagate(surface, sites, options);
    options.num_threads = 3;
    const Propagation three = propagate(surface, sites, options);
    expect_same(one, three);
    expect_same(build_diagram(surface, sites, one, {.num_threads = 1}),
                build_diagram(surface, sites, three, {.num_threads = 3}));
}

}  // namespace checks
