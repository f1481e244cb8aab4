// The program `remesh` as a process: exit codes, what it leaves on disk, what it says where.
#include <signal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "remesh/io/read_mesh.h"
#include "remesh/io/xml_reader.h"
#include "remesh/quality/self_intersections.h"
#include "remesh/topology/topology.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace fs = std::filesystem;

namespace {

class Remesh : public Scratch {
protected:
    [[nodiscard]] static process::Outcome remesh(std::vector<std::string> arguments,
                                                 const process::Options& options = {}) {
        return run(REMESH_PROGRAM, std::move(arguments), options);
    }
};

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
    EXPECT_EQ(with({"--lambda", "0.1"}), reference);
    EXPECT_NE(with({"--seed", "7"}), reference);
    EXPECT_NE(with({"--init", "random"}), reference);
    EXPECT_NE(with({"--init", "farthest"}), reference);
    EXPECT_NE(with({"--init", "farthest"}), with({"--init", "random"}));
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

TEST_F(Remesh, WrongUsageIsTwo) {
    const std::string in = put("in.off", shapes::sphere(1));
    const std::string out = at("out.off");
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {},
             {in},
             {in, out, "-n", "0"},
             {in, out, "-n", "-5"},
             {in, out, "-n", "many"},
             {in, out, "--no-such-option"},
             {in, out, "third"},
             {in, out, "--init", "magic"},
             {in, out, "--steiner-points", "-1"},
             {in, out, "--lambda", "0"},
             {in, out, "--lambda", "nan"},
             {in, out, "--lambda", "inf"},
             {in, out, "--engine", "magic"},
             {in, out, "--engine", "1"},
             {in, out, "--delaunay", "magic"},
             {in, out, "--max-error", "1"},
             {in, out, "--max-error", "-0.001"},
             {in, out, "--max-error", "nan"},
             {in, out, "--max-error", "small"},
             {in, out, "--engine", "vertex", "--max-error", "0.01"},
             {in, out, "-q", "--verbose"},
             {in, out, "--sites", at("sites"), "-n", "20"},
             {in, out, "--sites", at("sites"), "--init", "farthest"},
             {in, out, "--keep-sites"},
             {in, out, "--relax", "-1"},
             {in, out, "--report", out},
         }) {
        const auto outcome = remesh(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(arguments) << outcome.err;
        EXPECT_NE(outcome.err, "");
        EXPECT_EQ(outcome.out, "");
    }
    EXPECT_FALSE(fs::exists(out));
}

struct BadInput {
    const char* file;
    const char* bytes;  // Null: there is no such file.
    int exit_code;
    const char* told;  // In the text on stderr, besides the file's name.
};

void PrintTo(const BadInput& input, std::ostream* out) { *out << input.file; }

class RemeshBadInput : public Remesh, public testing::WithParamInterface<BadInput> {};

TEST_P(RemeshBadInput, EndsWithItsCodeAndNamesFileAndDefect) {
    const BadInput& input = GetParam();
    if (input.bytes != nullptr) put(input.file, input.bytes);
    put("out.obj", "old");
    const std::size_t files = num_files();
    const auto outcome = remesh({at(input.file), at("out.obj"), "-n", "20"});
    EXPECT_EQ(outcome.exit_code, input.exit_code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(input.file), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(input.told), std::string::npos) << outcome.err;
    EXPECT_EQ(bytes("out.obj"), "old");
    EXPECT_EQ(num_files(), files) << "a temporary file was left";
}

constexpr const char* truncated_ply =
    "ply\nformat binary_little_endian 1.0\nelement vertex 100\nproperty float x\n"
    "property float y\nproperty float z\nelement face 9\n"
    "property list uchar int vertex_indices\nend_header\nabcdefgh";
constexpr const char* point_cloud_ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
// A band of five triangles closed with a twist, which is what five vertices on a Moebius band need.
constexpr const char* moebius_off =
    "OFF\n5 5 0\n1 0 0\n0.3 0.95 0.4\n-0.8 0.6 0\n-0.8 -0.6 -0.4\n0.3 -0.95 0.2\n"
    "3 0 1 2\n3 1 2 3\n3 2 3 4\n3 3 4 0\n3 4 0 1\n";

INSTANTIATE_TEST_SUITE_P(
    Kinds, RemeshBadInput,
    testing::Values(
        BadInput{"missing.off", nullptr, 3, ""}, BadInput{"empty.off", "", 3, "empty"},
        BadInput{"mesh.xyz", "OFF\n", 3, "unknown"}, BadInput{"mesh", "OFF\n", 3, "unknown"},
        BadInput{"truncated.ply", truncated_ply, 3, ""},
        BadInput{"truncated.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n", 3, ""},
        BadInput{"nan.off", "OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n", 4, "finite"},
        BadInput{"inf.off", "OFF\n3 1 0\n0 0 0\ninf 0 0\n0 1 0\n3 0 1 2\n", 4, "finite"},
        BadInput{"huge.off", "OFF\n3 1 0\n0 0 0\n1e999 0 0\n0 1 0\n3 0 1 2\n", 4, ""},
        BadInput{"range.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", 4, "7"},
        BadInput{"range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", 4, ""},
        BadInput{"faceless.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", 4, "face"},
        BadInput{"cloud.ply", point_cloud_ply, 4, "face"},
        BadInput{"flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n", 4, "face"},
        BadInput{"moebius.off", moebius_off, 4, "orient"}),
    [](const auto& test) {
        std::string name = test.param.file;
        for (char& c : name) c = c == '.' ? '_' : c;
        return name;
    });

TEST_F(Remesh, TooFewSamplesForTheTopologyAreFiveAndTheOldFileStays) {
    const std::string in = put("in.off", shapes::torus(20, 10));
    put("out.off", "old");
    const auto outcome = remesh({in, at("out.off"), "-n", "3"});
    EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
    EXPECT_NE(outcome.err.find("in.off: 3 samples are too few"), std::string::npos) << outcome.err;
    EXPECT_EQ(bytes("out.off"), "old");
    EXPECT_EQ(num_files(), 2u);
}

// Two spheres, one just inside the other: their coarse meshes run through each other.
TEST_F(Remesh, IntersectionsAreToldAndWithStrictNothingIsWritten) {
    if (!remesh::find_self_intersections(shapes::cube().view())) GTEST_SKIP() << "without CGAL";
    agvd::TriangleMesh inner = shapes::sphere(2);
    for (agvd::Vec3& p : inner.positions) p *= 0.98;
    for (agvd::Triangle& t : inner.triangles) std::swap(t[1], t[2]);
    const std::string in = put("in.off", shapes::join(shapes::sphere(2), inner));
    const auto told = remesh({in, at("out.off"), "-n", "20", "-q"});
    EXPECT_EQ(told.exit_code, 0) << told.err;
    EXPECT_NE(told.err.find("warning: the result has "), std::string::npos) << told.err;
    EXPECT_NE(told.err.find("the input has 0; use more --samples\n"), std::string::npos)
        << told.err;
    put("out.off", "old");
    const auto refused = remesh({in, at("out.off"), "-n", "20", "--strict"});
    EXPECT_EQ(refused.exit_code, 5) << refused.err;
    EXPECT_NE(refused.err.find("or leave out --strict"), std::string::npos) << refused.err;
    EXPECT_EQ(bytes("out.off"), "old");
    EXPECT_EQ(num_files(), 2u);
    const std::string sphere = put("sphere.off", shapes::sphere(2));
    EXPECT_EQ(remesh({sphere, at("out.off"), "-n", "50", "--strict"}).exit_code, 0);
}

TEST_F(Remesh, WhereTheInputIntersectsItselfMoreSamplesAreNoAdvice) {
    if (!remesh::find_self_intersections(shapes::cube().view())) GTEST_SKIP() << "without CGAL";
    const agvd::TriangleMesh cubes =
        shapes::join(shapes::cube(), shapes::moved(shapes::cube(), {0.3, 0.35, 0.4}));
    const std::string in = put("in.off", cubes);
    const auto told = remesh({in, at("out.off"), "-n", "400", "-q"});
    EXPECT_EQ(told.exit_code, 0) << told.err;
    EXPECT_NE(told.err.find("where the input intersects itself, and more --samples give more, so "
                            "that no sites were added there; mend the input\n"),
              std::string::npos)
        << told.err;
    EXPECT_EQ(told.err.find("use more"), std::string::npos) << told.err;
    EXPECT_EQ(remesh({in, at("out.off"), "-n", "400", "--strict"}).exit_code, 5);
    // Less than twice the pairs of the input: sites are tried.
    const agvd::TriangleMesh spheres =
        shapes::join(shapes::sphere(2), shapes::moved(shapes::sphere(2), {1.2, 0.1, 0}));
    const auto tried = remesh({put("few.off", spheres), at("out.off"), "-n", "400", "-q"});
    EXPECT_NE(tried.err.find("more --samples give more; mend the input\n"), std::string::npos)
        << tried.err;
    // Two shells run through each other besides.
    agvd::TriangleMesh inner = shapes::sphere(2);
    for (agvd::Vec3& p : inner.positions) p *= 0.98;
    for (agvd::Triangle& t : inner.triangles) std::swap(t[1], t[2]);
    const agvd::TriangleMesh shells = shapes::join(shapes::sphere(2), inner);
    const auto both =
        remesh({put("both.off", shapes::join(shapes::moved(shells, {9, 0, 0}), cubes)),
                at("out.off"), "-n", "60", "-q"});
    EXPECT_EQ(both.exit_code, 0) << both.err;
    EXPECT_NE(both.err.find(" are not where the input intersects itself: for these use more "
                            "--samples, for the others mend the input\n"),
              std::string::npos)
        << both.err;
}

TEST_F(Remesh, AnOutputThatCannotBeWrittenIsThreeAndSaidBeforeTheWork) {
    // The input is missing too: the output is looked at first.
    const std::string in = at("missing.off");
    put("file", "");
    for (const std::string& out :
         {at("file") + "/out.off", at("no/folder/out.off"), at("out.xyz"), at("out")}) {
        const auto outcome = remesh({in, out});
        EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
        EXPECT_NE(outcome.err.find(out), std::string::npos) << outcome.err;
    }
    fs::create_directory(at("folder.off"));
    EXPECT_EQ(remesh({in, at("folder.off")}).exit_code, 3);
    EXPECT_EQ(remesh({in, at("out.off"), "--report", at("file") + "/r.json"}).exit_code, 3);
    EXPECT_EQ(remesh({in, at("out.off"), "--report", "/dev/full"}).exit_code, 3);
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(Remesh, AFullStandardOutputIsThree) {
    const std::string in = put("in.off", shapes::sphere(2));
    EXPECT_EQ(remesh({in, at("o.off"), "-n20", "--report", "-"}, {.out = "/dev/full"}).exit_code,
              3);
    EXPECT_EQ(remesh({"--help"}, {.out = "/dev/full"}).exit_code, 3);
}

TEST_F(Remesh, TwoNamesOfOneFileThatIsNotThereYetAreRefused) {
    put("in.off", shapes::sphere(2));
    const auto outcome =
        process::run({"/bin/sh", "-c",
                      "cd '" + at("") + "' && '" REMESH_PROGRAM "' in.off q.obj --report ./q.obj"});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("same file"), std::string::npos) << outcome.err;
    EXPECT_EQ(num_files(), 1u);
}

TEST_F(Remesh, AReportThatCannotBeWrittenLeavesTheOldMesh) {
    const std::string in = put("in.off", shapes::sphere(2));
    put("out.off", "old");
    for (const std::string report : {"/dev/full", "-"}) {
        const auto outcome =
            remesh({in, at("out.off"), "-n", "50", "--report", report}, {.out = "/dev/full"});
        EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
        EXPECT_EQ(bytes("out.off"), "old") << report;
    }
    EXPECT_EQ(num_files(), 2u);
}

TEST_F(Remesh, AFileThatMayGrowNoMoreIsThreeAndLeavesNothing) {
    put("in.off", shapes::sphere(2));
    const auto outcome = process::run(
        {"/bin/sh", "-c",
         "ulimit -f 1; cd '" + at("") + "' && exec '" REMESH_PROGRAM "' in.off o.off -n 2000"});
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("o.off"), std::string::npos) << outcome.err;
    EXPECT_EQ(num_files(), 1u);
}

TEST_F(Remesh, OverwritesAnInputOnlyWithForce) {
    const std::string in = put("in.off", shapes::sphere(3));
    const std::string sites = put("sites.off", "v 0\n");
    const std::string old = bytes("in.off");
    fs::create_symlink(in, at("link.off"));
    fs::create_hard_link(in, at("hard.off"));
    for (const std::string& out : {in, at("link.off"), at("hard.off"), at("./in.off")}) {
        EXPECT_EQ(remesh({in, out, "-n", "30"}).exit_code, 2) << out;
    }
    const auto refused = remesh({in, at("o.off"), "--report", in});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("--force"), std::string::npos) << refused.err;
    EXPECT_EQ(remesh({in, sites, "--sites", sites}).exit_code, 2);
    const std::string edges = put("edges.off", "0 1\n");
    EXPECT_EQ(remesh({in, edges, "--feature-edges", edges}).exit_code, 2);
    for (const auto& [option, file] : {std::pair("--sites", sites), {"--feature-edges", edges}}) {
        EXPECT_EQ(remesh({in, at("o.off"), option, file, "--report", file}).exit_code, 2) << file;
    }
    EXPECT_EQ(bytes("sites.off") + bytes("edges.off"), "v 0\n0 1\n");
    EXPECT_EQ(bytes("in.off"), old);
    EXPECT_EQ(remesh({in, in, "-n", "30", "--force"}).exit_code, 0);
    EXPECT_NE(bytes("in.off"), old);
}

TEST_F(Remesh, StopsAboveTheMemoryLimitAndNamesTheStage) {
    const std::string in = put("in.ply", shapes::sphere(3));
    put("out.ply", "old");
    auto outcome = remesh({in, at("out.ply"), "-n", "50", "--memory-limit", "1M"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("1M of --memory-limit"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("stage: read"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("use a smaller mesh"), std::string::npos) << outcome.err;
    EXPECT_EQ(bytes("out.ply"), "old");
    EXPECT_EQ(num_files(), 2u);

    // More Steiner points than that; the limit leaves room for the memory of sanitizers.
    const std::string larger = put("larger.ply", shapes::sphere(5));
    outcome = remesh({larger, at("out.ply"), "-n", "50", "--relax", "0", "--engine", "steiner",
                      "--steiner-points", "1000", "--lambda", "1e9", "--memory-limit", "150M"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("stage: propagate"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("--steiner-points"), std::string::npos) << outcome.err;
    EXPECT_EQ(bytes("out.ply"), "old");
    EXPECT_EQ(num_files(), 3u);
}

// More than the machine could read: told before anything is.
TEST_F(Remesh, RefusesAFileThatCannotFit) {
    const std::string in = put("in.off", "OFF\n");
    fs::resize_file(in, std::uintmax_t{1} << 38);
    const auto outcome = remesh({in, at("out.ply"), "--memory-limit", "4G"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("stage: read"), std::string::npos) << outcome.err;
}

TEST_F(Remesh, RefusesMoreSamplesThanFitAndTellsWhatTheyNeed) {
    const std::string in = put("in.off", shapes::sphere(2));
    // All three are about a million vertices.
    for (const auto& [option, value] :
         {std::pair("-n", "1000000"), {"--faces", "2e6"}, {"--edge-length", ".00376"}}) {
        SCOPED_TRACE(option);
        const auto outcome = remesh({in, at("out.ply"), option, value, "--memory-limit", "2G"});
        EXPECT_EQ(outcome.exit_code, 1);
        const std::string needs = "the program needs some ";
        const std::size_t begin = outcome.err.find(needs);
        ASSERT_NE(begin, std::string::npos) << outcome.err;
        // 2.7 for a million vertices, and what the program already uses: more with sanitizers.
        EXPECT_NEAR(std::stod(outcome.err.substr(begin + needs.size())), 2.85, .25);
        EXPECT_NE(outcome.err.find("more than the 2G of --memory-limit"), std::string::npos)
            << outcome.err;
        EXPECT_NE(outcome.err.find("use fewer --samples"), std::string::npos) << outcome.err;
    }
    EXPECT_FALSE(fs::exists(at("out.ply")));
}

// A bound for larger counts as well. The difference between two counts is free of what every run
// needs. Sanitizers need more.
TEST_F(Remesh, TakesABoundedAmountOfMemoryForASample) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "not with sanitizers";
#endif
    const std::string in = put("in.off", shapes::sphere(3));
    const auto peak = [&](int num_samples) {
        const auto outcome =
            remesh({in, at("out.ply"), "-q", "-t", "1", "-n", std::to_string(num_samples)});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return static_cast<double>(outcome.peak_bytes);
    };
    const double bytes_per_sample = (peak(9000) - peak(1000)) / 8000;
    EXPECT_LT(bytes_per_sample, 7500);
    EXPECT_GT(bytes_per_sample, 1000);  // It is measured.
}

TEST_F(Remesh, TakesMemoryLimitsWithSuffixesAndRefusesGarbage) {
    const std::string in = put("in.ply", shapes::sphere(2));
    for (const char* limit :
         {"500M", "2G", "1.5g", "1t", "4000000000", "90%", "100%", "3000000K"}) {
        const auto outcome = remesh({in, at("out.ply"), "-n", "30", "--memory-limit", limit});
        EXPECT_EQ(outcome.exit_code, 0) << limit << outcome.err;
    }
    for (const char* limit : {"", "0", "0%", "-1G", "101%", "G", "2X", "2GB", "nan", "inf", "1e400",
                              "2 G", "99999999999T"}) {
        const auto outcome = remesh({in, at("out.ply"), "-n", "30", "--memory-limit", limit});
        EXPECT_EQ(outcome.exit_code, 2) << limit << outcome.err;
    }
}

TEST_F(Remesh, ASignalEndsItWithTheOldFileUntouched) {
    // Work for minutes, so that the signal always finds it at work.
    const std::string in = put("in.ply", shapes::sphere(6));
    put("out.ply", "old");
    for (const int number : {SIGINT, SIGTERM}) {
        const auto outcome = remesh(
            {in, at("out.ply"), "--engine", "steiner", "--steiner-points", "40", "--verbose"},
            {.signal = number, .after = "in.ply"});
        EXPECT_FALSE(outcome.killed);
        EXPECT_EQ(outcome.exit_code, 128 + number) << outcome.err;
        EXPECT_EQ(bytes("out.ply"), "old");
        EXPECT_EQ(num_files(), 2u);
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
    const auto outcome =
        remesh({in, at("out.off"), "-n", "50", "--engine", "steiner", "--report", "-"});
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

TEST_F(Remesh, TheNumberOfVerticesIsGivenInManyWays) {
    const std::string in = put("in.off", shapes::sphere(4));  // 2562 vertices.
    const auto report_with = [&](std::vector<std::string> extra) {
        extra.insert(extra.begin(), {in, at("out.off"), "-q", "--relax", "10", "--report", "-"});
        const auto outcome = remesh(extra);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out);
    };
    EXPECT_EQ(report_with({"-n", "2e2"})["output_vertices"], 200);
    EXPECT_EQ(report_with({"-n", "10%"})["output_vertices"], 256);
    EXPECT_EQ(report_with({"--faces", "400"})["output_faces"], 400);
    for (const char* option : {"--edge-length", "--hsiz"}) {
        const auto report = report_with({option, "5%"});
        const double length = 0.05 * 2 * std::sqrt(3.);  // The box of the sphere is a cube.
        EXPECT_NEAR(report["options"]["sizing"]["edge_length_mesh_units"], length, 1e-3);
        EXPECT_NEAR(report["sizing"]["mean_edge_mesh_units"].get<double>() / length, 1, 0.02);
        EXPECT_EQ(report["sizing"]["samples"], report["output_vertices"]);
        EXPECT_TRUE(report["sizing"]["least_target_mesh_units"].is_null());
    }
    EXPECT_NEAR(report_with({"--edge-length", ".2"})["sizing"]["mean_edge_mesh_units"], 0.2, 0.004);
}

TEST_F(Remesh, AdaptiveEdgesKeepTheirBounds) {
    const std::string in = put("in.off", shapes::torus(80, 40));
    const auto outcome = remesh({in, at("out.off"), "-n", "500", "--adaptive", "--hmin", ".1",
                                 "--hmax", "6%", "--hgrad", "1.2", "--report", "-"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["output_vertices"], 500);
    EXPECT_EQ(report["options"]["sizing"]["adaptive"], true);
    EXPECT_EQ(report["options"]["sizing"]["gradation"], 1.2);
    EXPECT_EQ(report["options"]["sizing"]["min_edge_mesh_units"], 0.1);
    EXPECT_GE(report["sizing"]["least_target_mesh_units"], 0.099);
    EXPECT_LE(report["sizing"]["largest_target_mesh_units"],
              1.01 * report["options"]["sizing"]["max_edge_mesh_units"].get<double>());
    EXPECT_NE(outcome.err.find("targets from "), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
    const auto narrow = remesh({in, at("out.off"), "-n", "500", "--adaptive", "--hmax", ".05"});
    EXPECT_EQ(narrow.exit_code, 0) << narrow.err;
    EXPECT_NE(narrow.err.find("too few for --max-edge"), std::string::npos) << narrow.err;
    const auto wide = remesh({in, at("out.off"), "-n", "500", "--adaptive", "--hmin", ".5"});
    EXPECT_EQ(wide.exit_code, 0) << wide.err;
    EXPECT_NE(wide.err.find("too many for --min-edge"), std::string::npos) << wide.err;
}

TEST_F(Remesh, ADistanceIsKeptOrTheReasonTold) {
    const std::string in = put("in.off", shapes::sphere(4));
    const auto outcome = remesh({in, at("out.off"), "--max-distance", ".5%", "--report", "-"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto report = nlohmann::json::parse(outcome.out);
    const double limit = report["options"]["sizing"]["max_distance_mesh_units"];
    EXPECT_NEAR(limit, 0.005 * 2 * std::sqrt(3.), 1e-4);
    EXPECT_LE(report["sizing"]["largest_distance_mesh_units"], limit);
    EXPECT_GT(report["sizing"]["largest_distance_mesh_units"], limit / 4);
    EXPECT_LE(report["verdict"]["largest_distance_mesh_units"], limit);
    put("old.off", "old");
    const auto refused = remesh({in, at("old.off"), "--hausd", "1e-13"});
    EXPECT_EQ(refused.exit_code, 2) << refused.err;
    EXPECT_NE(refused.err.find("use longer ones"), std::string::npos) << refused.err;
    EXPECT_EQ(bytes("old.off"), "old");
}

// Edges of .2 on one half of a plate, of .05 on the other.
TEST_F(Remesh, PropertiesOfVerticesGiveLengthsAndDensities) {
    const agvd::TriangleMesh plate = shapes::grid(20);
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex " << plate.positions.size()
         << "\nproperty double x\nproperty double y\nproperty double z\nproperty float size\n"
         << "property float weight\nelement face " << plate.triangles.size()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const agvd::Vec3& p : plate.positions) {
        const bool is_fine = p.x() > 0.5;
        text << p.x() << ' ' << p.y() << ' ' << p.z() << (is_fine ? " .05 16\n" : " .2 1\n");
    }
    for (const auto& [a, b, c] : plate.triangles) text << "3 " << a << ' ' << b << ' ' << c << '\n';
    const std::string in = put("in.ply", text.str());
    const auto share_of_fine = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{in, at("out.off")};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto outcome = remesh(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const auto result = remesh::read_mesh(at("out.off")).mesh;
        const auto fine = std::count_if(result.positions.begin(), result.positions.end(),
                                        [](const agvd::Vec3& p) { return p.x() > 0.5; });
        return std::pair(static_cast<double>(fine) / static_cast<double>(result.positions.size()),
                         result.positions.size());
    };
    // Half the area holds 230 vertices and, but for the transition, the other 15.
    const auto [share, count] = share_of_fine({"--sizing", "size"});
    EXPECT_GT(share, 0.7);
    EXPECT_GT(count, 200u);
    EXPECT_LT(count, 450u);
    const auto [scaled_share, scaled_count] = share_of_fine({"--sizing", "size", "-n", "100"});
    EXPECT_GT(scaled_share, 0.6);
    EXPECT_EQ(scaled_count, 100u);
    EXPECT_GT(share_of_fine({"--density", "weight", "-n", "300"}).first, 0.7);
    EXPECT_NEAR(share_of_fine({"-n", "300"}).first, 0.5, 0.05);
    const auto unknown = remesh({in, at("out.off"), "--sizing", "nothing"});
    EXPECT_EQ(unknown.exit_code, 2) << unknown.err;
    EXPECT_NE(unknown.err.find("size"), std::string::npos) << unknown.err;
    EXPECT_NE(unknown.err.find("in.ply has no vertex property"), std::string::npos) << unknown.err;
}

TEST_F(Remesh, WrongNumbersAndLengthsAreRefused) {
    const std::string in = put("in.off", shapes::sphere(2));
    const std::vector<std::string> wrong[] = {{"-n", "0"},
                                              {"-n", "1.5"},
                                              {"-n", "5e9"},
                                              {"-n", "-3"},
                                              {"-n", "ten"},
                                              {"-n", "0%"},
                                              {"-n", "1e-5%"},
                                              {"--faces", "0"},
                                              {"--faces", "10%"},
                                              {"--edge-length", "0"},
                                              {"--edge-length", "nan"},
                                              {"--edge-length", "1mm"},
                                              {"--hmin", ".1"},
                                              {"--hgrad", "2"},
                                              {"--max-distance", "0"},
                                              {"-n", "100", "--max-distance", "1%"},
                                              {"--adaptive", "--sizing", "size"},
                                              {"--adaptive", "--hgrad", ".9"},
                                              {"-n", "100", "--faces", "100"},
                                              {"-n", "100", "--edge-length", ".1"},
                                              {"--faces", "100", "--edge-length", ".1"},
                                              {"--adaptive", "--hmin", "2", "--hmax", "1"}};
    for (std::vector<std::string> arguments : wrong) {
        const std::string first = arguments[0] + ' ' + arguments[1];
        arguments.insert(arguments.begin(), {in, at("never.off")});
        const auto outcome = remesh(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << first << outcome.err;
        EXPECT_NE(outcome.err, "");
    }
}

TEST_F(Remesh, QuietSaysNothing) {
    const std::string in = put("in.off", shapes::sphere(3));
    const auto outcome = remesh({in, at("out.off"), "-n", "50", "-q"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
}

// Of what was written to a terminal: each drawing of the bar without its end.
std::vector<std::string> drawings(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line, '\r');) {
        if (line.starts_with("\x1b[K")) line.erase(0, 3);
        if (line.starts_with('[')) lines.push_back(line);
    }
    return lines;
}

TEST_F(Remesh, ATerminalGetsABarOfTheWholeRunThatNeverFalls) {
    const std::string in = put("in.ply", shapes::torus(200, 100));
    for (const unsigned short columns : std::array<unsigned short, 2>{50, 100}) {
        const auto outcome = remesh({in, at("out.ply"), "-n", "3000"}, {.columns = columns});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        int last = -1;
        for (const std::string& line : drawings(outcome.err)) {
            EXPECT_LT(line.size(), columns) << line;
            const std::size_t at = line.find(']');
            ASSERT_NE(at, std::string::npos) << line;
            const int percent = std::stoi(line.substr(at + 1));
            EXPECT_GE(percent, last) << line;
            last = percent;
        }
        EXPECT_GE(last, 50);
        // The last drawing is removed, and the report stands alone.
        EXPECT_NE(outcome.err.find("\r\x1b[Kinput: "), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.err.rfind('['), outcome.err.rfind("[Kinput: "));
    }
}

TEST_F(Remesh, NoBarIsDrawnIfNobodySeesIt) {
    const std::string in = put("in.ply", shapes::torus(60, 30));
    EXPECT_EQ(remesh({in, at("out.ply"), "-n", "300"}).err.find('\r'), std::string::npos);
    EXPECT_EQ(remesh({in, at("out.ply"), "-n", "300", "-q"}, {.columns = 80}).err, "");
}

TEST_F(Remesh, VerboseTellsTimeMemoryAndWorkOfEachStage) {
    const std::string in = put("in.ply", shapes::torus(60, 30));
    const auto verbose = [&](const char* threads) {
        const auto outcome = remesh(
            {in, at("out.ply"), "-n", "300", "-t", threads, "--map", at("map"), "--verbose"});
        EXPECT_EQ(outcome.exit_code, 0);
        // Times and memory are left out.
        static const std::regex figures(
            " *[0-9]+[.][0-9][0-9] s\\b|memory peak [0-9.]+[KMG]|[0-9]+ bytes");
        return std::regex_replace(outcome.err, figures, "");
    };
    const std::string text = verbose("1");
    for (const char* line :
         {"\nread:, \n", "\nclean:, \n", "\nrelax:, \n", "\ncheck:, \n", "\ntransfer:, \n",
          "\nwrite:, \n", "\nclean  3600 faces, 3600 when cleaned, ", "; repaired: nothing; ",
          "\nsample  300 samples asked for\n", " sites, 60 steps, energy 1 ",
          "\ndual  0 rounds of repair, 0 sites added, ", " flips, ",
          "\nplace  300 vertices, 600 faces\n",
          "mended by 0 sites, and by 0 vertices moved back\n"}) {
        EXPECT_NE(text.find(line), std::string::npos) << line << " is missing in\n" << text;
    }
    const auto details = [](const std::string& all) {
        const std::size_t begin = all.find("\nclean  ");
        return all.substr(begin, all.find("\ntransfer:") - begin);
    };
    EXPECT_EQ(details(verbose("2")), details(text));
}

TEST_F(Remesh, HelpHasEightyColumnsWithoutATerminal) {
    const auto longest = [](const std::string& text) {
        std::istringstream lines(text);
        std::size_t most = 0;
        for (std::string line; std::getline(lines, line);) most = std::max(most, line.size());
        return most;
    };
    EXPECT_LE(longest(remesh({"--help"}).out), 80u);
    EXPECT_GE(longest(remesh({"--help"}).out), 75u);
}

TEST_F(Remesh, HelpAndVersionGoToStdout) {
    const auto help = remesh({"--help"});
    EXPECT_EQ(help.exit_code, 0);
    for (const char* text : {"Examples", "Exit codes", "--samples", "--report", "--engine",
                             "--max-error", "--delaunay", "window", "steiner", "vertex"}) {
        EXPECT_NE(help.out.find(text), std::string::npos) << text;
    }
    EXPECT_EQ(remesh({"--version"}).out.rfind("remesh ", 0), 0u);
}

}  // namespace
