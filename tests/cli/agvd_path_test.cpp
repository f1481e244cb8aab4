// The subcommand `path` of the program `agvd` as a process.
#include <cmath>
#include <sstream>

#include "remesh/meshfile/mesh_file.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace {

class AgvdPath : public Scratch {
protected:
    [[nodiscard]] static process::Outcome path(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "path");
        return run(AGVD_PROGRAM, std::move(arguments));
    }
    // The numbers behind a word in each comment of an OBJ file.
    static std::vector<double> numbers(const std::string& text, const std::string& word) {
        std::vector<double> found;
        std::istringstream in(text);
        for (std::string name; in >> name;) {
            if (name == word) in >> found.emplace_back();
        }
        return found;
    }
    [[nodiscard]] std::string square() const { return put("in.off", shapes::grid(7)); }
};

TEST_F(AgvdPath, LeadsFromEachTargetToItsSite) {
    const auto outcome = path({square(), "--sites", put("s", "p .1 .2 0\np .9 .9 0\n"), "--targets",
                               put("t", "p .5 .3 0\np .8 .7 0\nv 0\nv 0\n"), "-o", at("p.obj"),
                               "-o", at("p.vtp"), "-o", at("p.ply"), "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "") << "Targets may repeat.";
    const std::string text = bytes("p.obj");
    const std::vector<double> lengths = numbers(text, "length"), sites = numbers(text, "site");
    ASSERT_EQ(lengths.size(), 4u) << text;
    EXPECT_NEAR(lengths[0], std::hypot(.4, .1), 1e-14);
    EXPECT_NEAR(lengths[1], std::hypot(.1, .2), 1e-14);
    EXPECT_NEAR(lengths[2], std::hypot(.1, .2), 1e-14);
    EXPECT_EQ(sites, (std::vector<double>{0, 1, 0, 0}));
    EXPECT_NE(bytes("p.vtp").find("Name=\"length\""), std::string::npos);
    EXPECT_NE(bytes("p.ply").find("property double length"), std::string::npos);
}

// A site of two points, a line that starts at .1, and a region.
TEST_F(AgvdPath, LeadsToGroupsLinesAndRegions) {
    const std::string sites = put("s",
                                  "p .1 .2 0 site 0\np .1 .8 0 site 0 start .05\n"
                                  "l 56 57 58 59 60 61 62 63 site 1 start .1\nr 84 85 site 2\n");
    const auto outcome =
        path({square(), "--sites", sites, "--targets",
              put("t", "p .15 .2 0\np .15 .75 0\np .95 .1 0\np .8 .05 0\np .97 .6 0\n"), "-o",
              at("p.obj"), "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string text = bytes("p.obj");
    const std::vector<double> lengths = numbers(text, "length"), sites_of = numbers(text, "site");
    ASSERT_EQ(lengths.size(), 5u) << text;
    EXPECT_EQ(sites_of, (std::vector<double>{0, 0, 2, 2, 1}));
    EXPECT_NEAR(lengths[0], .05, 1e-14);
    EXPECT_NEAR(lengths[1], std::sqrt(2) * .05, 1e-14);
    EXPECT_EQ(lengths[2], 0);
    EXPECT_NEAR(lengths[3], 6.0 / 7 - .8, 1e-14);
    EXPECT_NEAR(lengths[4], .03, 1e-14) << "without the start";
}

TEST_F(AgvdPath, LeadsFromPointToPointOfPairs) {
    const auto outcome =
        path({square(), "--pairs", put("t", "v 0\np 1 1 0\np .5 .3 0\np .5 .9 0\n"), "-o",
              at("p.obj"), "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<double> lengths = numbers(bytes("p.obj"), "length");
    ASSERT_EQ(lengths.size(), 2u);
    EXPECT_NEAR(lengths[0], std::sqrt(2), 1e-14);
    EXPECT_NEAR(lengths[1], .6, 1e-14);
}

TEST_F(AgvdPath, WarnsOfTargetsThatNoSiteReaches) {
    const std::string in =
        put("two.off", shapes::join(shapes::grid(2), shapes::moved(shapes::grid(2), {3, 0, 0})));
    const auto outcome = path({in, "--sites", put("s", "v 0\n"), "--targets",
                               put("t", "v 12\nv 4\n"), "-o", at("p.obj"), "-q"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("no site reaches 1 targets"), std::string::npos) << outcome.err;
    EXPECT_EQ(numbers(bytes("p.obj"), "length").size(), 1u);
    EXPECT_EQ(numbers(bytes("p.obj"), "line"), std::vector<double>{1});
}

TEST_F(AgvdPath, RefusesWhatItCannotDoAndWritesNothing) {
    const std::string in = square(), out = at("p.obj"), pair = put("t", "v 0\nv 1\nv 2\n");
    const std::string apart =
        put("two.off", shapes::join(shapes::grid(2), shapes::moved(shapes::grid(2), {3, 0, 0})));
    struct Case {
        std::vector<std::string> arguments;
        int exit_code;
        std::string text;
    };
    const std::vector<Case> cases{
        {{in, "-o", out}, 2, "--targets FILE"},
        {{in, "--pairs", pair, "--targets", pair, "-o", out}, 2, "--targets"},
        {{in, "--pairs", pair, "--sites", pair, "-o", out}, 2, "--sites"},
        {{in, "--pairs", pair, "-o", out}, 4, "the last of 3 points"},
        {{apart, "--pairs", put("u", "v 0\nv 12\n"), "-o", out}, 4, "pair 0"},
        {{in, "--targets", pair, "-o", at("p.off")}, 3, ".vtp, .obj or .ply"},
        {{in, "--targets", pair, "-o", out, "-o", out}, 2, "named twice"},
        {{in, "--targets", at("none"), "-o", out}, 3, "none"},
        {{in, "--targets", put("x", "v 999\n"), "-o", out}, 4, "999"},
    };
    for (const Case& c : cases) {
        const auto outcome = path(c.arguments);
        EXPECT_EQ(outcome.exit_code, c.exit_code) << outcome.err;
        EXPECT_NE(outcome.err.find(c.text), std::string::npos) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(out));
    }
    EXPECT_EQ(path({in, "--targets", pair, "-o", pair}).exit_code, 3);
}

}  // namespace
