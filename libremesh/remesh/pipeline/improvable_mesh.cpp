#include "remesh/pipeline/improvable_mesh.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/crossings.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/placement/mesh_curves.h"
#include "remesh/sites/sampling.h"

namespace remesh::detail {
namespace {

// Most tries; in each one fewer vertices may move.
constexpr int most_tries = 4;
// find_corners() compares chords of half its spacing: these are as long as the mean edge.
constexpr double chords_of_lasting_corner = 2;
// In spacings: shorter loops have no chords as long as that.
constexpr double least_loop = 3;

// #V: corners of the boundary that turn over a whole spacing.
std::vector<bool> lasting_corners(const Domain& domain,
                                  const std::vector<std::vector<Index>>& loops) {
    const Surface& surface = *domain.whole;
    std::vector<bool> is_corner(surface.num_vertices(), false);
    for (const std::vector<Index>& loop : loops) {
        double length = 0;
        for (const Index h : loop) length += surface.length_of(h);
        const Index component = domain.parts->face_component[Surface::face(loop[0])];
        // The loop around a whole component counts, however small that is.
        const bool is_hole = domain.parts->components[component].area > length * length;
        if (is_hole && length < least_loop * domain.spacing) continue;
        const double chords = chords_of_lasting_corner * domain.spacing;
        for (const Index v : find_corners(surface, loop, chords)) is_corner[v] = true;
    }
    return is_corner;
}

MeshCurves curves_of(const Domain& domain, const ImprovableMesh& improvable) {
    const Surface& cut = domain.prepared.input();
    return {*domain.whole, cut, domain.plan ? domain.plan->network.network : improvable.boundary};
}

}  // namespace

std::optional<ImprovableMesh> find_improvable(const Domain& domain, PlacedDual placed,
                                              const RemeshOptions& options) {
    if (options.sites || domain.has_junctions()) return std::nullopt;
    // Bounds of the distance are met by vertices where they are missing: one that is taken away
    // elsewhere comes back in the next round.
    if (domain.plan && options.vertex_count == VertexCount::Add) return std::nullopt;
    ImprovableMesh result;
    result.hard = rim_of(placed.mesh.triangles);
    if (placed.patches) {
        const GluedMesh& glued = placed.patches->glued;
        for (auto& [from, to] : result.hard) {
            from = glued.vertex[from];
            to = glued.vertex[to];
        }
        result.mesh = {take(placed.mesh.points, glued.representative),
                       take(placed.mesh.offsets, glued.representative), glued.triangles};
    } else {
        result.mesh = std::move(placed.mesh);
    }
    std::vector<bool> is_corner;
    if (!domain.plan) {
        const std::vector<std::vector<Index>> loops = boundary_loops(*domain.whole);
        is_corner = lasting_corners(domain, loops);
        for (const std::vector<Index>& loop : loops) {
            result.boundary.curves.push_back(curve_of_loop(*domain.whole, loop));
        }
    }
    std::vector<bool> is_on_edge(result.mesh.points.size(), false);
    for (const auto& [from, to] : result.hard) is_on_edge[from] = is_on_edge[to] = true;
    const MeshCurves curves = curves_of(domain, result);
    for (Index v = 0; v < result.mesh.points.size(); ++v) {
        const CurvePlace place = curves.place_of(result.mesh.points[v]);
        Mobility mobility = place.is_free()           ? Mobility::Free
                            : place.curve != no_index ? Mobility::Boundary
                                                      : Mobility::Fixed;
        // A mesh may pass by a vertex on a curve, and a rim may lie off the boundary.
        if (!is_on_edge[v]) {
            if (place.node == no_index) mobility = Mobility::Free;
        } else if (mobility == Mobility::Free) {
            mobility = Mobility::Boundary;
        }
        if (!is_corner.empty()) {
            const auto corner = vertex_of(*domain.whole, result.mesh.points[v]);
            if (corner && is_corner[*corner]) mobility = Mobility::Fixed;
        }
        result.mobility.push_back(mobility);
    }
    return result;
}

bool improve(const Domain& domain, CrossingFinder& finder, ImprovableMesh& improvable,
             std::optional<CrossingCounts>& crossings, const StageContext& context) {
    const MeshCurves curves = curves_of(domain, improvable);
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
