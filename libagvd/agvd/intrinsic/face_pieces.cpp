#include "agvd/intrinsic/face_pieces.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "agvd/core/poller.h"
#include "agvd/mesh/face_area.h"

namespace agvd {
namespace {

constexpr Index most_pieces = 16;

// Evenly spread points of a triangle, the first at its centroid: a lattice whose steps are powers
// of the plastic number, folded into the triangle.
std::array<double, 3> spread_point(Index i) {
    constexpr double step_x = 0.7548776662466927, step_y = 0.5698402909980532;
    double x = 1.0 / 3 + i * step_x, y = 1.0 / 3 + i * step_y;
    x -= std::floor(x);
    y -= std::floor(y);
    if (x + y > 1) {
        x = 1 - x;
        y = 1 - y;
    }
    return {1 - x - y, x, y};
}

Vec3 area_vector(const Surface& surface, Index face) {
    const auto& [a, b, c] = surface.mesh.triangles[face];
    const auto& p = surface.mesh.positions;
    return (p[b] - p[a]).cross(p[c] - p[a]) / 2;
}

// Its sides are straight in space, so that they lie on the surface; between them no surface is as
// small as the triangle but itself.
bool is_flat(const Surface& surface, Index face) {
    constexpr double rounding = 1e-9;  // Of a side.
    const auto& p = surface.mesh.positions;
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const double length = surface.length_of(h);
        const double in_space = (p[surface.head(h)] - p[surface.tail(h)]).norm();
        if (!(in_space > (1 - rounding) * length)) return false;
    }
    return true;
}

}  // namespace

FacePieces::FacePieces(const IntrinsicTriangulation& base, double piece_area,
                       const Progress& progress)
    : input_(base.input()) {
    assert(piece_area > 0);
    constexpr std::size_t piece_work = 16;  // Steps that a piece counts for.
    Poller poller(progress);
    Ticker ticker(poller);
    const Surface& surface = base.surface();
    std::vector<InputPart> parts;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        ticker.tick();
        if (!base.is_changed(f)) continue;
        if (begin_.empty()) begin_.assign(surface.num_faces(), no_index);
        begin_[f] = static_cast<Index>(pieces_.size());
        parts.clear();
        if (is_flat(surface, f)) {
            pieces_.push_back(whole(surface, f));
        } else if (base.parts_of(f, parts) && !parts.empty()) {
            add_parts(parts);
        } else {
            add_samples(base, f, piece_area);
        }
        ticker.tick(piece_work * (pieces_.size() - begin_[f]));
        is_last_.resize(pieces_.size(), 0);
        is_last_.back() = 1;
    }
}

void FacePieces::add_parts(std::span<const InputPart> parts) {
    for (const InputPart& part : parts) {
        pieces_.push_back({agvd::position(input_.mesh.view(), part.centroid),
                           part.share * area_vector(input_, part.centroid.face.value())});
    }
}

void FacePieces::add_samples(const IntrinsicTriangulation& base, Index face, double piece_area) {
    const double area = face_area(base.surface(), face);
    const auto count = static_cast<Index>(
        std::clamp(std::ceil(area / piece_area), 1.0, static_cast<double>(most_pieces)));
    for (Index i = 0; i < count; ++i) {
        const SurfacePoint place = base.to_input({FaceId(face), spread_point(i)});
        const Vec3 normal = area_vector(input_, place.face.value()).normalized();
        pieces_.push_back({agvd::position(input_.mesh.view(), place), area / count * normal});
    }
}

SurfacePiece FacePieces::whole(const Surface& surface, Index face) {
    const auto& [a, b, c] = surface.mesh.triangles[face];
    const auto& p = surface.mesh.positions;
    return {(p[a] + p[b] + p[c]) / 3, area_vector(surface, face)};
}

}  // namespace agvd
