#include <gtest/gtest.h>

#include "remesh/quality/evaluate.h"
#include "support/shapes.h"

TEST(WithoutCgal, WhatItMeasuresIsAbsent) {
    const agvd::TriangleMesh mesh = shapes::tetrahedron();
    EXPECT_EQ(remesh::find_self_intersections(mesh.view()), std::nullopt);
    EXPECT_FALSE(remesh::surface_distance(mesh.view(), mesh.view()).has_value());
}
