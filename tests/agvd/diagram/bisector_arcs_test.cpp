// The arcs of diagrams: points of each are as far from both sites, by the relays of the propagation
// that the diagram was built from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agvd/diagram/diagram.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "support/checks.h"
#include "support/points.h"
#include "support/random_meshes.h"
#include "support/random_surfaces.h"
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
    double largest_gap = 0;      // In cell radii.
    double largest_outside = 0;  // Likewise: how far points lie outside the arc's face.
    double largest_stray = 0;    // Of the polylines from arcs, mesh units.
    Index num_arcs = 0, num_chords = 0, num_hyperbolas = 0;
};

template <typename Gap>
ArcFigures measure(const Surface& surface, const Diagram& diagram, double radius, const Gap& gap) {
    ArcFigures figures;
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const Index first = diagram.edge_arcs[e], end = diagram.edge_arcs[e + 1];
        for (Index a = first; a < end; ++a) {
            const BisectorArc& arc = diagram.arcs[a];
            ++figures.num_arcs;
            figures.num_chords += arc.kind == ArcKind::Chord ? 1 : 0;
            figures.num_hyperbolas += arc.kind == ArcKind::Hyperbola ? 1 : 0;
            for (int i = 0; i <= 10; ++i) {
                const Vec2 p = point_on_arc(arc, i / 10.0);
                const SurfacePoint on = to_surface(surface, arc.face.value(), p);
                const Vec2 back = position_in_frame(surface, on, 3 * arc.face.value());
                figures.largest_outside =
                    std::max(figures.largest_outside, (back - p).norm() / radius);
                const double here = gap(on, diagram.edges[e]) / radius;
                if (here > 1e-11 && std::getenv("AGVD_SHOW")) {
                    std::printf("face %u begin %g %g end %g %g edge %u arc %u/%u kind %d share %d gap %g len %g radius %g out %g w %g %g\n", arc.face.value(), arc.begin.x(), arc.begin.y(), arc.end.x(), arc.end.y(), e, a - first, end - first, int(arc.kind), i, here, (arc.end-arc.begin).norm(), radius, (back-p).norm(), arc.weight[0], arc.weight[1]);
                }
                figures.largest_gap = std::max(figures.largest_gap, here);
            }
        }
    }
    return figures;
}

}  // namespace

TEST(BisectorArcs, ShowFigures) {
    const auto show = [](const char* name, const TriangleMesh& mesh, Index count, double length) {
        const Surface surface = build_surface(mesh.view());
        const double size = std::sqrt(surface_area(surface));
        const ArcScene scene(mesh, points::scattered(surface, count, 3), length * size, 1e-3 * size);
        const ArcFigures a = measure(scene.base(), scene.on_base(), scene.radius(),
                                     [&](const SurfacePoint& p, const VoronoiEdge& e) { return scene.gap(p, e); });
        const ArcFigures b = measure(scene.surface(), scene.on_input(), scene.radius(),
                                     [&](const SurfacePoint& p, const VoronoiEdge& e) { return scene.gap_of_input(p, e); });
        std::printf("%-14s base: gap %.2g outside %.2g, %u arcs, %u chords, %u hyp, %zu points; input: gap %.2g outside %.2g %u arcs, %u chords %u hyp %zu points\n", name,
                    a.largest_gap, a.largest_outside, a.num_arcs, a.num_chords, a.num_hyperbolas, scene.on_base().points.size(),
                    b.largest_gap, b.largest_outside, b.num_arcs, b.num_chords, b.num_hyperbolas, scene.on_input().points.size());
        checks::expect_valid_complex(scene.base(), scene.on_base());
    };
    show("sphere", shapes::jitter(shapes::sphere(3), 0.05, 3), 40, 0.1);
    show("cube", shapes::cube(), 20, 0.1);
    show("grid", shapes::jitter(shapes::grid(12), 0.02, 5), 20, 0.1);
    show("torus", shapes::torus(24, 12), 20, 0.1);
    show("lips", shapes::lips(10, 10, 4), 20, 0.1);
    for (const char* family : random_meshes::families()) {
        for (int seed = 0; seed < 3; ++seed) show(family, random_meshes::make(family, seed), 9, 0.2);
    }
}
