#include "remesh/tiles/cut_by_planes.h"

#include <gtest/gtest.h>

#include "agvd/mesh/topology.h"
#include "support/random_meshes.h"
#include "support/shapes.h"

using agvd::FaceId;
using agvd::Index;
using agvd::Surface;
using agvd::Ticker;
using agvd::TriangleMesh;
using agvd::Vec3;
using remesh::CutMesh;
using remesh::PlaneTree;

namespace {

PlaneTree tree_of(const TriangleMesh& mesh, Index num_cells) {
    std::vector<Vec3> middles;
    std::vector<double> areas;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
        middles.emplace_back((p + q + r) / 3);
        areas.push_back((q - p).cross(r - p).norm() / 2);
    }
    return remesh::divide_by_planes(middles, areas, num_cells, Ticker());
}

// How far a point lies outside a cell.
double miss_of(const PlaneTree& tree, PlaneTree::Side side, Index cell, const Vec3& point) {
    if (side.is_cell) return side.index == cell ? 0 : 1e300;
    const PlaneTree::Node& node = tree.nodes[side.index];
    const double height = node.normal.dot(point) - node.offset;
    return std::min(std::max(miss_of(tree, node.below, cell, point), height),
                    std::max(miss_of(tree, node.above, cell, point), -height));
}

// Topology, area, cells and origins.
// \return the number of faces that were cut.
int check_cut(const TriangleMesh& mesh, const PlaneTree& tree, double snap) {
    const CutMesh cut = remesh::cut_by_planes(mesh, tree, snap, Ticker());
    const Surface before = agvd::build_surface(mesh.view()),
                  after = agvd::build_surface(cut.mesh.view());
    const agvd::Topology old_one = agvd::analyze_topology(mesh.view()),
                         new_one = agvd::analyze_topology(cut.mesh.view());
    EXPECT_TRUE(new_one.is_manifold && new_one.is_oriented);
    EXPECT_TRUE(agvd::same_topology(new_one, old_one));
    std::vector<double> area(mesh.triangles.size(), 0);
    std::vector<int> count(mesh.triangles.size(), 0);
    const double size = surface_area(before);
    for (Index f = 0; f < after.num_faces(); ++f) {
        area[cut.parts.face(f)] += face_area(after, f);
        ++count[cut.parts.face(f)];
        for (Index k = 0; k < 3; ++k) {
            agvd::SurfacePoint corner{FaceId(f), {0, 0, 0}};
            corner.barycentric[k] = 1;
            const Vec3 here = position(cut.mesh.view(), corner);
            EXPECT_LT((position(mesh.view(), cut.parts.to_whole(corner)) - here).norm(),
                      1e-13 * std::sqrt(size));
            EXPECT_LE(miss_of(tree, tree.root(), cut.cell[f], here), snap * (1 + 1e-9));
            const Index h = 3 * f + k, whole = cut.parts.half_edge_of_whole(h);
            if (whole != agvd::no_index) {
                EXPECT_EQ(after.twin[h] == agvd::no_index, before.twin[whole] == agvd::no_index);
            }
        }
    }
    int num_cut = 0;
    for (Index f = 0; f < area.size(); ++f) {
        EXPECT_NEAR(area[f], face_area(before, f), 1e-12 * size);
        if (count[f] > 1) ++num_cut;
    }
    return num_cut;
}

TEST(CutByPlanes, KeepsTheSurface) {
    const std::vector<TriangleMesh> meshes{
        shapes::cube(),  shapes::sphere(2),     shapes::torus(12, 8),  shapes::tube(9, 4),
        shapes::grid(1), shapes::tetrahedron(), shapes::lips(12, 8, 3)};
    int num_cut = 0;
    for (const TriangleMesh& mesh : meshes) {
        for (const Index num_cells : {2u, 7u, 60u}) {
            for (const double snap : {1e-9, 0.01, 0.1}) {
                SCOPED_TRACE(num_cells);
                num_cut += check_cut(mesh, tree_of(mesh, num_cells), snap);
            }
        }
    }
    EXPECT_GT(num_cut, 800);
}

TEST(CutByPlanes, KeepsRandomSurfaces) {
    int num_cut = 0, num_tried = 0;
    for (const char* family : random_meshes::families()) {
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            SCOPED_TRACE(std::string(family) + ' ' + std::to_string(seed));
            const TriangleMesh mesh = random_meshes::make(family, seed);
            const double size = std::sqrt(surface_area(agvd::build_surface(mesh.view())));
            try {
                num_cut += check_cut(mesh, tree_of(mesh, 9), 0.002 * size);
                ++num_tried;
            } catch (const agvd::InvalidInput&) {
                // A face was too narrow to be cut.
            }
        }
    }
    EXPECT_GT(num_tried, 3 * static_cast<int>(random_meshes::families().size()));
    EXPECT_GT(num_cut, 10 * num_tried);
}

TEST(CutByPlanes, LeavesAMeshInOneCellAsItIs) {
    const TriangleMesh mesh = shapes::sphere(1);
    const CutMesh cut = remesh::cut_by_planes(mesh, PlaneTree{}, 0.01, Ticker());
    EXPECT_EQ(cut.mesh.triangles, mesh.triangles);
    EXPECT_EQ(cut.mesh.positions, mesh.positions);
    EXPECT_EQ(cut.cell, std::vector<Index>(mesh.triangles.size(), 0));
}

}  // namespace
