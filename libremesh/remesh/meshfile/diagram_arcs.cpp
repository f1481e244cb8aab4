#include "remesh/meshfile/diagram_arcs.h"

#include "remesh/meshfile/formats.h"

namespace remesh {

std::string arc_header(const Diagram& diagram) {
    std::string text =
        "comment arcs of the voronoi edges in turn; kind 0: line, 1: hyperbola, 2: chord\n"
        "comment in the face's plane, corner 0 at the origin, corner 1 on the x axis\n"
        "element arc " +
        std::to_string(diagram.arcs.size()) + '\n';
    constexpr std::size_t num_whole = 6;
    std::size_t place = 0;
    for (const char* name : arc_properties) {
        text += std::string(place++ < num_whole ? "property int " : "property double ") + name;
        text += '\n';
    }
    return text;
}

void append_arcs(std::string& bytes, const Diagram& diagram, Ticker& ticker) {
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const auto& [left, right, tail, head] = diagram.edges[e];
        for (Index a = diagram.edge_arcs[e]; a < diagram.edge_arcs[e + 1]; ++a) {
            ticker.tick();
            const BisectorArc& arc = diagram.arcs[a];
            append_all(bytes, e, arc.face.value(), static_cast<std::int32_t>(arc.kind),
                       arc.first_point, left.value(), right.value());
            for (std::size_t k = 0; k < 2; ++k) {
                append_all(bytes, arc.focus[k].x(), arc.focus[k].y(), arc.weight[k]);
            }
            append_all(bytes, arc.begin.x(), arc.begin.y(), arc.end.x(), arc.end.y());
        }
    }
}

void append_foci(VtpWriter& writer, const Surface& surface, std::span<const BisectorArc> cells,
                 Ticker& ticker) {
    const auto has_foci = [](const BisectorArc& arc) {
        return arc.face.is_valid() && arc.kind != ArcKind::Chord;
    };
    for (std::size_t k = 0; k < 2; ++k) {
        const std::string side = k == 0 ? "left" : "right";
        writer.add_array<double>("focus_" + side, "Float64", 3, cells.size(), ticker,
                                 [&](std::size_t i) -> Vec3 {
                                     if (!has_foci(cells[i])) return {0, 0, 0};
                                     return foci_in_space(surface, cells[i])[k];
                                 });
        writer.add_array<double>("weight_" + side, "Float64", 1, cells.size(), ticker,
                                 [&](std::size_t i) { return std::array{cells[i].weight[k]}; });
    }
}

}  // namespace remesh
