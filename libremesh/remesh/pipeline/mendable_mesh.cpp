#include "remesh/pipeline/mendable_mesh.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/sites/sampling.h"

namespace remesh::detail {
namespace {

// Most mendings; in the second fewer vertices may move.
constexpr int most_mendings = 2;
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

std::optional<MendableMesh> find_mendable(const Domain& domain, const ValidDual& dual,
                                          PlacedMesh placed, const std::vector<bool>& is_thinned,
                                          const RemeshOptions& options) {
    std::vector<bool> is_mendable = is_thinned;
    is_mendable.resize(domain.parts->components.size(), false);
    for (Index i = 0; i < is_mendable.size() && !options.sites; ++i) {
        if (domain.parts->components[i].boundary_loops > 0) is_mendable[i] = true;
    }
    if (std::find(is_mendable.begin(), is_mendable.end(), true) == is_mendable.end()) {
        return std::nullopt;
    }
    MendableMesh result{.mesh = {}, .mobility = {}, .hard = rim_of(placed.triangles)};
    result.mobility.assign(placed.points.size(), Mobility::Free);
    for (const auto& [from, to] : result.hard) {
        result.mobility[from] = result.mobility[to] = Mobility::Boundary;
    }
    const std::vector<bool> is_corner = lasting_corners(domain);
    for (Index i = 0; i < placed.points.size(); ++i) {
        const SurfacePoint& point = dual.points[i];
        const auto v = vertex_of(domain.base(), point);
        if ((v && *v < is_corner.size() && is_corner[*v]) ||
            !is_mendable[domain.component[point.face.value()]]) {
            result.mobility[i] = Mobility::Fixed;
        }
    }
    result.mesh = std::move(placed);
    return result;
}

bool mend(const Domain& domain, CrossingFinder& finder, MendableMesh& mendable,
          std::optional<CrossingCounts>& crossings, const StageContext& context) {
    for (int round = 0; round < most_mendings; ++round) {
        PlacedDual mended{mendable.mesh, {}};
        std::vector<Index> numbers;
        {
            const StageClock clock(Stage::Place, context.result);
            numbers = repair_shape(domain.prepared.input(), mendable.mobility, mendable.hard,
                                   mended.mesh, progress_at(Stage::Place, context.options, 1));
        }
        if (numbers.empty()) return false;
        std::optional<FacePairs> pairs = finder.find(mended);
        if (!pairs || pairs->size() <= crossings->all) {
            if (pairs) crossings = finder.tell_fresh(mended, *std::move(pairs)).counts();
            mendable.mesh = std::move(mended.mesh);
            return true;
        }
        for_each_corner(*pairs, mended.mesh.triangles, [&](Index v) {
            const Index before = numbers[v];
            if (before < mendable.mobility.size()) mendable.mobility[before] = Mobility::Fixed;
        });
    }
    return false;
}

}  // namespace remesh::detail
