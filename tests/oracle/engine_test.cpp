// Every engine against exact geodesics, at the vertices and through the relays: on random meshes
// that are hard for windows, and on real ones.
//
// AGVD_LONG=1 asks for more of both. AGVD_SEED=N runs case N alone, as in
//     AGVD_SEED=17 oracle_engines --gtest_filter='*needles'

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "paper/oracle.h"
#include "remesh/clean/clean_input.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/arbiter.h"
#include "support/checks.h"
#include "support/dice.h"
#include "support/files.h"
#include "support/points.h"
#include "support/random_meshes.h"

using namespace agvd;

namespace {

// Distances of real paths in double, relative to the larger of the distance and the mesh.
constexpr double rounding = 1e-9;

std::vector<PropagationOptions> settings() {
    std::vector<PropagationOptions> all;
    for (const int m : {0, 3, 8}) all.push_back({.engine = Engine::Steiner, .steiner_points = m});
    for (const double error : {0.0, 1e-3, 1e-2}) {
        all.push_back({.engine = Engine::Window, .max_error = error});
    }
    return all;
}

std::string describe(const PropagationOptions& options) {
    std::string text = engine_name(options.engine);
    if (options.engine == Engine::Steiner) text += " m=" + std::to_string(options.steiner_points);
    if (options.max_error) text += " max_error=" + std::to_string(*options.max_error);
    return text;
}

// Sites, the points that are asked about (first every vertex that has a face), and the truth there.
struct EngineCase {
    Surface surface;
    std::vector<SurfacePoint> sites;
    std::vector<Index> vertices;
    std::vector<SurfacePoint> targets;
    NearestSites exact;
    double size = 0;  // Diagonal of the box.
    bool is_by_arbiter = false;

    [[nodiscard]] double tolerance(double distance) const {
        return rounding * std::max(distance, size);
    }
};

std::string number(double value) {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return text.str();
}

// The arbiter's distances instead of the oracle's; where these differ, both are printed: CGAL has
// faults where windows begin and end in line with vertices.
void correct_by_arbiter(EngineCase& c) {
    if (c.is_by_arbiter) return;
    c.is_by_arbiter = true;
    const arbiter::Distances truth = arbiter::nearest_sites(c.surface, c.sites, c.targets);
    const NearestSites oracle = std::move(c.exact);
    c.exact.distance.assign(truth.distance.begin(), truth.distance.end());
    c.exact.site = truth.site;
    for (std::size_t i = 0; i < oracle.distance.size(); ++i) {
        const double exact = c.exact.distance[i], other = oracle.distance[i];
        if (other == exact || std::abs(other - exact) <= c.tolerance(exact)) continue;
        std::cout << "oracle: " << number(other) << ", arbiter: " << number(exact) << '\n';
    }
}

// Whose word is taken first.
enum class Judge { Oracle, Arbiter };

EngineCase make_case(const TriangleMesh& mesh, std::vector<SurfacePoint> sites,
                     const std::vector<SurfacePoint>& more_targets, Judge judge) {
    EngineCase c;
    c.surface = build_surface(mesh.view());
    c.sites = std::move(sites);
    Eigen::AlignedBox3d box;
    for (const Vec3& p : mesh.positions) box.extend(p);
    c.size = box.diagonal().norm();
    for (Index v = 0; v < c.surface.num_vertices(); ++v) {
        if (c.surface.outgoing[v] == no_index) continue;
        c.vertices.push_back(v);
        c.targets.push_back(point_at(c.surface, v));
    }
    c.targets.insert(c.targets.end(), more_targets.begin(), more_targets.end());
    if (judge == Judge::Arbiter) {
        correct_by_arbiter(c);
    } else if (c.sites.size() == 1) {
        c.exact.distance = exact_distances(c.surface, c.sites[0], c.targets);
        for (const double d : c.exact.distance) {
            c.exact.site.push_back(std::isfinite(d) ? SiteId(0) : SiteId());
        }
    } else {
        c.exact = exact_nearest_sites(c.surface, c.sites, c.targets);
    }
    return c;
}

// What an engine says of the targets.
std::vector<PointLabel> answers(const EngineCase& c, const Propagation& propagation) {
    std::vector<PointLabel> all;
    for (std::size_t i = 0; i < c.targets.size(); ++i) {
        if (i < c.vertices.size()) {
            const Index v = c.vertices[i];
            all.push_back({propagation.vertex_site[v], propagation.vertex_distance[v]});
        } else {
            all.push_back(point_label(c.surface, propagation, c.targets[i]));
        }
    }
    return all;
}

// Distances of the targets from one site, at least as far as `longest`.
std::vector<double> distances_from(const EngineCase& c, SiteId site,
                                   std::span<const SurfacePoint> targets, double longest,
                                   Judge judge) {
    const SurfacePoint& from = c.sites[site.value()];
    if (judge == Judge::Oracle) return exact_distances(c.surface, from, targets);
    const auto found = arbiter::nearest_sites(c.surface, {&from, 1}, targets, longest);
    return {found.distance.begin(), found.distance.end()};
}

// The greatest distance that the bound allows.
double ceiling(const EngineCase& c, double exact, double bound) {
    return std::isfinite(bound) ? exact * (1 + bound) + c.tolerance(exact) : infinity;
}

bool is_possible(const EngineCase& c, const PointLabel& ours, double exact, double bound) {
    if (ours.site.is_valid() != std::isfinite(exact)) return false;
    if (!ours.distance || *ours.distance == exact) return true;
    return *ours.distance >= exact - c.tolerance(exact) &&
           *ours.distance <= ceiling(c, exact, bound);
}

// Every distance is that of a real path from its site, and none exceeds the nearest site's by more
// than `bound`; hence the nearest site is right wherever the next one is farther than that.
void expect_right(EngineCase& c, const Propagation& propagation, double bound) {
    const std::vector<PointLabel> ours = answers(c, propagation);
    const auto text_of = [&](std::size_t i) {
        return (i < c.vertices.size() ? "vertex " + std::to_string(c.vertices[i])
                                      : "face " + std::to_string(c.targets[i].face.value())) +
               ": site " + std::to_string(ours[i].site.value()) + " at " +
               number(ours[i].distance.value_or(std::nan(""))) + ", exact " +
               std::to_string(c.exact.site[i].value()) + " at " + number(c.exact.distance[i]);
    };
    std::vector<std::vector<std::size_t>> other_label(c.sites.size());
    for (std::size_t i = 0; i < ours.size(); ++i) {
        if (!is_possible(c, ours[i], c.exact.distance[i], bound)) correct_by_arbiter(c);
        ASSERT_TRUE(is_possible(c, ours[i], c.exact.distance[i], bound)) << text_of(i);
        const SiteId site = ours[i].site;
        if (site != c.exact.site[i]) other_label[site.value()].push_back(i);
    }
    // How far another site may be than the one that is said to be the nearest.
    const auto most = [&](std::size_t i) {
        const double claimed = ours[i].distance.value_or(infinity);
        return std::min(claimed + c.tolerance(c.exact.distance[i]),
                        ceiling(c, c.exact.distance[i], bound));
    };
    for (Index s = 0; s < c.sites.size(); ++s) {
        std::vector<SurfacePoint> targets;
        double longest = 0;
        for (const std::size_t i : other_label[s]) {
            targets.push_back(c.targets[i]);
            longest = std::max(longest, most(i));
        }
        if (targets.empty()) continue;
        const auto are_possible = [&](const std::vector<double>& theirs, bool is_told) {
            for (std::size_t k = 0; k < theirs.size(); ++k) {
                const std::size_t i = other_label[s][k];
                if (theirs[k] <= most(i)) continue;
                if (is_told) ADD_FAILURE() << text_of(i) << ", its site at " << number(theirs[k]);
                return false;
            }
            return true;
        };
        if (c.is_by_arbiter ||
            !are_possible(distances_from(c, SiteId(s), targets, longest, Judge::Oracle), false)) {
            are_possible(distances_from(c, SiteId(s), targets, longest, Judge::Arbiter), true);
        }
    }
}

// Of several sites at one place, the first owns all.
void expect_first_of_equals(const EngineCase& c, const Propagation& propagation) {
    for (std::size_t s = 1; s < c.sites.size(); ++s) {
        for (std::size_t r = 0; r < s; ++r) {
            if (c.sites[r] != c.sites[s]) continue;
            const auto& labels = propagation.vertex_site;
            EXPECT_EQ(std::count(labels.begin(), labels.end(), SiteId(static_cast<Index>(s))), 0)
                << "site " << s << " lies where site " << r << " is";
        }
    }
}

// The contract of relays.h that needs no distances.
void expect_well_formed(const EngineCase& c, const Propagation& p) {
    ASSERT_EQ(p.vertex_site.size(), c.surface.num_vertices());
    ASSERT_EQ(p.vertex_distance.size(), c.surface.num_vertices());
    ASSERT_EQ(p.relay_ranges.size(), p.mixed_faces.size());
    ASSERT_TRUE(std::is_sorted(p.mixed_faces.begin(), p.mixed_faces.end()));
    for (std::size_t i = 0; i < p.mixed_faces.size(); ++i) {
        ASSERT_EQ(p.relay_ranges[i].begin, i == 0 ? 0 : p.relay_ranges[i - 1].end);
        for (const Relay& relay : relays_of(p, static_cast<Index>(i))) {
            ASSERT_EQ(Surface::face(relay.half_edge), p.mixed_faces[i]);
            ASSERT_LT(relay.site.value(), c.sites.size());
            ASSERT_TRUE(0 <= relay.begin && relay.begin <= relay.end &&
                        relay.end <= c.surface.length_of(relay.half_edge));
            ASSERT_TRUE(std::isfinite(relay.x) && std::isfinite(relay.y) &&
                        std::isfinite(relay.weight));
        }
    }
    std::size_t next = 0;
    for (Index f = 0; f < c.surface.num_faces(); ++f) {
        if (next < p.mixed_faces.size() && p.mixed_faces[next] == f) {
            ++next;
            continue;
        }
        const auto& [i, j, k] = c.surface.mesh.triangles[f];
        ASSERT_TRUE(p.vertex_site[i] == p.vertex_site[j] && p.vertex_site[j] == p.vertex_site[k])
            << "face " << f << " is said to have one label";
    }
}

void check_engines(EngineCase c, int other_threads) {
    for (PropagationOptions options : settings()) {
        SCOPED_TRACE(describe(options));
        options.num_threads = 1;
        const Propagation propagation = propagate(c.surface, c.sites, options);
        ASSERT_NO_FATAL_FAILURE(expect_well_formed(c, propagation));
        EXPECT_LE(propagation.certified_error, options.max_error.value_or(infinity));
        expect_right(c, propagation, propagation.certified_error);
        expect_first_of_equals(c, propagation);
        options.num_threads = other_threads;
        SCOPED_TRACE(std::to_string(other_threads) + " threads");
        checks::expect_same(propagation, propagate(c.surface, c.sites, options));
    }
}

bool is_long() { return std::getenv("AGVD_LONG") != nullptr; }

class Engines : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(RandomMeshes, Engines, testing::ValuesIn(random_meshes::families()),
                         [](const auto& test) { return test.param; });

TEST_P(Engines, AreRight) {
    const std::size_t num_cases =
        ((is_long() ? 10000 : 300) - 1) / random_meshes::families().size() + 1;
    const char* const one = std::getenv("AGVD_SEED");
    const std::uint64_t first = one != nullptr ? std::stoull(one) : 0;
    const std::uint64_t last = one != nullptr ? first : num_cases - 1;
    for (std::uint64_t seed = first; seed <= last; ++seed) {
        const TriangleMesh mesh = random_meshes::make(GetParam(), seed);
        Dice dice(seed + (std::uint64_t{1} << 32));  // Other rolls than the mesh's.
        const auto num_faces = static_cast<Index>(mesh.triangles.size());
        const auto sites = points::random_sites(dice, num_faces);
        std::vector<SurfacePoint> targets;
        for (int i = 0; i < 40; ++i) {
            targets.push_back(points::anywhere(dice, dice.count(0, num_faces - 1)));
        }
        SCOPED_TRACE(std::string(GetParam()) + " AGVD_SEED=" + std::to_string(seed) + ", " +
                     std::to_string(num_faces) + " faces, " + std::to_string(sites.size()) +
                     " sites");
        check_engines(make_case(mesh, sites, targets, Judge::Oracle),
                      static_cast<int>(dice.count(2, 8)));
        if (HasFailure()) return;
    }
}

void check_real_mesh(const std::filesystem::path& path, Index num_sites) {
    const TriangleMesh mesh = remesh::clean_input(remesh::read_mesh(path).mesh.view()).mesh;
    SCOPED_TRACE(path.string() + ", " + std::to_string(num_sites) + " sites");
    Dice dice(num_sites);
    const auto num_faces = static_cast<Index>(mesh.triangles.size());
    ASSERT_LT(num_faces, 100000u);
    std::vector<SurfacePoint> sites, targets;
    while (sites.size() < num_sites) {
        sites.push_back(points::anywhere(dice, dice.count(0, num_faces - 1)));
    }
    for (int i = 0; i < 1000; ++i) {
        targets.push_back(points::anywhere(dice, dice.count(0, num_faces - 1)));
    }
    // CGAL takes seconds here, an hour on some larger ones.
    const Judge judge = num_faces < 13000 ? Judge::Oracle : Judge::Arbiter;
    check_engines(make_case(mesh, sites, targets, judge), 2);
}

class RealMesh : public testing::TestWithParam<const char*> {};

std::string identifier(std::string text) {
    for (char& c : text) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    return text;
}

INSTANTIATE_TEST_SUITE_P(Engines, RealMesh,
                         testing::Values("data/part.off", "data/slivers.off", "spot.obj",
                                         "fandisk.off", "hole_capsule.off", "alligator.obj",
                                         "3holes.off", "fertility.off", "rocker-arm.obj",
                                         "camelhead.off", "beetle.off", "bunny.off",
                                         "armadillo.obj", "nefertiti.obj", "dirty/72214.stl",
                                         "dirty/65004.stl", "dirty/79741.stl", "dirty/58011.stl",
                                         "dirty/triple_vierbein.obj", "dirty/fan3.obj",
                                         "dirty/hourglass_ico.obj", "dirty/stl_box_ascii.stl"),
                         [](const auto& test) { return identifier(test.param); });

TEST_P(RealMesh, EnginesAreRight) {
    const auto path = files::find_mesh(GetParam());
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << path << " is absent; set AGVD_MESHES to the folder of real meshes";
    }
    const std::string name = GetParam();
    if (is_long()) {
        for (const Index t : {1u, 2u, 30u, 1000u}) check_real_mesh(path, t);
    } else if (name == "spot.obj" || name == "fandisk.off" || name.starts_with("data/")) {
        for (const Index t : {2u, 30u}) check_real_mesh(path, t);
    } else {
        GTEST_SKIP() << "set AGVD_LONG for " << path;
    }
}

}  // namespace
