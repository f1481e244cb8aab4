#include "paper/cell_at.h"

#include <limits>
#include <span>

#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

Vec2 in_frame(const SurfacePoint& point) { return {point.barycentric[1], point.barycentric[2]}; }

// Calls visit(edge, point, next point) for each piece of each bisector.
template <typename Visit>
void for_each_piece(const Diagram& diagram, const Visit& visit) {
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const VoronoiEdge& edge = diagram.edges[e];
        if (!edge.right.is_valid()) continue;
        const Index begin = diagram.edge_points[e];
        const Index end = diagram.edge_points[e + 1];
        for (Index i = begin; i + 1 < end; ++i) visit(edge, i, i + 1);
        if (edge.tail == no_index) visit(edge, end - 1, begin);
    }
}

}  // namespace

CellLocator::CellLocator(const Surface& surface, const Diagram& diagram)
    : surface_(surface), diagram_(diagram), offsets_(surface.num_faces() + 1, 0) {
    // Shorter ones, left by ties at vertices, have no direction that could be trusted.
    constexpr double least_length = 1e-8;  // Of the face's sides.
    const auto for_each_piece_of_face = [&](const auto& visit) {
        for_each_piece(diagram, [&](const VoronoiEdge& edge, Index i, Index next) {
            const SurfacePoint& a = diagram.points[i];
            const SurfacePoint& b = diagram.points[next];
            const CommonFaces faces = common_faces(surface, a, b);
            for (const Index face : {faces.first, faces.second}) {
                if (face == no_index) continue;
                const Piece piece{in_frame(*seen_from(surface, a, face)),
                                  in_frame(*seen_from(surface, b, face)), edge.left, edge.right};
                if ((piece.to - piece.from).norm() > least_length) visit(face, piece);
            }
        });
    };
    for_each_piece_of_face([&](Index face, const Piece&) { ++offsets_[face + 1]; });
    for (Index f = 0; f < surface.num_faces(); ++f) offsets_[f + 1] += offsets_[f];
    pieces_.resize(offsets_.back());
    std::vector<Index> next(offsets_.begin(), offsets_.end() - 1);
    for_each_piece_of_face([&](Index face, const Piece& piece) { pieces_[next[face]++] = piece; });
}

SiteId CellLocator::operator()(const SurfacePoint& point) const {
    const Index face = point.face.value();
    const std::span pieces =
        std::span(pieces_).subspan(offsets_[face], offsets_[face + 1] - offsets_[face]);
    // Looks from the point at the middle of a piece; the first piece on the way there decides. A
    // look that meets a piece near its end may slip through a joint; then another may do better.
    constexpr double margin = 1e-9;
    const Vec2 p = in_frame(point);
    SiteId doubtful;
    for (const Piece& target : pieces) {
        const Vec2 look = (target.from + target.to) / 2 - p;
        double nearest = std::numeric_limits<double>::infinity();
        bool is_clear = false;
        for (const Piece& piece : pieces) {
            const Vec2 along = piece.to - piece.from;
            const double sine = cross(look, along);
            if (sine == 0) continue;
            const double at = cross(piece.from - p, along) / sine;
            const double on_piece = cross(piece.from - p, look) / sine;
            if (!(at >= 0 && at < nearest) || on_piece < -margin || on_piece > 1 + margin) continue;
            nearest = at;
            is_clear = on_piece > margin && on_piece < 1 - margin;
            doubtful = sine > 0 ? piece.left : piece.right;
        }
        if (is_clear) return doubtful;
    }
    if (doubtful.is_valid()) return doubtful;
    // One cell; a corner that only touches another cell is outvoted.
    const Triangle& corners = surface_.mesh.triangles[face];
    const auto label = [&](std::size_t k) { return diagram_.nearest_site[corners[k]]; };
    return label(1) == label(2) ? label(1) : label(0);
}

}  // namespace agvd
