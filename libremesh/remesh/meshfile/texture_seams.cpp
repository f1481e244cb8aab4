#include <limits>

#include "agvd/mesh/any_mesh.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/text.h"

namespace remesh {
namespace {

struct Side {
    std::uint64_t edge;
    Index face;
    std::uint8_t low, high;  // Corners of the face at the lower and the higher end.

    [[nodiscard]] bool operator<(const Side& other) const {
        return edge != other.edge ? edge < other.edge : face < other.face;
    }
};

std::vector<Side> sorted_sides(const MeshView& mesh, Ticker& ticker) {
    const std::vector<Index> point = first_at_position(mesh.positions, ticker);
    std::vector<Side> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        for (std::uint8_t k = 0; k < 3; ++k) {
            const auto next = static_cast<std::uint8_t>((k + 1) % 3);
            const Index a = point[mesh.triangles[f][k]], b = point[mesh.triangles[f][next]];
            if (a == b) continue;
            sides.push_back({edge_key(a, b), f, a < b ? k : next, a < b ? next : k});
        }
    }
    sort_ticked(sides, ticker, std::less<>());
    return sides;
}

}  // namespace

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
    const std::vector<Side> sides = sorted_sides(mesh, ticker);
    std::vector<std::array<Index, 2>> seams;
    for (std::size_t first = 0, i = 0; i < sides.size(); ++i) {
        ticker.tick();
        if (sides[i].edge != sides[first].edge) first = i;
        const Side &a = sides[first], &b = sides[i];
        if (agree(a.face, a.low, b.face, b.low) && agree(a.face, a.high, b.face, b.high)) continue;
        const Triangle& t = mesh.triangles[a.face];
        seams.push_back({t[a.low], t[a.high]});
        while (i + 1 < sides.size() && sides[i + 1].edge == a.edge) ++i;
    }
    return seams;
}

}  // namespace remesh
