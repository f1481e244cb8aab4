#include "agvd/diagram/cell_tally.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "agvd/mesh/surface.h"

namespace agvd {

CellTally::CellTally(const Surface& surface) : surface_(&surface) {
    const double area = surface_area(surface);
    constexpr int bits = 61;
    constexpr int least_exponent = -1000;  // Its inverse is finite, too.
    if (area > 0) unit_ = std::ldexp(1.0, std::max(std::ilogb(area) - bits, least_exponent));
}

void CellTally::count_vertex(Index vertex, Index site, int sign) {
    if (surface_->outgoing[vertex] == no_index) return;
    count(site, sign);
    // One boundary edge leaves each vertex of the boundary, and both are left out.
    for_each_outgoing(*surface_, vertex, [&](Index h) {
        if (h < surface_->twin[h]) count(site, -sign);
    });
}

void CellTally::count_vertices(std::span<const Index> vertex_site) {
    for (Index v = 0; v < surface_->num_vertices(); ++v) {
        if (surface_->outgoing[v] != no_index) count(vertex_site[v], 1);
    }
    for (Index f = 0; f < surface_->num_faces(); ++f) {
        for (Index k = 0; k < 3; ++k) {
            const Index h = 3 * f + k;
            if (h < surface_->twin[h]) count(vertex_site[surface_->mesh.triangles[f][k]], -1);
        }
    }
}

void CellTally::count_row(std::span<const Crossing> row, int sign) {
    if (row.empty()) return;
    if (surface_->twin[row[0].line.half_edge()] == no_index) return;
    for (const Crossing& crossing : row) count(crossing.site_after, -sign);
}

void CellTally::count_cut(std::span<const Crossing> row, Index site_at_end, int sign) {
    for (const Crossing& crossing : row) count(crossing.site_before, -sign);
    count(site_at_end, -sign);
}

void CellTally::count_face(Index face, Index site, int sign) {
    if (site == no_index) return;
    // At least one unit: a cell that owns a face is not empty, however small its component is.
    const std::int64_t area = std::max(units(face_area(*surface_, face)), std::int64_t{1});
    change_cell(site, sign, sign * area);
}

void CellTally::count_parts(std::span<const FaceArcs::CellPart> parts, int sign) {
    for (const FaceArcs::CellPart& part : parts) {
        if (part.site == no_index) continue;
        change_cell(part.site, sign * part.pieces, sign * units(part.area));
    }
}

CellSet CellTally::take_changed() {
    CellSet changed(static_cast<Index>(cells_.size()));
    for (Index s = 0; s < cells_.size(); ++s) {
        if (std::exchange(cells_[s].is_changed, false)) changed.insert(s);
    }
    return changed;
}

void CellTally::write(Diagram& diagram) const {
    diagram.cell_area.clear();
    diagram.cell_euler.clear();
    for (const Cell& cell : cells_) {
        diagram.cell_area.push_back(static_cast<double>(cell.area) * unit_);
        diagram.cell_euler.push_back(cell.euler);
    }
}

std::int64_t CellTally::units(double area) const {
    const double count = area * (1 / unit_);
    // A part that is larger than the surface has lost its digits: its triangle is 10^15 times as
    // long as wide.
    constexpr double most = 0x1p62;
    return std::abs(count) <= most ? std::llrint(count) : 0;
}

}  // namespace agvd
