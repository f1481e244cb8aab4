// The program `remesh-eval` as a process.
#include <nlohmann/json.hpp>

#include "support/scratch.h"
#include "support/shapes.h"

namespace {

class RemeshEval : public Scratch {
protected:
    [[nodiscard]] static process::Outcome eval(std::vector<std::string> arguments) {
        return run(REMESH_EVAL_PROGRAM, std::move(arguments));
    }
};

TEST_F(RemeshEval, PrintsFiguresAsTextOrJson) {
    const std::string original = put("a.off", shapes::sphere(3));
    const std::string result = put("b.off", shapes::sphere(2));
    const auto text = eval({original, result, "--samples", "1000"});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_NE(text.out.find("topology"), std::string::npos) << text.out;
    EXPECT_EQ(text.err, "");
    const auto json = eval({original, result, "--samples", "1000", "--report", "-"});
    EXPECT_TRUE(nlohmann::json::parse(json.out).is_object());
    EXPECT_EQ(eval({original, result, "--samples", "1000", "--json", at("r.json")}).out, text.out);
    EXPECT_EQ(nlohmann::json::parse(bytes("r.json")), nlohmann::json::parse(json.out));
}

TEST_F(RemeshEval, TakesNumbersWithExponents) {
    const std::string mesh = put("a.off", shapes::sphere(1));
    const auto samples_of = [&](const char* count) {
        const auto outcome = eval({mesh, mesh, "--samples", count, "--report", "-"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out)["distance"]["samples_per_surface"];
    };
    EXPECT_EQ(samples_of("1e3"), samples_of("1000"));
    EXPECT_EQ(eval({mesh, mesh, "--samples", "1.5"}).exit_code, 2);
}

// The edges around one vertex that stands out are sharp, but no crease at the scale of the result,
// whose edges are all sharp.
TEST_F(RemeshEval, SharpEdgesAreShownWhereTheOriginalHasCreases) {
    agvd::TriangleMesh rough = shapes::sphere(4);
    rough.positions[0] *= 1.05;
    const std::string original = put("a.off", rough);
    const std::string coarse = put("b.off", shapes::sphere(0));
    const auto smooth = eval({original, coarse, "--samples", "1000", "--json", at("r.json")});
    EXPECT_EQ(smooth.exit_code, 0) << smooth.err;
    EXPECT_GT(nlohmann::json::parse(bytes("r.json"))["features"]["false_percent"], 0);
    for (const char* word : {"sharp edges", "covered", "corners"}) {
        EXPECT_EQ(smooth.out.find(word), std::string::npos) << word << " in\n" << smooth.out;
    }
    const std::string cube = put("cube.off", shapes::cube());
    const auto sharp = eval({cube, cube, "--samples", "1000"});
    for (const char* word : {"false sharp edges (%)", "covered within .1 %", "corners kept"}) {
        EXPECT_NE(sharp.out.find(word), std::string::npos) << word << " not in\n" << sharp.out;
    }
}

TEST_F(RemeshEval, ExitCodes) {
    const std::string mesh = put("a.off", shapes::sphere(1));
    const std::string old = bytes("a.off");
    EXPECT_EQ(eval({}).exit_code, 2);
    EXPECT_EQ(eval({mesh}).exit_code, 2);
    EXPECT_EQ(eval({"--help"}).exit_code, 0);
    EXPECT_EQ(eval({mesh, mesh, "--samples", "0"}).exit_code, 2);
    const auto overwriting = eval({mesh, mesh, "--json", mesh});
    EXPECT_EQ(overwriting.exit_code, 2);
    EXPECT_EQ(overwriting.err.find("--force"), std::string::npos) << overwriting.err;
    EXPECT_EQ(eval({mesh, at("missing.off")}).exit_code, 3);
    EXPECT_EQ(eval({mesh, put("n.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")}).exit_code,
              4);
    EXPECT_EQ(bytes("a.off"), old);
}

}  // namespace
