// Labels of faces whose borders are curves: how much of the area keeps its label.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <set>

#include "agvd/core/random.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/transfer/transfer.h"
#include "support/junction_shapes.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;

namespace {

using LabelOf = std::function<Index(const Vec3&)>;

std::vector<Index> labels_of(const TriangleMesh& mesh, const LabelOf& label_of) {
    std::vector<Index> labels;
    for (const auto& [a, b, c] : mesh.triangles) {
        labels.push_back(label_of((mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3));
    }
    return labels;
}

// The share of the input's area whose nearest point of the result has the same label.
double kept_share(const TriangleMesh& mesh, const std::vector<Index>& labels,
                  remesh::RemeshOptions options) {
    options.face_labels = labels;
    const auto made = remesh::remesh(mesh.view(), options);
    const auto map =
        remesh::map_to_input(mesh.view(), made.mesh.view(), made.sites, {.with_faces = true});
    const std::vector<double> given(labels.begin(), labels.end());
    const auto values = transfer_face_values(given, map.faces, remesh::ValueKind::Label);
    const agvd::ClosestPointTree tree(made.mesh.view());
    const agvd::Surface surface = agvd::build_surface(mesh.view());
    constexpr Index num_points = 200'000;
    Index num_kept = 0;
    for (const agvd::SurfacePoint& point : agvd::uniform_points(surface, num_points, 1)) {
        const auto nearest = tree.query(position(mesh.view(), point));
        if (values[nearest.point.face.value()] == labels[point.face.value()]) ++num_kept;
    }
    return num_kept / static_cast<double>(num_points);
}

struct Labelled {
    const char* name;
    TriangleMesh mesh;
    LabelOf label_of;
};

std::vector<Labelled> labelled_meshes() {
    const auto octants = [](const Vec3& p) {
        return Index{p.x() > 0.1} + 2 * Index{p.y() > -0.2} + 4 * Index{p.z() > 0};
    };
    const auto spots = [](const Vec3& p) { return Index{p.z() > 0.8} + 2 * Index{p.x() < -0.7}; };
    const auto slices = [](const Vec3& p) {
        return static_cast<Index>(
            std::floor(3 * (std::atan2(p.y(), p.x()) / std::numbers::pi + 1)));
    };
    const auto strip = [](const Vec3& p) {
        return Index{p.x() + p.y() > 0.7} + 2 * Index{p.z() < 0.3};
    };
    TriangleMesh box = shapes::cube();
    for (int i = 0; i < 5; ++i) box = shapes::subdivide(box);
    return {{"sphere, octants", shapes::sphere(5), octants},
            {"sphere, spots", shapes::sphere(5), spots},
            {"torus, slices", shapes::torus(120, 60), slices},
            {"torus, octants", shapes::torus(120, 60), octants},
            {"box, strip", box, strip}};
}

// A closed mesh with a label for each planar side.
struct Polyhedron {
    TriangleMesh mesh;
    std::vector<Index> labels;
};

// An oblique prism over a star-shaped outline; the caps have the labels n and n + 1.
Polyhedron prism_over(const std::vector<Vec3>& outline, const Vec3& along) {
    const auto n = static_cast<Index>(outline.size()), top = n + 1;
    Polyhedron prism;
    for (const Vec3& shift : {Vec3(0, 0, 0), along}) {
        for (const Vec3& p : outline) prism.mesh.positions.push_back(p + shift);
        prism.mesh.positions.push_back(shift);
    }
    for (Index i = 0; i < n; ++i) {
        const Index next = (i + 1) % n;
        prism.mesh.triangles.insert(prism.mesh.triangles.end(), {{i, next, top + next},
                                                                 {i, top + next, top + i},
                                                                 {n, next, i},
                                                                 {top + n, top + i, top + next}});
        prism.labels.insert(prism.labels.end(), {i, i, n, n + 1});
    }
    return prism;
}

// With a notch that may be narrow.
Polyhedron random_prism(std::uint64_t seed) {
    const auto draw = [&](std::uint64_t stream, std::uint64_t i, double least, double most) {
        return least + (most - least) * agvd::random_unit(seed, stream, i);
    };
    const auto on_outline = [](double radius, double turn) {
        return Vec3(radius * std::cos(turn), radius * std::sin(turn), 0);
    };
    const double notch = draw(4, 0, 0.14, 1), rest = 2 * (std::numbers::pi - notch);
    std::vector<Vec3> outline{on_outline(1, -notch), on_outline(0.1, 0), on_outline(1, notch)};
    const auto n = static_cast<Index>(draw(0, 0, 1, 6));
    for (Index i = 0; i < n; ++i) {
        const double turn = notch + rest * (i + draw(1, i, 0.3, 1)) / (n + 1);
        outline.push_back(on_outline(draw(2, i, 0.2, 1), turn));
    }
    return prism_over(outline, {draw(3, 0, -1, 1), draw(3, 1, -1, 1), draw(3, 2, 0.4, 1.5)});
}

// The extremes of the angles between neighbouring faces, inside, in degrees.
std::pair<double, double> dihedral_range(const TriangleMesh& mesh) {
    const agvd::Surface surface = agvd::build_surface(mesh.view());
    const auto normal = [&](Index half_edge) {
        const auto& [a, b, c] = mesh.triangles[half_edge / 3];
        const auto& p = mesh.positions;
        return Vec3((p[b] - p[a]).cross(p[c] - p[a]).normalized());
    };
    std::pair<double, double> range(360, 0);
    for (const Index h : surface.edge_half) {
        const Vec3 left = normal(h), right = normal(surface.twin[h]);
        const Vec3 along =
            (mesh.positions[surface.head(h)] - mesh.positions[surface.tail(h)]).normalized();
        const double turn = std::atan2(left.cross(right).dot(along), left.dot(right));
        range.first = std::min(range.first, 180 - turn * 180 / std::numbers::pi);
        range.second = std::max(range.second, 180 - turn * 180 / std::numbers::pi);
    }
    return range;
}

// The labels that a face of the result may have: of the sides on which all of it lies, else those
// that are nearest somewhere.
struct LabelsUnder {
    std::set<Index> all, nearest;
};

LabelsUnder labels_under(const Polyhedron& input, const std::array<Vec3, 3>& corners) {
    constexpr int n = 6;
    constexpr double tolerance = 1e-9;
    const Index num_labels = 1 + *std::max_element(input.labels.begin(), input.labels.end());
    LabelsUnder under;
    for (Index label = 0; label < num_labels; ++label) under.all.insert(label);
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j) {
            const Vec3 point =
                (i * corners[0] + j * corners[1] + (n - i - j) * corners[2]) / double{n};
            std::vector<double> distance(num_labels, std::numeric_limits<double>::infinity());
            for (Index f = 0; f < input.labels.size(); ++f) {
                const auto& [a, b, c] = input.mesh.triangles[f];
                const auto& p = input.mesh.positions;
                const auto found =
                    agvd::closest_point_on_triangle({p[a], p[b], p[c]}, agvd::FaceId(f), point);
                double& least = distance[input.labels[f]];
                least = std::min(least, std::sqrt(found.distance_sq));
            }
            const double least = *std::min_element(distance.begin(), distance.end());
            for (Index label = 0; label < num_labels; ++label) {
                if (distance[label] > tolerance) under.all.erase(label);
                if (distance[label] <= least + tolerance) under.nearest.insert(label);
            }
        }
    }
    return under;
}

}  // namespace

TEST(KeptLabels, BordersThatAreCurvesKeepTheArea) {
    for (const Labelled& labelled : labelled_meshes()) {
        const auto labels = labels_of(labelled.mesh, labelled.label_of);
        const double share = kept_share(labelled.mesh, labels, {.num_samples = 2000});
        std::printf("%s: %.3f %% of the area keep their label\n", labelled.name, 100 * share);
        EXPECT_GT(share, 0.99) << labelled.name;
    }
}

TEST(KeptLabels, NoFaceHasALabelThatNoneOfTheFacesUnderItHas) {
    int num_prisms = 0, num_faces = 0, num_on_one_side = 0;
    std::pair<double, double> range(360, 0);
    for (std::uint64_t seed = 0; num_prisms < 200; ++seed) {
        const Polyhedron input = random_prism(seed);
        const auto [least, most] = dihedral_range(input.mesh);
        if (least < 20 || most > 340) continue;
        range = {std::min(range.first, least), std::max(range.second, most)};
        ++num_prisms;
        remesh::RemeshOptions options{.num_samples = 100};
        if (num_prisms % 2 == 0) options.face_labels = input.labels;
        const auto made = remesh::remesh(input.mesh.view(), options);
        const auto map = remesh::map_to_input(input.mesh.view(), made.mesh.view(), made.sites,
                                              {.with_faces = true});
        const std::vector<double> given(input.labels.begin(), input.labels.end());
        const auto values = transfer_face_values(given, map.faces, remesh::ValueKind::Label);
        for (std::size_t f = 0; f < values.size(); ++f) {
            const auto& [a, b, c] = made.mesh.triangles[f];
            const auto& p = made.mesh.positions;
            const LabelsUnder under = labels_under(input, {p[a], p[b], p[c]});
            const auto& allowed = under.all.empty() ? under.nearest : under.all;
            ++num_faces;
            num_on_one_side += under.all.empty() ? 0 : 1;
            EXPECT_TRUE(allowed.contains(static_cast<Index>(values[f])))
                << "face " << f << " with label " << values[f] << " of prism " << seed;
        }
    }
    std::printf("%d of %d faces lie on one side, dihedral angles from %.1f to %.1f degrees\n",
                num_on_one_side, num_faces, range.first, range.second);
    EXPECT_GT(num_on_one_side, num_faces / 2);
    EXPECT_LT(range.first, 25);
    EXPECT_GT(range.second, 335);
}

// Where two sheets meet at a small angle the nearest face may be of the other one.
TEST(KeptLabels, FacesAtJunctionsHaveTheLabelOfTheirSheet) {
    for (const double height : {0.15, 0.3, 0.6}) {
        const TriangleMesh mesh = shapes::three_lobes(80, height);
        const auto labels = labels_of(mesh, [](const Vec3& p) {
            return std::abs(p.z()) < 1e-9 ? Index{0} : p.z() > 0 ? Index{1} : Index{2};
        });
        const std::vector<double> given(labels.begin(), labels.end());
        for (const Index count : {60, 100, 150, 200, 300}) {
            const auto made = remesh::remesh(mesh.view(), {.num_samples = count,
                                                           .face_labels = labels,
                                                           .junctions = remesh::Junctions::Keep});
            const auto map = remesh::map_to_input(mesh.view(), made.mesh.view(), made.sites,
                                                  {.with_faces = true});
            const auto values = transfer_face_values(given, map.faces, remesh::ValueKind::Label);
            EXPECT_EQ(made.junctions.apart_edges, 0) << height << ' ' << count;
            agvd::for_each_edge(agvd::sorted_edge_sides(made.mesh.triangles),
                                [&](const auto& edge) {
                                    if (edge.size() != 2) return;
                                    EXPECT_EQ(values[edge[0].face()], values[edge[1].face()])
                                        << height << ' ' << count;
                                });
        }
    }
}
