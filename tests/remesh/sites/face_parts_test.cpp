#include "remesh/sites/face_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.h"

using namespace agvd;
using remesh::detail::FaceParts;

// More faces than a chunk has.
TEST(FaceParts, EachPartHasTheFacesOfItsLabelsInTheirOrder) {
    const Surface surface = build_surface(shapes::torus(120, 120).view());
    ASSERT_GT(surface.num_faces(), Index{1} << 14);
    std::vector<Index> label(surface.num_vertices());
    for (Index v = 0; v < label.size(); ++v) label[v] = v % 7 == 0 ? no_index : v / 11;
    for (const int num_threads : {1, 2, 8}) {
        Poller poller;
        const FaceParts parts(surface, label, num_threads, poller);
        std::vector<Index> owners(surface.num_vertices(), 0);
        for (Index part = 0; part < parts.count(); ++part) {
            for (Index v = 0; v < label.size(); ++v) owners[v] += parts.has(part, label[v]) ? 1 : 0;
            std::vector<Index> expected, found;
            for (Index f = 0; f < surface.num_faces(); ++f) {
                const Triangle& t = surface.mesh.triangles[f];
                const bool is_of_part = std::any_of(
                    t.begin(), t.end(), [&](Index v) { return parts.has(part, label[v]); });
                if (is_of_part || parts.count() == 1) expected.push_back(f);
            }
            parts.for_each_face(part, [&](Index f) { found.push_back(f); });
            EXPECT_EQ(found, expected) << "part " << part << " of " << parts.count();
        }
        for (Index v = 0; v < label.size(); ++v) EXPECT_EQ(owners[v], label[v] == no_index ? 0 : 1);
    }
}
