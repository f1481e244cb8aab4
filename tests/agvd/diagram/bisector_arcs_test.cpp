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

struct ArcFigures {
    double largest_gap = 0;           // |dA - dB| in cell radii, at ten points of each arc.
    double wrong_distance = 0;        // Told at points of the polylines, in cell radii.
    double largest_stray = 0;         // Of the polylines from the arcs, mesh units.
    double farthest_outside = 0;      // Of these points from the face, in cell radii.
    Index most_of_line = 0;           // Points of the polyline of a line.
    double largest_jump = 0;          // Between an arc's ends and its polyline's, in cell radii.
    double longest_chord = 0;         // Of arcs without foci, in cell radii.
    std::array<Index, 3> num_arcs{};  // By kind.
};

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const double length_sq = along.squaredNorm();
    const double at = length_sq > 0 ? std::clamp((p - a).dot(along) / length_sq, 0.0, 1.0) : 0;
    return (p - a - at * along).norm();
}

// The polyline along an arc, in the plane of its face.
std::vector<Vec2> points_along(const Surface& surface, const Diagram& diagram, Index edge,
                               Index arc) {
    const std::vector<Index> indices = points_of_arc(diagram, edge, arc);
    const Index h = 3 * diagram.arcs[arc].face.value();
    std::vector<Vec2> points;
    for (std::size_t i = 0; i + 1 < indices.size(); ++i) {
        const CurvePiece piece = curve_piece(surface, diagram, edge, indices[i]);
        EXPECT_EQ(piece.from.face, diagram.arcs[arc].face);
        points.push_back(position_in_frame(surface, piece.from, h));
        if (i + 2 == indices.size()) points.push_back(position_in_frame(surface, piece.to, h));
    }
    return points;
}

// A surface, its base, and the exact diagram on both.
class ArcScene {
public:
    ArcScene(const TriangleMesh& mesh, std::vector<SurfacePoint> sites, double max_length,
             double chord, const SitePoints& roles = {})
        : surface_(build_surface(mesh.view())),
          base_(surface_, {.max_length = max_length}),
          on_base_(base_.to_intrinsic(sites)),
          propagation_(propagate(base_.surface(), on_base_, {.points = roles, .max_error = 0})),
          radius_(std::sqrt(surface_area(surface_) /
                            (std::numbers::pi * static_cast<double>(sites.size())))),
          diagram(build_diagram(base_.surface(), on_base_, propagation_, {.chord = chord})),
          on_input(diagram_on_input(base_, diagram)) {}

    [[nodiscard]] const Surface& input() const { return surface_; }
    [[nodiscard]] const Surface& base() const { return base_.surface(); }

    [[nodiscard]] ArcFigures figures_on_base() const {
        return measure(base(), diagram, [](const SurfacePoint& p) { return p; });
    }
    [[nodiscard]] ArcFigures figures_on_input() const {
        return measure(input(), on_input,
                       [&](const SurfacePoint& p) { return base_.to_intrinsic(p); });
    }

private:
    // |dA - dB| at a point of the base, in cell radii.
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
        return std::abs(left - right) / radius_;
    }

    template <typename ToBase>
    [[nodiscard]] ArcFigures measure(const Surface& surface, const Diagram& drawn,
                                     const ToBase& to_base) const {
        ArcFigures figures;
        EXPECT_EQ(drawn.edge_arcs.size(), drawn.edges.size() + 1);
        for (Index e = 0; e < drawn.edges.size(); ++e) {
            const Index first = drawn.edge_arcs[e], end = drawn.edge_arcs[e + 1];
            EXPECT_EQ(first == end, !drawn.edges[e].right.is_valid()) << e;
            if (first == end) continue;
            EXPECT_EQ(drawn.arcs[first].first_point, drawn.edge_points[e]);
            for (Index a = first; a < end; ++a) {
                const BisectorArc& arc = drawn.arcs[a];
                ++figures.num_arcs.at(static_cast<std::size_t>(arc.kind));
                const std::vector<Vec2> line = points_along(surface, drawn, e, a);
                figures.largest_jump =
                    std::max({figures.largest_jump, (line.front() - arc.begin).norm() / radius_,
                              (line.back() - arc.end).norm() / radius_});
                if (arc.kind == ArcKind::Chord) {
                    figures.longest_chord =
                        std::max(figures.longest_chord, (arc.end - arc.begin).norm() / radius_);
                    continue;
                }
                const std::vector<Index> indices = points_of_arc(drawn, e, a);
                for (std::size_t i = 0; i < line.size(); ++i) {
                    const double told = drawn.point_distance[indices[i]];
                    const double found = (line[i] - arc.focus[0]).norm() + arc.weight[0];
                    figures.wrong_distance =
                        std::max(figures.wrong_distance, std::abs(told - found) / radius_);
                }
                if (arc.kind == ArcKind::Line) {
                    figures.most_of_line =
                        std::max(figures.most_of_line, static_cast<Index>(line.size()));
                }
                for (int i = 0; i < 10; ++i) {
                    const Vec2 p = point_on_arc(arc, i / 9.0);
                    const SurfacePoint on = to_surface(surface, arc.face.value(), p);
                    figures.farthest_outside =
                        std::max(figures.farthest_outside,
                                 (position_in_frame(surface, on, 3 * arc.face.value()) - p).norm() /
                                     radius_);
                    figures.largest_gap =
                        std::max(figures.largest_gap, gap(to_base(on), drawn.edges[e]));
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

    Surface surface_;
    IntrinsicTriangulation base_;
    std::vector<SurfacePoint> on_base_;
    Propagation propagation_;
    double radius_;

public:
    const Diagram diagram, on_input;
};

double total_area(const Diagram& diagram) {
    return std::accumulate(diagram.cell_area.begin(), diagram.cell_area.end(), 0.0);
}

// On the base and on the input. Returns the numbers of arcs there by kind.
std::array<Index, 3> expect_true_arcs(const TriangleMesh& mesh, Index num_sites, double max_length,
                                      const SitePoints& roles = {}) {
    const Surface surface = build_surface(mesh.view());
    const double size = std::sqrt(surface_area(surface));
    const double chord = 1e-4 * size;
    const auto sites = points::scattered(surface, num_sites, 3);
    const ArcScene scene(mesh, sites, max_length * size, chord, roles);
    checks::expect_valid_complex(scene.base(), scene.diagram, roles.site.empty() ? 1 : 3);
    const ArcFigures on_input = scene.figures_on_input();
    for (const ArcFigures& figures : {scene.figures_on_base(), on_input}) {
        EXPECT_LE(figures.largest_gap, 1e-11);
        EXPECT_LE(figures.wrong_distance, 1e-11);
        EXPECT_LE(figures.largest_stray, chord);
        EXPECT_LE(figures.farthest_outside, 1e-11);
        EXPECT_LE(figures.most_of_line, 50u);
        EXPECT_LE(figures.largest_jump, 1e-14);
        EXPECT_LE(figures.longest_chord, 1e-9);
    }
    // Without inner points, arcs and their chords cross other edges of the input.
    const ArcScene coarse(mesh, sites, max_length * size, size, roles);
    EXPECT_LE(coarse.figures_on_input().largest_gap, 1e-11);
    EXPECT_LE(coarse.figures_on_input().farthest_outside, 1e-11);
    EXPECT_NEAR(total_area(scene.on_input), total_area(scene.diagram), 1e-12 * size * size);
    return on_input.num_arcs;
}

Index of_kind(const std::array<Index, 3>& numbers, ArcKind kind) {
    return numbers.at(static_cast<std::size_t>(kind));
}

// Of a point in the plane of an arc's face, which lies in z = 0.
Vec2 in_plane(const Surface& surface, const BisectorArc& arc, const Vec3& p) {
    const Triangle& corners = surface.mesh.triangles[arc.face.value()];
    const Vec3 d = p - surface.mesh.positions[corners[0]];
    const Vec3 x =
        (surface.mesh.positions[corners[1]] - surface.mesh.positions[corners[0]]).normalized();
    return {d.dot(x), d.dot(Vec3(0, 0, 1).cross(x))};
}

}  // namespace

TEST(BisectorArcs, AreAsFarFromBothSitesOnShapes) {
    const auto on_sphere = expect_true_arcs(shapes::jitter(shapes::sphere(3), 0.05, 3), 40, 0.1);
    EXPECT_GT(of_kind(on_sphere, ArcKind::Hyperbola), 100u);
    expect_true_arcs(shapes::torus(24, 12), 20, 0.1);
    expect_true_arcs(shapes::cube(), 20, 0.1);
    expect_true_arcs(shapes::jitter(shapes::grid(12), 0.02, 5), 20, 0.1);
    expect_true_arcs(shapes::lips(10, 10, 4), 20, 0.1);
}

TEST(BisectorArcs, AreAsFarFromBothSitesOnRandomMeshes) {
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            SCOPED_TRACE(std::string(family) + " seed " + std::to_string(seed));
            expect_true_arcs(random_meshes::make(family, seed), 9, 0.2);
        }
    }
}

TEST(BisectorArcs, AreAsFarFromGroupsOfPointsWithStarts) {
    const SitePoints roles{.site = {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3},
                           .start = {0, .1, .05, 0, 0, .1, .02, 0, 0, .1, 0, 0}};
    const auto numbers = expect_true_arcs(shapes::sphere(3), 12, 0.1, roles);
    EXPECT_GT(of_kind(numbers, ArcKind::Hyperbola), 50u);
}

TEST(BisectorArcs, AreAsFarFromBothSitesOnARealMesh) {
    const std::filesystem::path path = files::find_mesh("bunny.off");
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << path << " is absent; set AGVD_MESHES to the folder that has it";
    }
    const auto numbers = expect_true_arcs(remesh::read_mesh(path).mesh, 100, 0.02);
    EXPECT_GT(of_kind(numbers, ArcKind::Hyperbola), 1000u);
}

TEST(BisectorArcs, AreLinesBetweenTheSitesInThePlane) {
    const Surface surface = build_surface(shapes::grid(6).view());
    const auto sites = points::scattered(surface, 7, 2);
    const Diagram diagram =
        build_diagram(surface, sites, propagate(surface, sites, {.max_error = 0}), {.chord = 1e-3});
    EXPECT_GT(diagram.arcs.size(), 20u);
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

// |p - (.2, .5)| = |p - (.8, .5)| + .2 is x = .5 + .1 sqrt(1 + (y - .5)^2 / .08).
TEST(BisectorArcs, AreAHyperbolaByFormulaBetweenWeightedSitesInThePlane) {
    const TriangleMesh mesh = shapes::grid(5);  // The unit square.
    const Surface surface = build_surface(mesh.view());
    std::vector<SurfacePoint> sites;
    for (const Vec3& p : {Vec3(.2, .5, 0), Vec3(.8, .5, 0)}) {
        for (Index f = 0; f < surface.num_faces(); ++f) {
            const Triangle& t = mesh.triangles[f];
            const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]],
                       &c = mesh.positions[t[2]];
            const auto area = [](const Vec3& u, const Vec3& v) { return u.cross(v).z(); };
            const double whole = area(b - a, c - a), to_b = area(p - a, c - a) / whole,
                         to_c = area(b - a, p - a) / whole;
            if (to_b < 0 || to_c < 0 || to_b + to_c > 1) continue;
            sites.push_back({FaceId(f), {1 - to_b - to_c, to_b, to_c}});
            break;
        }
    }
    ASSERT_EQ(sites.size(), 2u);
    const auto on_formula = [](double y) {
        return .5 + .1 * std::sqrt(1 + (y - .5) * (y - .5) / .08);
    };
    const PropagationOptions weighted{.points = {.start = {0, .2}}, .max_error = 0};
    const auto expect_on_formula = [&](const Diagram& diagram, double chord) {
        for (const BisectorArc& arc : diagram.arcs) {
            EXPECT_EQ(arc.kind, ArcKind::Hyperbola);
            for (int i = 0; i < 10; ++i) {
                const Vec2 at = point_on_arc(arc, i / 9.0);
                const SurfacePoint in_face = to_surface(surface, arc.face.value(), at);
                const Vec3 p = position(mesh.view(), in_face);
                EXPECT_NEAR(p.x(), on_formula(p.y()), 1e-14);
                // In the face: it need not be moved there.
                EXPECT_LE((position_in_frame(surface, in_face, 3 * arc.face.value()) - at).norm(),
                          1e-14);
            }
        }
        for (Index p = diagram.edge_points[0]; p < diagram.edge_points[1]; ++p) {
            const Vec3 at = position(mesh.view(), diagram.points[p]);
            EXPECT_NEAR(diagram.point_distance[p], (at - Vec3(.2, .5, 0)).norm(), 1e-14);
        }
        // The middle of a chord is at most so far from the arc.
        for (Index p = diagram.edge_points[0]; p + 1 < diagram.edge_points[1]; ++p) {
            const CurvePiece piece = curve_piece(surface, diagram, 0, p);
            const Vec3 middle =
                (position(mesh.view(), piece.from) + position(mesh.view(), piece.to)) / 2;
            EXPECT_LE(std::abs(middle.x() - on_formula(middle.y())), 1.1 * chord);
        }
    };
    const Diagram diagram =
        build_diagram(surface, sites, propagate(surface, sites, weighted), {.chord = 1e-5});
    EXPECT_GT(diagram.arcs.size(), 4u);
    expect_on_formula(diagram, 1e-5);
    // Two faces, so that one arc crosses many of the input's.
    const IntrinsicTriangulation base(surface, {.min_length = 1});
    EXPECT_GT(base.counts().removed, 8u);
    const auto on_base = base.to_intrinsic(sites);
    for (const double chord : {1e-5, .5}) {
        const Diagram mapped = diagram_on_input(
            base, build_diagram(base.surface(), on_base,
                                propagate(base.surface(), on_base, weighted), {.chord = chord}));
        EXPECT_GT(mapped.arcs.size(), 4u);
        expect_on_formula(mapped, chord);
        EXPECT_NEAR(total_area(mapped), 1, 1e-14);
    }
}

// A kite with its long diagonal, x = 0, between the faces of two sites; the base has the short
// diagonal. The arc above that crosses x = 0 twice, its chord does not.
TEST(BisectorArcs, AreCutWhereTheyCrossAnEdgeOfTheInputBesideTheirChord) {
    const TriangleMesh mesh{{{-1, 0, 0}, {0, -5, 0}, {1, 0, 0}, {0, 5, 0}, {-3, 3, 0}, {3, 3, 0}},
                            {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}, {2, 5, 3}}};
    const Surface surface = build_surface(mesh.view());
    const auto in_face = [&](Index face, const Vec3& p) {
        const auto corner = [&](Index k) { return mesh.positions[mesh.triangles[face][k]]; };
        const Vec3 a = corner(1) - corner(0), b = corner(2) - corner(0), d = p - corner(0);
        const double whole = a.cross(b).z(), at_1 = d.cross(b).z() / whole,
                     at_2 = a.cross(d).z() / whole;
        return SurfacePoint{FaceId(face), {1 - at_1 - at_2, at_1, at_2}};
    };
    const std::vector<SurfacePoint> sites{in_face(2, {-1.2, .8, 0}), in_face(3, {.9, .8, 0})};
    const IntrinsicTriangulation base(surface);
    const auto on_base = base.to_intrinsic(sites);
    const Propagation propagation =
        propagate(base.surface(), on_base, {.points = {.start = {0, .28}}, .max_error = 0});
    const Diagram diagram =
        diagram_on_input(base, build_diagram(base.surface(), on_base, propagation, {.chord = 10}));
    Index num_left = 0;
    for (const BisectorArc& arc : diagram.arcs) {
        if (arc.face == FaceId(0)) ++num_left;
        for (int i = 0; i < 10; ++i) {
            const Vec2 at = point_on_arc(arc, i / 9.0);
            const SurfacePoint inside = to_surface(surface, arc.face.value(), at);
            EXPECT_LE((position_in_frame(surface, inside, 3 * arc.face.value()) - at).norm(),
                      1e-13);
            const Vec3 p = position(mesh.view(), inside);
            const double height = (p.y() - .8) * (p.y() - .8) / (1.05 * 1.05 - .14 * .14);
            EXPECT_NEAR(p.x(), -.15 + .14 * std::sqrt(1 + height), 1e-13);
        }
    }
    EXPECT_EQ(num_left, 1u);
}

// A strip bent to an L: paths of a site to the other leg bend at the inner corner.
TEST(BisectorArcs, AreHyperbolasAboutACornerThatPathsBendAt) {
    const TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
                            {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
    const Surface surface = build_surface(mesh.view());
    const std::vector<SurfacePoint> sites{point_at(surface, 2), point_at(surface, 5)};
    const Diagram diagram =
        build_diagram(surface, sites, propagate(surface, sites, {.max_error = 0}), {.chord = 1e-3});
    Index num_bent = 0;
    for (const BisectorArc& arc : diagram.arcs) {
        for (std::size_t k = 0; k < 2; ++k) {
            if (arc.weight[k] == 0) continue;
            ++num_bent;
            EXPECT_EQ(arc.kind, ArcKind::Hyperbola);
            EXPECT_NEAR(
                std::min(std::abs(arc.weight[k] - 1), std::abs(arc.weight[k] - std::sqrt(2))), 0,
                1e-15);
            EXPECT_LE((in_plane(surface, arc, Vec3(1, 1, 0)) - arc.focus[k]).norm(), 1e-13);
        }
    }
    EXPECT_GT(num_bent, 0u);
}

TEST(BisectorArcs, WithErrorsFormAValidComplex) {
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(3), 0.05, 3).view());
    const auto sites = points::scattered(surface, 30, 2);
    for (const PropagationOptions& options :
         {PropagationOptions{}, PropagationOptions{.max_error = 1e-2},
          PropagationOptions{.engine = Engine::Steiner}}) {
        const Diagram diagram =
            build_diagram(surface, sites, propagate(surface, sites, options), {.chord = 1e-4});
        checks::expect_valid_complex(surface, diagram);
        const auto num_chords =
            std::count_if(diagram.arcs.begin(), diagram.arcs.end(),
                          [](const BisectorArc& arc) { return arc.kind == ArcKind::Chord; });
        EXPECT_LT(num_chords, static_cast<std::ptrdiff_t>(diagram.arcs.size() / 50));
        for (const BisectorArc& arc : diagram.arcs) {
            if (arc.kind == ArcKind::Chord) continue;
            const Vec2 p = point_on_arc(arc, 0.5);
            EXPECT_NEAR((p - arc.focus[0]).norm() + arc.weight[0],
                        (p - arc.focus[1]).norm() + arc.weight[1], 1e-13);
        }
    }
}

// Conics of distances with large errors may cross: these arcs stay as they were.
TEST(BisectorArcs, WithLargeErrorsDoNotCross) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Surface surface = build_surface(shapes::jitter(shapes::sphere(3), 0.1, seed).view());
        const auto sites = points::scattered(surface, 100, seed);
        const Propagation propagation =
            propagate(surface, sites, {.engine = Engine::Steiner, .steiner_points = 1});
        checks::expect_valid_complex(surface,
                                     build_diagram(surface, sites, propagation, {.chord = 1e-4}));
    }
}

TEST(BisectorArcs, AreMadeOnlyIfAskedForWithAChordAboveZero) {
    const Surface surface = build_surface(shapes::sphere(2).view());
    const auto sites = points::scattered(surface, 5, 2);
    const Propagation propagation = propagate(surface, sites);
    const Diagram plain = build_diagram(surface, sites, propagation);
    EXPECT_TRUE(plain.arcs.empty());
    EXPECT_TRUE(plain.edge_arcs.empty());
    EXPECT_THROW((void)build_diagram(surface, sites, propagation, {.chord = 0}), InvalidOption);
    const auto with_threads = [&](int count) {
        return build_diagram(surface, sites, propagation, {.chord = 1e-3, .num_threads = count});
    };
    checks::expect_same(with_threads(1), with_threads(3));
}
