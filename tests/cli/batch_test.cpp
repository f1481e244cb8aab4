// `remesh --out-dir` as a process: many meshes in one run. Also --no-clobber and reports of runs
// that fail, which single runs have as well.
#include <signal.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/remesh_program.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/shapes.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

class RemeshBatch : public Remesh {
protected:
    [[nodiscard]] json report_at(const std::string& name) const { return json::parse(bytes(name)); }
    void expect_told(const process::Outcome& outcome, const std::string& text) {
        EXPECT_NE(outcome.err.find(text), std::string::npos) << text << " is not in\n"
                                                             << outcome.err;
    }
};

TEST_F(RemeshBatch, EachResultIsThatOfARunAlone) {
    const std::string a = put("a.off", shapes::sphere(3)), b = put("b.obj", shapes::torus(30, 15));
    const auto outcome =
        remesh({a, b, "-n", "150", "--out-dir", at("new/out"), "--report", at("r.json")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    expect_told(outcome, "mesh 2 of 2: " + b);
    expect_told(outcome, "2 done, 0 failed");
    EXPECT_EQ(outcome.err.find("skipped"), std::string::npos) << outcome.err;
    EXPECT_EQ(remesh({a, at("alone.off"), "-n", "150"}).exit_code, 0);
    EXPECT_EQ(remesh({b, at("alone.obj"), "-n", "150"}).exit_code, 0);
    EXPECT_TRUE(bytes("new/out/a.off") == bytes("alone.off"));
    EXPECT_TRUE(bytes("new/out/b.obj") == bytes("alone.obj"));
    const json reports = report_at("r.json");
    ASSERT_EQ(reports.size(), 2u);
    EXPECT_EQ(reports[0]["input_path"], a);
    EXPECT_EQ(reports[1]["output_path"], at("new/out/b.obj"));
    for (const json& report : reports) {
        EXPECT_EQ(report["status"], "done");
        EXPECT_EQ(report["output"]["vertices"], 150);
    }
}

TEST_F(RemeshBatch, QuietSaysNothingUnlessSomethingFails) {
    const std::string a = put("a.off", shapes::sphere(2));
    const auto outcome = remesh({a, "-n", "50", "-q", "--out-dir", at("out"), "--report", "-"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(json::parse(outcome.out).size(), 1u);
    const auto failing = remesh({at("missing.off"), "-q", "--out-dir", at("out")});
    EXPECT_EQ(failing.exit_code, 6);
    expect_told(failing, "0 done, 1 failed");
}

TEST_F(RemeshBatch, AFailureDoesNotStopTheRest) {
    const std::string bad = put("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
    const std::string good = put("good.off", shapes::sphere(2));
    const std::string torus = put("torus.off", shapes::torus(20, 10));
    fs::create_directory(at("out"));
    put("out/bad.off", "old");
    const auto outcome = remesh({at("missing.off"), bad, good, torus, "-n", "4", "--out-dir",
                                 at("out"), "--report", at("r.json")});
    EXPECT_EQ(outcome.exit_code, 6);
    expect_told(outcome, "remesh: error: 1 done, 3 failed\n  " + at("missing.off") + ": ");
    const std::string summary = outcome.err.substr(outcome.err.find("remesh: error: "));
    EXPECT_EQ(std::count(summary.begin(), summary.end(), '\n'), 4) << summary;
    EXPECT_NE(summary.find("bad.off: "), std::string::npos) << summary;
    EXPECT_NE(summary.find("(exit code 4)"), std::string::npos) << summary;
    EXPECT_EQ(bytes("out/bad.off"), "old");
    EXPECT_EQ(remesh::read_mesh(at("out/good.off")).mesh.positions.size(), 4u);
    EXPECT_FALSE(fs::exists(at("out/missing.off")) || fs::exists(at("out/torus.off")));
    const json reports = report_at("r.json");
    ASSERT_EQ(reports.size(), 4u);
    std::vector<int> codes;
    for (const json& report : reports) codes.push_back(report["exit_code"]);
    EXPECT_EQ(codes, (std::vector{3, 4, 0, 5}));
    EXPECT_EQ(reports[1]["status"], "failed");
    EXPECT_EQ(reports[1]["stage"], "read");
    EXPECT_EQ(reports[2]["status"], "done");
    EXPECT_NE(reports[3]["error"].get<std::string>().find("too few"), std::string::npos);
}

TEST_F(RemeshBatch, AnExtensionThatCannotBeWrittenBecomesPly) {
    const std::string in = put("mesh.txt", "no mesh");
    const auto outcome = remesh({in, "--out-dir", at("out"), "--report", at("r.json")});
    EXPECT_EQ(outcome.exit_code, 6) << outcome.err;
    EXPECT_EQ(report_at("r.json")[0]["output_path"], at("out/mesh.ply"));
}

TEST_F(RemeshBatch, AFormatNamesAllOutputs) {
    const std::string a = put("a.off", shapes::sphere(2)), b = put("b.old.stl", shapes::cube());
    const auto outcome = remesh({a, b, "-n", "20", "--out-dir", at("out"), "--to", "obj"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(remesh::read_mesh(at("out/a.obj")).mesh.positions.size(), 20u);
    EXPECT_EQ(remesh::read_mesh(at("out/b.old.obj")).mesh.positions.size(), 20u);
    for (const std::string stream : {"-", "/dev/stdin"}) {
        const auto refused = remesh({a, stream, "-n", "20", "--out-dir", at("new")});
        EXPECT_EQ(refused.exit_code, 2) << stream;
        expect_told(refused, "gives no name for a file");
    }
    EXPECT_FALSE(fs::exists(at("new")));
}

TEST_F(RemeshBatch, NamesThatCannotAllBeWrittenAreFoundBeforeAnyWork) {
    const std::string a = put("a.off", shapes::sphere(2)), old = bytes("a.off");
    fs::create_directory(at("other"));
    const std::string twin = put("other/a.off", shapes::sphere(2));
    fs::create_directory(at("links"));
    fs::create_symlink(a, at("links/b.off"));
    fs::create_hard_link(a, at("links/c.off"));
    const std::string out = at("out"), both = "would be written to the same file";
    struct Case {
        std::vector<std::string> arguments;
        std::string told;
    };
    for (const Case& wrong :
         std::vector<Case>{{{a, twin, "--out-dir", out}, both},
                           {{a, a, "--out-dir", out}, both},
                           {{at("x.one"), at("x.two"), "--out-dir", out}, both},
                           {{a, "--out-dir", out, "--report", out + "/a.off"}, both},
                           {{a, "--out-dir", at("")}, "would be overwritten"},
                           {{twin, a, "--out-dir", at("")}, both},
                           {{at("b.off"), a, "--out-dir", at("links")}, "would be overwritten"},
                           {{at("c.off"), a, "--out-dir", at("links")}, "would be overwritten"},
                           {{a, "--out-dir", out, "--report", a}, "would be overwritten"},
                           {{"-", "--out-dir", out}, "name a file"},
                           {{at(""), "--out-dir", out}, "name a file"},
                           {{a, "--out-dir", out, "-o", at("b.off")}, "--out-dir"},
                           {{a, "--out-dir", out, "--map", at("map")}, "--out-dir"},
                           {{a, "--out-dir", out, "--force", "--no-clobber"}, "--no-clobber"},
                           {{a, at("b.off"), at("c.off")}, "--out-dir"},
                           {{a, at("b.off"), "-o", at("c.off")}, "--out-dir"},
                           {{a}, "--out-dir"}}) {
        const auto outcome = remesh(wrong.arguments);
        EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(wrong.arguments) << outcome.err;
        expect_told(outcome, wrong.told);
    }
    EXPECT_FALSE(fs::exists(out));
    EXPECT_EQ(bytes("a.off"), old);
    EXPECT_EQ(remesh({a, "-n", "40", "--force", "--out-dir", at("")}).exit_code, 0);
    EXPECT_NE(bytes("a.off"), old);
}

TEST_F(RemeshBatch, AFolderOrReportThatCannotBeWrittenIsThree) {
    const std::string a = put("a.off", shapes::sphere(2));
    put("file", "");
    for (const std::string& folder : {at("file"), at("file/inside"), std::string("/proc")}) {
        const auto outcome = remesh({a, "--out-dir", folder});
        EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
        expect_told(outcome, folder);
    }
    EXPECT_EQ(remesh({a, "--out-dir", at("out"), "--report", at("file") + "/r.json"}).exit_code, 3);
    EXPECT_FALSE(fs::exists(at("out/a.off")));
    EXPECT_EQ(remesh({a, "-n", "20", "--out-dir", at("out"), "--report", "-"}, {.out = "/dev/full"})
                  .exit_code,
              3);
}

TEST_F(RemeshBatch, ASignalEndsItAndKeepsWhatIsFinished) {
    const std::string quick = put("quick.off", shapes::sphere(2));
    const std::string slow = put("slow.off", shapes::sphere(6));
    put("last.off", shapes::sphere(2));
    // Work for minutes on the second mesh, so that the signal always finds it at work.
    const auto outcome =
        remesh({quick, slow, at("last.off"), "--engine", "steiner", "--steiner-points", "40",
                "--out-dir", at("out"), "--report", at("r.json")},
               {.signal = SIGTERM, .after = "slow.off: "});
    EXPECT_FALSE(outcome.killed);
    EXPECT_EQ(outcome.exit_code, 143) << outcome.err;
    expect_told(outcome, "remesh: interrupted: 1 done, 0 failed, 2 not finished");
    EXPECT_TRUE(fs::exists(at("out/quick.off")));
    EXPECT_FALSE(fs::exists(at("out/slow.off")) || fs::exists(at("out/last.off")));
    EXPECT_EQ(report_at("r.json").size(), 1u);
}

TEST_F(RemeshBatch, NoClobberSkipsWhatIsThere) {
    const std::string a = put("a.off", shapes::sphere(2)), b = put("b.off", shapes::sphere(3));
    fs::create_directory(at("out"));
    put("out/a.off", "old");
    const std::vector<std::string> arguments{
        a, b, "-n", "50", "--no-clobber", "--out-dir", at("out"), "--report", at("r.json")};
    const auto outcome = remesh(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_told(outcome, "1 done, 0 failed, 1 skipped");
    EXPECT_EQ(bytes("out/a.off"), "old");
    EXPECT_TRUE(fs::exists(at("out/b.off")));
    EXPECT_EQ(report_at("r.json")[0]["status"], "skipped");
    EXPECT_EQ(report_at("r.json")[0]["exit_code"], 0);
    EXPECT_EQ(report_at("r.json")[1]["status"], "done");
    const auto again = remesh(arguments);
    EXPECT_EQ(again.exit_code, 3) << again.err;
    expect_told(again, at("r.json") + ": exists already");
}

TEST_F(RemeshBatch, NoClobberRefusesAnyOutputOfARunAlone) {
    const std::string in = put("in.off", shapes::sphere(2)), out = at("out.off");
    put("old", "old");
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {in, at("old")}, {in, out, "--report", at("old")}, {in, out, "--map", at("old")}}) {
        std::vector<std::string> all = arguments;
        if (all[1] == at("old")) fs::copy_file(at("old"), all[1] = at("old.off"));
        all.emplace_back("--no-clobber");
        const auto outcome = remesh(all);
        EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
        expect_told(outcome, "exists already");
        EXPECT_EQ(outcome.err.find("vertices"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(bytes("old") + bytes("old.off"), "oldold");
    EXPECT_FALSE(fs::exists(out));
    EXPECT_EQ(remesh({in, out, "-n", "20", "--no-clobber", "--report", "/dev/null"}).exit_code, 0);
}

// The output appears while the program works.
TEST_F(RemeshBatch, NoClobberLooksAgainBeforeItWrites) {
    const std::string in = put("in.off", shapes::sphere(4));
    const auto outcome =
        process::run({"/bin/sh", "-c",
                      "cd '" + at("") +
                          "' && mkfifo pipe.off && ('" REMESH_PROGRAM
                          "' pipe.off out.off -n 50 --no-clobber; echo $? > code) & cd '" +
                          at("") + "'; sleep 1; echo old > out.off; cat in.off > pipe.off; wait"});
    EXPECT_EQ(bytes("code"), "3\n") << outcome.err;
    EXPECT_EQ(bytes("out.off"), "old\n");
}

TEST_F(RemeshBatch, AFailedRunReplacesTheReportAndLeavesTheMesh) {
    const std::string torus = put("torus.off", shapes::torus(20, 10));
    put("out.off", "old");
    put("r.json", "old");
    const auto outcome = remesh({torus, at("out.off"), "-n", "3", "--report", at("r.json")});
    EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
    const json report = report_at("r.json");
    EXPECT_EQ(report["status"], "failed");
    EXPECT_EQ(report["exit_code"], 5);
    EXPECT_EQ("remesh: error: " + report["error"].get<std::string>() + "\n",
              outcome.err.substr(outcome.err.find("remesh: error: ")));
    EXPECT_TRUE(report["stage"].is_string());
    EXPECT_EQ(report["input_path"], torus);
    EXPECT_EQ(report["output_path"], at("out.off"));
    EXPECT_EQ(bytes("out.off"), "old");
    EXPECT_EQ(num_files(), 3u);
    const auto printed = remesh({at("missing.off"), at("out.off"), "--report", "-"});
    EXPECT_EQ(json::parse(printed.out)["exit_code"], 3);
}

TEST_F(RemeshBatch, WhatIsRefusedBeforeTheWorkAndInterruptionsLeaveTheReport) {
    const std::string in = put("in.off", shapes::sphere(6));
    put("r.json", "old");
    const std::string report = at("r.json");
    EXPECT_EQ(remesh({in, in, "--report", report}).exit_code, 2);
    EXPECT_EQ(remesh({in, at("out.off"), "--report", report, "-n", "0"}).exit_code, 2);
    const auto stopped = remesh(
        {in, at("out.off"), "--report", report, "--engine", "steiner", "--steiner-points", "40"},
        {.signal = SIGINT, .after = "in.off: "});
    EXPECT_EQ(stopped.exit_code, 130);
    EXPECT_EQ(bytes("r.json"), "old");
}

TEST_F(RemeshBatch, WarningsAreInTheReportOfTheirMesh) {
    const std::string textured =
        put("textured.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 nan\nf 1/1 2/2 3/3\n");
    const std::string plain = put("plain.off", shapes::sphere(2));
    const auto outcome =
        remesh({textured, plain, "-n", "20", "--out-dir", at("out"), "--report", at("r.json")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const json reports = report_at("r.json");
    ASSERT_EQ(reports[0]["warnings"].size(), 1u);
    expect_told(outcome, "warning: " + reports[0]["warnings"][0].get<std::string>() + "\n");
    EXPECT_TRUE(reports[1]["warnings"].empty());
    EXPECT_EQ(remesh({textured, at("out.off"), "-n", "1", "--report", at("f.json")}).exit_code, 5);
    EXPECT_EQ(report_at("f.json")["warnings"], reports[0]["warnings"]);
}

}  // namespace
