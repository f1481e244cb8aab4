// Meshes from and to standard streams: what goes where, and which formats they have.

#include <nlohmann/json.hpp>

#include "remesh/meshfile/mesh_file.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace {

class Pipes : public Scratch {
protected:
    // Runs a line of the shell in which $REMESH and $EVAL are programs, and $IN a sphere in OFF.
    [[nodiscard]] process::Outcome shell(const std::string& line) const {
        const std::string names = std::string("REMESH=") + REMESH_PROGRAM +
                                  " EVAL=" + REMESH_EVAL_PROGRAM + " AGVD=" + AGVD_PROGRAM +
                                  " IN=" + input_ + " DIR=" + at("") + "\n";
        return process::run({"/bin/sh", "-c", names + line});
    }
    std::string input_ = put("in.off", shapes::sphere(3));
};

TEST_F(Pipes, AMeshGoesThroughPipesAsThroughFiles) {
    EXPECT_EQ(shell("$REMESH $IN $DIR/a.ply -n 60 -q").exit_code, 0);
    for (const char* line :
         {"cat $IN | $REMESH - - --from off --to ply -n 60 -q",
          "$REMESH --to PLY --from OFF -n 60 -q -o - - < $IN",
          "cat $IN | $REMESH /dev/stdin /dev/stdout --from off --to ply -n 60"}) {
        const auto outcome = shell(line);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.out, bytes("a.ply")) << line;
    }
}

TEST_F(Pipes, FilesMayHaveAnyExtensionIfTheFormatIsGiven) {
    const std::string in = put("in.dat", bytes("in.off"));
    const auto outcome = shell("$REMESH " + in + " $DIR/out.dat --from off --to off -n 60 -q");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(bytes("out.dat").substr(0, 3), "OFF");
    const auto refused = shell("$REMESH " + in + " $DIR/b.off -n 60");
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_NE(refused.err.find("--from"), std::string::npos) << refused.err;
}

TEST_F(Pipes, AFormatThatTheNameOfTheOutputContradictsIsWrongUsage) {
    for (const char* line :
         {"$REMESH $IN $DIR/a.obj --to ply -n 60", "$REMESH $IN $DIR/a.ply.gz --to ply -n 60"}) {
        const auto outcome = shell(line);
        EXPECT_EQ(outcome.exit_code, 2) << line;
        EXPECT_NE(outcome.err.find("leave out --to, or name the output .ply"), std::string::npos)
            << outcome.err;
    }
    EXPECT_EQ(num_files(), 1u);
    EXPECT_EQ(shell("$REMESH $IN $DIR/a.PLY --to ply -n 60").exit_code, 0);
}

TEST_F(Pipes, StreamsNeedAFormat) {
    const auto in = shell("$REMESH - $DIR/a.ply < $IN");
    EXPECT_EQ(in.exit_code, 3);
    EXPECT_NE(in.err.find("/dev/stdin: unknown extension"), std::string::npos) << in.err;
    const auto out = shell("$REMESH $IN -");
    EXPECT_EQ(out.exit_code, 3);
    EXPECT_EQ(out.out, "");
    EXPECT_NE(out.err.find("/dev/stdout: unknown extension"), std::string::npos) << out.err;
    EXPECT_NE(out.err.find("--to"), std::string::npos) << out.err;
    const auto unknown = shell("$REMESH $IN - --to step");
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_NE(unknown.err.find("'step'; use ply, obj"), std::string::npos) << unknown.err;
    EXPECT_EQ(num_files(), 1u);
}

TEST_F(Pipes, ErrorsOfStandardInputNameIt) {
    const auto empty = shell("$REMESH - $DIR/a.ply --from off < /dev/null");
    EXPECT_EQ(empty.exit_code, 3);
    EXPECT_NE(empty.err.find("/dev/stdin: the file is empty"), std::string::npos) << empty.err;
    const auto cut = shell("head -c 200 $IN | $REMESH - $DIR/a.ply --from off");
    EXPECT_EQ(cut.exit_code, 3);
    EXPECT_NE(cut.err.find("/dev/stdin: line "), std::string::npos) << cut.err;
    const auto closed = shell("$REMESH - $DIR/a.ply --from off <&-");
    EXPECT_EQ(closed.exit_code, 3);
    EXPECT_EQ(num_files(), 1u);
}

TEST_F(Pipes, StandardInputIsReadFromWhereItStands) {
    put("two", "a line for the shell\n" + bytes("in.off"));
    const auto outcome = shell("(read first; $REMESH - $DIR/a.off --from off -n 60 -q) < $DIR/two");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(Pipes, AFileOnStandardOutputIsWrittenToNotReplaced) {
    const auto outcome =
        shell("(echo first; $REMESH $IN - --to off -n 60 -q; echo last) > $DIR/all");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string all = bytes("all");
    EXPECT_EQ(all.substr(0, 10), "first\nOFF\n");
    EXPECT_EQ(all.substr(all.size() - 5), "last\n");
}

TEST_F(Pipes, OnlyOneThingGoesToStandardOutput) {
    for (const char* report : {"-", "/dev/stdout"}) {
        const auto outcome = shell(std::string("$REMESH $IN - --to off -n 60 --report ") + report);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find("--report"), std::string::npos) << outcome.err;
    }
    const auto both = shell("$REMESH $IN - --to off -n 60 --report $DIR/r.json");
    EXPECT_EQ(both.exit_code, 0) << both.err;
    EXPECT_EQ(nlohmann::json::parse(bytes("r.json"))["output_path"], "/dev/stdout");
}

TEST_F(Pipes, AReportMayGoToAPipeOfTheShell) {
    const auto outcome = shell("$REMESH $IN $DIR/a.off -n 60 -q --report /dev/fd/3 3>&1 | cat");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(nlohmann::json::accept(outcome.out)) << outcome.out;
}

TEST_F(Pipes, AClosedPipeIsAnErrorOfTheFile) {
    const auto outcome = shell("($REMESH $IN - --to off -n 60 -q; echo $? >&2) | true");
    EXPECT_NE(outcome.err.find("/dev/stdout: cannot be written: Broken pipe"), std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("; check the program that reads"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.substr(outcome.err.size() - 2), "3\n");
    EXPECT_EQ(shell("$REMESH $IN - --to off -n 60 >&-").exit_code, 3);
}

TEST_F(Pipes, OtherProgramsReadStandardInputToo) {
    const auto measured =
        shell("$REMESH $IN - --to ply -n 60 -q | $EVAL $IN - --from ply --json -");
    EXPECT_EQ(measured.exit_code, 0) << measured.err;
    EXPECT_EQ(nlohmann::json::parse(measured.out)["result_path"], "/dev/stdin");
    EXPECT_EQ(shell("$EVAL - - --from off < $IN").exit_code, 2);
    const auto drawn = shell("$AGVD diagram - --from off -n 10 -q -o $DIR/d.ply < $IN");
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_EQ(remesh::read_mesh(at("d.ply")).mesh.triangles.size(),
              shapes::sphere(3).triangles.size());
}

TEST_F(Pipes, LossesOfSinglePrecisionAreWarnedOf) {
    agvd::TriangleMesh far = shapes::sphere(3);
    for (agvd::Vec3& p : far.positions) p += agvd::Vec3(500'000, 5'400'000, 100);
    const std::string in = put("far.ply", far);
    const auto lossy = shell("$REMESH $DIR/far.ply $DIR/far.stl -n 100 -q");
    EXPECT_EQ(lossy.exit_code, 0);
    EXPECT_NE(lossy.err.find("far.stl: stl stores"), std::string::npos) << lossy.err;
    EXPECT_NE(lossy.err.find("% of the diagonal"), std::string::npos) << lossy.err;
    EXPECT_NE(lossy.err.find("write .ply"), std::string::npos) << lossy.err;
    EXPECT_EQ(shell("$REMESH $DIR/far.ply $DIR/far.obj -n 100 -q").err, "");
    EXPECT_EQ(shell("$REMESH $IN $DIR/near.stl -n 100 -q").err, "");
}

TEST_F(Pipes, CompressedMeshesAreReadAndWritten) {
    if (!remesh::is_known_mesh_extension("a.ply.gz")) GTEST_SKIP() << "built without zlib";
    const auto out = shell("gzip -c $IN | $REMESH - $DIR/a.off.gz --from off -n 60 -q");
    EXPECT_EQ(out.exit_code, 0) << out.err;
    EXPECT_EQ(shell("$REMESH $IN $DIR/a.off -n 60 -q").exit_code, 0);
    EXPECT_EQ(shell("gzip -cd $DIR/a.off.gz").out, bytes("a.off"));
    EXPECT_EQ(shell("$REMESH $IN - --to off.gz -n 60 -q | gzip -cd").out, bytes("a.off"));
}

TEST_F(Pipes, AHugeContentStopsAtTheMemoryLimit) {
    if (!remesh::is_known_mesh_extension("a.ply.gz")) GTEST_SKIP() << "built without zlib";
    EXPECT_EQ(shell("head -c 1000000000 /dev/zero | gzip -1 > $DIR/huge.ply.gz").exit_code, 0);
    const auto outcome = shell("exec $REMESH $DIR/huge.ply.gz $DIR/a.off --memory-limit 200M");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("--memory-limit (stage: read)"), std::string::npos) << outcome.err;
    EXPECT_LT(outcome.peak_bytes, 400'000'000u);
}

}  // namespace
