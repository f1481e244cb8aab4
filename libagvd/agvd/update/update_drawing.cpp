#include "agvd/update/update_drawing.h"

#include <utility>

#include "agvd/diagram/draw_points.h"

namespace agvd {
namespace {

void copy_points(const KeptDiagram& kept, const Block& points, Diagram& out) {
    const auto copy = [&](const auto& from, auto& to) {
        to.insert(to.end(), from.begin() + points.begin, from.begin() + points.end());
    };
    copy(kept.points, out.points);
    copy(kept.point_distance, out.point_distance);
    copy(kept.passages, out.passages);
}

// Edge after edge.
void gather_points(const DrawingInput& input, Ticker& ticker, KeptDiagram& kept, Diagram& out) {
    std::swap(out.points, kept.points);
    std::swap(out.point_distance, kept.point_distance);
    std::swap(out.passages, kept.passages);
    clear_points(input, out);
    // Old ones that follow one another are copied together.
    Block waiting;
    const auto copy_waiting = [&] { copy_points(kept, std::exchange(waiting, {}), out); };
    for (const Index name : input.parts.joined.order) {
        Block& drawn = kept.parts.joined.edges[name].drawn;
        if (drawn.count == 0 || drawn.begin != waiting.end()) copy_waiting();
        const Index first = out.edge_points.back();
        if (drawn.count == 0) {
            draw_edge(input, name, ticker, out);
            drawn.count = out.edge_points.back() - first;
        } else {
            if (waiting.count == 0) waiting.begin = drawn.begin;
            waiting.count += drawn.count;
            out.edge_points.push_back(first + drawn.count);
        }
        drawn.begin = first;
    }
    copy_waiting();
}

}  // namespace

void update_drawing(const Surface& surface, Ticker ticker, KeptDiagram& kept, Diagram& diagram) {
    const DrawingInput input = drawing_input(surface, kept.parts, kept.voronoi_vertices);
    draw_complex(input, ticker, diagram);
    gather_points(input, ticker, kept, diagram);
    draw_boundary(input, diagram);
    draw_vertices(input, diagram);
    kept.parts.tally.write(diagram);
    diagram.num_sites = static_cast<Index>(diagram.cell_area.size());
}

}  // namespace agvd
