// The program `agvd` as a process.
#include "remesh/io/read_mesh.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace {

class AgvdDiagram : public Scratch {
protected:
    [[nodiscard]] static process::Outcome diagram(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "diagram");
        return run(AGVD_PROGRAM, std::move(arguments));
    }
};

TEST_F(AgvdDiagram, WritesEveryOutputAskedFor) {
    const std::string in = put("in.off", shapes::sphere(3));
    const auto outcome =
        diagram({in, "-n", "20", "-o", at("d.vtp"), "-o", at("d.obj"), "-o", at("d.ply")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(bytes("d.vtp").find("site_left"), std::string::npos);
    EXPECT_NE(bytes("d.obj").find("\nl "), std::string::npos);
    EXPECT_EQ(remesh::read_mesh(at("d.ply")).mesh.triangles, shapes::sphere(3).triangles);
}

TEST_F(AgvdDiagram, SitesMayLieInDirtyMeshes) {
    // Face 0 is degenerate and dropped in cleaning; sites keep the numbers of the file. One end of
    // it is a corner of the square, the other is nowhere on the surface.
    const std::string in =
        put("in.off", "OFF\n5 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 5 0\n3 0 0 4\n3 0 1 2\n3 0 2 3\n");
    EXPECT_EQ(
        diagram({in, "--sites", put("s", "f 0 1 0 0\nf 1 0 1 0\nf 2 0 0 1\n"), "-o", at("d.ply")})
            .exit_code,
        0);
    EXPECT_EQ(diagram({in, "--sites", put("s", "f 0 0 0 1\n"), "-o", at("d.ply")}).exit_code, 4);
}

TEST_F(AgvdDiagram, AComponentWithoutASiteIsToldAndWritten) {
    const std::string in = put("in.off", shapes::join(shapes::sphere(1), shapes::sphere(1)));
    const auto outcome = diagram({in, "--sites", put("s", "v 0\n"), "-q", "-o", at("d.ply")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("42 vertices"), std::string::npos) << outcome.err;
    EXPECT_EQ(remesh::read_mesh(at("d.ply")).mesh.positions.size(), 84u);
}

TEST_F(AgvdDiagram, TellsTheEngineAndWhatItCertifies) {
    const std::string in = put("in.off", shapes::sphere(2));
    const auto outcome = diagram({in, "-n", "20", "--engine", "steiner", "-o", at("d.ply")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("steiner engine, error unknown"), std::string::npos) << outcome.err;
}

TEST_F(AgvdDiagram, ExitCodes) {
    const std::string in = put("in.off", shapes::sphere(1));
    EXPECT_EQ(run(AGVD_PROGRAM, {}).exit_code, 2);
    EXPECT_EQ(run(AGVD_PROGRAM, {"--help"}).exit_code, 0);
    EXPECT_EQ(diagram({"--help"}).exit_code, 0);
    EXPECT_EQ(diagram({in}).exit_code, 2);
    EXPECT_EQ(diagram({in, "-n", "0", "-o", at("d.vtp")}).exit_code, 2);
    EXPECT_EQ(diagram({in, "--engine", "magic", "-o", at("d.vtp")}).exit_code, 2);
    EXPECT_EQ(diagram({in, "--max-error", "1", "-o", at("d.vtp")}).exit_code, 2);
    EXPECT_EQ(diagram({in, "--engine=vertex", "--max-error=0", "-o", at("d.vtp")}).exit_code, 2);
    EXPECT_EQ(diagram({in, "-o", at("d.stl")}).exit_code, 3);
    EXPECT_EQ(diagram({in, "-o", at("no/d.vtp")}).exit_code, 3);
    EXPECT_EQ(diagram({at("missing.off"), "-o", at("d.vtp")}).exit_code, 3);
    EXPECT_EQ(diagram({in, "--sites", at("missing"), "-o", at("d.vtp")}).exit_code, 3);
}

}  // namespace
