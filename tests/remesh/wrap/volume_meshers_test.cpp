// Whether other programs fill wrapped meshes with tetrahedra: TetGen and gmsh. They refuse surfaces
// that are open or intersect themselves.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <numbers>

#include "agvd/mesh/topology.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "support/dice.h"
#include "support/dirty_shapes.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace {

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;

struct Input {
    const char* name;
    std::function<TriangleMesh()> make;
    agvd::Index num_samples;
};

std::ostream& operator<<(std::ostream& out, const Input& input) { return out << input.name; }

// A ball one of whose vertices is on the other side of it.
TriangleMesh crossing_itself() {
    TriangleMesh ball = shapes::sphere(2);
    ball.positions[0] *= -2;
    return ball;
}

TriangleMesh crossing_cubes() {
    return shapes::join(shapes::cube(), shapes::moved(shapes::cube(), {0.5, 0.3, 0.4}));
}

// A cylinder of `sides` sides around the z axis, with both ends closed.
TriangleMesh cylinder(double radius, double low, double high, Index sides) {
    TriangleMesh mesh{{{0, 0, low}, {0, 0, high}}, {}};
    for (Index i = 0; i < sides; ++i) {
        const double turn = 2 * std::numbers::pi * i / sides;
        for (const double z : {low, high}) {
            mesh.positions.emplace_back(radius * std::cos(turn), radius * std::sin(turn), z);
        }
        const Index a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % sides);
        mesh.triangles.insert(mesh.triangles.end(),
                              {{0, b, a}, {1, a + 1, b + 1}, {a, b, b + 1}, {a, b + 1, a + 1}});
    }
    return mesh;
}

// With its head on the plate.
TriangleMesh bolt_through_plate() {
    TriangleMesh plate = shapes::cube();
    for (Vec3& p : plate.positions) p = (p - Vec3(0.5, 0.5, 0.5)).cwiseProduct(Vec3(4, 4, 0.5));
    const TriangleMesh bolt = shapes::join(cylinder(0.5, -1, 1, 24), cylinder(0.9, 0.25, 0.8, 6));
    return shapes::join(plate, bolt);
}

TriangleMesh ten_spheres() {
    Dice dice(7);
    TriangleMesh mesh;
    for (int i = 0; i < 10; ++i) {
        TriangleMesh ball = shapes::sphere(3);
        const double radius = dice.number(0.5, 1);
        const Vec3 middle(dice.number(-1, 1), dice.number(-1, 1), dice.number(-1, 1));
        for (Vec3& p : ball.positions) p = radius * p + middle;
        mesh = shapes::join(mesh, ball);
    }
    return mesh;
}

class VolumeMeshers : public Scratch, public testing::WithParamInterface<Input> {
protected:
    // \return whether the program is here.
    static bool has(const std::string& program) {
        return process::run({"/usr/bin/env", "sh", "-c", "command -v " + program}).exit_code == 0;
    }
    // Meshes the insides of all components of a mesh. \return whether it can, within a minute.
    [[nodiscard]] bool fills_by_tetgen(const TriangleMesh& mesh) const {
        const process::Outcome outcome = process::run(
            {"/usr/bin/env", "timeout", "60", "tetgen", "-pqQ", put("solid.off", mesh)});
        return outcome.exit_code == 0 && !bytes("solid.1.ele").empty();
    }
    [[nodiscard]] bool fills_by_gmsh(const TriangleMesh& mesh) const {
        const agvd::Topology topology = agvd::analyze_topology(mesh);
        std::string script;
        const std::size_t count = topology.components.size();
        for (std::size_t i = 0; i < count; ++i) {
            TriangleMesh part{mesh.positions, {}};
            for (Index f = 0; f < mesh.triangles.size(); ++f) {
                if (topology.face_component[f] == i) part.triangles.push_back(mesh.triangles[f]);
            }
            const std::string number = std::to_string(i + 1);
            script += "Merge \"" + put("part" + number + ".stl", part) + "\";\n";
        }
        script += "CreateTopology;\n";
        for (std::size_t i = 1; i <= count; ++i) {
            const std::string number = std::to_string(i);
            script += "Surface Loop(" + number + ") = {" + number + "};\nVolume(" + number +
                      ") = {" + number + "};\n";
        }
        const process::Outcome outcome =
            process::run({"/usr/bin/env", "gmsh", "-3", "-v", "1", "-o", at("solid.mesh"),
                          put("solid.geo", script)});
        return outcome.exit_code == 0 &&
               bytes("solid.mesh").find("Tetrahedra") != std::string::npos;
    }
};

class TetGen : public VolumeMeshers {};

}  // namespace

// AGVD_LONG=1 asks for 1000 soups.
TEST_F(TetGen, FillsTheWrapsOfSoups) {
    if (!has("tetgen")) GTEST_SKIP() << "there is no program tetgen";
    if (!remesh::find_self_intersections(shapes::cube())) GTEST_SKIP() << "needs CGAL";
    const std::uint64_t last = std::getenv("AGVD_LONG") != nullptr ? 1000 : 5;
    for (std::uint64_t seed = 4; seed <= last; ++seed) {
        const TriangleMesh soup = shapes::dirty_solids(seed);
        const TriangleMesh mesh = remesh::remesh(soup, {.num_samples = 400, .wrap = 0}).mesh;
        EXPECT_TRUE(fills_by_tetgen(mesh)) << seed;
        std::filesystem::remove(at("solid.1.ele"));
    }
}

TEST_P(VolumeMeshers, FillWraps) {
    const bool has_tetgen = has("tetgen"), has_gmsh = has("gmsh");
    if (!has_tetgen && !has_gmsh) GTEST_SKIP() << "there are no programs tetgen and gmsh";
    if (!remesh::find_self_intersections(shapes::cube())) GTEST_SKIP() << "needs CGAL";
    const TriangleMesh dirty = GetParam().make();
    const TriangleMesh mesh =
        remesh::remesh(dirty, {.num_samples = GetParam().num_samples, .wrap = 0}).mesh;
    if (has_tetgen) {
        EXPECT_TRUE(fills_by_tetgen(mesh));
        EXPECT_FALSE(fills_by_tetgen(crossing_itself())) << "it takes anything";
    }
    if (has_gmsh) {
        EXPECT_TRUE(fills_by_gmsh(mesh));
        EXPECT_FALSE(fills_by_gmsh(crossing_itself())) << "it takes anything";
    }
    if (!has_tetgen || !has_gmsh) {
        GTEST_SKIP() << "there is no program " << (has_tetgen ? "gmsh" : "tetgen");
    }
}

INSTANTIATE_TEST_SUITE_P(
    Inputs, VolumeMeshers,
    testing::Values(Input{"CrossingCubes", crossing_cubes, 500},
                    Input{"BoltThroughPlate", bolt_through_plate, 800},
                    Input{"TenSpheres", ten_spheres, 800},
                    Input{"LooseTriangles",
                          [] { return shapes::jitter(shapes::unweld(shapes::sphere(3)), 1e-3, 1); },
                          300},
                    Input{"Sheet", [] { return shapes::grid(4); }, 300},
                    Input{"Soup1", [] { return shapes::dirty_solids(1); }, 500},
                    Input{"Soup2", [] { return shapes::dirty_solids(2); }, 500},
                    Input{"Soup3", [] { return shapes::dirty_solids(3); }, 500}),
    [](const testing::TestParamInfo<Input>& test) { return std::string(test.param.name); });
