#include "remesh/pipeline/expected_work.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "remesh/pipeline/stage_context.h"

namespace remesh {
namespace {

// Time for a million faces of the input and for a million samples: seconds of scripts/stage-shares
// on bunny, fandisk, nefertiti, beetle, armadillo, fertility and rocker-arm, each with 500, 2000
// and 20 000 samples; of sampling with `--relax 0`. Only their ratios count.
struct StageWork {
    Stage stage;
    double of_faces, of_samples;
};
constexpr StageWork measured_work[] = {
    {Stage::Clean, 1.29, 10.0},    {Stage::Sample, 0.09, 8.6},   {Stage::Relax, 0.61, 47.7},
    {Stage::Propagate, 0.59, 2.6}, {Stage::Diagram, 0.28, 11.0}, {Stage::Dual, 0.05, 5.7},
    {Stage::Delaunay, 0.09, 8.1},  {Stage::Place, 0.43, 40.6},   {Stage::Check, 0.18, 11.2},
};

// What is done within tiles is told as relaxation: not that they are cut, nor what is placed at
// their borders.
double kept_outside_of_tiles(Stage stage) {
    return stage == Stage::Clean ? 0.2 : stage == Stage::Place ? 0.5 : 0;
}

bool is_in_tiles(std::size_t num_samples, const RemeshOptions& options) {
    const std::size_t per_tile = options.samples_per_tile;
    return per_tile > 0 && num_samples > per_tile + per_tile / 4 && detail::is_relaxed(options) &&
           !options.sites && options.sizing.is_even() &&
           !std::holds_alternative<MaxDistance>(options.sizing.count);
}

// More steps than this are hardly ever taken before the sites stay where they are.
constexpr int most_steps = 250;

}  // namespace

std::vector<std::pair<Stage, double>> expected_work(std::size_t num_faces, std::size_t num_samples,
                                                    const RemeshOptions& options) {
    constexpr double million = 1e6;
    const double faces = static_cast<double>(num_faces) / million;
    const double samples = static_cast<double>(num_samples) / million;
    const int steps = detail::is_relaxed(options) ? options.relax_steps : 0;
    std::vector<std::pair<Stage, double>> work;
    for (const StageWork& row : measured_work) {
        double factor = 1;
        if (row.stage == Stage::Relax) {
            factor = std::min(steps, most_steps) / static_cast<double>(RemeshOptions{}.relax_steps);
        } else if (row.stage == Stage::Sample) {
            factor = steps == 0 ? 1 : 0;  // Relaxed sites begin coarse.
        }
        work.emplace_back(row.stage, factor * (faces * row.of_faces + samples * row.of_samples));
    }
    if (!is_in_tiles(num_samples, options)) return work;
    double& relaxing = work[static_cast<std::size_t>(Stage::Relax)].second;
    for (auto& [stage, of_stage] : work) {
        if (stage == Stage::Relax || stage == Stage::Check) continue;
        const double kept = kept_outside_of_tiles(stage) * of_stage;
        relaxing += of_stage - kept;
        of_stage = kept;
    }
    return work;
}

double overall_fraction(Stage stage, double fraction, std::size_t num_faces,
                        const RemeshOptions& options) {
    double done = 0, all = 0;
    for (const auto& [one, work] : expected_work(num_faces, options.num_samples, options)) {
        all += work;
        if (one <= stage) done += one < stage ? work : fraction * work;
    }
    return done / all;
}

}  // namespace remesh
