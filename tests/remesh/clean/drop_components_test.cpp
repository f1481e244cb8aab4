#include "remesh/clean/soup.h"

#include <gtest/gtest.h>

#include <cmath>

#include "agvd/core/error.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Triangle;

namespace {

// Rectangles of areas 1, 2 and 1, each of two faces.
remesh::CleanResult three_rectangles() {
    agvd::TriangleMesh large = shapes::moved(shapes::grid(1), {0, 2, 0});
    for (agvd::Vec3& p : large.positions) p.x() *= 2;
    return remesh::clean_input(shapes::join(shapes::join(shapes::grid(1), large),
                                            shapes::moved(shapes::grid(1), {0, 4, 0}))
                                   .view());
}

Index drop(remesh::CleanResult& clean, double least_share) {
    return remesh::detail::drop_components(clean, remesh::analyze_topology(clean.mesh.view()),
                                           least_share);
}

TEST(DropComponents, AComponentWithTheLeastShareStays) {
    remesh::CleanResult clean = three_rectangles();
    EXPECT_EQ(drop(clean, 0.25), 0u);
    EXPECT_EQ(clean.mesh.triangles.size(), 6u);
    EXPECT_EQ(drop(clean, std::nextafter(0.25, 1)), 2u);
}

TEST(DropComponents, WhatStaysKeepsItsOrigins) {
    remesh::CleanResult clean = three_rectangles();
    const std::vector<agvd::Vec3> before = clean.mesh.positions;
    EXPECT_EQ(drop(clean, 0.5), 2u);
    EXPECT_EQ(clean.face_origin, (std::vector<Index>{2, 3}));
    EXPECT_EQ(clean.vertex_origin, (std::vector<Index>{4, 5, 6, 7}));
    EXPECT_EQ(clean.mesh.positions, std::vector(before.begin() + 4, before.begin() + 8));
    EXPECT_EQ(clean.mesh.triangles, (std::vector<Triangle>{{0, 2, 3}, {0, 3, 1}}));
    EXPECT_TRUE(clean.connectivity.twin.empty());
}

TEST(DropComponents, ThatNoneIsLeftIsRefusedAndNothingChanges) {
    remesh::CleanResult clean = three_rectangles();
    EXPECT_THROW((void)drop(clean, 0.51), agvd::InvalidOption);
    EXPECT_EQ(clean.mesh.triangles.size(), 6u);
    EXPECT_FALSE(clean.connectivity.twin.empty());
}

}  // namespace
