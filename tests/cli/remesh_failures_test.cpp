// The program `remesh` where it cannot do what is asked: exit codes, texts, and files that stay.
#include <signal.h>

#include "cli/remesh_program.h"
#include "remesh/quality/evaluate.h"
#include "support/shapes.h"

namespace fs = std::filesystem;

namespace {

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
             {in, out, "--engine", "steiner", "--max-error", "0"},
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

// Two spheres, one just inside the other: their coarse meshes run through each other, and without
// relaxation nothing is repaired.
TEST_F(Remesh, IntersectionsAreToldAndWithStrictNothingIsWritten) {
    if (!remesh::find_self_intersections(shapes::cube().view())) GTEST_SKIP() << "without CGAL";
    agvd::TriangleMesh inner = shapes::sphere(2);
    for (agvd::Vec3& p : inner.positions) p *= 0.98;
    for (agvd::Triangle& t : inner.triangles) std::swap(t[1], t[2]);
    const std::string in = put("in.off", shapes::join(shapes::sphere(2), inner));
    const auto told = remesh({in, at("out.off"), "-n", "20", "-q", "--relax", "0"});
    EXPECT_EQ(told.exit_code, 0) << told.err;
    EXPECT_NE(told.err.find("warning: the result has "), std::string::npos) << told.err;
    EXPECT_NE(told.err.find("the input has 0, one near "), std::string::npos) << told.err;
    put("out.off", "old");
    const auto refused = remesh({in, at("out.off"), "-n", "20", "--strict", "--relax", "0"});
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
    EXPECT_NE(told.err.find("where the input intersects itself, and more --samples give more; "
                            "repair the input, or use --wrap\n"),
              std::string::npos)
        << told.err;
    EXPECT_EQ(told.err.find("use more"), std::string::npos) << told.err;
    EXPECT_EQ(remesh({in, at("out.off"), "-n", "400", "--strict"}).exit_code, 5);
    // Two shells run through each other besides.
    agvd::TriangleMesh inner = shapes::sphere(2);
    for (agvd::Vec3& p : inner.positions) p *= 0.98;
    for (agvd::Triangle& t : inner.triangles) std::swap(t[1], t[2]);
    const agvd::TriangleMesh shells = shapes::join(shapes::sphere(2), inner);
    const auto both =
        remesh({put("both.off", shapes::join(shapes::moved(shells, {9, 0, 0}), cubes)),
                at("out.off"), "-n", "60", "-q", "--relax", "0"});
    EXPECT_EQ(both.exit_code, 0) << both.err;
    EXPECT_NE(
        both.err.find(
            ": for these use more --samples, for the others repair the input, or use --wrap\n"),
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
    // All three are about ten million vertices.
    for (const auto& [option, value] :
         {std::pair("-n", "10000000"), {"--faces", "2e7"}, {"--edge-length", ".00119"}}) {
        SCOPED_TRACE(option);
        const auto outcome = remesh({in, at("out.ply"), option, value, "--memory-limit", "2G"});
        EXPECT_EQ(outcome.exit_code, 1);
        const std::string needs = "the program needs some ";
        const std::size_t begin = outcome.err.find(needs);
        ASSERT_NE(begin, std::string::npos) << outcome.err;
        // 2.8 for ten million vertices, and what the program already uses: more with sanitizers.
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
    // In one piece, and so many that free memory which the program keeps counts little.
    const double bytes_per_sample = (peak(12'000) - peak(1000)) / 11'000;
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

}  // namespace
