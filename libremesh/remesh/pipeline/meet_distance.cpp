#include "remesh/pipeline/meet_distance.h"

#include <limits>
#include <string>

#include "agvd/core/error.h"
#include "agvd/mesh/scale.h"
#include "remesh/pipeline/distance_check.h"

namespace remesh::detail {
namespace {

constexpr int max_rounds = 16;
// The error that the first edges aim at, as a share of the limit: fitted vertices lie on both sides
// of the surface, and what is too far is refined.
constexpr double first_error = 1.7;
// Each run places its vertices anew, and other points may be too far then. After so many rounds
// edges get shorter everywhere, too.
constexpr int local_rounds = 5;
constexpr double global_factor = 0.8;

}  // namespace

RemeshResult meet_distance(const CleanedInput& cleaned, const RemeshOptions& options, double limit,
                           const RunWithLengths& run) {
    RemeshOptions finer = options;
    finer.vertex_count = VertexCount::Add;
    finer.sizing.edges = AdaptiveEdges{};
    MaxError aim{first_error * limit};
    const MeshView mesh = cleaned.surface.mesh.view();
    const Progress cleaning = progress_of(Stage::Clean, options);
    const DistanceCheck check(mesh, options.num_threads,
                              within(cleaning, cleaned_fraction, cleaned_fraction));
    const Progress checking = progress_of(Stage::Check, options);
    const Progress last = within(checking, 1, 1);
    const MeshBox box = box_of(mesh, options.num_threads);
    std::vector<double> most_lengths(mesh.positions.size(), (box.high - box.low).norm());
    MeasuredDistance best{std::numeric_limits<double>::infinity(), false, {}};
    std::size_t num_vertices = 0;
    for (int round = 0; round < max_rounds; ++round) {
        finer.sizing.count = aim;
        RemeshResult result = run(finer, most_lengths);
        const MeasuredDistance found = check.measure(result.mesh.view(), limit, most_lengths, last);
        result.sizing.largest_distance = found.largest;
        if (found.is_within) return result;
        if (round >= local_rounds) aim.error *= global_factor;
        if (found.largest < best.largest) {
            best = found;
            num_vertices = result.mesh.positions.size();
        }
    }
    throw ConstraintUnmet("the largest distance asked for is " + std::to_string(limit) + ", and " +
                          std::to_string(best.largest) + " was reached with " +
                          std::to_string(num_vertices) + " vertices, near " +
                          std::to_string(best.where.x()) + ' ' + std::to_string(best.where.y()) +
                          ' ' + std::to_string(best.where.z()) + "; allow a larger distance");
}

}  // namespace remesh::detail
