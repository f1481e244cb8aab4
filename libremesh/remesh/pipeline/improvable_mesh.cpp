#include "remesh/pipeline/improvable_mesh.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/crossings.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/placed_dual.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/pipeline/valid_dual.h"
#include "remesh/sites/sampling.h"

namespace remesh::detail {
namespace {

// Most tries; in the second fewer vertices may move.
constexpr int most_tries = 2;
// find_corners() compares chords of half its spacing: these are as long as the mean edge.
constexpr double chords_of_lasting_corner = 2;
// In spacings: shorter loops have no chords as long as that.
constexpr double least_loop = 3;

// #V of the base: corners of the boundary that turn over a whole spacing.
std::vector<bool> lasting_corners(const Domain& domain) {
    const Surface& surface = *domain.whole;
    std::vector<bool> is_corner(surface.num_vertices(), false);
    const double spacing = chords_of_lasting_corner * domain.spacing;
    for (const std::vector<Index>& loop : boundary_loops(surface)) {
        double length = 0;
        for (const Index h : loop) length += surface.length_of(h);
        const Index component = domain.parts->face_component[Surface::face(loop[0])];
        // The loop around a whole component counts, however small that is.
        const bool is_hole = domain.parts->components[component].area > length * length;
        if (is_hole && length < least_loop * domain.spacing) continue;
        for (const Index v : find_corners(surface, loop, spacing)) is_corner[v] = true;
    }
    return is_corner;
}

}  // namespace

std::optional<ImprovableMesh> find_improvable(const Domain& domain, const ValidDual& dual,
                                              PlacedMesh placed,
                                              const std::vector<bool>& is_simplified,
                                              const RemeshOptions& options) {
    std::vector<bool> is_improvable = is_simplified;
    is_improvable.resize(domain.parts->components.size(), false);
    for (Index i = 0; i < is_improvable.size() && !options.sites; ++i) {
        if (domain.parts->components[i].boundary_loops > 0) is_improvable[i] = true;
    }
    if (std::find(is_improvable.begin(), is_improvable.end(), true) == is_improvable.end()) {
        return std::nullopt;
    }
    ImprovableMesh result{.mesh = {}, .mobility = {}, .hard = rim_of(placed.triangles)};
    result.mobility.assign(placed.points.size(), Mobility::Free);
    for (const auto& [from, to] : result.hard) {
        result.mobility[from] = result.mobility[to] = Mobility::Boundary;
    }
    const std::vector<bool> is_corner = lasting_corners(domain);
    for (Index i = 0; i < placed.points.size(); ++i) {
        const SurfacePoint& point = dual.points[i];
        const auto v = vertex_of(domain.base(), point);
        if ((v && *v < is_corner.size() && is_corner[*v]) ||
            !is_improvable[domain.component[point.face.value()]]) {
            result.mobility[i] = Mobility::Fixed;
        }
    }
    result.mesh = std::move(placed);
    return result;
}

bool improve(const Domain& domain, CrossingFinder& finder, ImprovableMesh& improvable,
             std::optional<CrossingCounts>& crossings, const StageContext& context) {
    for (int round = 0; round < most_tries; ++round) {
        PlacedDual improved{improvable.mesh, {}};
        std::vector<Index> numbers;
        {
            const StageClock clock(Stage::Place, context.result);
            numbers = repair_shape(domain.prepared.input(), improvable.mobility, improvable.hard,
                                   improved.mesh, progress_at(Stage::Place, context.options, 1));
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
