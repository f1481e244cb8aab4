// `remesh-tiles` as a process: its commands, what they say, and processes that share the work.
#include "remesh/meshfile/mesh_file.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace {

class RemeshTiles : public Scratch {
protected:
    [[nodiscard]] static process::Outcome tiles(std::vector<std::string> arguments) {
        return run(REMESH_TILES_PROGRAM, std::move(arguments));
    }
    void expect_told(const process::Outcome& outcome, int exit_code, const std::string& text) {
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
        EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
    }
};

TEST_F(RemeshTiles, ProcessesShareTheWork) {
    const std::string file = put("a.ply", shapes::torus(120, 80));
    expect_told(tiles({"split", file, at("d"), "-n", "3000", "--tile", "600"}), 0,
                "19200 faces in 5 tiles, with ");
    expect_told(tiles({"mesh", at("d"), "--tile", "3", "--tile", "0"}), 0,
                "2 tiles meshed, 0 were there");
    expect_told(tiles({"mesh", at("d"), "--share", "0/3"}), 0, "0 tiles meshed, 2 were there");
    expect_told(tiles({"mesh", at("d"), "--share", "2/3"}), 0, "1 tiles meshed, 0 were there");
    expect_told(tiles({"join", at("d"), at("out.ply")}), 3, "00001.mesh: is not there");
    expect_told(tiles({"mesh", at("d")}), 0, "2 tiles meshed, 3 were there");
    expect_told(tiles({"join", at("d"), at("out.ply")}), 0,
                "3000 vertices, 6000 triangles, 1 components of genus 1 with 0 boundary loops");
    EXPECT_EQ(remesh::read_mesh(at("out.ply")).mesh.positions.size(), 3000u);
}

TEST_F(RemeshTiles, ErrorsNameWhatIsWrong) {
    const std::string file = put("a.ply", shapes::sphere(3)), off = put("a.off", shapes::cube());
    expect_told(tiles({"split", off, at("d")}), 3, "a.off: is neither binary PLY nor binary STL");
    expect_told(tiles({"split", file, at("d"), "--tile", "10"}), 2, "samples_per_tile is 10");
    expect_told(tiles({"mesh", at("none")}), 3, "plan.json: is not there; split a file");
    expect_told(tiles({"split", file, at("d"), "-n", "500"}), 0, "in 1 tiles");
    expect_told(tiles({"mesh", at("d"), "--tile", "1"}), 2, "there is no tile 1");
    for (const char* share : {"2", "2/2", "a/3", "-1/3", "1/"}) {
        expect_told(tiles({"mesh", at("d"), "--share", share}), 2,
                    "use I/K with I from 0 to K - 1");
    }
    expect_told(tiles({"join", at("d"), at("out.xyz")}), 3, "out.xyz");
    expect_told(tiles({"mesh", at("d"), "-q"}), 0, "");
    expect_told(tiles({"join", at("d"), file, "--no-clobber"}), 3, "a.ply");
}

}  // namespace
