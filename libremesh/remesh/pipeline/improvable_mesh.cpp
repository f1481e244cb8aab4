#include "remesh/pipeline/improvable_mesh.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/crossings.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/placement/mesh_curves.h"

namespace remesh::detail {
namespace {

// Most tries; in the second one fewer vertices may move. Repair adds no intersections but those in
// one plane or by rounding.
constexpr int most_tries = 2;

MeshCurves curves_of(const Domain& domain) {
    return {*domain.whole, domain.prepared.input(), domain.plan->network.network};
}

}  // namespace

std::optional<ImprovableMesh> find_improvable(const Domain& domain, const PlacedDual& placed,
                                              const RemeshOptions& options) {
    if (options.sites || domain.has_junctions()) return std::nullopt;
    // Bounds of the distance are met by vertices where they are missing: one that is taken away
    // elsewhere comes back in the next round.
    if (std::holds_alternative<MaxDistance>(options.sizing.count)) return std::nullopt;
    ImprovableMesh result;
    const GluedMesh& glued = placed.patches->glued;
    for (const auto& [from, to] : rim_of(placed.mesh.triangles)) {
        result.hard.emplace_back(glued.vertex[from], glued.vertex[to]);
    }
    result.mesh = {take(placed.mesh.points, glued.representative),
                   take(placed.mesh.offsets, glued.representative), glued.triangles};
    std::vector<bool> is_on_edge(result.mesh.points.size(), false);
    for (const auto& [from, to] : result.hard) is_on_edge[from] = is_on_edge[to] = true;
    const MeshCurves curves = curves_of(domain);
    for (Index v = 0; v < result.mesh.points.size(); ++v) {
        const CurvePlace place = curves.place_of(result.mesh.points[v]);
        Mobility mobility = place.is_free()           ? Mobility::Free
                            : place.curve != no_index ? Mobility::Boundary
                            : domain.has_locked()     ? Mobility::Fixed
                                                      : Mobility::Node;
        // A mesh may pass by a vertex on a curve, and a rim may lie off the boundary.
        if (!is_on_edge[v]) {
            if (place.node == no_index) mobility = Mobility::Free;
        } else if (mobility == Mobility::Free) {
            mobility = Mobility::Boundary;
        }
        result.mobility.push_back(mobility);
    }
    return result;
}

bool improve(const Domain& domain, CrossingFinder& finder, ImprovableMesh& improvable,
             std::optional<CrossingCounts>& crossings, const StageContext& context) {
    const MeshCurves curves = curves_of(domain);
    for (int round = 0; round < most_tries; ++round) {
        PlacedDual improved{improvable.mesh, {}};
        std::vector<Index> numbers;
        {
            const StageClock clock(Stage::Place, context.result);
            numbers = repair_shape(curves, improvable.mobility, improvable.hard, improved.mesh,
                                   progress_at(Stage::Place, context.options, 1));
        }
        if (numbers.empty()) return false;
        std::optional<FacePairs> pairs = finder.find(improved);
        if (!pairs || pairs->size() <= crossings->all) {
            if (pairs) crossings = finder.tell_added(improved, *std::move(pairs)).counts();
            improvable.mesh = std::move(improved.mesh);
            return true;
        }
        for_each_corner(*pairs, improved.mesh.triangles, [&](Index v) {
            const Index before = numbers[v];
            if (before < improvable.mobility.size()) improvable.mobility[before] = Mobility::Fixed;
        });
    }
    return false;
}

}  // namespace remesh::detail
