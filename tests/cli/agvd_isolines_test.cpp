// The subcommand `isolines` of the program `agvd` as a process.
#include <cmath>
#include <sstream>

#include "support/scratch.h"
#include "support/shapes.h"

namespace {

class AgvdIsolines : public Scratch {
protected:
    [[nodiscard]] static process::Outcome isolines(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "isolines");
        return run(AGVD_PROGRAM, std::move(arguments));
    }
    [[nodiscard]] std::string square() const { return put("in.off", shapes::grid(7)); }
    [[nodiscard]] std::string middle() const { return put("s", "p .5 .5 0\n"); }
};

TEST_F(AgvdIsolines, AreCirclesOnASquare) {
    const auto outcome =
        isolines({square(), "--sites", middle(), "--levels", ".2,.4", "--tolerance", "1e-4", "-o",
                  at("l.obj"), "-o", at("l.vtp"), "-o", at("l.ply"), "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::istringstream in(bytes("l.obj"));
    std::vector<agvd::Vec3> points;
    std::string word;
    double level = 0;
    int num_lines = 0;
    std::array<double, 2> lengths{};
    while (in >> word) {
        if (word == "v") {
            agvd::Vec3& p = points.emplace_back();
            in >> p.x() >> p.y() >> p.z();
        } else if (word == "level") {
            in >> level;
        } else if (word == "l") {
            ++num_lines;
            std::string rest;
            std::getline(in, rest);
            std::istringstream numbers(rest);
            agvd::Vec3 last(NAN, NAN, NAN);
            for (std::size_t i = 0; numbers >> i;) {
                const agvd::Vec3& p = points.at(i - 1);
                EXPECT_NEAR((p - agvd::Vec3(.5, .5, 0)).norm(), level, 1e-9);
                if (last.x() == last.x()) lengths.at(level < .3 ? 0 : 1) += (p - last).norm();
                last = p;
            }
        }
    }
    EXPECT_EQ(num_lines, 2);
    EXPECT_NEAR(lengths[0], 2 * M_PI * .2, 1e-2);
    EXPECT_NEAR(lengths[1], 2 * M_PI * .4, 1e-2);
    EXPECT_NE(bytes("l.vtp").find("Name=\"level\""), std::string::npos);
    EXPECT_NE(bytes("l.ply").find("property double level"), std::string::npos);
}

// Around a region in the corner and a point that starts at .1.
TEST_F(AgvdIsolines, AreAroundRegionsAndStarts) {
    const std::string sites = put("s", "p .5 .5 0 start .1\nr 0 1\n");
    const auto outcome = isolines({square(), "--sites", sites, "--levels", ".15", "--tolerance",
                                   "1e-4", "-o", at("l.obj"), "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::istringstream in(bytes("l.obj"));
    int num_around_point = 0, num_around_region = 0;
    for (std::string word; in >> word;) {
        if (word != "v") continue;
        agvd::Vec3 p;
        in >> p.x() >> p.y() >> p.z();
        const double to_point = (p - agvd::Vec3(.5, .5, 0)).norm();
        const double side = 1.0 / 7;
        const agvd::Vec3 beside(std::max(p.x() - side, 0.0), std::max(p.y() - side, 0.0), 0);
        const bool is_around_point = to_point < .06;
        EXPECT_NEAR(is_around_point ? to_point : beside.norm(), is_around_point ? .05 : .15, 1e-9);
        ++(is_around_point ? num_around_point : num_around_region);
    }
    EXPECT_GT(num_around_point, 8);
    EXPECT_GT(num_around_region, 8);
}

TEST_F(AgvdIsolines, ComeAtEachMultiple) {
    const auto outcome =
        isolines({square(), "--sites", middle(), "--every", ".1", "-o", at("l.obj")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find(" at 7 levels"), std::string::npos) << outcome.err;
    const std::string text = bytes("l.obj");
    for (const char* level : {" level 0.1\n", " level 0.5\n", " level 0.7"}) {
        EXPECT_NE(text.find(level), std::string::npos) << level;
    }
}

TEST_F(AgvdIsolines, RefuseWhatTheyCannotDoAndWriteNothing) {
    const std::string in = square(), sites = middle(), out = at("l.obj");
    struct Case {
        std::vector<std::string> arguments;
        int exit_code;
        std::string text;
    };
    const std::vector<Case> cases{
        {{in, "--sites", sites, "-o", out}, 2, "--levels"},
        {{in, "--sites", sites, "--levels", "1,-2", "-o", out}, 2, "-2"},
        {{in, "--sites", sites, "--levels", "1", "--every", "1", "-o", out}, 2, "--every"},
        {{in, "--sites", sites, "--every", "1e-9", "-o", out}, 2, "use a larger number"},
        {{in, "--sites", sites, "--levels", "1", "--tolerance", "0", "-o", out}, 2, "above 0"},
        {{in, "--sites", sites, "--levels", "1", "-o", at("l.off")}, 3, ".vtp, .obj or .ply"},
        {{in, "--sites", at("none"), "--levels", "1", "-o", out}, 3, "none"},
    };
    for (const Case& c : cases) {
        const auto outcome = isolines(c.arguments);
        EXPECT_EQ(outcome.exit_code, c.exit_code) << outcome.err;
        EXPECT_NE(outcome.err.find(c.text), std::string::npos) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(out));
    }
}

}  // namespace
