// The arcs of diagrams: points of each are as far from both sites, by the relays of the propagation
// that the diagram was built from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <numeric>

#include "agvd/diagram/diagram.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/checks.h"
#include "support/files.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

double cell_radius(const Surface& surface, std::size_t num_sites) {
    return std::sqrt(surface_area(surface) / (std::numbers::pi * static_cast<double>(num_sites)));
}

// A surface, its base, and an exact diagram on both.
class ArcScene {
public:
    ArcScene(const TriangleMesh& mesh, std::vector<SurfacePoint> sites, double max_length,
             double tolerance)
        : surface_(build_surface(mesh.view())),
          base_(surface_, {.max_length = max_length}),
          sites_(std::move(sites)),
          on_base_(base_.to_intrinsic(sites_)),
          propagation_(propagate(base_.surface(), on_base_, {.max_error = 0})),
          diagram_(build_diagram(base_.surface(), on_base_, propagation_,
                                 {.with_arcs = true, .tolerance = tolerance})),
          on_input_(diagram_on_input(base_, diagram_)) {}

    [[nodiscard]] double radius() const { return cell_radius(surface_, sites_.size()); }
    [[nodiscard]] const Surface& surface() const { return surface_; }
    [[nodiscard]] const Surface& base() const { return base_.surface(); }
    [[nodiscard]] const Diagram& on_base() const { return diagram_; }
    [[nodiscard]] const Diagram& on_input() const { return on_input_; }

    // |dA - dB| at a point of the base.
    [[nodiscard]] double gap(const SurfacePoint& p, const VoronoiEdge& edge) const {
        const std::optional<Index> mixed = mixed_index_of(propagation_, p.face.value());
        if (!mixed) return infinity;
        double left = infinity, right = infinity;
        const Vec2 at = position_in_frame(base(), p, 3 * p.face.value());
        for (const Relay& relay : relays_of(propagation_, *mixed)) {
            const PlanarRelay planar = to_planar(relay, to_face_frame(base(), relay.half_edge));
            const double distance = reach(planar, at).distance;
            if (relay.site == edge.left) left = std::min(left, distance);
            if (relay.site == edge.right) right = std::min(right, distance);
        }
        return std::abs(left - right);
    }
    [[nodiscard]] double gap_of_input(const SurfacePoint& p, const VoronoiEdge& edge) const {
        return gap(base_.to_intrinsic(p), edge);
    }

private:
    Surface surface_;
    IntrinsicTriangulation base_;
    std::vector<SurfacePoint> sites_, on_base_;
    Propagation propagation_;
    Diagram diagram_, on_input_;
};

struct ArcFigures {
    double largest_gap = 0;    // |dA - dB| in cell radii, at ten points of each arc and its end.
    double largest_stray = 0;  // Of the arcs from the polylines, mesh units.
    double longest_chord = 0;  // Of arcs without foci, in cell radii.
    Index num_lines = 0, num_hyperbolas = 0;
};

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const double length_sq = along.squaredNorm();
    const double at = length_sq > 0 ? std::clamp((p - a).dot(along) / length_sq, 0.0, 1.0) : 0;
    return (p - a - at * along).norm();
}

// The points of the polyline along an arc, in the plane of its face.
std::vector<Vec2> points_along(const Surface& surface, const Diagram& diagram, Index edge,
                               Index arc) {
    const Index h = 3 * diagram.arcs[arc].face.value();
    const bool is_last = arc + 1 == diagram.edge_arcs[edge + 1];
    const bool is_closed = diagram.edges[edge].tail == no_index;
    const Index end = !is_last    ? diagram.arcs[arc + 1].first_point
                      : is_closed ? diagram.edge_points[edge + 1]
                                  : diagram.edge_points[edge + 1] - 1;
    std::vector<Vec2> points;
    for (Index p = diagram.arcs[arc].first_point; p < end; ++p) {
        const CurvePiece piece = curve_piece(surface, diagram, edge, p);
        EXPECT_EQ(piece.from.face, diagram.arcs[arc].face);
        points.push_back(position_in_frame(surface, piece.from, h));
        if (p + 1 == end) points.push_back(position_in_frame(surface, piece.to, h));
    }
    return points;
}

template <typename Gap>
ArcFigures measure(const Surface& surface, const Diagram& diagram, double radius, const Gap& gap) {
    ArcFigures figures;
    EXPECT_EQ(diagram.edge_arcs.size(), diagram.edges.size() + 1);
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const Index first = diagram.edge_arcs[e], end = diagram.edge_arcs[e + 1];
        EXPECT_EQ(first == end, !diagram.edges[e].right.is_valid()) << e;
        if (first == end) continue;
        EXPECT_EQ(diagram.arcs[first].first_point, diagram.edge_points[e]);
        for (Index a = first; a < end; ++a) {
            const BisectorArc& arc = diagram.arcs[a];
            const double length = (arc.end - arc.begin).norm() / radius;
            if (arc.kind == ArcKind::Chord) {
                figures.longest_chord = std::max(figures.longest_chord, length);
                continue;
            }
            ++(arc.kind == ArcKind::Line ? figures.num_lines : figures.num_hyperbolas);
            for (int i = 0; i <= 10; ++i) {
                const Vec2 p = point_on_arc(arc, i / 10.0);
                const SurfacePoint on = to_surface(surface, arc.face.value(), p);
                figures.largest_gap =
                    std::max(figures.largest_gap, gap(on, diagram.edges[e]) / radius);
            }
            const std::vector<Vec2> line = points_along(surface, diagram, e, a);
            EXPECT_LE((line.front() - arc.begin).norm(), 1e-10 * radius) << e << ' ' << a;
            EXPECT_LE((line.back() - arc.end).norm(), 1e-10 * radius) << e << ' ' << a;
            for (int i = 1; i < 20; ++i) {
                const Vec2 p = point_on_arc(arc, i / 20.0);
                double least = infinity;
                for (std::size_t k = 0; k + 1 < line.size(); ++k) {
                    least = std::min(least, distance_to_segment(p, line[k], line[k + 1]));
                }
                figures.largest_stray = std::max(figures.largest_stray, least);
            }
        }
    }
    return figures;
}

// On the base and on the input. Returns the number of hyperbolas there.
Index expect_true_arcs(const TriangleMesh& mesh, Index num_sites, double max_length) {
    const Surface surface = build_surface(mesh.view());
    const double size = std::sqrt(surface_area(surface));
    const double tolerance = 1e-4 * size;
    const ArcScene scene(mesh, points::scattered(surface, num_sites, 3), max_length * size,
                         tolerance);
    const auto expect_good = [&](const ArcFigures& figures) {
        EXPECT_LE(figures.largest_gap, 1e-11);
        EXPECT_LE(figures.largest_stray, tolerance);
        EXPECT_LE(figures.longest_chord, 1e-9);
        EXPECT_GT(figures.num_lines + figures.num_hyperbolas, 0u);
    };
    checks::expect_valid_complex(scene.base(), scene.on_base());
    expect_good(measure(
        scene.base(), scene.on_base(), scene.radius(),
        [&](const SurfacePoint& p, const VoronoiEdge& edge) { return scene.gap(p, edge); }));
    const ArcFigures on_input = measure(
        scene.surface(), scene.on_input(), scene.radius(),
        [&](const SurfacePoint& p, const VoronoiEdge& e) { return scene.gap_of_input(p, e); });
    expect_good(on_input);
    const auto area_of = [](const Diagram& diagram) {
        return std::accumulate(diagram.cell_area.begin(), diagram.cell_area.end(), 0.0);
    };
    EXPECT_NEAR(area_of(scene.on_input()), area_of(scene.on_base()), 1e-12 * size * size);
    return on_input.num_hyperbolas;
}

// Of a site in the plane of the arc's face.
Vec2 in_plane(const Surface& surface, const BisectorArc& arc, const Vec3& p) {
    const Triangle& corners = surface.mesh.triangles[arc.face.value()];
    const Vec3 d = p - surface.mesh.positions[corners[0]];
    const Vec3 x =
        (surface.mesh.positions[corners[1]] - surface.mesh.positions[corners[0]]).normalized();
    return {d.dot(x), d.dot(Vec3(0, 0, 1).cross(x))};
}

}  // namespace

TEST(BisectorArcs, AreAsFarFromBothSitesOnShapes) {
    EXPECT_GT(expect_true_arcs(shapes::jitter(shapes::sphere(3), 0.05, 3), 40, 0.1), 100u);
    EXPECT_GT(expect_true_arcs(shapes::torus(24, 12), 20, 0.1), 100u);
    expect_true_arcs(shapes::cube(), 20, 0.1);
    expect_true_arcs(shapes::jitter(shapes::grid(12), 0.02, 5), 20, 0.1);
    expect_true_arcs(shapes::lips(10, 10, 4), 20, 0.1);
}

// One of these has a site's image on the line of an edge, beyond its end.
TEST(BisectorArcs, AreAsFarFromBothSitesOnRandomMeshes) {
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            SCOPED_TRACE(std::string(family) + " seed " + std::to_string(seed));
            expect_true_arcs(random_meshes::make(family, seed), 9, 0.2);
        }
    }
}

TEST(BisectorArcs, AreAsFarFromBothSitesOnARealMesh) {
    const std::filesystem::path path = files::find_mesh("bunny.off");
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << path << " is absent; set AGVD_MESHES to the folder that has it";
    }
    EXPECT_GT(expect_true_arcs(remesh::read_mesh(path).mesh, 100, 0.02), 1000u);
}

TEST(BisectorArcs, HaveTheSitesAsFociInThePlane) {
    const Surface surface = build_surface(shapes::grid(6).view());
    const auto sites = points::scattered(surface, 7, 2);
    const Diagram diagram = build_diagram(
        surface, sites, propagate(surface, sites, {.max_error = 0}), {.with_arcs = true});
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const std::array ends{diagram.edges[e].left, diagram.edges[e].right};
        for (Index a = diagram.edge_arcs[e]; a < diagram.edge_arcs[e + 1]; ++a) {
            const BisectorArc& arc = diagram.arcs[a];
            if ((arc.end - arc.begin).norm() < 1e-12) continue;  // At a vertex any path will do.
            EXPECT_EQ(arc.kind, ArcKind::Line);
            for (std::size_t k = 0; k < 2; ++k) {
                const Vec3 site = position(surface.mesh.view(), sites[ends[k].value()]);
                EXPECT_LE((in_plane(surface, arc, site) - arc.focus[k]).norm(), 1e-13);
                EXPECT_EQ(arc.weight[k], 0);
            }
        }
    }
}

// A strip bent to an L: paths of site 0 to the other leg bend at the inner corner.
TEST(BisectorArcs, AreHyperbolasAboutACornerThatPathsBendAt) {
    const TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
                            {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
    const Surface surface = build_surface(mesh.view());
    const std::vector<SurfacePoint> sites{point_at(surface, 2), point_at(surface, 5)};
    const Diagram diagram = build_diagram(
        surface, sites, propagate(surface, sites, {.max_error = 0}), {.with_arcs = true});
    Index num_bent = 0;
    for (const BisectorArc& arc : diagram.arcs) {
        for (std::size_t k = 0; k < 2; ++k) {
            if (arc.weight[k] == 0) continue;
            ++num_bent;
            EXPECT_NEAR(arc.weight[k], k == 0 ? 1 : std::sqrt(2.0), 1.0);
            EXPECT_LE((in_plane(surface, arc, Vec3(1, 1, 0)) - arc.focus[k]).norm(), 1e-13);
        }
    }
    EXPECT_GT(num_bent, 0u);
}

TEST(BisectorArcs, WithErrorsAreThoseOfTheRelays) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(3), 0.05, 3).view());
    const auto sites = points::scattered(surface, 30, 2);
    for (const Engine engine : {Engine::Window, Engine::Steiner}) {
        const Diagram diagram = build_diagram(
            surface, sites, propagate(surface, sites, {.engine = engine}), {.with_arcs = true});
        checks::expect_valid_complex(surface, diagram);
        EXPECT_EQ(diagram.edge_arcs.back(), diagram.arcs.size());
        for (const BisectorArc& arc : diagram.arcs) {
            if (arc.kind == ArcKind::Chord) continue;
            const Vec2 p = point_on_arc(arc, 0.5);
            EXPECT_NEAR((p - arc.focus[0]).norm() + arc.weight[0],
                        (p - arc.focus[1]).norm() + arc.weight[1], 1e-2);
        }
    }
}

TEST(BisectorArcs, AreMadeOnlyIfAskedForAndTheToleranceIsChecked) {
    const Surface surface = build_surface(shapes::grid(3).view());
    const auto sites = points::scattered(surface, 3, 2);
    const Propagation propagation = propagate(surface, sites);
    EXPECT_TRUE(build_diagram(surface, sites, propagation).arcs.empty());
    EXPECT_THROW((void)build_diagram(surface, sites, propagation, {.tolerance = 0}), InvalidOption);
    const Diagram one =
        build_diagram(surface, sites, propagation, {.with_arcs = true, .num_threads = 1});
    checks::expect_same(
        one, build_diagram(surface, sites, propagation, {.with_arcs = true, .num_threads = 3}));
}
