#include "remesh/pipeline/mendable_mesh.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/placement/placement.h"
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
        const SurfacePoint& point = dual.mesh.points[i];
        const auto v = vertex_of(domain.base(), point);
        if ((v && *v < is_corner.size() && is_corner[*v]) ||
            !is_mendable[domain.component[point.face.value()]]) {
            result.mobility[i] = Mobility::Fixed;
        }
    }
    result.mesh = std::move(placed);
    return result;
}

std::optional<MendedMesh> mend(const Domain& domain, MendableMesh mendable,
                               std::optional<Index> most_crossings, CrossingFinder& finder,
                               const StageContext& context) {
    for (int round = 0; round < most_mendings; ++round) {
        PlacedDual mended{mendable.mesh, {}};
        std::vector<Index> numbers;
        {
            const StageClock clock(Stage::Place, context.result);
            const Progress progress = progress_of(Stage::Place, context.options);
            numbers = repair_shape(domain.prepared.input(), mendable.mobility, mendable.hard,
                                   mended.mesh, within(progress, 1, 1));
        }
        if (numbers.empty()) return std::nullopt;
        const std::optional<CrossingFaces> crossings = finder.find(mended);
        if (!crossings) return MendedMesh{std::move(mended.mesh), std::nullopt};
        if (crossings->counts().all <= most_crossings) {
            return MendedMesh{std::move(mended.mesh), crossings->counts()};
        }
        for_each_corner(crossings->all, mended.mesh.triangles, [&](Index v) {
            const Index before = numbers[v];
            if (before < mendable.mobility.size()) mendable.mobility[before] = Mobility::Fixed;
        });
    }
    return std::nullopt;
}

}  // namespace remesh::detail
