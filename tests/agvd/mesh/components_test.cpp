#include "agvd/mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/shapes.h"

using namespace agvd;

namespace {

// Three parts of more faces than a chunk has, in any order: what hangs together is far apart.
TriangleMesh shuffled_parts() {
    TriangleMesh mesh =
        shapes::join(shapes::join(shapes::tube(120, 80), shapes::torus(80, 80)), shapes::grid(40));
    std::mt19937 random(7);
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
    return mesh;
}

// By passing from face to face.
FaceLabels flooded(const Surface& surface) {
    FaceLabels labels{std::vector<Index>(surface.num_faces(), no_index), 0};
    for (Index seed = 0; seed < surface.num_faces(); ++seed) {
        if (labels.of_face[seed] != no_index) continue;
        std::vector<Index> faces{seed};
        labels.of_face[seed] = labels.count;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            for (Index h = 3 * faces[i]; h < 3 * faces[i] + 3; ++h) {
                if (surface.twin[h] == no_index) continue;
                const Index other = Surface::face(surface.twin[h]);
                if (labels.of_face[other] != no_index) continue;
                labels.of_face[other] = labels.count;
                faces.push_back(other);
            }
        }
        ++labels.count;
    }
    return labels;
}

}  // namespace

TEST(Components, AreLabelledByLowestFace) {
    for (const TriangleMesh& mesh :
         {shuffled_parts(), shapes::torus(120, 120), shapes::tetrahedron()}) {
        const Surface surface = build_surface(mesh.view());
        const FaceLabels expected = flooded(surface);
        const FaceLabels labels = label_components(surface.twin);
        EXPECT_EQ(labels.count, expected.count);
        EXPECT_EQ(labels.of_face, expected.of_face);
    }
}

TEST(Components, AreMeasuredOneByOne) {
    const Surface surface = build_surface(shuffled_parts().view());
    const FaceLabels labels = flooded(surface);
    const std::vector<Component> components = find_components(surface);
    ASSERT_EQ(components.size(), 3u);
    std::vector<int> euler, loops;
    for (Index i = 0; i < 3; ++i) {
        const Component& c = components[i];
        euler.push_back(c.euler);
        loops.push_back(c.boundary_loops);
        EXPECT_TRUE(std::is_sorted(c.faces.begin(), c.faces.end()));
        double area = 0;
        for (std::size_t k = 0; k < c.faces.size(); ++k) {
            EXPECT_EQ(labels.of_face[c.faces[k]], i);
            area += surface.length_of(3 * c.faces[k]) * surface.apex[3 * c.faces[k]].y() / 2;
            ASSERT_EQ(c.area_up_to[k], area);
        }
    }
    std::sort(euler.begin(), euler.end());
    std::sort(loops.begin(), loops.end());
    EXPECT_EQ(euler, (std::vector{0, 0, 1}));
    EXPECT_EQ(loops, (std::vector{0, 1, 2}));
}

TEST(Components, TopologyIsTheSameWithAndWithoutConnectivity) {
    const TriangleMesh mesh = shuffled_parts();
    const Connectivity connectivity = *find_connectivity(mesh.view());
    const agvd::Topology expected = agvd::analyze_topology(mesh.view());
    const agvd::Topology found = agvd::analyze_topology(mesh.view(), connectivity);
    ASSERT_EQ(found.components.size(), expected.components.size());
    EXPECT_EQ(found.face_component, expected.face_component);
    for (std::size_t i = 0; i < found.components.size(); ++i) {
        EXPECT_EQ(found.components[i].euler, expected.components[i].euler);
        EXPECT_EQ(found.components[i].faces, expected.components[i].faces);
        EXPECT_EQ(found.components[i].area, expected.components[i].area);
        EXPECT_EQ(found.components[i].boundary_loops, expected.components[i].boundary_loops);
    }
}
