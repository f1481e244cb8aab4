// The order in which stages report to the progress callback, and their fractions.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "remesh/pipeline/remesh.h"
#include "support/damages.h"
#include "support/shapes.h"

namespace {

using agvd::TriangleMesh;
using remesh::Stage;

struct Report {
    Stage stage;
    double fraction;
};

std::vector<Report> reports_of(const TriangleMesh& mesh, remesh::RemeshOptions options) {
    std::vector<Report> reports;
    options.num_threads = 1;
    options.progress = [&](Stage stage, double fraction) {
        reports.push_back({stage, fraction});
        return true;
    };
    static_cast<void>(remesh::remesh(mesh.view(), options));
    return reports;
}

// The first of the reports from `begin` on that comes from this stage.
auto first_of(const std::vector<Report>& reports, Stage stage, std::ptrdiff_t begin = 0) {
    return std::find_if(reports.begin() + begin, reports.end(),
                        [&](const Report& report) { return report.stage == stage; }) -
           reports.begin();
}

TEST(Stages, CleaningReportsWhatIsDoneOfThePreparation) {
    const std::vector<Report> reports =
        reports_of(shapes::jitter(shapes::sphere(5), 1e-4, 1), {.num_samples = 500});
    double last = 0;
    std::vector<double> fractions;
    for (const auto& [stage, fraction] : reports) {
        if (stage != Stage::Clean) break;
        EXPECT_GE(fraction, last);
        if (fractions.empty() || fraction > last) fractions.push_back(fraction);
        last = fraction;
    }
    EXPECT_GE(fractions.size(), 6u);
    EXPECT_GE(last, 0.9);
}

TEST(Stages, ADistanceIsCheckedOnlyOnceThereIsAResult) {
    const std::vector<Report> reports =
        reports_of(shapes::sphere(3), {.sizing = {.count = remesh::MaxDistance{0.05}}});
    EXPECT_LT(first_of(reports, Stage::Place), first_of(reports, Stage::Check));
}

TEST(Stages, ARegionIsCleanedOnlyOnceAndCheckedLast) {
    const TriangleMesh mesh = shapes::sphere(4);
    std::vector<std::uint8_t> region(mesh.triangles.size(), 0);
    std::fill_n(region.begin(), region.size() / 2, std::uint8_t{1});
    const std::vector<Report> reports = reports_of(mesh, {.num_samples = 300, .region = region});
    const auto relaxed = first_of(reports, Stage::Relax);
    ASSERT_LT(relaxed, static_cast<std::ptrdiff_t>(reports.size()));
    EXPECT_EQ(first_of(reports, Stage::Clean, relaxed),
              static_cast<std::ptrdiff_t>(reports.size()));
    EXPECT_EQ(reports.back().stage, Stage::Check);
}

TEST(Stages, AMeshWithManyJunctionsTakesFewAttempts) {
    Dice dice(4);
    const TriangleMesh walls = damages::apply("walls", shapes::sphere(3), dice);
    const TriangleMesh mesh = damages::apply("sheets", walls, dice);
    remesh::RemeshOptions options{.num_samples = 150};
    Stage last = Stage::Clean;
    int num_attempts = 0;
    options.progress = [&](Stage stage, double) {
        if (stage == Stage::Propagate && last == Stage::Relax) ++num_attempts;
        last = stage;
        return true;
    };
    const remesh::RemeshResult result = remesh::remesh(mesh.view(), options);
    EXPECT_LE(num_attempts, 4);
    EXPECT_EQ(result.junctions.edges, 12U);
    EXPECT_EQ(result.junctions.apart_edges, 0U);
}

}  // namespace
