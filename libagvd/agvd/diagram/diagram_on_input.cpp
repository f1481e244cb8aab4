#include "agvd/diagram/arc_on_input.h"
#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// Draws Voronoi edges on the faces of another mesh, point by point.
class EdgeMapper {
public:
    EdgeMapper(const IntrinsicTriangulation& base, const Diagram& from, Diagram& to, Ticker ticker)
        : base_(base), from_(from), to_(to), ticker_(ticker) {}

    void map_edges() {
        to_.edge_points.push_back(0);
        if (!from_.edge_arcs.empty()) to_.edge_arcs.push_back(0);
        to_.arcs.reserve(from_.arcs.size() + from_.arcs.size() / 8);
        for (Index e = 0; e < from_.edges.size(); ++e) {
            const Index begin = from_.edge_points[e], end = from_.edge_points[e + 1];
            const bool is_closed = from_.edges[e].tail == no_index;
            const Index num_pieces = begin == end ? 0 : end - begin - (is_closed ? 0 : 1);
            if (has_arcs(e)) {
                map_arcs(e, begin + num_pieces);
            } else {
                for (Index i = begin; i < begin + num_pieces; ++i) map_piece(e, i, next_of(e, i));
            }
            if (!is_closed) {
                add(base_.to_input(from_.points[end - 1]), from_.point_distance[end - 1]);
            }
            to_.edge_points.push_back(static_cast<Index>(to_.points.size()));
            if (!from_.edge_arcs.empty()) {
                to_.edge_arcs.push_back(static_cast<Index>(to_.arcs.size()));
            }
        }
    }

private:
    static constexpr std::size_t segment_work = 16;  // Steps that a segment counts for.

    [[nodiscard]] bool has_arcs(Index edge) const {
        return !from_.edge_arcs.empty() && from_.edge_arcs[edge] < from_.edge_arcs[edge + 1];
    }
    [[nodiscard]] Index next_of(Index edge, Index point) const {
        return point + 1 == from_.edge_points[edge + 1] ? from_.edge_points[edge] : point + 1;
    }

    void add(const SurfacePoint& point, double distance) {
        to_.points.push_back(point);
        to_.point_distance.push_back(distance);
    }

    // But for its end.
    void map_piece(Index edge, Index begin, Index end) {
        ticker_.tick(segment_work);
        const CurvePiece piece = curve_piece(base_.surface(), from_, edge, begin);
        parts_.clear();
        base_.to_input(piece.from, piece.to, parts_);
        const MeshView mesh = base_.input().mesh.view();
        const auto length_of = [&](std::size_t i) {
            if (base_.input().has_own_lengths) {
                return face_distance(base_.input(), parts_[i], parts_[i + 1]);
            }
            return (position(mesh, parts_[i + 1]) - position(mesh, parts_[i])).norm();
        };
        double length = 0;
        for (std::size_t i = 0; i < parts_.size(); i += 2) length += length_of(i);
        double passed = 0;
        for (std::size_t i = 0; i < parts_.size(); i += 2) {
            const double share = length > 0 ? passed / length : 0;
            add(parts_[i],
                (1 - share) * from_.point_distance[begin] + share * from_.point_distance[end]);
            passed += length_of(i);
        }
    }

    // \param end  one past the edge's last piece.
    void map_arcs(Index edge, Index end) {
        for (Index a = from_.edge_arcs[edge]; a < from_.edge_arcs[edge + 1]; ++a) {
            const bool is_last = a + 1 == from_.edge_arcs[edge + 1];
            const BisectorArc& arc = from_.arcs[a];
            const Index arc_end = is_last ? end : from_.arcs[a + 1].first_point;
            if (!base_.is_changed(arc.face.value())) {
                copy_arc(arc, edge, arc_end);
                continue;
            }
            for (Index i = arc.first_point; i < arc_end; ++i) {
                if (arc.kind == ArcKind::Chord) {
                    map_chord(edge, i);
                } else {
                    map_arc_piece(arc, edge, i);
                }
            }
            finish_arc(arc);
        }
    }

    // In a face of the input.
    void copy_arc(const BisectorArc& arc, Index edge, Index end) {
        const Index first = arc.first_point;
        ticker_.tick(end - first);
        to_.arcs.push_back(arc);
        to_.arcs.back().first_point = static_cast<Index>(to_.points.size());
        add(curve_piece(base_.surface(), from_, edge, first).from, from_.point_distance[first]);
        for (Index i = first + 1; i < end; ++i) add(from_.points[i], from_.point_distance[i]);
    }

    // A chord has an arc in each face, too.
    void map_chord(Index edge, Index i) {
        const Index first = static_cast<Index>(to_.points.size());
        map_piece(edge, i, next_of(edge, i));
        for (std::size_t part = 0; part < parts_.size(); part += 2) {
            BisectorArc arc{.face = parts_[part].face,
                            .first_point = first + static_cast<Index>(part / 2)};
            const Index h = 3 * arc.face.value();
            arc.begin = position_in_frame(base_.input(), parts_[part], h);
            arc.end = position_in_frame(base_.input(), parts_[part + 1], h);
            to_.arcs.push_back(arc);
        }
    }

    void map_arc_piece(const BisectorArc& arc, Index edge, Index i) {
        const Conic conic{arc.focus, arc.weight};
        const CurvePiece piece = curve_piece(base_.surface(), from_, edge, i);
        segments_.clear();
        mapper_.map(conic, arc.kind == ArcKind::Line, piece.from, piece.to, segments_);
        ticker_.tick(segment_work * segments_.size());
        double doubled_area = 0;  // Beside the chord.
        const Vec2 first = segments_.front().base_begin;
        for (const InputSegment& segment : segments_) {
            if (!is_open_ || run_.begin.face != segment.begin.face) {
                finish_arc(arc);
                is_open_ = true;
                run_ = segment;
                run_begins_ = static_cast<Index>(to_.points.size());
            }
            run_.end = segment.end;
            run_.at_end = segment.at_end;
            run_.base_end = segment.base_end;
            add(segment.begin, &segment == segments_.data()
                                   ? from_.point_distance[i]
                                   : conic.distance(0, segment.base_begin));
            doubled_area += cross(segment.base_begin - first, segment.base_end - first);
        }
        to_.cell_area[from_.edges[edge].left.value()] += doubled_area / 2;
        to_.cell_area[from_.edges[edge].right.value()] -= doubled_area / 2;
    }

    // The part of the arc in one face.
    void finish_arc(const BisectorArc& arc) {
        if (!is_open_) return;
        is_open_ = false;
        const Conic conic = moved(run_.motion(), {arc.focus, arc.weight});
        to_.arcs.push_back({run_.begin.face, arc.kind, run_begins_, conic.focus, conic.weight,
                            run_.at_begin, run_.at_end});
    }

    const IntrinsicTriangulation& base_;
    const Diagram& from_;
    Diagram& to_;
    Ticker ticker_;
    std::vector<SurfacePoint> parts_;  // Two a part.
    ArcMapper mapper_{base_};
    std::vector<InputSegment> segments_;

    // The arc at hand, as far as it has come in one face.
    InputSegment run_;
    Index run_begins_ = 0;  // Of the points.
    bool is_open_ = false;
};

}  // namespace

Diagram diagram_on_input(const IntrinsicTriangulation& base, Diagram diagram,
                         const Progress& progress) {
    Poller poller(progress);
    Diagram
        mapped;  // Only the edges' points and arcs, and areas; passages are of the base's faces.
    mapped.cell_area = diagram.cell_area;
    EdgeMapper(base, diagram, mapped, Ticker(poller)).map_edges();
    diagram.points = std::move(mapped.points);
    diagram.point_distance = std::move(mapped.point_distance);
    diagram.edge_points = std::move(mapped.edge_points);
    diagram.arcs = std::move(mapped.arcs);
    diagram.edge_arcs = std::move(mapped.edge_arcs);
    diagram.cell_area = std::move(mapped.cell_area);
    diagram.passages.clear();
    diagram.vertices = base.to_input(diagram.vertices);
    diagram.nearest_site.resize(base.input().num_vertices());
    diagram.nearest_distance.resize(base.input().num_vertices());
    return diagram;
}

}  // namespace agvd
