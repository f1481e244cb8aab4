// Labels of faces whose borders are curves: how much of the area keeps its label.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/uniform_points.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/transfer/transfer_values.h"
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

}  // namespace

TEST(KeptLabels, BordersThatAreCurvesKeepTheArea) {
    for (const Labelled& labelled : labelled_meshes()) {
        const auto labels = labels_of(labelled.mesh, labelled.label_of);
        const double share = kept_share(labelled.mesh, labels, {.num_samples = 2000});
        std::printf("%s: %.3f %% of the area keep their label\n", labelled.name, 100 * share);
        EXPECT_GT(share, 0.99) << labelled.name;
    }
}
