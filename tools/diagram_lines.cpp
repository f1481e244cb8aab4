#include "diagram_lines.h"

namespace cli {
namespace {

using agvd::Index;
using agvd::Vec2;
using agvd::Vec3;

// A position in a face's plane, in space.
Vec3 in_space(const agvd::Surface& surface, Index face, const Vec2& p) {
    const auto& corners = surface.mesh.triangles[face];
    const auto& positions = surface.mesh.positions;
    const Vec3 origin = positions[corners[0]];
    const Vec3 along = (positions[corners[1]] - origin).normalized();
    const Vec3 normal = agvd::doubled_normal(positions, corners).normalized();
    return origin + p.x() * along + p.y() * normal.cross(along);
}

}  // namespace

remesh::Lines arc_lines(const agvd::Surface& surface, const agvd::Diagram& diagram) {
    remesh::Lines lines;
    remesh::Attribute distance{.name = "distance"};
    std::vector<remesh::Attribute> values;
    for (const char* name : {"edge", "site_left", "site_right", "face", "kind"}) {
        values.push_back({.name = name, .type = remesh::NumberType::Int32});
    }
    for (const char* name : {"focus_left_x", "focus_left_y", "focus_left_z", "weight_left",
                             "focus_right_x", "focus_right_y", "focus_right_z", "weight_right"}) {
        values.push_back({.name = name});
    }
    const auto add_point = [&](Index point) {
        lines.points.push_back(agvd::position(surface.mesh.view(), diagram.points[point]));
        distance.values.push_back(diagram.point_distance[point]);
    };
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const agvd::VoronoiEdge& edge = diagram.edges[e];
        const Index last_arc = diagram.edge_arcs[e + 1];
        const bool is_closed = edge.tail == agvd::no_index;
        for (Index a = diagram.edge_arcs[e]; a < last_arc; ++a) {
            const agvd::BisectorArc& arc = diagram.arcs[a];
            const bool is_last = a + 1 == last_arc;
            const Index end =
                is_last ? diagram.edge_points[e + 1] : diagram.arcs[a + 1].first_point + 1;
            for (Index p = arc.first_point; p < end; ++p) add_point(p);
            if (is_last && is_closed) add_point(diagram.edge_points[e]);
            lines.offsets.push_back(static_cast<Index>(lines.points.size()));
            const bool is_chord = arc.kind == agvd::ArcKind::Chord;
            const auto place = [&](const Vec2& focus) {
                return is_chord ? Vec3(0, 0, 0) : in_space(surface, arc.face.value(), focus);
            };
            const Vec3 left = place(arc.focus[0]), right = place(arc.focus[1]);
            const double row[] = {static_cast<double>(e),
                                  static_cast<double>(edge.left.value()),
                                  static_cast<double>(edge.right.value()),
                                  static_cast<double>(arc.face.value()),
                                  static_cast<double>(arc.kind),
                                  left.x(),
                                  left.y(),
                                  left.z(),
                                  arc.weight[0],
                                  right.x(),
                                  right.y(),
                                  right.z(),
                                  arc.weight[1]};
            for (std::size_t i = 0; i < values.size(); ++i) values[i].values.push_back(row[i]);
        }
    }
    lines.of_points = {std::move(distance)};
    lines.of_lines = std::move(values);
    return lines;
}

}  // namespace cli
