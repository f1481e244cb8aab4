// The faces are cut along the bisectors (mesh/line_cutter.h); each polygon gets its cell.
#include "agvd/diagram/cut_cells.h"

#include <array>
#include <map>
#include <string>

#include "agvd/core/error.h"
#include "agvd/mesh/line_cutter.h"

namespace agvd {
namespace {

class CellCutter {
public:
    CellCutter(const Surface& surface, const Diagram& diagram, Ticker ticker)
        : surface_(surface), diagram_(diagram), ticker_(ticker), cutter_(surface, ticker) {}

    CutCells run() {
        collect_pieces();
        std::vector<SiteId> face_site;
        CutFaces cut =
            cutter_.run([&](Index face, std::span<const Index> polygon, Index num_triangles) {
                face_site.insert(face_site.end(), num_triangles, site_of(face, polygon));
            });
        return {std::move(cut.mesh), std::move(cut.points), std::move(face_site),
                std::move(cut.face_origin)};
    }

private:
    // By face. What lies between bisectors, on the boundary, is no cut.
    void collect_pieces() {
        for (Index e = 0; e < diagram_.edges.size(); ++e) {
            const VoronoiEdge& edge = diagram_.edges[e];
            if (!edge.right.is_valid()) continue;
            const Index begin = diagram_.edge_points[e], end = diagram_.edge_points[e + 1];
            const Index last = edge.tail == no_index ? end : end - 1;
            for (Index i = begin; i < last; ++i) {
                ticker_.tick(8);
                const CurvePiece piece = curve_piece(surface_, diagram_, e, i);
                const Index from = cutter_.vertex_at(diagram_.points[i]);
                const Index to = cutter_.vertex_at(diagram_.points[i + 1 == end ? begin : i + 1]);
                if (from == to) continue;
                if (piece.from == piece.to || piece.from.face != piece.to.face) {
                    throw InvalidInput("points " + std::to_string(i) +
                                       " and the next of Voronoi "
                                       "edge " +
                                       std::to_string(e) +
                                       " share no face; give a diagram of this surface");
                }
                const Index face = piece.from.face.value();
                cutter_.add_piece(face, from, to);
                left_of_[{from, to, face}] = edge.left;
                left_of_[{to, from, face}] = edge.right;
            }
        }
    }

    // The cell of a polygon, by a bisector along it, by a vertex that lies on none, or by a
    // bisector on the other side of one of its sides.
    [[nodiscard]] SiteId site_of(Index face, const std::span<const Index> polygon) const {
        SiteId beside, any;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Index from = polygon[i], to = polygon[(i + 1) % polygon.size()];
            const auto own = left_of_.find({from, to, face});
            if (own != left_of_.end()) return own->second;
            const auto first = left_of_.lower_bound({from, to, 0});
            if (first == left_of_.end() || first->first[0] != from) continue;
            if (first->first[1] == to) beside = first->second;
        }
        for (const Index vertex : polygon) {
            if (vertex >= surface_.num_vertices()) continue;
            any = diagram_.nearest_site[vertex];
            const auto piece = left_of_.lower_bound({vertex, 0, 0});
            if (piece == left_of_.end() || piece->first[0] != vertex) return any;
        }
        return beside.is_valid() ? beside : any;
    }

    const Surface& surface_;
    const Diagram& diagram_;
    Ticker ticker_;
    LineCutter cutter_;
    // By the vertices of a piece and its face: the cell left of it. Of a bisector that runs into an
    // edge and out again two pieces have the same vertices.
    std::map<std::array<Index, 3>, SiteId> left_of_;
};

}  // namespace

CutCells cut_cells(const Surface& surface, const Diagram& diagram, const Progress& progress) {
    Poller poller(progress);
    return CellCutter(surface, diagram, Ticker(poller)).run();
}

}  // namespace agvd
