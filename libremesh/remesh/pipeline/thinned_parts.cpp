#include "remesh/pipeline/thinned_parts.h"

#include <utility>

#include "agvd/mesh/point_faces.h"
#include "remesh/placement/mend_shape.h"

namespace remesh::detail {
namespace {

using agvd::Index;

// Most rounds of mending; in the second fewer vertices may move.
constexpr int max_rounds = 2;

}  // namespace

ThinnedParts find_thinned_parts(const Domain& domain, const ValidDual& dual, PlacedMesh placed,
                                const std::vector<bool>& is_thinned,
                                const std::vector<bool>& is_corner) {
    ThinnedParts parts;
    parts.hard = rim_of(placed.triangles);
    parts.mobility.assign(placed.points.size(), Mobility::Free);
    for (const auto& [from, to] : parts.hard) {
        parts.mobility[from] = parts.mobility[to] = Mobility::Boundary;
    }
    for (Index i = 0; i < placed.points.size(); ++i) {
        const agvd::SurfacePoint& point = dual.mesh.points[i];
        const auto v = agvd::vertex_of(domain.base(), point);
        if ((v && is_corner[*v]) || !is_thinned[domain.component[point.face.value()]]) {
            parts.mobility[i] = Mobility::Fixed;
        }
    }
    parts.mesh = std::move(placed);
    return parts;
}

std::optional<MendedMesh> mend_thinned(const Domain& domain, ThinnedParts parts,
                                       std::optional<Index> most_crossings, CrossingFinder& finder,
                                       const StageContext& context) {
    for (int round = 0; round < max_rounds; ++round) {
        PlacedDual mended{parts.mesh, {}};
        std::vector<Index> numbers;
        {
            const StageClock clock(Stage::Place, context.result);
            const agvd::Progress progress = progress_of(Stage::Place, context.options);
            numbers = mend_shape(domain.prepared.input(), parts.mobility, parts.hard, mended.mesh,
                                 agvd::within(progress, 1, 1));
        }
        if (numbers.empty()) return std::nullopt;
        const CrossingFaces crossings = finder.find(mended);
        if (!crossings) return MendedMesh{std::move(mended.mesh), std::nullopt};
        const auto num_crossings = static_cast<Index>(crossings->size());
        if (num_crossings <= most_crossings) {
            return MendedMesh{std::move(mended.mesh), num_crossings};
        }
        for_each_corner(*crossings, mended.mesh.triangles, [&](Index v) {
            const Index before = numbers[v];
            if (before < parts.mobility.size()) parts.mobility[before] = Mobility::Fixed;
        });
    }
    return std::nullopt;
}

}  // namespace remesh::detail
