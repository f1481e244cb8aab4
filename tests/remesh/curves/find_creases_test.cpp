// Creases of parts by formula: where they are is known.
#include "remesh/curves/find_creases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agvd/core/error.h"
#include "agvd/mesh/surface.h"
#include "remesh/clean/clean_input.h"
#include "remesh/curves/crease_chains.h"
#include "support/dice.h"
#include "support/parts.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

constexpr double pi = std::numbers::pi;

using Flags = std::vector<std::uint8_t>;

// Of so many sites.
double spacing(const Surface& surface, double sites = 2000) {
    return std::sqrt(surface_area(surface) / sites);
}

Flags creases(const Surface& surface, double sites = 2000, double angle = 40) {
    return remesh::find_creases(surface, {.angle = angle, .spacing = spacing(surface, sites)});
}

// A network in figures.
struct Network {
    std::size_t edges = 0;
    std::size_t chains = 0;
    std::size_t open_ends = 0;
    double length = 0;
};

Network network_of(const Surface& surface, const Flags& flags) {
    remesh::detail::CreaseSet set(surface);
    Network network;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (flags[e] == 0) continue;
        set.add(e);
        ++network.edges;
        network.length += surface.length[e];
    }
    Poller poller;
    for (const auto& chain : remesh::detail::chains_of(set, poller)) {
        ++network.chains;
        for (const Index v : chain.ends) network.open_ends += set.is_open_end(v) ? 1 : 0;
    }
    return network;
}

void expect_network(const TriangleMesh& mesh, std::size_t edges, std::size_t chains,
                    double length) {
    const Surface surface = build_surface(mesh.view());
    const Network found = network_of(surface, creases(surface));
    EXPECT_EQ(found.edges, edges);
    EXPECT_EQ(found.chains, chains);
    EXPECT_EQ(found.open_ends, 0u);
    EXPECT_NEAR(found.length, length, 1e-6 * length);
}

// The parts whose creases do not end in nothing.
std::vector<TriangleMesh> some_parts() {
    return {parts::box({1, 1, 1}, 10),      parts::box({3, 2, 0.02}, 4), parts::extruded_l(6),
            parts::capped_cylinder(128, 8), parts::cone_on_plate(64, 8), parts::crossing_vaults(24),
            parts::ribbed_plate(0.02, 20)};
}

// Segments of creases, to compare the networks of two triangulations.
struct Segments {
    std::vector<std::pair<Vec3, Vec3>> list;
    double length = 0;
};

Segments segments_of(const Surface& surface, const Flags& flags) {
    Segments segments;
    const auto& p = surface.mesh.positions;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (flags[e] == 0) continue;
        const Index h = surface.edge_half[e];
        segments.list.emplace_back(p[surface.tail(h)], p[surface.head(h)]);
        segments.length += surface.length[e];
    }
    return segments;
}

bool lies_on(const Vec3& point, const std::pair<Vec3, Vec3>& segment, double tolerance) {
    const Vec3 along = segment.second - segment.first;
    const double t = std::clamp((point - segment.first).dot(along) / along.squaredNorm(), 0., 1.);
    return (segment.first + t * along - point).norm() < tolerance;
}

// Both ends of each segment lie on one segment of the other network.
bool lies_on(const Segments& inner, const Segments& outer, double tolerance) {
    return std::all_of(inner.list.begin(), inner.list.end(), [&](const auto& s) {
        return std::any_of(outer.list.begin(), outer.list.end(), [&](const auto& o) {
            return lies_on(s.first, o, tolerance) && lies_on(s.second, o, tolerance);
        });
    });
}

void expect_same_network(const TriangleMesh& plain, const TriangleMesh& other, double tolerance) {
    const Surface a = build_surface(plain.view()), b = build_surface(other.view());
    const Segments of_plain = segments_of(a, creases(a)), of_other = segments_of(b, creases(b));
    EXPECT_NEAR(of_plain.length, of_other.length, 1e-6 * of_plain.length);
    EXPECT_TRUE(lies_on(of_other, of_plain, tolerance));
}

}  // namespace

TEST(FindCreases, BoxHasItsTwelveEdges) {
    expect_network(parts::box({1, 1, 1}, 20), 240, 12, 12);
    expect_network(shapes::cube(), 12, 12, 12);
    expect_network(parts::box({1, 1, 1}, 1), 12, 12, 12);
}

TEST(FindCreases, ExtrudedLHasEighteenChains) {
    expect_network(parts::extruded_l(10), 220, 18, 22);
}

TEST(FindCreases, CapsOfACylinderHaveTwoCircles) {
    expect_network(parts::capped_cylinder(128, 16), 256, 2, 2 * 128 * 2 * std::sin(pi / 128));
}

TEST(FindCreases, ConeMeetsItsPlateInACircle) {
    expect_network(parts::cone_on_plate(64, 10), 64, 1, 64 * 2 * std::sin(pi / 64));
}

TEST(FindCreases, CrossingVaultsMeetInTwoCurvesFromBoundaryToBoundary) {
    const Surface surface = build_surface(parts::crossing_vaults(40).view());
    const Network found = network_of(surface, creases(surface));
    EXPECT_EQ(found.edges, 80u);
    EXPECT_EQ(found.chains, 2u);
    EXPECT_EQ(found.open_ends, 0u);
}

TEST(FindCreases, RibsAndPlatesMuchThinnerThanTheSpacingHaveAllTheirCreases) {
    expect_network(parts::ribbed_plate(0.01, 40), 160, 4, 16);  // A tenth of the spacing.
    expect_network(parts::box({4, 4, 0.01}, 20), 240, 12, 32.04);
}

TEST(FindCreases, StepsAreCreasesAtEverySpacing) {
    const Surface surface = build_surface(parts::ribbed_plate(0.05, 40).view());
    for (const double sites : {50., 1e4, 1e6}) {
        EXPECT_EQ(network_of(surface, creases(surface, sites)).edges, 160u) << sites;
    }
}

TEST(FindCreases, FadingFoldEndsWhereItIsWeakAndSlitsAreNoCreases) {
    // 80 degrees for x < 0; 25 degrees, which is weak, at x = 2.06; nothing from 3 on.
    const auto fold = [](double x) { return 80 * std::clamp(1 - x / 3, 0., 1.); };
    const TriangleMesh plate = parts::folded_plate(64, 16, 1, fold);
    for (const TriangleMesh& mesh : {plate, parts::with_slit(plate, 3.5, 0.5)}) {
        const Surface surface = build_surface(mesh.view());
        const Flags flags = creases(surface);
        const Network found = network_of(surface, flags);
        EXPECT_EQ(found.chains, 1u);
        EXPECT_EQ(found.open_ends, 1u);
        double end = -4;
        for (const auto& [a, b] : segments_of(surface, flags).list) {
            EXPECT_EQ(a.y(), 0);
            EXPECT_EQ(b.y(), 0);
            end = std::max({end, a.x(), b.x()});
        }
        EXPECT_NEAR(found.length, end + 4, 1e-9);
        EXPECT_NEAR(end, 2.06, 0.13);
    }
}

TEST(FindCreases, FoldThatIsWeakForAShortWayIsOneCrease) {
    for (const double weakest : {30., 10.}) {
        const auto fold = [&](double x) { return std::abs(x) < 0.3 ? weakest : 80; };
        const Surface surface = build_surface(parts::folded_plate(64, 8, 0.25, fold).view());
        const Network found = network_of(surface, remesh::find_creases(surface, {.spacing = 1}));
        // 25 degrees are what a crease goes on along.
        EXPECT_EQ(found.chains, weakest > 25 ? 1u : 2u);
        EXPECT_EQ(found.open_ends, weakest > 25 ? 0u : 2u);
    }
}

TEST(FindCreases, ShortFoldsInTheMiddleOfNothingAreLeft) {
    // A fold of 60 degrees and length 2, fading on both sides.
    const auto fold = [](double x) { return 60 * std::clamp(2 - std::abs(x), 0., 1.); };
    const Surface surface = build_surface(parts::folded_plate(128, 16, 0.5, fold).view());
    const auto length_at = [&](double spacing) {
        return network_of(surface, remesh::find_creases(surface, {.spacing = spacing})).length;
    };
    EXPECT_EQ(length_at(2), 0);
    EXPECT_EQ(length_at(0.6), 0);
    EXPECT_GT(length_at(0.2), 2);
}

TEST(FindCreases, SmoothSurfacesHaveNone) {
    for (const TriangleMesh& mesh : {shapes::sphere(3), shapes::torus(40, 24), shapes::grid(8)}) {
        const Surface surface = build_surface(mesh.view());
        EXPECT_EQ(network_of(surface, creases(surface)).edges, 0u);
    }
}

TEST(FindCreases, NoiseHasNone) {
    // Dihedral angles up to 90 degrees everywhere, at every number of sites up to the vertices'.
    const Surface surface = build_surface(shapes::jitter(shapes::sphere(5), 0.02, 1).view());
    const double spacing_2000 = spacing(surface);
    const Flags all =
        remesh::find_creases(surface, {.spacing = spacing_2000, .is_automatic = false});
    EXPECT_GT(network_of(surface, all).length, 30);
    for (const double sites : {200., 2000., 10000.}) {
        EXPECT_EQ(network_of(surface, creases(surface, sites)).edges, 0u) << sites;
    }
}

TEST(FindCreases, WithoutTheRulesOfScaleEveryEdgeAboveTheAngleCounts) {
    const Surface surface = build_surface(shapes::icosahedron().view());  // 41.8 degrees.
    for (const double angle : {41., 42.}) {
        const Flags flags =
            remesh::find_creases(surface, {.angle = angle, .spacing = 1, .is_automatic = false});
        EXPECT_EQ(network_of(surface, flags).edges, angle < 41.8 ? 30u : 0u);
    }
}

TEST(FindCreases, AngleDecides) {
    const Surface surface = build_surface(parts::crossing_vaults(24).view());  // 60 to 90 degrees.
    EXPECT_EQ(network_of(surface, creases(surface, 2000, 55)).edges, 48u);
    EXPECT_EQ(network_of(surface, creases(surface, 2000, 95)).edges, 0u);
    EXPECT_EQ(network_of(surface, creases(surface, 2000, 170)).edges, 0u);
}

TEST(FindCreases, NeedlesAndSplitsInFlatFacesChangeNothing) {
    for (const TriangleMesh& mesh : some_parts()) {
        for (const double aspect : {0.3, 1e-4, 1e-6}) {
            SCOPED_TRACE(aspect);
            SCOPED_TRACE(mesh.triangles.size());
            expect_same_network(mesh, parts::with_needles(mesh, aspect, 0.4, 7), 1e-9);
        }
    }
}

TEST(FindCreases, NeedlesOfRoundedCoordinatesHaveNoDirection) {
    for (const TriangleMesh& mesh : some_parts()) {
        TriangleMesh needles = parts::turned(parts::with_needles(mesh, 2e-6, 0.3, 3), 5);
        for (Vec3& p : needles.positions) p = p.cast<float>().cast<double>();
        const TriangleMesh clean = remesh::clean_input(needles.view()).mesh;
        // They do have false angles,
        const Surface surface = build_surface(clean.view());
        const Flags raw = remesh::find_creases(surface, {.spacing = 1e-9, .is_automatic = false});
        const Surface plain = build_surface(mesh.view());
        const double length = network_of(plain, creases(plain)).length;
        EXPECT_GT(network_of(surface, raw).length, 1.2 * length);
        // and no effect.
        expect_same_network(parts::turned(mesh, 5), clean, 1e-4);
    }
}

TEST(FindCreases, TurningScalingAndNoiseChangeNothing) {
    for (const TriangleMesh& mesh : some_parts()) {
        const Surface plain = build_surface(mesh.view());
        const Flags expected = creases(plain);
        for (const double scale : {1e-6, 1., 1e6}) {
            TriangleMesh other = parts::turned(mesh, 11);
            for (Vec3& p : other.positions) p *= scale;
            const Surface surface = build_surface(other.view());
            EXPECT_EQ(creases(surface), expected);
            double shortest = 1e300;
            for (const double length : surface.length) shortest = std::min(shortest, length);
            const TriangleMesh noisy = shapes::jitter(other, 1e-3 * shortest, 2);
            EXPECT_EQ(creases(build_surface(noisy.view())), expected);
        }
    }
}

TEST(FindCreases, ThreadsChangeNothing) {
    const Surface surface = build_surface(parts::capped_cylinder(128, 64).view());
    const auto with_threads = [&](int threads) {
        return remesh::find_creases(surface, {.spacing = spacing(surface), .num_threads = threads});
    };
    EXPECT_EQ(with_threads(1), with_threads(2));
    EXPECT_EQ(with_threads(1), with_threads(8));
}

TEST(FindCreases, OptionsOutOfRangeAreRefused) {
    const Surface surface = build_surface(shapes::cube().view());
    for (const double angle : {0., 180., -1., std::nan("")}) {
        EXPECT_THROW(remesh::find_creases(surface, {.angle = angle, .spacing = 1}), InvalidOption);
    }
    for (const double length : {0., -1., std::nan(""), HUGE_VAL}) {
        EXPECT_THROW(remesh::find_creases(surface, {.spacing = length}), InvalidOption);
    }
}
