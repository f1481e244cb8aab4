#include "remesh/pipeline/near_mesh.h"

#include <algorithm>

#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/placement/keep_distance.h"
#include "remesh/quality/area_samples.h"

namespace remesh::detail {
namespace {

// Points of the input that are looked at besides its vertices: for each face of the mesh, at most.
constexpr std::size_t samples_for_each = 32, most_area_samples = 100'000;

}  // namespace

std::optional<double> bring_near(const CurvedSurface& curved, PlacedMesh& mesh,
                                 const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Place, result);
    const DistanceBound& bound = *curved.bound;
    DistanceLimit limit{.input = {bound.input, bound.tree},
                        .limit = bound.limit,
                        .may_leave_surface = options.fit.value_or(is_relaxed(options)),
                        .least_edge = options.sizing.min_edge,
                        .most_edge = options.sizing.max_edge,
                        .bounds = options.bounds,
                        .num_threads = options.num_threads};
    limit.points.assign(bound.input.positions.begin(), bound.input.positions.end());
    const AreaSamples samples(bound.input);
    const auto num_samples =
        static_cast<Index>(std::min(samples_for_each * mesh.triangles.size(), most_area_samples));
    for (Index i = 0; i < num_samples; ++i) {
        limit.points.push_back(position(bound.input, samples.at(i, num_samples)));
    }
    const MeshCurves curves = curved.curves();
    return keep_distance(curves, find_mobility(curved, curves, mesh), limit, mesh,
                         progress_at(Stage::Place, options, 1));
}

}  // namespace remesh::detail
