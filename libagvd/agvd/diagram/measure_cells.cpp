// Areas are whole numbers of 2^-61 of the surface's area, so that sums do not depend on the order.
// The Euler characteristic is the alternating sum of a cell's faces, intervals and points.
#include <algorithm>
#include <cmath>

#include "agvd/diagram/stages.h"
#include "agvd/mesh/surface.h"

namespace agvd {
namespace {

class CellTally {
public:
    CellTally(const Surface& surface, const DiagramParts& parts, Index num_sites)
        : surface_(surface), labels_(parts.labels), arcs_(parts.arcs), cells_(num_sites) {
        const double area = surface_area(surface);
        constexpr int bits = 61;
        constexpr int least_exponent = -1000;  // Its inverse is finite, too.
        if (area > 0) unit_ = std::ldexp(1.0, std::max(std::ilogb(area) - bits, least_exponent));
    }

    // One boundary edge leaves each vertex of the boundary, and both are left out.
    void count_points() {
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            if (surface_.outgoing[v] != no_index) count(labels_.point_site[v], 1);
        }
        for (const InnerPoint& point : labels_.inner_points) count(point.site, 1);
    }

    // The first interval of an edge has the label of the tail of its edge_half.
    void count_edges() {
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            const Index h = surface_.edge_half[e];
            count(labels_.point_site[surface_.tail(h)], -1);
            if (surface_.twin[h] == no_index) continue;
            for (const Crossing& crossing : labels_.on_edge(e)) count(crossing.site_after, -1);
        }
        for (const Cut& cut : labels_.cuts) {
            for (const Crossing& crossing : elements_of(labels_.crossings, cut.row)) {
                count(crossing.site_before, -1);
            }
            count(labels_.point_site[cut.to.point], -1);
        }
    }

    void count_faces(Ticker& ticker) {
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            ticker.tick();
            if (labels_.mixed_index[f] == no_index) {
                // At least one unit: a cell that owns a face is not empty, however small its
                // component is.
                const std::int64_t area = std::max(units(face_area(surface_, f)), std::int64_t{1});
                count(labels_.point_site[surface_.mesh.triangles[f][0]], 1, area);
                continue;
            }
            const FaceArcs& face = arcs_.faces[labels_.mixed_index[f]];
            for (const CellPart& part : elements_of(arcs_.parts, face.parts)) {
                count(part.site, part.pieces, units(part.area));
            }
        }
    }

    void write(Diagram& diagram) const {
        for (const Cell& cell : cells_) {
            diagram.cell_area.push_back(static_cast<double>(cell.area) * unit_);
            diagram.cell_euler.push_back(cell.euler);
        }
    }

private:
    struct Cell {
        std::int64_t area = 0;  // In units.
        int euler = 0;
    };

    void count(Index site, int euler, std::int64_t area = 0) {
        if (site == no_index) return;
        Cell& cell = cells_[site];
        cell.euler += euler;
        // Wraps where areas are wrong.
        cell.area = static_cast<std::int64_t>(static_cast<std::uint64_t>(cell.area) +
                                              static_cast<std::uint64_t>(area));
    }

    [[nodiscard]] std::int64_t units(double area) const {
        const double count = area * (1 / unit_);
        // A part that is larger than the surface has lost its digits: its triangle is 10^15 times
        // as long as wide.
        constexpr double most = 0x1p62;
        return std::abs(count) <= most ? std::llrint(count) : 0;
    }

    const Surface& surface_;
    const EdgeLabels& labels_;
    const Arcs& arcs_;
    double unit_ = 1;  // Of area: a power of two.
    std::vector<Cell> cells_;
};

}  // namespace

void measure_cells(const Surface& surface, const DiagramParts& parts, Ticker ticker,
                   Diagram& diagram) {
    CellTally tally(surface, parts, diagram.num_sites);
    tally.count_points();
    tally.count_edges();
    tally.count_faces(ticker);
    tally.write(diagram);
}

}  // namespace agvd
