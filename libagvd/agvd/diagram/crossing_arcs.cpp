#include "agvd/diagram/crossing_arcs.h"

#include <cassert>

#include "agvd/diagram/face_relays.h"

namespace agvd {
namespace {

// Whether the ends of each segment lie on different sides of the other.
bool do_cross(const ArcSegment& s, const ArcSegment& t) {
    const Vec2 along_s = s.to - s.from;
    const double at_t_from = cross(along_s, t.from - s.from);
    const double at_t_to = cross(along_s, t.to - s.from);
    if (!((at_t_from < 0 && at_t_to > 0) || (at_t_from > 0 && at_t_to < 0))) return false;
    const Vec2 along_t = t.to - t.from;
    const double at_s_from = cross(along_t, s.from - t.from);
    const double at_s_to = cross(along_t, s.to - t.from);
    return (at_s_from < 0 && at_s_to > 0) || (at_s_from > 0 && at_s_to < 0);
}

void collect_segments(Index first_arc, std::span<const ArcPlace> places, const LocalDiagram& out,
                      std::vector<ArcSegment>& segments) {
    segments.clear();
    for (Index i = first_arc; i < out.arcs.size(); ++i) {
        const LocalArc& arc = out.arcs[i];
        const ArcPlace& place = places[i - first_arc];
        Vec2 last = place.tail;
        for (Index j = arc.first_point; j < arc.first_point + arc.num_points; ++j) {
            segments.push_back({i, last, out.points[j]});
            last = out.points[j];
        }
        segments.push_back({i, last, place.head});
    }
}

}  // namespace

bool straighten_crossing_arcs(const LocalDiagram::Mark& since, std::span<const ArcPlace> places,
                              std::vector<ArcSegment>& scratch, LocalDiagram& out) {
    assert(places.size() == out.arcs.size() - since.arcs);
    // Two segments that share an end do not cross.
    if (places.size() + out.points.size() - since.points < 3) return false;
    collect_segments(since.arcs, places, out, scratch);
    bool is_any = false;
    for (std::size_t i = 0; i < scratch.size(); ++i) {
        for (std::size_t j = i + 1; j < scratch.size(); ++j) {
            if (!do_cross(scratch[i], scratch[j])) continue;
            out.arcs[scratch[i].arc].num_points = 0;
            out.arcs[scratch[j].arc].num_points = 0;
            is_any = true;
        }
    }
    return is_any;
}

}  // namespace agvd
