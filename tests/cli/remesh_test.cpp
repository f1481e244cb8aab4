// The program `remesh`: what it writes.
#include <nlohmann/json.hpp>

#include "agvd/mesh/topology.h"
#include "cli/remesh_program.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/xml_reader.h"
#include "support/dirty_shapes.h"
#include "support/shapes.h"

namespace {

TEST_F(Remesh, WritesAMeshOfTheSameTopologyAndNothingOnStdout) {
    const std::string in = put("in.ply", shapes::torus(40, 20));
    for (const char* name : {"out.ply", "out.obj", "out.off", "out.stl", "out.vtk", "out.vtp",
                             "out.mesh", "out.3mf", "out.glb"}) {
        const auto outcome = remesh({in, "-n", "150", at(name)});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err, "");
        if (!remesh::knows_xml() &&
            (name == std::string("out.vtp") || name == std::string("out.3mf"))) {
            continue;  // Written, but not read.
        }
        const auto topology = remesh::analyze_topology(remesh::read_mesh(at(name)).mesh.view());
        EXPECT_TRUE(topology.is_manifold && topology.is_oriented);
        EXPECT_EQ(topology.genus(), 1);
    }
}

TEST_F(Remesh, WritesPlyAsTextIfAsked) {
    const std::string in = put("in.ply", shapes::sphere(3));
    EXPECT_EQ(remesh({in, "-n", "60", "-q", at("a.ply")}).exit_code, 0);
    EXPECT_EQ(remesh({in, "-n", "60", "-q", "--ascii", at("b.ply")}).exit_code, 0);
    EXPECT_EQ(bytes("b.ply").rfind("ply\nformat ascii 1.0\n", 0), 0U);
    EXPECT_EQ(remesh::read_mesh(at("a.ply")).mesh.positions,
              remesh::read_mesh(at("b.ply")).mesh.positions);
    EXPECT_EQ(remesh({in, "-n", "60", "-q", "--ascii", at("c.off")}).exit_code, 0);
    EXPECT_EQ(bytes("c.off").rfind("OFF\n", 0), 0U);
}

TEST_F(Remesh, TakesTheOutputAsOptionAndSamplesByEitherName) {
    const std::string in = put("in.off", shapes::sphere(3));
    EXPECT_EQ(remesh({in, "--samples", "80", at("a.off")}).exit_code, 0);
    EXPECT_EQ(remesh({"-o", at("b.off"), "--vertices", "80", in}).exit_code, 0);
    EXPECT_EQ(remesh({in, "-n80", "--output", at("c.off")}).exit_code, 0);
    EXPECT_EQ(bytes("a.off"), bytes("b.off"));
    EXPECT_EQ(bytes("a.off"), bytes("c.off"));
}

TEST_F(Remesh, SameBytesForAnyThreadsAndLambdaButNotForAnySeed) {
    const std::string in = put("in.ply", shapes::torus(60, 30));
    const auto with = [&](std::vector<std::string> extra) {
        extra.insert(extra.begin(), {in, at("out.ply"), "-n", "200", "-q"});
        EXPECT_EQ(remesh(extra).exit_code, 0);
        return bytes("out.ply");
    };
    const std::string reference = with({"-t", "1"});
    EXPECT_EQ(with({"-t", "2"}), reference);
    EXPECT_EQ(with({"-t", "8"}), reference);
    EXPECT_EQ(with({"--engine", "steiner", "--lambda", "0.1"}), with({"--engine", "steiner"}));
    EXPECT_NE(with({"--seed", "7"}), reference);
    EXPECT_NE(with({"--init", "random"}), reference);
    EXPECT_NE(with({"--init", "farthest"}), reference);
    EXPECT_NE(with({"--init", "farthest"}), with({"--init", "random"}));
}

TEST_F(Remesh, ASlitIsWeldedWithAWarningOrLeftOpen) {
    const std::string in = put("in.off", shapes::slit_grid(8, 2, 6));
    const auto loops = [&](std::vector<std::string> options, std::string& err) {
        options.insert(options.begin(), {in, at("out.off"), "-q", "-n", "60"});
        err = remesh(options).err;
        const auto mesh = remesh::read_mesh(at("out.off")).mesh;
        return remesh::analyze_topology(mesh.view()).components.at(0).boundary_loops;
    };
    std::string err;
    EXPECT_EQ(loops({}, err), 1);
    EXPECT_NE(err.find("a slit of length 0.5 "), std::string::npos) << err;
    EXPECT_EQ(loops({"--keep-slits"}, err), 2);
    EXPECT_EQ(err, "");
}

TEST_F(Remesh, GapsAreWeldedAndHolesFilledIfAskedFor) {
    const auto loops = [&] {
        return remesh::analyze_topology(remesh::read_mesh(at("out.off")).mesh.view())
            .boundary_loops();
    };
    const agvd::TriangleMesh gaps = shapes::jitter(shapes::unweld(shapes::torus(20, 10)), 1e-3, 1);
    const std::string soup = put("soup.off", gaps);
    EXPECT_EQ(remesh({soup, at("out.off"), "-q", "-n", "90", "--weld", "1%"}).exit_code, 0);
    EXPECT_EQ(loops(), 0);
    EXPECT_EQ(remesh({soup, at("none.off"), "--weld", "1%", "--keep-slits"}).exit_code, 2);

    agvd::TriangleMesh open = shapes::sphere(2);
    open.triangles.pop_back();
    const auto filled =
        remesh({put("open.off", open), at("out.off"), "-n", "60", "--fill-holes", "3"});
    if (filled.err.find("CGAL") != std::string::npos) {
        EXPECT_EQ(filled.exit_code, 2);
        GTEST_SKIP() << "without CGAL";
    }
    EXPECT_NE(filled.err.find("1 filled hole"), std::string::npos) << filled.err;
    EXPECT_EQ(loops(), 0);
}

TEST_F(Remesh, AWrapHasAValueOnlyIfALengthFollows) {
    const agvd::TriangleMesh cubes =
        shapes::join(shapes::cube(), shapes::moved(shapes::cube(), {0.3, 0.35, 0.4}));
    const std::string in = put("in.off", cubes);
    const auto wrapped = remesh({"--wrap", in, at("out.off"), "-n", "60", "-q"});
    if (wrapped.err.find("CGAL") != std::string::npos) {
        EXPECT_EQ(wrapped.exit_code, 2);
        GTEST_SKIP() << "without CGAL";
    }
    EXPECT_EQ(wrapped.exit_code, 0) << wrapped.err;
    const agvd::TriangleMesh result = remesh::read_mesh(at("out.off")).mesh;
    EXPECT_EQ(remesh::analyze_topology(result.view()).components.size(), 1u);
    EXPECT_EQ(remesh({in, at("out.off"), "-n", "60", "--wrap", "9%"}).exit_code, 0);
    EXPECT_NE(remesh::read_mesh(at("out.off")).mesh.positions, result.positions);
    EXPECT_EQ(remesh({in, at("out.off"), "--wrap", "--max-distance", "1%"}).exit_code, 2);
}

TEST_F(Remesh, MoreSamplesThanVerticesWork) {
    const std::string in = put("in.off", shapes::icosahedron());
    EXPECT_EQ(remesh({in, at("out.off"), "-n", "300"}).exit_code, 0);
    EXPECT_GE(remesh::read_mesh(at("out.off")).mesh.positions.size(), 300u);
}

TEST_F(Remesh, GivenSitesBecomeTheVertices) {
    const std::string in = put("in.off", shapes::icosahedron());
    std::string sites = "p 0 0 1\n";
    for (int v = 0; v < 12; ++v) sites += "v " + std::to_string(v) + "\n";
    for (int f = 0; f < 20; ++f) sites += "f " + std::to_string(f) + " 0.25 0.25 0.5\n";
    const auto outcome =
        remesh({in, at("out.off"), "--sites", put("sites.txt", sites), "--keep-sites"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto mesh = remesh::read_mesh(at("out.off")).mesh;
    ASSERT_GE(mesh.positions.size(), 33u);
    EXPECT_NEAR((mesh.positions[1] - shapes::icosahedron().positions[0]).norm(), 0, 1e-12);
}

TEST_F(Remesh, SitesOnOneSpotAreOneVertexOrAreParted) {
    const std::string in = put("in.off", shapes::sphere(3));
    std::string sites;
    for (int v = 0; v < 60; ++v) {
        for (int copy = 0; copy < 5; ++copy) sites += "v " + std::to_string(v) + "\n";
    }
    const std::string file = put("sites.txt", sites);
    const auto num_vertices = [&](const std::string& option, const std::string& value) {
        std::vector<std::string> arguments{in, at("out.off"), "--sites", file, option};
        if (!value.empty()) arguments.push_back(value);
        const auto outcome = remesh(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const bool tells = outcome.err.find("240 sites dropped") != std::string::npos;
        const auto count = remesh::read_mesh(at("out.off")).mesh.positions.size();
        EXPECT_EQ(tells, count == 60) << outcome.err;
        return count;
    };
    EXPECT_EQ(num_vertices("--keep-sites", ""), 60u);
    EXPECT_EQ(num_vertices("--relax", "0"), 60u);
    EXPECT_EQ(num_vertices("--relax", "10"), 300u);
}

TEST_F(Remesh, ManySitesOnFewSpotsAreAMistake) {
    const auto run = [&](const agvd::TriangleMesh& mesh, int num_copies) {
        std::string sites;
        for (int v = 0; v < 8; ++v) {
            for (int copy = 0; copy < num_copies; ++copy) sites += "v " + std::to_string(v) + "\n";
        }
        return remesh({put("in.off", mesh), at("out.off"), "--sites", put("sites.txt", sites),
                       "--relax", "2"});
    };
    // Creases carry the sites of a cube, and none is found on the sphere.
    for (const agvd::TriangleMesh& mesh : {shapes::sphere(2), shapes::cube()}) {
        const auto refused = run(mesh, 200);
        EXPECT_EQ(refused.exit_code, 4) << refused.err;
        EXPECT_NE(
            refused.err.find("sites.txt: 1600 sites were given, but only at 8 different points"),
            std::string::npos)
            << refused.err;
        EXPECT_EQ(run(mesh, 100).exit_code, 0);
    }
}

TEST_F(Remesh, ReportsAsJsonToAFileOrStdout) {
    const std::string in = put("in.off", shapes::sphere(3));
    const auto outcome = remesh({in, at("out.off"), "-n", "50", "--report", "-"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(nlohmann::json::parse(outcome.out).is_object());
    EXPECT_EQ(remesh({in, at("out.off"), "-n", "50", "--report", at("r.json")}).out, "");
    EXPECT_TRUE(nlohmann::json::parse(bytes("r.json")).is_object());
}

TEST_F(Remesh, TellsTheEngineAndWhatItCertifies) {
    const std::string in = put("in.off", shapes::sphere(3));
    const auto outcome = remesh(
        {in, at("out.off"), "-n", "50", "--engine", "steiner", "--report", "-", "--verbose"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["options"]["engine"], "steiner");
    EXPECT_EQ(report["options"]["max_error"], nullptr);
    EXPECT_EQ(report["certified_error"], nullptr);
    EXPECT_NE(outcome.err.find("steiner engine, error unknown"), std::string::npos) << outcome.err;
}

TEST_F(Remesh, FlipsByTheLengthsAskedFor) {
    const std::string in = put("in.off", shapes::jitter(shapes::torus(60, 30), 0.02, 1));
    std::vector<std::string> outputs;
    for (const char* name : {"intrinsic", "extrinsic", "off"}) {
        const auto outcome = remesh({in, at("out.off"), "-n", "400", "--init", "random", "--relax",
                                     "0", "--delaunay", name, "--report", "-"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const auto report = nlohmann::json::parse(outcome.out);
        EXPECT_EQ(report["options"]["delaunay"], name);
        EXPECT_EQ(report["delaunay"].is_null(), std::string(name) == "off");
        outputs.push_back(bytes("out.off"));
    }
    EXPECT_FALSE(outputs[0] == outputs[1]);  // Not EXPECT_NE: it would print the files.
    EXPECT_FALSE(outputs[1] == outputs[2]);
}

TEST_F(Remesh, KeepsBelowTheErrorAskedFor) {
    const std::string in = put("in.off", shapes::jitter(shapes::sphere(3), 0.01, 1));
    for (const char* error : {"0", "0.001", "0.2"}) {
        const auto outcome = remesh({in, at("out.off"), "-n", "50", "--engine", "window",
                                     "--max-error", error, "--report", "-"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const auto report = nlohmann::json::parse(outcome.out);
        EXPECT_EQ(report["options"]["engine"], "window");
        EXPECT_EQ(report["options"]["max_error"], std::stod(error));
        ASSERT_TRUE(report["certified_error"].is_number());
        EXPECT_LE(report["certified_error"], std::stod(error));
    }
}

}  // namespace
