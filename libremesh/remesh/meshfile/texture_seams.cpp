#include <algorithm>
#include <limits>

#include "agvd/mesh/any_mesh.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/text.h"

namespace remesh {
CornerCoordinates no_coordinates() {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {Vec2(none, none), Vec2(none, none), Vec2(none, none)};
}

CornerAgreement::CornerAgreement(std::span<const CornerCoordinates> values) : values_(values) {
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::max()), high = -low;
    for (const CornerCoordinates& corners : values) {
        for (const Vec2& corner : corners) {
            if (!corner.allFinite()) continue;
            low = low.cwiseMin(corner);
            high = high.cwiseMax(corner);
        }
    }
    if (low.x() <= high.x()) most_ = tolerance * (high - low).maxCoeff();
}

std::vector<std::array<Index, 2>> find_texture_seams(const MeshView& mesh,
                                                     std::span<const CornerCoordinates> values,
                                                     Ticker ticker) {
    if (values.size() != mesh.triangles.size()) {
        throw InvalidOption(joined("there are texture coordinates for ", values.size(),
                                   " faces, but the mesh has ", mesh.triangles.size(),
                                   "; give three for each"));
    }
    const CornerAgreement agree(values);
    const std::vector<Triangle> faces =
        rename_vertices(mesh.triangles, first_at_position(mesh.positions, ticker));
    std::vector<std::array<Index, 2>> seams;
    for_each_edge(sorted_edge_sides(faces, ticker), [&](std::span<const EdgeSide> edge) {
        ticker.tick(edge.size());
        // The corners of a side's face at the lower and the higher end.
        const auto low = [](const EdgeSide& side) {
            return (side.forward ? side.half_edge : next_half_edge(side.half_edge)) % 3;
        };
        const auto high = [](const EdgeSide& side) {
            return (side.forward ? next_half_edge(side.half_edge) : side.half_edge) % 3;
        };
        const EdgeSide& a = edge[0];
        const auto agrees = [&](const EdgeSide& b) {
            return agree(a.face(), low(a), b.face(), low(b)) &&
                   agree(a.face(), high(a), b.face(), high(b));
        };
        if (a.low() == a.high() || std::ranges::all_of(edge, agrees)) return;
        const Triangle& t = mesh.triangles[a.face()];
        seams.push_back({t[low(a)], t[high(a)]});
    });
    return seams;
}

}  // namespace remesh
