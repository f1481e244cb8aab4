#include "agvd/diagram/diagram.h"

#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// The first face that holds both, for a diagram without passages.
CurvePiece piece_in_common_face(const Surface& surface, const SurfacePoint& from,
                                const SurfacePoint& to) {
    const Index face = common_faces(surface, from, to).first;
    if (face == no_index) return {from, from};
    return {*seen_from(surface, from, face), *seen_from(surface, to, face)};
}

Index half_edge_at(const SurfacePoint& point, const Passage& passage) {
    return 3 * point.face.value() + passage.side;
}

}  // namespace

CurvePiece curve_piece(const Surface& surface, const Diagram& diagram, Index edge, Index point) {
    const bool is_last = point + 1 == diagram.edge_points[edge + 1];
    const Index next = is_last ? diagram.edge_points[edge] : point + 1;
    CurvePiece piece{diagram.points[point], diagram.points[next]};
    if (diagram.passages.empty()) return piece_in_common_face(surface, piece.from, piece.to);
    const Passage& out = diagram.passages[point];
    const Passage& in = diagram.passages[next];
    if (!diagram.edges[edge].right.is_valid()) {
        if (in.leaves) {  // The mesh vertex at the head.
            piece.to = point_on(Surface::next(half_edge_at(piece.from, out)), 0);
        }
        return piece;
    }
    if (out.side != Passage::none && out.leaves) {
        piece.from = across_edge(surface, piece.from, half_edge_at(piece.from, out));
    }
    if (in.side != Passage::none && !in.leaves) {
        piece.to = across_edge(surface, piece.to, half_edge_at(piece.to, in));
    }
    return piece;
}

std::vector<Index> points_of_arc(const Diagram& diagram, Index edge, Index arc) {
    const Index end = diagram.edge_points[edge + 1];
    const bool is_last = arc + 1 == diagram.edge_arcs[edge + 1];
    const Index last = is_last ? end : diagram.arcs[arc + 1].first_point + 1;
    std::vector<Index> points;
    for (Index p = diagram.arcs[arc].first_point; p < last; ++p) points.push_back(p);
    if (is_last && diagram.edges[edge].tail == no_index) {
        points.push_back(diagram.edge_points[edge]);
    }
    return points;
}

double curve_length(const Surface& surface, const Diagram& diagram, Index edge) {
    double sum = 0;
    for (Index i = diagram.edge_points[edge]; i + 1 < diagram.edge_points[edge + 1]; ++i) {
        const auto [from, to] = curve_piece(surface, diagram, edge, i);
        sum += face_distance(surface, from, to);
    }
    return sum;
}

}  // namespace agvd
