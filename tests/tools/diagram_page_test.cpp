// What a page of a diagram shows: lines that lie where they should, cells of faces, figures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "based_diagram.h"
#include "diagram_for_page.h"
#include "support/shapes.h"

namespace {

using agvd::Vec3;

struct DrawnPage {
    page::DiagramPage page;
    agvd::Diagram diagram;
};

// Of the unit square with sites in the faces with these numbers, and lines and regions.
DrawnPage page_of_square(const std::vector<agvd::Index>& faces,
                         const std::vector<agvd::SiteShape>& shapes = {}) {
    static const agvd::TriangleMesh mesh = shapes::grid(16);
    const agvd::Surface surface = agvd::build_surface(mesh.view());
    std::vector<agvd::SurfacePoint> sites;
    for (const agvd::Index f : faces) sites.push_back({agvd::FaceId(f), {0.2, 0.5, 0.3}});
    const agvd::PropagationOptions exact{.shapes = shapes, .max_error = 0};
    const auto silent = [](const char*) { return agvd::Progress(); };
    cli::BasedDiagram based = cli::based_diagram(surface, sites, exact, silent);
    page::DiagramPage page =
        cli::diagram_for_page(surface, sites, based.diagram, exact, based.certified_error, silent);
    page.mesh = mesh.view();
    return {std::move(page), std::move(based.diagram)};
}

page::Json data_of(const DrawnPage& drawn) {
    const std::string html = page::format_page(drawn.page, drawn.diagram);
    const std::string begin = R"(id="page-data">)";
    const std::size_t at = html.find(begin) + begin.size();
    return page::Json::parse(html.substr(at, html.find("</script>", at) - at));
}

double nearest(const Vec3& point, const std::vector<Vec3>& sites) {
    double least = agvd::infinity;
    for (const Vec3& site : sites) least = std::min(least, (point - site).norm());
    return least;
}

TEST(DiagramPage, LinesAndRegionsAreShownByTheirEdges) {
    const auto [page, diagram] =
        page_of_square({70}, {{.faces = {300, 301}, .site = 1}, {.edges = {7, 7, 8}, .site = 2}});
    EXPECT_EQ(page.sites.size(), 1U);
    EXPECT_EQ(diagram.num_sites, 3U);
    // Both faces are a square: its four sides, not the diagonal.
    EXPECT_EQ(page.site_lines.lengths, std::vector<agvd::Index>(6, 2));
    ASSERT_EQ(page.site_lines.points.size(), 12U);
    const agvd::Surface surface = agvd::build_surface(page.mesh);
    double length = 4.0 / 16;
    for (const agvd::Index edge : {7, 8}) length += surface.length[edge];
    for (std::size_t i = 0; i < 12; i += 2) {
        length -= (page.site_lines.points[i] - page.site_lines.points[i + 1]).norm();
    }
    EXPECT_NEAR(length, 0, 1e-12);
    EXPECT_FALSE(page.bisectors.points.empty());
    EXPECT_FALSE(page.isolines.points.empty());
}

TEST(DiagramPage, LinesLieWhereDistancesAreEqualOrMultiplesOfTheStep) {
    const auto [page, diagram] = page_of_square({70, 333, 400});
    ASSERT_EQ(page.sites.size(), 3U);
    ASSERT_FALSE(page.bisectors.points.empty());
    for (const Vec3& point : page.bisectors.points) {
        std::vector<double> distances;
        for (const Vec3& site : page.sites) distances.push_back((point - site).norm());
        std::sort(distances.begin(), distances.end());
        EXPECT_NEAR(distances[0], distances[1], 1e-9);
    }
    ASSERT_GT(page.isoline_step, 0);
    double most = 0;
    for (const Vec3& point : page.isolines.points) {
        const double steps = nearest(point, page.sites) / page.isoline_step;
        EXPECT_NEAR(steps, std::round(steps), 1e-6);
        most = std::max(most, steps);
    }
    EXPECT_GE(most, 3);
    EXPECT_LE(most, 12.01);
}

TEST(DiagramPage, FacesOfSeveralCellsHaveNone) {
    const page::Json data = data_of(page_of_square({70, 333}));
    const page::Json& labels = data["original"]["labels"];
    EXPECT_TRUE(labels["has_none"].get<bool>());
    EXPECT_EQ(labels["count"], 3);
    const page::Json alone = data_of(page_of_square({70}));
    EXPECT_FALSE(alone["original"]["labels"]["has_none"].get<bool>());
}

TEST(DiagramPage, FiguresAreThoseOfTheDiagram) {
    const page::Json data = data_of(page_of_square({70, 333, 333}));
    const page::Json& figures = data["diagram"]["figures"];
    EXPECT_EQ(figures["sites"], 3);
    EXPECT_EQ(figures["empty_cells"], 1);
    EXPECT_EQ(figures["cells_that_are_no_discs"], 0);
    EXPECT_EQ(figures["unreached_vertices"], 0);
    EXPECT_NEAR(figures["area_square_mesh_units"].get<double>(), 1, 1e-12);
    EXPECT_NEAR(figures["mean_cell_area_square_mesh_units"].get<double>(), 0.5, 1e-12);
    EXPECT_NEAR(figures["least_cell_area_square_mesh_units"].get<double>() +
                    figures["largest_cell_area_square_mesh_units"].get<double>(),
                1, 1e-12);
    std::size_t neighbours = 0, cells = 0;
    const page::Json& counts = data["diagram"]["histograms"]["neighbours"]["counts"];
    for (std::size_t i = 0; i < counts.size(); ++i) {
        cells += counts[i].get<std::size_t>();
        neighbours += i * counts[i].get<std::size_t>();
    }
    EXPECT_EQ(cells, 2U);
    EXPECT_EQ(neighbours, 2U);
}

}  // namespace
