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
