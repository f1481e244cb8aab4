// --html and --picture of `remesh` and `remesh-eval` as processes. What the page shows is tested in
// tests/browser.
#include "cli/remesh_program.h"
#include "support/shapes.h"

namespace {

class Pages : public Remesh {
protected:
    void SetUp() override {
        Remesh::SetUp();
        in_ = put("in.off", shapes::sphere(2));
    }
    // For tests that need the viewer.
    [[nodiscard]] bool has_viewer() {
        const auto outcome =
            remesh({in_, at("try.ply"), "-n", "50", "-q", "--html", at("try.html")});
        if (outcome.exit_code == 0) return true;
        EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
        EXPECT_NE(outcome.err.find("nodejs npm"), std::string::npos) << outcome.err;
        EXPECT_FALSE(exists("try.html") || exists("try.ply"));
        return false;
    }
    [[nodiscard]] bool exists(const std::string& name) const {
        return std::filesystem::exists(at(name));
    }
    std::string in_;
};

TEST_F(Pages, SamePageForAnyNumberOfThreads) {
    if (!has_viewer()) GTEST_SKIP() << "built without the viewer";
    const auto page = [&](const char* threads) {
        const auto outcome = remesh(
            {in_, at("out.ply"), "-n", "60", "-q", "-t", threads, "--html", at("page.html")});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        // The command line tells the number.
        std::string html = bytes("page.html");
        const std::string told = std::string("-t ") + threads;
        const std::size_t found = html.find(told);
        EXPECT_NE(found, std::string::npos);
        return html.erase(found, told.size());
    };
    const std::string first = page("1");
    EXPECT_EQ(first.rfind("<!doctype html>", 0), 0U);
    EXPECT_EQ(first, page("2"));
}

TEST_F(Pages, OverheadIsBelow700Kilobytes) {
    if (!has_viewer()) GTEST_SKIP() << "built without the viewer";
    EXPECT_LT(bytes("try.html").size(), 700'000U);
}

TEST_F(Pages, PictureIsAPng) {
    const auto outcome = remesh({in_, at("out.ply"), "-n", "60", "-q", "--picture", at("p.png")});
    if (outcome.exit_code == 2 && outcome.err.find("libpng") != std::string::npos) {
        GTEST_SKIP() << "built without libpng";
    }
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(bytes("p.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
    const auto judged = run(REMESH_EVAL_PROGRAM, {in_, at("out.ply"), "--picture", at("q.png")});
    EXPECT_EQ(judged.exit_code, 0) << judged.err;
    EXPECT_EQ(bytes("p.png"), bytes("q.png"));
}

TEST_F(Pages, AllFilesThatWereWrittenAreListed) {
    const std::string out = at("out.ply"), cells = at("cells.ply");
    const auto expect_listed = [](const auto& outcome, const std::string& file) {
        EXPECT_NE(outcome.err.find("written: " + file + '\n'), std::string::npos) << outcome.err;
    };
    std::vector<std::string> more{at("map.txt"), at("report.json")};
    std::vector<std::string> options{in_, out, "-n", "60", "--map", more[0], "--report", more[1]};
    if (has_viewer()) {
        more.push_back(at("a.html"));
        options.insert(options.end(), {"--html", more.back()});
    }
    const auto outcome = remesh(options);
    expect_listed(outcome, out);
    for (const std::string& file : more) expect_listed(outcome, file);
    const auto diagram =
        run(AGVD_PROGRAM, {"diagram", in_, "-n", "9", "-o", out, "--cells", cells});
    expect_listed(diagram, out);
    expect_listed(diagram, cells);
}

TEST_F(Pages, APageIsNoPdf) {
    for (const auto& outcome :
         {remesh({in_, at("out.ply"), "-n", "60", "--html", at("x.pdf")}),
          run(AGVD_PROGRAM, {"diagram", in_, "-n", "9", "-o", at("a.ply"), "--html", at("x.pdf")}),
          run(REMESH_EVAL_PROGRAM, {in_, in_, "--html", at("x.pdf")})}) {
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_NE(outcome.err.find("name it .html"), std::string::npos) << outcome.err;
    }
    EXPECT_FALSE(exists("out.ply") || exists("a.ply") || exists("x.pdf"));
}

TEST_F(Pages, LevelsHaveAPageEach) {
    if (!has_viewer()) GTEST_SKIP() << "built without the viewer";
    const auto outcome =
        remesh({in_, at("out.ply"), "--levels", "60,30", "-q", "--html", at("p.html")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(exists("p-0.html") && exists("p-1.html") && !exists("p.html"));
}

TEST_F(Pages, NoInputIsOverwrittenAndNoFileIsNamedTwice) {
    if (!has_viewer()) GTEST_SKIP() << "built without the viewer";
    const std::string old = bytes("in.off");
    const std::string out = at("out.ply"), html = at("a.html");
    EXPECT_EQ(remesh({in_, out, "-n", "60", "--html", in_}).exit_code, 2);
    EXPECT_EQ(remesh({in_, out, "-n", "60", "--html", out}).exit_code, 2);
    EXPECT_EQ(remesh({in_, out, "-n", "60", "--html", html, "--report", html}).exit_code, 2);
    EXPECT_EQ(remesh({in_, out, "-n", "60", "--html", "-"}).exit_code, 2);
    EXPECT_EQ(remesh({in_, out, "-n", "60", "--html", at("no/a.html")}).exit_code, 3);
    EXPECT_EQ(remesh({in_, "--out-dir", at("dir"), "-n", "60", "--html", html}).exit_code, 2);
    EXPECT_EQ(run(REMESH_EVAL_PROGRAM, {in_, in_, "--html", in_}).exit_code, 2);
    EXPECT_EQ(run(REMESH_EVAL_PROGRAM, {in_, in_, "--html", html, "--json", html}).exit_code, 2);
    EXPECT_EQ(bytes("in.off"), old);
    EXPECT_FALSE(exists("out.ply") || exists("a.html"));
}

// Nothing is written if the run fails.
TEST_F(Pages, AFailedRunWritesNoPage) {
    if (!has_viewer()) GTEST_SKIP() << "built without the viewer";
    EXPECT_EQ(remesh({in_, at("out.ply"), "-n", "1", "--html", at("a.html")}).exit_code, 5);
    EXPECT_FALSE(exists("out.ply") || exists("a.html"));
}

}  // namespace
