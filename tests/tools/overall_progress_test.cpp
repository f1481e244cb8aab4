#include "overall_progress.h"

#include <gtest/gtest.h>

#include "expected_stages.h"
#include "progress_bar.h"

namespace {

using cli::ExpectedStage;
using cli::OverallProgress;
using cli::Runs;

const std::vector<ExpectedStage> stages{{"clean", 1, true}, {"relax", 2}, {"check", 1}};

// After these calls.
double fraction_after(OverallProgress& progress,
                      const std::vector<std::pair<const char*, double>>& calls) {
    double last = progress.fraction();
    for (const auto& [stage, fraction] : calls) {
        progress.update(stage, fraction);
        EXPECT_GE(progress.fraction(), last) << stage << ' ' << fraction;
        last = progress.fraction();
    }
    return last;
}

TEST(OverallProgress, StagesCountByTheirWork) {
    OverallProgress progress;
    progress.expect(stages);
    EXPECT_EQ(progress.fraction(), 0);
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"clean", 0.5}}), 0.125);
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"clean", 1}, {"relax", 0}}), 0.25);
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"relax", 0.5}}), 0.5);
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"check", 1}}), 1);
    EXPECT_EQ(progress.run(), 1);
}

TEST(OverallProgress, NeverFalls) {
    OverallProgress progress;
    progress.expect(stages);
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"relax", 0.5}, {"relax", 0.25}}), 0.5);
    fraction_after(progress,
                   {{"clean", 0}, {"check", 1}, {"relax", 0}, {"clean", 1}, {"check", 1}});
    EXPECT_LE(progress.fraction(), 1);
}

TEST(OverallProgress, WhatComesAgainSharesWhatIsLeft) {
    OverallProgress progress;
    progress.expect(stages);
    fraction_after(progress, {{"check", 0}});  // 0.75 is done.
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"relax", 0}}), 0.75);
    EXPECT_EQ(progress.run(), 1) << "no run begins with relaxation";
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"relax", 1}}), 0.75 + 0.25 * 2 / 3);
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"check", 1}}), 1);
}

TEST(OverallProgress, CountsRuns) {
    OverallProgress progress;
    progress.expect(stages);
    fraction_after(progress, {{"check", 0.5}, {"clean", 0}});
    EXPECT_EQ(progress.run(), 2);
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"relax", 0.5}}), 0.875 + 0.125 / 2);
}

TEST(OverallProgress, ToldThatRunsAreUnknownItKeepsHalfForTheNext) {
    OverallProgress progress;
    progress.expect(stages, Runs::Unknown);
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"check", 1}}), 0.5);
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"relax", 0}, {"check", 1}}), 0.5) << "no new run";
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"clean", 0}, {"check", 1}}), 0.75);
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"clean", 0}, {"check", 1}}), 0.875);
    EXPECT_EQ(progress.run(), 3);
    EXPECT_FALSE(progress.left_over_done());
}

TEST(OverallProgress, TellsWhatIsLeftOverWhatIsDone) {
    OverallProgress progress;
    EXPECT_FALSE(progress.left_over_done());
    progress.expect(stages);
    EXPECT_FALSE(progress.left_over_done());
    progress.update("clean", 0.04);  // 1 % is too little.
    EXPECT_FALSE(progress.left_over_done());
    progress.update("clean", 1);
    EXPECT_DOUBLE_EQ(progress.left_over_done().value(), 3);
    progress.update("check", 0);
    progress.update("relax", 0);  // Again: 3/4 done, 3/4 left.
    EXPECT_DOUBLE_EQ(progress.left_over_done().value(), 1);
    progress.update("check", 1);
    EXPECT_DOUBLE_EQ(progress.left_over_done().value(), 0);
}

TEST(OverallProgress, NewExpectationsShareWhatIsLeft) {
    OverallProgress progress;
    progress.expect({{"read", 1}, {"rest", 9}});
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"read", 1}}), 0.1);
    progress.expect(stages);
    EXPECT_DOUBLE_EQ(progress.fraction(), 0.1);
    EXPECT_DOUBLE_EQ(fraction_after(progress, {{"relax", 0.5}}), 0.55);
    EXPECT_DOUBLE_EQ(progress.left_over_done().value(), 1);
    EXPECT_EQ(progress.run(), 1);
}

TEST(OverallProgress, UnexpectedStagesChangeNothing) {
    OverallProgress progress;
    progress.update("clean", 1);
    EXPECT_EQ(progress.fraction(), 0);
    progress.expect(stages);
    progress.update("relax", 0.5);
    progress.update("write", 1);
    EXPECT_DOUBLE_EQ(progress.fraction(), 0.5);
    progress.expect({{"nothing", 0}});
    progress.update("nothing", 1);
    EXPECT_DOUBLE_EQ(progress.fraction(), 0.5);
}

double work_of(const std::vector<ExpectedStage>& all, const char* name) {
    for (const ExpectedStage& stage : all) {
        if (stage.name == name) return stage.work;
    }
    ADD_FAILURE() << name << " is missing";
    return 0;
}

TEST(ExpectedStages, GrowWithFacesAndSamples) {
    const auto few = cli::stages_of_remesh(1000, 100, true, {});
    const auto more_faces = cli::stages_of_remesh(2000, 100, true, {});
    const auto more_samples = cli::stages_of_remesh(1000, 200, true, {});
    for (const char* name : {"clean", "relax", "dual", "delaunay", "place", "check", "transfer"}) {
        EXPECT_GT(work_of(few, name), 0) << name;
        EXPECT_GT(work_of(more_faces, name), work_of(few, name)) << name;
        EXPECT_GT(work_of(more_samples, name), work_of(few, name)) << name;
    }
    EXPECT_DOUBLE_EQ(work_of(more_samples, "write"), 2 * work_of(few, "write"));
    EXPECT_TRUE(few.front().begins_run);
    EXPECT_EQ(few.front().name, "clean");
    EXPECT_EQ(cli::stages_of_remesh(1000, 100, false, {}).size() + 1, few.size());
    EXPECT_GT(work_of(cli::stages_of_remesh(1000, 0, false, {}), "write"), 0) << "unknown number";
}

TEST(ExpectedStages, RelaxationGrowsWithItsSteps) {
    const auto relax = [](int steps) {
        remesh::RemeshOptions options;
        options.relax_steps = steps;
        return work_of(cli::stages_of_remesh(1000, 100, false, options), "relax");
    };
    EXPECT_EQ(relax(0), 0);
    EXPECT_DOUBLE_EQ(relax(120), 2 * relax(60));
    EXPECT_EQ(relax(1000), relax(10000));
}

TEST(ExpectedStages, OnlySitesThatAreNotRelaxedAreSampledAtFullNumber) {
    remesh::RemeshOptions fixed;
    fixed.relax_steps = 0;
    const auto moved = cli::stages_of_remesh(1000, 100, false, {});
    const auto few = cli::stages_of_remesh(1000, 100, false, fixed);
    const auto more_faces = cli::stages_of_remesh(2000, 100, false, fixed);
    const auto more_samples = cli::stages_of_remesh(1000, 200, false, fixed);
    EXPECT_EQ(work_of(moved, "sample"), 0);
    EXPECT_GT(work_of(moved, "propagate"), 0);
    EXPECT_GT(work_of(moved, "diagram"), 0);
    for (const char* name : {"sample", "propagate", "diagram"}) {
        EXPECT_GT(work_of(few, name), 0) << name;
        EXPECT_GT(work_of(more_faces, name), work_of(few, name)) << name;
        EXPECT_GT(work_of(more_samples, name), work_of(few, name)) << name;
    }
}

TEST(ProgressLine, ShowsWhatIsDoneAndTimes) {
    using std::chrono::seconds;
    EXPECT_EQ(cli::progress_line({0.5, "relax", 1, seconds(9), {}}, 80),
              "[###############               ]  50 %  relax  0:09");
    EXPECT_EQ(cli::progress_line({1, "check", 2, seconds(61), seconds(3661)}, 80),
              "[##############################] 100 %  check, run 2  1:01, 1:01:01 left");
    EXPECT_EQ(cli::progress_line({0.999, "check", 1, seconds(0), seconds(0)}, 80),
              "[############################# ]  99 %  check  0:00, 0:00 left");
}

TEST(ProgressJson, HasFractionStageAndRun) {
    EXPECT_EQ(cli::progress_json({0.42, "relax", 2, std::chrono::seconds(9), {}}),
              R"({"progress": 0.420, "stage": "relax", "run": 2})");
    EXPECT_EQ(cli::progress_json({1.5, "write", 1, {}, {}}),
              R"({"progress": 1.000, "stage": "write", "run": 1})");
}

TEST(ProgressLine, FitsIntoTheTerminal) {
    const cli::ProgressState state{0.5, "relax", 1, std::chrono::seconds(9), {}};
    for (std::size_t width = 0; width < 80; ++width) {
        EXPECT_LE(cli::progress_line(state, width).size(), width == 0 ? 0 : width - 1) << width;
    }
    EXPECT_EQ(cli::progress_line(state, 29), "[###    ]  50 %  relax  0:09");
    EXPECT_EQ(cli::progress_line(state, 20), " 50 %  relax  0:09");
    EXPECT_EQ(cli::progress_line(state, 10), " 50 %  re");
}

}  // namespace
