#include "agvd/update/touched_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.h"

using namespace agvd;

namespace {

// Seen from either face: its labels depend on the relays of both and on the labels of both ends.
TEST(TouchedParts, AnEdgeHoldsIfNoFaceAndNoEndOfItIsTouched) {
    const Surface surface = build_surface(shapes::grid(5).view());
    const std::vector<Index> faces{16, 17, 40};
    TouchedParts touched(surface, faces);
    const Index cleared = surface.mesh.triangles[16][0];
    touched.clear_vertex(cleared);
    std::vector<bool> is_vertex_touched(surface.num_vertices(), false);
    for (const Index face : faces) {
        for (const Index v : surface.mesh.triangles[face]) is_vertex_touched[v] = v != cleared;
    }
    const auto is_face_touched = [&](Index half_edge) {
        return half_edge != no_index &&
               std::find(faces.begin(), faces.end(), Surface::face(half_edge)) != faces.end();
    };
    Index num_held = 0;
    for (Index h = 0; h < surface.twin.size(); ++h) {
        const bool holds = !is_face_touched(h) && !is_face_touched(surface.twin[h]) &&
                           !is_vertex_touched[surface.tail(h)] &&
                           !is_vertex_touched[surface.head(h)];
        EXPECT_EQ(touched.holds_on_edge(h), holds) << h;
        num_held += holds ? 1 : 0;
    }
    EXPECT_GT(num_held, 50u);
    EXPECT_LT(num_held, 120u);
}

}  // namespace
