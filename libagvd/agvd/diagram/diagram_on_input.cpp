// Polylines are mapped piece by piece. A chord crosses the input's edges beside its arc; Newton
// along the edge finds the arc's own point. A piece is halved, at a point of the arc, unless its
// arc crosses the same edges and no others: each part of the arc lies in the triangle of its chord
// and its tangents, which must lie in the face.
#include <cmath>
#include <optional>

#include "agvd/diagram/bisectors.h"
#include "agvd/diagram/conic.h"
#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

constexpr std::size_t segment_work = 16;  // Ticks of a segment.
constexpr int most_halvings = 40;
constexpr int most_halvings_of_arc = 400;
constexpr int most_newton_steps = 12;
// A share of a face's longest side: points so near to a side lie on it.
constexpr double beside_face = 1e-12;
// A crossing moves at most so many lengths of the segment that tells the arc's direction.
constexpr double farthest_move = 100;

// A point, and where it lies in the plane of its face.
struct PlacedPoint {
    SurfacePoint point;
    Vec2 at;
};

// The part of a piece in one face of the input.
struct InputSegment {
    PlacedPoint begin, end;  // On the input.
    Vec2 from, to;           // In the plane of the base's face.
};

// From one plane into another that has these two points, too. Exact at the first.
Motion motion_between(const Vec2& from, const Vec2& to, const Vec2& from_there,
                      const Vec2& to_there) {
    const Vec2 here = to - from, there = to_there - from_there;
    Vec2 axis(here.dot(there), cross(here, there));
    axis = axis.norm() > 0 ? Vec2(axis.normalized()) : Vec2(1, 0);
    const Motion turn{axis, {0, 0}};
    return {axis, from_there - turn(from)};
}

Conic moved(const Motion& motion, const Conic& conic) {
    return {{motion(conic.focus[0]), motion(conic.focus[1])}, conic.weight};
}

Vec2 moved_back(const Motion& motion, const Vec2& p) {
    return Motion{{motion.axis.x(), -motion.axis.y()}, {0, 0}}(p - motion.origin);
}

// Draws Voronoi edges on the faces of another mesh, point by point.
class EdgeMapper {
public:
    EdgeMapper(const IntrinsicTriangulation& base, const Diagram& from, Diagram& to, Ticker ticker)
        : base_(base), input_(base.input()), from_(from), to_(to), ticker_(ticker) {}

    void map_edges() {
        to_.edge_points.push_back(0);
        if (!from_.edge_arcs.empty()) to_.edge_arcs.push_back(0);
        for (Index e = 0; e < from_.edges.size(); ++e) {
            const Index begin = from_.edge_points[e], end = from_.edge_points[e + 1];
            const bool is_closed = from_.edges[e].tail == no_index;
            const Index num_pieces = begin == end ? 0 : end - begin - (is_closed ? 0 : 1);
            const bool has_arcs =
                !from_.edge_arcs.empty() && from_.edge_arcs[e] < from_.edge_arcs[e + 1];
            if (has_arcs) {
                map_arcs(e, begin + num_pieces);
            } else {
                for (Index i = begin; i < begin + num_pieces; ++i) map_piece(e, i);
            }
            if (!is_closed)
                add(base_.to_input(from_.points[end - 1]), from_.point_distance[end - 1]);
            to_.edge_points.push_back(static_cast<Index>(to_.points.size()));
            if (!from_.edge_arcs.empty()) {
                to_.edge_arcs.push_back(static_cast<Index>(to_.arcs.size()));
            }
        }
    }

private:
    void add(const SurfacePoint& point, double distance) {
        to_.points.push_back(point);
        to_.point_distance.push_back(distance);
    }

    [[nodiscard]] Index next_of(Index edge, Index point) const {
        return point + 1 == from_.edge_points[edge + 1] ? from_.edge_points[edge] : point + 1;
    }

    // --- Pieces without arcs -------------------------------------------------------------------

    // But for its end.
    void map_piece(Index edge, Index begin) {
        const CurvePiece piece = curve_piece(base_.surface(), from_, edge, begin);
        const double at_begin = from_.point_distance[begin];
        const double at_end = from_.point_distance[next_of(edge, begin)];
        cut({piece.from, {0, 0}}, {piece.to, {1, 0}});
        for (const InputSegment& segment : segments_) {
            const double share = segment.from.x();
            add(segment.begin.point, (1 - share) * at_begin + share * at_end);
        }
    }

    // The segments of a straight piece in one face of the base.
    void cut(const PlacedPoint& begin, const PlacedPoint& end) {
        ticker_.tick(segment_work);
        parts_.clear();
        base_.to_input(begin.point, end.point, parts_);
        segments_.clear();
        const auto place = [&](const SurfacePoint& p) {
            return PlacedPoint{p, position_in_frame(input_, p, 3 * p.face.value())};
        };
        double length = 0;
        for (std::size_t i = 0; i < parts_.size(); i += 2) {
            segments_.push_back({place(parts_[i]), place(parts_[i + 1]), begin.at, end.at});
            length += length_of(segments_.back());
        }
        double passed = 0;
        for (InputSegment& segment : segments_) {
            const auto at = [&](double reached) -> Vec2 {
                const double share = length > 0 ? reached / length : 0;
                return (1 - share) * begin.at + share * end.at;
            };
            segment.from = at(passed);
            passed += length_of(segment);
            if (&segment != &segments_.back()) segment.to = at(passed);
        }
    }
    [[nodiscard]] static double length_of(const InputSegment& segment) {
        return (segment.end.at - segment.begin.at).norm();
    }

    // --- Arcs ----------------------------------------------------------------------------------

    // \param last  point at which the edge ends; of a closed one the number of its first point and
    //              of all others.
    void map_arcs(Index edge, Index last) {
        for (Index a = from_.edge_arcs[edge]; a < from_.edge_arcs[edge + 1]; ++a) {
            const bool is_last = a + 1 == from_.edge_arcs[edge + 1];
            const Index end = is_last ? last : from_.arcs[a + 1].first_point;
            arc_ = from_.arcs[a];
            conic_ = {arc_.focus, arc_.weight};
            doubled_area_ = 0;
            halvings_left_ = most_halvings_of_arc;
            face_ = no_index;
            for (Index i = arc_.first_point; i < end; ++i) {
                const CurvePiece piece = curve_piece(base_.surface(), from_, edge, i);
                const auto place = [&](const SurfacePoint& p) {
                    return PlacedPoint{p,
                                       position_in_frame(base_.surface(), p, 3 * p.face.value())};
                };
                map_arc_piece(place(piece.from), place(piece.to), from_.point_distance[i],
                              from_.point_distance[next_of(edge, i)], 0);
            }
            finish_arc();
            const VoronoiEdge& sides = from_.edges[edge];
            to_.cell_area[sides.left.value()] += doubled_area_ / 2;
            to_.cell_area[sides.right.value()] -= doubled_area_ / 2;
        }
    }

    void map_arc_piece(const PlacedPoint& begin, const PlacedPoint& end, double at_begin,
                       double at_end, int depth) {
        cut(begin, end);
        join_segments();
        const bool is_chord = arc_.kind == ArcKind::Chord;
        if (!is_chord && depth < most_halvings && halvings_left_ > 0 && !follows_arc()) {
            --halvings_left_;
            const Vec2 top = conic_.opposite(begin.at, end.at, 0.5);
            const PlacedPoint middle{to_surface(base_.surface(), arc_.face.value(), top), top};
            const double distance = (top - conic_.focus[0]).norm() + conic_.weight[0];
            doubled_area_ += cross(top - begin.at, end.at - begin.at);
            map_arc_piece(begin, middle, at_begin, distance, depth + 1);
            map_arc_piece(middle, end, distance, at_end, depth + 1);
            return;
        }
        const double length = (end.at - begin.at).norm();
        for (std::size_t i = 0; i < segments_.size(); ++i) {
            const InputSegment& segment = segments_[i];
            const double share = length > 0 ? (segment.from - begin.at).norm() / length : 0;
            const double distance =
                i == 0     ? at_begin
                : is_chord ? (1 - share) * at_begin + share * at_end
                           : (segment.from - conic_.focus[0]).norm() + conic_.weight[0];
            go_on(segment);
            add(segment.begin.point, distance);
            doubled_area_ += cross(segment.from - begin.at, segment.to - begin.at);
        }
    }

    // Parts in one face that follow each other are one.
    void join_segments() {
        std::size_t last = 0;
        for (std::size_t i = 1; i < segments_.size(); ++i) {
            if (segments_[i].begin.point.face == segments_[last].begin.point.face) {
                segments_[last].end = segments_[i].end;
                segments_[last].to = segments_[i].to;
            } else {
                segments_[++last] = segments_[i];
            }
        }
        segments_.resize(last + 1);
    }

    // The side of the first segment's face through which the piece comes to the second.
    [[nodiscard]] std::optional<Index> edge_between(const InputSegment& a,
                                                    const InputSegment& b) const {
        std::optional<Index> best;
        for (Index k = 0; k < 3; ++k) {
            const Index h = 3 * a.begin.point.face.value() + k;
            const Index twin = input_.twin[h];
            if (twin == no_index || Surface::face(twin) != b.begin.point.face.value()) continue;
            const auto opposite = [&](Index side) {
                return a.end.point.barycentric[(side + 2) % 3];
            };
            if (!best || opposite(k) < opposite(*best % 3)) best = h;
        }
        return best;
    }

    // Moves the crossings onto the arc. False, and some are moved: it takes another way.
    [[nodiscard]] bool follows_arc() {
        for (std::size_t i = 0; i + 1 < segments_.size(); ++i) {
            if (!move_crossing(segments_[i], segments_[i + 1])) return false;
        }
        if (arc_.kind == ArcKind::Line) return true;
        for (const InputSegment& segment : segments_) {
            if (!stays_in_face(segment)) return false;
        }
        return true;
    }

    [[nodiscard]] bool move_crossing(InputSegment& before, InputSegment& behind) {
        const std::optional<Index> half_edge = edge_between(before, behind);
        if (!half_edge) return false;
        // The longer segment tells the direction better. Its first end may have been moved.
        const bool by_before = length_of(before) >= length_of(behind);
        const InputSegment& known = by_before ? before : behind;
        const Motion motion = motion_between(known.from, known.to, known.begin.at, known.end.at);
        const Conic conic = moved(motion, conic_);
        const Index here = by_before ? *half_edge : input_.twin[*half_edge];
        const auto corners = face_corners(input_, Surface::face(here));
        const Vec2& tail = corners[here % 3];
        const Vec2 along = corners[(here + 1) % 3] - tail;
        double at = (known.end.at - tail).dot(along) / along.squaredNorm();
        if (!by_before) at = (known.begin.at - tail).dot(along) / along.squaredNorm();
        const Vec2 start = tail + at * along;
        for (int i = 0; i < most_newton_steps; ++i) {
            const Vec2 p = tail + at * along;
            const double step = conic.gap(p) / conic.gradient(p).dot(along);
            if (!std::isfinite(step)) return false;
            at -= step;
            if (std::abs(step) <= 1e-15) break;
        }
        if (!(at > 0 && at < 1)) return false;
        const Vec2 p = tail + at * along;
        if ((p - start).norm() > farthest_move * length_of(known)) return false;
        const Vec2 in_base = moved_back(motion, p);
        const SurfacePoint there = point_on(*half_edge, by_before ? at : 1 - at);
        const SurfacePoint across = across_edge(input_, there, *half_edge);
        before.end = {there, position_in_frame(input_, there, 3 * there.face.value())};
        behind.begin = {across, position_in_frame(input_, across, 3 * across.face.value())};
        before.to = behind.from = in_base;
        return true;
    }

    // Whether chord and tangents of the arc enclose a part of the face only.
    [[nodiscard]] bool stays_in_face(const InputSegment& segment) const {
        const Conic conic = moved(
            motion_between(segment.from, segment.to, segment.begin.at, segment.end.at), conic_);
        const Vec2 chord = segment.end.at - segment.begin.at;
        const Vec2 first = conic.gradient(segment.begin.at);
        const Vec2 last = conic.gradient(segment.end.at);
        const double turn = cross(first, last);
        // Below the rounding of the face's size it does not matter where the tangents meet.
        const auto corners = face_corners(input_, segment.begin.point.face.value());
        const double size = longest_side(corners);
        if (std::abs(turn) * chord.norm() <= beside_face * size * first.norm() * last.norm()) {
            return true;
        }
        // Tangents are perpendicular to gradients.
        const double reach = chord.dot(last) / turn;
        const Vec2 apex = segment.begin.at + reach * Vec2(-first.y(), first.x());
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 side = corners[(k + 1) % 3] - corners[k];
            if (!(cross(side, apex - corners[k]) >= -beside_face * size * side.norm())) {
                return false;
            }
        }
        return true;
    }

    // Lets the arc go on along a segment, whose first point is added next: in the same face, or in
    // another one, which begins an arc of its own.
    void go_on(const InputSegment& segment) {
        const Index face = segment.begin.point.face.value();
        if (face != face_) {
            finish_arc();
            face_ = face;
            first_point_ = static_cast<Index>(to_.points.size());
            run_ = segment;
        }
        run_.end = segment.end;
        run_.to = segment.to;
    }

    // The arc on the input, in one face.
    void finish_arc() {
        if (face_ == no_index) return;
        const Conic conic =
            moved(motion_between(run_.from, run_.to, run_.begin.at, run_.end.at), conic_);
        to_.arcs.push_back({FaceId(face_), arc_.kind, first_point_, conic.focus, conic.weight,
                            run_.begin.at, run_.end.at});
        face_ = no_index;
    }

    const IntrinsicTriangulation& base_;
    const Surface& input_;
    const Diagram& from_;
    Diagram& to_;
    Ticker ticker_;
    std::vector<SurfacePoint> parts_;  // Two a part.
    std::vector<InputSegment> segments_;

    // The arc at hand, on the base.
    BisectorArc arc_;
    Conic conic_;
    int halvings_left_ = 0;
    double doubled_area_ = 0;  // Between its polylines there and here.
    // Its part in the input's face at hand; no_index: none.
    Index face_ = no_index;
    Index first_point_ = 0;
    InputSegment run_;
};

}  // namespace

Diagram diagram_on_input(const IntrinsicTriangulation& base, Diagram diagram,
                         const Progress& progress) {
    Poller poller(progress);
    Diagram mapped;  // Only points and arcs of the edges; passages are of the base's faces.
    mapped.cell_area = std::move(diagram.cell_area);
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
