#include "expected_work.h"

#include <algorithm>

#include "remesh/pipeline/stage_context.h"

namespace remesh {
namespace {

// Time for a million faces of the input and for a million samples: seconds of scripts/stage-shares
// on bunny, fandisk, nefertiti, beetle, armadillo, fertility, rocker-arm and a bunny of 1.1 million
// faces, each with 500, 2000 and 20 000 samples. Only their ratios count.
struct StageWork {
    Stage stage;
    double of_faces, of_samples;
};
constexpr StageWork measured_work[] = {
    {Stage::Clean, 7.60, 0},        {Stage::Sample, 0, 0},        {Stage::Relax, 5.24, 201.7},
    {Stage::Propagate, 2.51, 13.8}, {Stage::Diagram, 1.69, 44.8}, {Stage::Dual, 0.86, 23.8},
    {Stage::Delaunay, 0.64, 19.3},  {Stage::Place, 2.48, 86.4},   {Stage::Check, 0.85, 34.3},
};

// More steps than this are hardly ever taken before the sites stay where they are.
constexpr int most_steps = 250;

}  // namespace

std::vector<std::pair<Stage, double>> expected_work(std::size_t num_faces, std::size_t num_samples,
                                                    const RemeshOptions& options) {
    constexpr double million = 1e6;
    const double faces = static_cast<double>(num_faces) / million;
    const double samples = static_cast<double>(num_samples) / million;
    std::vector<std::pair<Stage, double>> work;
    for (const StageWork& row : measured_work) {
        double factor = 1;
        if (row.stage == Stage::Relax) {
            const int steps = detail::is_relaxed(options) ? options.relax_steps : 0;
            factor = std::min(steps, most_steps) / static_cast<double>(RemeshOptions{}.relax_steps);
        }
        work.emplace_back(row.stage, factor * (faces * row.of_faces + samples * row.of_samples));
    }
    return work;
}

}  // namespace remesh
