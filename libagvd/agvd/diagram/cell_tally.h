//! \file
//! Areas and Euler characteristics of cells.
#pragma once

#include "agvd/diagram/cell_set.h"
#include "agvd/diagram/diagram.h"
#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/face_arcs.h"

namespace agvd {

//! Parts of the complex are added and removed in any order. Areas are whole numbers of units of
//! about 2^-61 of the surface's area, so that sums do not depend on the order. An open cell is a
//! union of open pieces of triangles, open intervals of inner edges and cuts, and inner points; the
//! alternating sum of their numbers is its Euler characteristic (without the surface's boundary).
class CellTally {
public:
    //! Of no sites.
    //! \param surface  outlives this.
    explicit CellTally(const Surface& surface);
    //! Of so many sites; new ones have nothing.
    void resize(Index num_sites) { cells_.resize(num_sites); }

    // A site that is no_index has no cell, and nothing is counted.
    // \param sign  1: the part is added; -1: it is removed.

    //! A vertex, and the first interval of each edge whose edge_half leaves it.
    void count_vertex(Index vertex, Index site, int sign);
    //! Adds all vertices. Cost: O(#F), in order.
    void count_vertices(std::span<const Index> vertex_site);
    //! The other intervals of an edge.
    void count_row(std::span<const Crossing> row, int sign);
    //! An inner point.
    void count_inner_point(const InnerPoint& point) { count(point.site, 1); }
    //! The intervals of a cut.
    //! \param site_at_end  of its last one.
    void count_cut(std::span<const Crossing> row, Index site_at_end, int sign);
    //! An unlisted face.
    void count_face(Index face, Index site, int sign);
    //! The pieces of a listed face.
    void count_parts(std::span<const FaceArcs::CellPart> parts, int sign);

    //! The cells of which a part was added or removed since the last call.
    [[nodiscard]] CellSet take_changed();

    //! Sets cell_area and cell_euler.
    void write(Diagram& diagram) const;

private:
    struct Cell {
        std::int64_t area = 0;  // In units.
        int euler = 0;
        bool is_changed = false;
    };

    void count(Index site, int change) {
        if (site != no_index) change_cell(site, change, 0);
    }
    void change_cell(Index site, int euler, std::int64_t area) {
        Cell& cell = cells_[site];
        cell.euler += euler;
        // Wraps, so that what is removed undoes what was added, whatever that was.
        cell.area = static_cast<std::int64_t>(static_cast<std::uint64_t>(cell.area) +
                                              static_cast<std::uint64_t>(area));
        cell.is_changed = true;
    }
    [[nodiscard]] std::int64_t units(double area) const;

    const Surface* surface_;
    double unit_ = 1;  // Of area: a power of two.
    std::vector<Cell> cells_;
};

}  // namespace agvd
