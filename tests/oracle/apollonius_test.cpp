// The diagram inside one triangle against CGAL's Apollonius graph.
//
// CGAL's distance of a point p from a site of weight w is |p - site| - w: our weights with the sign
// turned.

#include "agvd/diagram/apollonius.h"

#include <CGAL/Apollonius_graph_2.h>
#include <CGAL/Apollonius_graph_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "agvd/diagram/envelope.h"
#include "support/dice.h"

using namespace agvd;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Apollonius_graph_traits_2<Kernel, CGAL::Field_with_sqrt_tag>;
using Graph = CGAL::Apollonius_graph_2<Traits>;

// Positions in double, found by Newton here and by formulas there.
constexpr double position_rounding = 1e-7;

struct ApolloniusCase {
    std::array<Vec2, 3> corners;
    std::vector<PlanarRelay> relays;  // Relay i is site i.
};

// Sites lie outside, so that every cell that enters the triangle reaches its boundary.
ApolloniusCase make_case(std::uint64_t seed) {
    Dice dice(seed);
    ApolloniusCase c;
    c.corners = {Vec2(0, 0), Vec2(1, 0), Vec2(dice.number(-0.3, 1.3), dice.number(0.2, 1.2))};
    const Index count = dice.count(3, 12);
    const double spread = dice.one_in(2) ? 0.7 : 3;
    const double most_weight = dice.one_in(3) ? 0 : dice.number(0, 0.4);
    while (c.relays.size() < count) {
        const Vec2 p(0.5 + dice.number(-spread, spread), 0.4 + dice.number(-spread, spread));
        bool is_inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2& a = c.corners[k];
            is_inside = is_inside && cross(c.corners[(k + 1) % 3] - a, p - a) > 0;
        }
        if (is_inside) continue;
        c.relays.push_back(
            point_relay(p, dice.number(0, most_weight), static_cast<Index>(c.relays.size())));
    }
    return c;
}

std::vector<Breakpoint> label_boundary(const ApolloniusCase& c) {
    std::vector<Breakpoint> breakpoints;
    EnvelopeScratch scratch;
    std::vector<LabelInterval> intervals;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2& p = c.corners[k];
        const Vec2& q = c.corners[(k + 1) % 3];
        const double length = (q - p).norm();
        std::vector<LineRelay> on_side;
        for (const PlanarRelay& relay : c.relays) {
            on_side.push_back(on_line(relay, p, (q - p) / length, length));
        }
        label_envelope(on_side, {length, nearest(c.relays, p).site, nearest(c.relays, q).site},
                       scratch, intervals);
        for (std::size_t i = 0; i + 1 < intervals.size(); ++i) {
            const Vec2 at = p + intervals[i].end * (q - p);
            const auto name = static_cast<Index>(breakpoints.size());
            breakpoints.push_back({at, nearest(c.relays, at).distance, NodeId::of_crossing(name),
                                   intervals[i + 1].site, name});
        }
    }
    return breakpoints;
}

Graph graph_of(const ApolloniusCase& c) {
    Graph graph;
    for (const PlanarRelay& relay : c.relays) {
        graph.insert({{relay.image.x(), relay.image.y()}, -relay.weight});
    }
    return graph;
}

Index site_of(const ApolloniusCase& c, const Graph::Site_2& site) {
    for (const PlanarRelay& relay : c.relays) {
        if (relay.image.x() == site.point().x() && relay.image.y() == site.point().y()) {
            return relay.site;
        }
    }
    return no_index;
}

// How far inside the triangle a point lies.
double depth(const ApolloniusCase& c, const Vec2& p) {
    double least = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2& a = c.corners[k];
        const Vec2 side = c.corners[(k + 1) % 3] - a;
        least = std::min(least, cross(side, p - a) / side.norm());
    }
    return least;
}

struct Vertex {
    std::set<Index> sites;
    Vec2 position;
};

std::vector<Vertex> vertices_of(const ApolloniusCase& c, const Graph& graph) {
    std::vector<Vertex> result;
    for (auto f = graph.finite_faces_begin(); f != graph.finite_faces_end(); ++f) {
        const auto& s0 = f->vertex(0)->site();
        const auto& s1 = f->vertex(1)->site();
        const auto& s2 = f->vertex(2)->site();
        const auto p = graph.geom_traits().construct_Apollonius_vertex_2_object()(s0, s1, s2);
        result.push_back({{site_of(c, s0), site_of(c, s1), site_of(c, s2)}, {p.x(), p.y()}});
    }
    return result;
}

bool has_near(const std::vector<Vertex>& vertices, const Vertex& v) {
    return std::any_of(vertices.begin(), vertices.end(), [&](const Vertex& other) {
        return other.sites == v.sites && (other.position - v.position).norm() <= position_rounding;
    });
}

// Three cells that meet twice within a short distance: between the two points one cell barely
// touches another, and whether it does is decided by samples of the arc.
bool barely_meets(const std::vector<Vertex>& vertices, const Vertex& v) {
    constexpr double short_distance = 0.05;
    return std::any_of(vertices.begin(), vertices.end(), [&](const Vertex& other) {
        const double distance = (other.position - v.position).norm();
        return other.sites == v.sites && distance > 0 && distance < short_distance;
    });
}

// The distances of the two sites of an arc are the least that CGAL knows.
void expect_on_bisector(const ApolloniusCase& c, const Graph& graph, const Vec2& p,
                        const Arc& arc) {
    const auto nearest_site = graph.nearest_neighbor({p.x(), p.y()})->site();
    const double least = (p - Vec2(nearest_site.point().x(), nearest_site.point().y())).norm() -
                         nearest_site.weight();
    EXPECT_NEAR(reach(c.relays[arc.left], p).distance, least, position_rounding);
    EXPECT_NEAR(reach(c.relays[arc.right], p).distance, least, position_rounding);
}

}  // namespace

TEST(Apollonius, InATriangleIsThatOfCgal) {
    std::size_t num_voronoi_vertices = 0, num_arcs = 0;
    for (std::uint64_t seed = 0; seed < 1000 && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const ApolloniusCase c = make_case(seed);
        const std::vector<Breakpoint> breakpoints = label_boundary(c);
        const Graph graph = graph_of(c);
        Arcs local;
        TriangleSolver solver(0.01, local);
        std::vector<Index> sites;
        for (const PlanarRelay& relay : c.relays) sites.push_back(relay.site);
        solver.set_relays(c.relays, sites);
        if (!breakpoints.empty()) solver.solve(0, c.corners, breakpoints);

        std::vector<Vertex> ours;
        for (const VoronoiVertex& voronoi_vertex : local.voronoi_vertices) {
            ours.push_back({{voronoi_vertex.sites.begin(), voronoi_vertex.sites.end()},
                            voronoi_vertex.position});
        }
        const std::vector<Vertex> theirs = vertices_of(c, graph);
        for (const Vertex& v : ours) {
            if (barely_meets(theirs, v)) continue;
            EXPECT_TRUE(has_near(theirs, v)) << "only ours: " << v.position.transpose();
        }
        for (const Vertex& v : theirs) {
            if (depth(c, v.position) < position_rounding || barely_meets(theirs, v)) continue;
            EXPECT_TRUE(has_near(ours, v)) << "only CGAL's: " << v.position.transpose();
        }
        for (const Arc& arc : local.arcs) {
            for (Index i = arc.first_point; i < arc.first_point + arc.num_points; ++i) {
                expect_on_bisector(c, graph, local.points[i], arc);
            }
        }
        num_voronoi_vertices += local.voronoi_vertices.size();
        num_arcs += local.arcs.size();
    }
    EXPECT_GT(num_voronoi_vertices, 500u);
    EXPECT_GT(num_arcs, 2000u);
}
