// The program `remesh`: what it says, and where.
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "cli/remesh_program.h"
#include "support/shapes.h"

namespace {

TEST_F(Remesh, QuietSaysNothing) {
    const std::string in = put("in.off", shapes::sphere(3));
    const auto outcome = remesh({in, at("out.off"), "-n", "50", "-q"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
}

// Of what was written to a terminal: each drawing of the bar without its end.
std::vector<std::string> drawings(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line, '\r');) {
        if (line.starts_with("\x1b[K")) line.erase(0, 3);
        if (line.starts_with('[')) lines.push_back(line);
    }
    return lines;
}

TEST_F(Remesh, ATerminalGetsABarOfTheWholeRunThatNeverFalls) {
    const std::string in = put("in.ply", shapes::torus(200, 100));
    for (const unsigned short columns : std::array<unsigned short, 2>{50, 100}) {
        const auto outcome = remesh({in, at("out.ply"), "-n", "3000"}, {.columns = columns});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        int last = -1;
        for (const std::string& line : drawings(outcome.err)) {
            EXPECT_LT(line.size(), columns) << line;
            const std::size_t at = line.find(']');
            ASSERT_NE(at, std::string::npos) << line;
            const int percent = std::stoi(line.substr(at + 1));
            EXPECT_GE(percent, last) << line;
            last = percent;
        }
        EXPECT_GE(last, 50);
        // The last drawing is removed, and the report stands alone.
        EXPECT_NE(outcome.err.find("\r\x1b[Kinput: "), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.err.rfind('['), outcome.err.rfind("[Kinput: "));
    }
}

TEST_F(Remesh, NoBarIsDrawnIfNobodySeesIt) {
    const std::string in = put("in.ply", shapes::torus(60, 30));
    EXPECT_EQ(remesh({in, at("out.ply"), "-n", "300"}).err.find('\r'), std::string::npos);
    EXPECT_EQ(remesh({in, at("out.ply"), "-n", "300", "-q"}, {.columns = 80}).err, "");
}

TEST_F(Remesh, OtherProgramsGetProgressAsLinesOfJson) {
    const std::string in = put("in.ply", shapes::torus(200, 100));
    const auto outcome = remesh({in, at("out.ply"), "-n", "3000", "--progress", "json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::istringstream lines(outcome.err);
    double last = 0;
    int count = 0;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with('{')) continue;
        const auto state = nlohmann::json::parse(line);
        EXPECT_GE(state["progress"], last) << line;
        EXPECT_LE(state["progress"], 1) << line;
        EXPECT_FALSE(state["stage"].get<std::string>().empty()) << line;
        last = state["progress"];
        ++count;
    }
    EXPECT_GE(last, 0.5);
    EXPECT_GE(count, 3);
    EXPECT_NE(outcome.err.find("\ninput: "), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find('\r'), std::string::npos) << outcome.err;
    // The other messages stay away with --quiet.
    const auto quiet = remesh({in, at("out.ply"), "-n", "3000", "-q", "--progress", "json"});
    EXPECT_EQ(quiet.err.rfind('{', 0), 0u) << quiet.err;
    EXPECT_EQ(quiet.err.find("input: "), std::string::npos) << quiet.err;
}

TEST_F(Remesh, VerboseTellsTimeMemoryAndWorkOfEachStage) {
    const std::string in = put("in.ply", shapes::torus(60, 30));
    const auto verbose = [&](const char* threads) {
        const auto outcome = remesh(
            {in, at("out.ply"), "-n", "300", "-t", threads, "--map", at("map"), "--verbose"});
        EXPECT_EQ(outcome.exit_code, 0);
        // Times and memory are left out.
        static const std::regex figures(
            " *[0-9]+[.][0-9][0-9] s\\b|memory peak [0-9.]+[KMG]|[0-9]+ bytes");
        return std::regex_replace(outcome.err, figures, "");
    };
    const std::string text = verbose("1");
    for (const char* line :
         {"\nread:, \n", "\nclean:, \n", "\nrelax:, \n", "\ncheck:, \n", "\ntransfer:, \n",
          "\nwrite:, \n", "\nclean  3600 faces, 3600 when cleaned, ", "; repaired: nothing; ",
          "\nsample  300 samples asked for\n", " sites, 60 steps, energy 1 ",
          "\ndual  300 of 300 sites with the triangles of their cells; cells that are no discs, or "
          "meet others along several arcs: 0; parts simplified: 0; sites dropped: 0\n",
          " flips, ", "\nplace  300 vertices, 600 faces\n",
          " in the input; 0 vertices moved back\n"}) {
        EXPECT_NE(text.find(line), std::string::npos) << line << " is missing in\n" << text;
    }
    const auto details = [](const std::string& all) {
        const std::size_t begin = all.find("\nclean  ");
        return all.substr(begin, all.find("\ntransfer:") - begin);
    };
    EXPECT_EQ(details(verbose("2")), details(text));
}

TEST_F(Remesh, WordsOfTheMethodComeWithVerboseOnly) {
    const std::string in = put("in.off", shapes::cube());
    std::vector<std::string> words{in, at("out.off"), "-n", "100", "--max-error", ".01"};
    const std::string brief = remesh(words).err;
    words.emplace_back("--verbose");
    const std::string verbose = remesh(words).err;
    for (const char* word : {"creases and boundary: 12 curves", "relaxation: ", "Delaunay",
                             "window engine", "genus 0", "propagation memory"}) {
        EXPECT_EQ(brief.find(word), std::string::npos) << word << " in\n" << brief;
        EXPECT_NE(verbose.find(word), std::string::npos) << word << " is missing in\n" << verbose;
    }
    for (const std::string* text : {&brief, &verbose}) {
        EXPECT_NE(text->find("\ntriangles: even, smallest angle "), std::string::npos) << *text;
        EXPECT_NE(text->find("\ndistance: farthest at least 0 % of the size"), std::string::npos)
            << *text;
        EXPECT_NE(text->find("\ntoo small for edges of "), std::string::npos) << *text;
    }
}

TEST_F(Remesh, HelpHasEightyColumnsWithoutATerminal) {
    const auto longest = [](const std::string& text) {
        std::istringstream lines(text);
        std::size_t most = 0;
        for (std::string line; std::getline(lines, line);) most = std::max(most, line.size());
        return most;
    };
    EXPECT_LE(longest(remesh({"--help"}).out), 80u);
    EXPECT_GE(longest(remesh({"--help"}).out), 75u);
}

TEST_F(Remesh, HelpAndVersionGoToStdout) {
    const auto help = remesh({"--help"});
    EXPECT_EQ(help.exit_code, 0);
    for (const char* text : {"Examples", "Exit codes", "--samples", "--report", "--engine",
                             "--max-error", "--delaunay", "window", "steiner"}) {
        EXPECT_NE(help.out.find(text), std::string::npos) << text;
    }
    EXPECT_EQ(remesh({"--version"}).out.rfind("remesh ", 0), 0u);
}

}  // namespace
