// `agvd diagram --picture`: what is drawn where.
#include <png.h>

#include <cmath>
#include <regex>

#include "support/scratch.h"
#include "support/shapes.h"

namespace {

using agvd::Vec2;

class AgvdPicture : public Scratch {
protected:
    process::Outcome draw(const agvd::TriangleMesh& mesh, const std::string& sites,
                          const std::string& picture, const std::string& view) {
        return run(AGVD_PROGRAM, {"diagram", put("in.off", mesh), "--sites", put("s", sites), "-q",
                                  "--picture", at(picture), "--view", view});
    }
    // The numbers of all matches of a pattern with two groups.
    static std::vector<Vec2> pairs(const std::string& text, const char* pattern) {
        std::vector<Vec2> found;
        const std::regex regex(pattern);
        for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) {
            found.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
        }
        return found;
    }
    // The points of a path of p.svg, or those where lines of it begin.
    [[nodiscard]] std::vector<Vec2> path(const std::string& id,
                                         const std::string& letters = "ML") const {
        const std::string svg = bytes("p.svg");
        const std::size_t begin = svg.find(" d=\"", svg.find("<path id=\"" + id + '"'));
        return pairs(svg.substr(begin, svg.find("/>", begin) - begin),
                     ("[" + letters + "]([0-9.]+) ([0-9.]+)").c_str());
    }
    [[nodiscard]] std::vector<Vec2> circles() const {
        return pairs(bytes("p.svg"), "cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"");
    }
};

// The unit square with two sites, seen from above: it is 846 pixels wide.
TEST_F(AgvdPicture, CurvesStandWhereTheyAre) {
    const auto outcome = draw(shapes::grid(8), "p .25 .5 0\np .75 .5 0\n", "p.svg", "0,0,0");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<Vec2> bisector = path("bisectors");
    ASSERT_EQ(bisector.size(), 2u);
    for (const Vec2& p : bisector) EXPECT_NEAR(p.x(), 600, 0.01);
    EXPECT_NEAR(std::abs(bisector[0].y() - bisector[1].y()), 846, 0.01);
    const std::vector<Vec2> sites = circles();
    ASSERT_EQ(sites.size(), 2u);
    EXPECT_LT((sites[0] - Vec2(600 - 846 * 0.25, 450)).norm(), 0.02);
    EXPECT_LT((sites[1] - Vec2(600 + 846 * 0.25, 450)).norm(), 0.02);

    // Lines of equal distance. The largest one, that of the corners, is sqrt(5) / 4 = 0.559.
    const std::vector<Vec2> points = path("isolines");
    EXPECT_LE(path("isolines", "M").size(), 4 * 11u) << "lines are drawn in one go";
    std::array<int, 12> count{};
    for (const Vec2& pixel : points) {
        const Vec2 p = (pixel - Vec2(600, 450)) / 846;
        const double distance = (p.cwiseAbs() - Vec2(0.25, 0)).norm();
        const long level = std::lround(distance / 0.05);
        EXPECT_NEAR(distance, 0.05 * static_cast<double>(level), 3e-4);
        ++count.at(static_cast<std::size_t>(level));
    }
    for (std::size_t level = 1; level < count.size(); ++level) EXPECT_GT(count[level], 3) << level;
}

TEST_F(AgvdPicture, LinesAreDrawnAsLines) {
    const agvd::TriangleMesh square = shapes::grid(8);
    std::string line = "l";
    for (std::size_t v = 0; v < square.positions.size(); ++v) {
        if (square.positions[v].x() == 0.5) line += ' ' + std::to_string(v);
    }
    const auto outcome = draw(square, "p .1 .5 0\n" + line + "\n", "p.svg", "0,0,0");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const char* id : {"site_lines", "site_line_rims"}) {
        const std::vector<Vec2> drawn = path(id);
        ASSERT_FALSE(drawn.empty());
        for (const Vec2& p : drawn) EXPECT_NEAR(p.x(), 600, 0.01);
    }
    EXPECT_EQ(circles().size(), 1u);
}

// Turned about y by -60 degrees, x = 1 and z = 1 are in front.
TEST_F(AgvdPicture, WhatLiesBehindIsHidden) {
    const auto outcome =
        draw(shapes::sphere(3), "p 0 0 1\np 1 0 0\np 0 0 -1\np -1 0 0\n", "p.svg", "0,-60,0");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<Vec2> sites = circles();
    ASSERT_EQ(sites.size(), 2u);
    EXPECT_LT(sites[0].x(), 600 - 300) << "z = 1";
    EXPECT_GT(sites[1].x(), 600 + 100) << "x = 1";
    EXPECT_LT(sites[1].x(), 600 + 300) << "x = 1";
    EXPECT_NEAR(sites[0].y(), 450, 1);
}

// Lines on the lower of two sheets do not shine through.
TEST_F(AgvdPicture, LinesBehindAThinSheetAreHidden) {
    const agvd::TriangleMesh above = shapes::grid(8);
    const agvd::TriangleMesh below = shapes::moved(above, {0, 0, -1e-3});
    const auto outcome =
        draw(shapes::join(above, below), "p .25 .5 0\np .75 .5 0\np .5 .25 -.001\np .5 .75 -.001\n",
             "p.svg", "0,0,0");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<Vec2> both = path("bisectors");
    double length_across = 0;
    for (std::size_t i = 0; i + 1 < both.size(); i += 2) {
        length_across += std::abs(both[i].x() - both[i + 1].x());
    }
    EXPECT_LT(length_across, 2) << "at the rim of the upper sheet";
    EXPECT_EQ(circles().size(), 2u);
}

// The bisector is dark, lines of equal distance are bright, and the cells have two colours.
TEST_F(AgvdPicture, CellsHaveColoursOfTheirOwn) {
    ASSERT_EQ(draw(shapes::grid(8), "p .25 .5 0\np .75 .5 0\n", "p.png", "0,0,0").exit_code, 0);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_file(&image, at("p.png").c_str()), 0);
    ASSERT_EQ(image.width, 1200u);
    ASSERT_EQ(image.height, 900u);
    image.format = PNG_FORMAT_RGB;
    std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
    ASSERT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
    const auto color = [&](double x, double y) {
        const auto column = static_cast<std::size_t>(600 + 846 * (x - 0.5));
        const auto row = static_cast<std::size_t>(450 - 846 * (y - 0.5));
        const png_byte* const at = &pixels[3 * (row * 1200 + column)];
        return Eigen::Vector3i(at[0], at[1], at[2]);
    };
    // Between two lines.
    const Eigen::Vector3i left = color(0.25 + 0.125, 0.5), right = color(0.75 + 0.125, 0.5);
    EXPECT_GT((left - right).norm(), 60);
    EXPECT_LT((left - color(0.25, 0.5 + 0.125)).norm(), 10);
    EXPECT_LT((right - color(0.75, 0.5 + 0.125)).norm(), 10);
    EXPECT_LT(color(0.5, 0.45).maxCoeff(), 60) << "the bisector";
    EXPECT_GT(color(0.25, 0.65).minCoeff(), 150) << "a line";
    EXPECT_LT(color(0.25, 0.5).maxCoeff(), 60) << "a site";
    EXPECT_EQ(color(-0.1, 0.5).minCoeff(), 255) << "beside the mesh";
}

TEST_F(AgvdPicture, PngAndSvgAlone) {
    const auto outcome = draw(shapes::grid(2), "v 0\n", "p.jpg", "0,0,0");
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_NE(outcome.err.find("p.jpg: pictures are .png or .svg"), std::string::npos)
        << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(at("p.jpg")));
    const std::string in = at("in.off"), old = bytes("in.off");
    EXPECT_EQ(
        run(AGVD_PROGRAM, {"diagram", in, "-n", "1", "--picture", at("p.png"), "-o", at("p.png")})
            .exit_code,
        2);
    EXPECT_EQ(run(AGVD_PROGRAM, {"diagram", in, "-n", "1", "--view", "0,0,0", "-o", at("d.obj")})
                  .exit_code,
              2)
        << "a view of no picture";
    EXPECT_EQ(bytes("in.off"), old);
}

}  // namespace
