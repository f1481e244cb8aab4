// Vertices that leave the surface bring the mesh nearer to it and harm nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numbers>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "remesh/dual/build_dual.h"
#include "remesh/placement/placement.h"
#include "remesh/quality/evaluate.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/sites.h"
#include "support/shapes.h"

using namespace agvd;
using remesh::PlacedMesh;

namespace {

// A spacing that asks for no vertices besides the surface's own.
constexpr double unrefined = std::numeric_limits<double>::infinity();

struct Remeshed {
    explicit Remeshed(const TriangleMesh& input)
        : surface(build_surface(input.view())), prepared(surface, unrefined) {}
    Remeshed(const Remeshed&) = delete;

    Surface surface;
    remesh::PreparedSurface prepared;
    PlacedMesh mesh;
    std::vector<Index> nearest_vertex;
};

// The dual of `count` sites, relaxed in some steps, with its vertices at the sites.
std::unique_ptr<Remeshed> remeshed(const TriangleMesh& input, Index count, int steps) {
    auto result = std::make_unique<Remeshed>(input);
    const remesh::PreparedSurface& prepared = result->prepared;
    result->mesh.points =
        relax_sites(prepared, remesh::sample_sites(result->surface, {.num_samples = count}),
                    {.steps = steps})
            .sites;
    const Surface& base = prepared.base.surface();
    const auto sites = prepared.base.to_intrinsic(result->mesh.points);
    const Diagram diagram =
        build_diagram(base, sites, propagate(base, prepared.layout, sites, {.max_error = 1e-3}));
    result->mesh.triangles = remesh::build_dual(diagram);
    result->mesh.offsets.assign(count, Vec3::Zero());
    for (const SiteId site : diagram.nearest_site) result->nearest_vertex.push_back(site.value());
    return result;
}

void fit_vertices(const Remeshed& r, PlacedMesh& mesh, int num_threads = 0) {
    const auto num_vertices = static_cast<Index>(mesh.points.size());
    remesh::fit_vertices(r.prepared.base, r.nearest_vertex,
                         remesh::sample_cells(r.prepared, r.nearest_vertex, num_vertices, {}), mesh,
                         num_threads, {}, 0, {});
}

TriangleMesh shape_of(const Remeshed& r) {
    TriangleMesh mesh{{}, r.mesh.triangles};
    for (Index v = 0; v < r.mesh.points.size(); ++v) {
        mesh.positions.push_back(r.mesh.position(r.surface.mesh.view(), v));
    }
    return mesh;
}

// Of the surface's faces, by their centroids.
double mean_square_distance(const Remeshed& r) {
    const ClosestPointTree tree(shape_of(r).view());
    double sum = 0, area = 0;
    const auto& p = r.surface.mesh.positions;
    for (const auto& [a, b, c] : r.surface.mesh.triangles) {
        const double doubled = (p[b] - p[a]).cross(p[c] - p[a]).norm();
        sum += doubled * tree.query((p[a] + p[b] + p[c]) / 3).distance_sq;
        area += doubled;
    }
    return sum / area;
}

std::vector<TriangleMesh> smooth_shapes() {
    return {shapes::sphere(5), shapes::torus(90, 45), shapes::tube(80, 40)};
}

}  // namespace

TEST(FitVertices, TheMeshComesNearerToTheSurface) {
    for (const TriangleMesh& input : smooth_shapes()) {
        const auto owner = remeshed(input, 300, 20);
        Remeshed& r = *owner;
        const double before = mean_square_distance(r);
        fit_vertices(r, r.mesh);
        // Vertices on the boundary cannot help.
        const double share = boundary_loops(r.surface).empty() ? 0.4 : 0.9;
        EXPECT_LT(mean_square_distance(r), share * before);
    }
}

TEST(FitVertices, OffsetsAreTheSameForAnyNumberOfThreads) {
    const auto owner = remeshed(shapes::sphere(5), 300, 20);
    const Remeshed& r = *owner;
    remesh::PlacedMesh alone = r.mesh;
    fit_vertices(r, alone, 1);
    for (const int threads : {2, 8}) {
        remesh::PlacedMesh shared = r.mesh;
        fit_vertices(r, shared, threads);
        EXPECT_EQ(shared.offsets, alone.offsets);
    }
}

TEST(FitVertices, AFlatMeshStaysFlatAndVerticesOnTheBoundaryStay) {
    const auto owner = remeshed(shapes::grid(40), 200, 20);
    Remeshed& r = *owner;
    fit_vertices(r, r.mesh);
    int num_boundary = 0;
    for (Index v = 0; v < r.mesh.points.size(); ++v) {
        EXPECT_NEAR(r.mesh.offsets[v].z(), 0, 1e-9);
        if (!is_on_boundary(r.surface, r.mesh.points[v])) continue;
        ++num_boundary;
        EXPECT_EQ(r.mesh.offsets[v], Vec3(Vec3::Zero()));
    }
    EXPECT_GT(num_boundary, 20);
}

TEST(FitVertices, ItFindsTheEdgesOfACube) {
    TriangleMesh cube = shapes::cube();
    for (int i = 0; i < 5; ++i) cube = shapes::subdivide(cube);
    const auto owner = remeshed(cube, 500, 20);
    Remeshed& r = *owner;
    const double before = mean_square_distance(r);
    fit_vertices(r, r.mesh);
    EXPECT_LT(mean_square_distance(r), 0.4 * before);
}

TEST(FitVertices, ShapesGetBetter) {
    for (const TriangleMesh& input : smooth_shapes()) {
        const auto owner = remeshed(input, 300, 20);
        Remeshed& r = *owner;
        const double before = remesh::measure_triangles(shape_of(r).view()).mean_quality;
        fit_vertices(r, r.mesh);
        EXPECT_GT(remesh::measure_triangles(shape_of(r).view()).mean_quality, before + 0.005);
    }
}

TEST(FitVertices, NoVertexGoesFarOffTheSurface) {
    // Around the rim of a flat lens the planes of the two sides meet far outside.
    TriangleMesh lens = shapes::sphere(5);
    for (Vec3& p : lens.positions) p.z() *= 0.1;
    const auto owner = remeshed(lens, 300, 20);
    Remeshed& r = *owner;
    fit_vertices(r, r.mesh);
    const ClosestPointTree tree(lens.view());
    const double spacing = std::sqrt(2 * std::numbers::pi / 300);
    for (const Vec3& p : shape_of(r).positions) {
        EXPECT_LT(std::sqrt(tree.query(p).distance_sq), 0.15 * spacing);
    }
}

TEST(FitVertices, NoTriangleTurnsOver) {
    for (const TriangleMesh& input :
         {shapes::jitter(shapes::sphere(5), 0.02, 3), shapes::torus(90, 45, 0.1)}) {
        const auto owner = remeshed(input, 400, 5);
        Remeshed& r = *owner;
        const TriangleMesh before = shape_of(r);
        fit_vertices(r, r.mesh);
        const TriangleMesh after = shape_of(r);
        for (const auto& [a, b, c] : r.mesh.triangles) {
            const auto normal = [&](const std::vector<Vec3>& p) {
                return Vec3((p[b] - p[a]).cross(p[c] - p[a]));
            };
            EXPECT_GT(normal(before.positions).dot(normal(after.positions)), 0);
        }
    }
}
