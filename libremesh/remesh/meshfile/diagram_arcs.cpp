#include "remesh/meshfile/diagram_arcs.h"

#include <algorithm>

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

void append_foci(VtpWriter& writer, const Surface& surface,
                 std::span<const BisectorArc* const> cells, Ticker& ticker) {
    std::array<std::vector<double>, 2> foci, weights;
    for (std::size_t k = 0; k < 2; ++k) {
        foci[k].resize(3 * cells.size());
        weights[k].resize(cells.size());
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        ticker.tick();
        if (cells[i] == nullptr) continue;
        for (std::size_t k = 0; k < 2; ++k) weights[k][i] = cells[i]->weight[k];
        if (cells[i]->kind == ArcKind::Chord) continue;
        const auto in_space = foci_in_space(surface, *cells[i]);
        for (std::size_t k = 0; k < 2; ++k) {
            std::copy(in_space[k].begin(), in_space[k].end(), &foci[k][3 * i]);
        }
    }
    for (std::size_t k = 0; k < 2; ++k) {
        const std::string side = k == 0 ? "left" : "right";
        writer.add_numbers<double>("focus_" + side, "Float64", 3, foci[k]);
        writer.add_numbers<double>("weight_" + side, "Float64", 1, weights[k]);
    }
}

}  // namespace remesh
