#include "agvd/diagram/triangle_boundary.h"

#include <algorithm>

#include "agvd/diagram/face_relays.h"

namespace agvd {
namespace {

Vec2 position_of(const TriangleBoundary& boundary, const LocalDiagram& local, NodeId node) {
    return node.is_voronoi_vertex() ? local.voronoi_vertices[node.voronoi_vertex()].position
                                    : boundary.breakpoints[node.crossing()].position;
}

void add_area_along(const TriangleBoundary& boundary, const LocalDiagram& local,
                    const LocalArc& arc, TriangleParts parts) {
    const Vec2 head = position_of(boundary, local, arc.head);
    Vec2 last = position_of(boundary, local, arc.tail);
    double doubled = 0;
    for (Index j = arc.first_point; j < arc.first_point + arc.num_points; ++j) {
        doubled += cross(last, local.points[j]);
        last = local.points[j];
    }
    doubled += cross(last, head);
    parts.add(arc.left, 0, doubled / 2);
    parts.add(arc.right, 0, -doubled / 2);
}

}  // namespace

void collect_breakpoints(const EdgeLabels& labels, const std::array<TriangleSide, 3>& sides,
                         Index site, TriangleBoundary& boundary, TriangleParts parts) {
    boundary.breakpoints.clear();
    boundary.nodes.clear();
    if (std::all_of(sides.begin(), sides.end(),
                    [](const TriangleSide& side) { return side.row.count == 0; })) {
        return;
    }
    for (const TriangleSide& side : sides) {
        Vec2 last = side.from;
        for (Index j = 0; j < side.row.count; ++j) {
            const Index crossing = side.row.begin + (side.forward ? j : side.row.count - 1 - j);
            const Crossing& c = labels.crossings[crossing];
            const double at = side.forward ? c.at : 1 - c.at;
            const Vec2 p = (1 - at) * side.from + at * side.to;
            parts.add(site, 0, cross(last, p) / 2);
            site = side.forward ? c.site_after : c.site_before;
            const bool is_last = j + 1 == side.row.count;
            const IntervalId interval =
                is_last ? IntervalId::to_point(side.to_point)
                        : IntervalId::after_crossing(side.forward ? crossing : crossing - 1);
            const auto place = static_cast<Index>(boundary.breakpoints.size());
            boundary.breakpoints.push_back(
                {p, c.distance, NodeId::of_crossing(place), site, interval});
            boundary.nodes.push_back({crossing, side.is_across});
            last = p;
        }
        parts.add(site, 0, cross(last, side.to) / 2);
    }
}

void count_arcs(const TriangleBoundary& boundary, const LocalDiagram& local,
                const LocalDiagram::Mark& before, TriangleParts parts) {
    for (const Breakpoint& breakpoint : boundary.breakpoints) {
        parts.add(breakpoint.site_after, 1, 0);
    }
    for (std::size_t i = before.connections; i < local.connections.size(); ++i) {
        parts.add(local.connections[i].site, -1, 0);
    }
    for (std::size_t i = before.arcs; i < local.arcs.size(); ++i) {
        add_area_along(boundary, local, local.arcs[i], parts);
    }
}

void name_nodes(const TriangleBoundary& boundary, Index first_arc, LocalDiagram& local) {
    for (std::size_t i = first_arc; i < local.arcs.size(); ++i) {
        LocalArc& arc = local.arcs[i];
        for (const bool at_tail : {true, false}) {
            NodeId& node = at_tail ? arc.tail : arc.head;
            if (node.is_voronoi_vertex()) continue;
            const auto& [crossing, is_across] = boundary.nodes[node.crossing()];
            (at_tail ? arc.tail_is_across : arc.head_is_across) = is_across;
            node = NodeId::of_crossing(crossing);
        }
    }
}

}  // namespace agvd
