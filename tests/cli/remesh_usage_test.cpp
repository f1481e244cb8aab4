// The program `remesh`: what it says of options that do not fit, in the words of its command line.
#include <regex>

#include "cli/remesh_program.h"
#include "support/shapes.h"

namespace {

class RemeshUsage : public Remesh {
protected:
    // What it says, after "remesh: error: ".
    [[nodiscard]] std::string error_of(const std::vector<std::string>& options, int exit_code = 2) {
        std::vector<std::string> arguments{put("in.off", shapes::cube()), at("out.off")};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto outcome = remesh(arguments);
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
        const std::string begin = "remesh: error: ";
        const std::size_t at = outcome.err.find(begin);
        return at == std::string::npos ? "" : outcome.err.substr(at + begin.size());
    }
};

TEST_F(RemeshUsage, AnUnknownOptionIsToldWithTheNearestOne) {
    for (const char* option : {"--edgelength", "--edge-lenght=3", "-edge-length", "--edge"}) {
        const std::string text = error_of({"-n", "100", option});
        const std::string name = std::string(option).substr(0, std::string(option).find('='));
        EXPECT_EQ(text, "there is no option " + name +
                            " (did you mean --edge-length?); see remesh --help\n");
    }
    EXPECT_EQ(error_of({"--colour"}), "there is no option --colour; see remesh --help\n");
}

TEST_F(RemeshUsage, AFolderIsNoMesh) {
    const std::string folder = at("");
    for (const auto& outcome :
         {remesh({folder, at("out.off")}), remesh({put("in.off", shapes::cube()), folder})}) {
        EXPECT_EQ(outcome.exit_code, 3);
        EXPECT_EQ(outcome.err, "remesh: error: " + folder + ": is a folder; name a file\n");
    }
}

TEST_F(RemeshUsage, AFileWithoutPropertiesHasNoneToUse) {
    EXPECT_EQ(error_of({"--sizing", "q"}),
              "--sizing: " + at("in.off") +
                  " has no vertex property 'q', nor any other; use a file that has it\n");
}

TEST_F(RemeshUsage, OptionsOfTheLibraryHaveTheNamesOfTheProgram) {
    const agvd::TriangleMesh two =
        shapes::join(shapes::cube(), shapes::moved(shapes::cube(), {3, 0, 0}));
    const auto outcome = remesh({put("two.off", two), at("out.off"), "--drop-components", "60"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("; use a smaller --drop-components\n"), std::string::npos)
        << outcome.err;
}

TEST_F(RemeshUsage, StrictTellsHowManySamplesWouldDo) {
    const agvd::TriangleMesh far =
        shapes::join(shapes::sphere(3), shapes::moved(shapes::sphere(1), {9, 0, 0}));
    const std::string in = put("two.off", far);
    const auto refused = remesh({in, at("out.off"), "-n", "16", "--strict"});
    EXPECT_EQ(refused.exit_code, 5) << refused.err;
    EXPECT_NE(refused.err.find(
                  "components; use more --samples (about 24 would do), or leave out --strict\n"),
              std::string::npos)
        << refused.err;
    EXPECT_EQ(remesh({in, at("out.off"), "-n", "24", "--strict"}).exit_code, 0);
}

TEST_F(RemeshUsage, ValuesThatCannotBeTakenAreRefused) {
    const std::string seeds =
        "; use a whole number from 0 to 18446744073709551615; see remesh --help\n";
    EXPECT_EQ(error_of({"--seed", "-1"}), "--seed: the seed is -1" + seeds);
    EXPECT_EQ(error_of({"--seed", "18446744073709551616"}),
              "--seed: the seed is 18446744073709551616" + seeds);
    EXPECT_EQ(error_of({"--faces", "100.5"}),
              "--faces: the number is 100.5; use a whole number above 0, such as 2000 or 1e4; see "
              "remesh --help\n");
    EXPECT_EQ(error_of({"-n", "100", "--seed", "18446744073709551615"}, 0), "");
}

TEST_F(RemeshUsage, OptionsThatContradictEachOtherAreRefused) {
    EXPECT_NE(error_of({"--fit", "--no-fit"}).find("fit excludes --"), std::string::npos);
    for (const char* option : {"--steiner-points", "--lambda"}) {
        EXPECT_EQ(error_of({"-n", "50", option, "3"}),
                  std::string(option) +
                      ": only the Steiner engine has it; add --engine steiner, or leave it out; "
                      "see remesh --help\n");
        EXPECT_EQ(error_of({"-n", "50", option, "3", "--engine", "steiner"}, 0), "");
    }
}

TEST_F(RemeshUsage, WhatIsNotThereIsNotRefused) {
    const auto outcome = remesh({put("plate.off", shapes::grid(4)), at("out.off"), "-n", "50",
                                 "--junctions", "keep", "--boundary", "free"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
}

TEST_F(RemeshUsage, ANameOfLabelsNeedsAnEqualsSign) {
    EXPECT_EQ(error_of({"--keep-labels", "material"}),
              "'material' has no extension of a mesh; if it names labels, write "
              "--keep-labels=material\n");
}

// A length or number that the message names works.
TEST_F(RemeshUsage, TooLongEdgesAndTooFewFacesAreToldInLengthsAndFaces) {
    const std::string in = put("torus.off", shapes::torus(40, 20));
    const auto expect_advice = [&](const std::string& option, const std::string& value,
                                   const std::string& begin, const std::string& end) {
        const auto refused = remesh({in, at("out.off"), option, value});
        EXPECT_EQ(refused.exit_code, 5) << refused.err;
        std::smatch match;
        const std::regex advice(in + ": " + begin + "([0-9.]+)" + end + '\n');
        ASSERT_TRUE(std::regex_search(refused.err, match, advice)) << refused.err;
        const auto taken = remesh({in, at("out.off"), option, match[1].str()});
        EXPECT_EQ(taken.exit_code, 0) << refused.err << taken.err;
    };
    const std::string what = " for the topology of the mesh; use ";
    expect_advice("--edge-length", "50", "an edge length of 50 is too long" + what + "at most ",
                  "");
    expect_advice("--faces", "2", "2 faces are too few" + what, " faces");
}

}  // namespace
