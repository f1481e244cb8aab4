//! \file
//! How a number of sites is shared between the curves of a surface and what lies between them.
#pragma once

#include "remesh/features/curve_sites.h"

namespace remesh {

//! A network with what sampling has to know of it.
struct NetworkPlan {
    CurveNetwork network;
    CutSurface cut;                          //!< The surface, cut along it.
    std::vector<std::vector<double>> along;  //!< By curve: where its sites belong.
    std::vector<agvd::Index> intervals;      //!< By curve: these divide it into so many.
    JunctionSet junctions;                   //!< Those given; none where the sites are too few.
    double spacing = 0;                      //!< Mesh units: of neighbouring sites.
    double length = 0;                       //!< Of the creases kept, mesh units.
    double dropped_length = 0;               //!< Of those that the sites are too few for.
    agvd::Index sites_for_junctions = 0;     //!< Fewest vertices with which these are kept.
    agvd::Index sites_for_all = 0;           //!< Fewest vertices with which all are kept.
};

//! Boundary, creases and junctions, with the spacing at which the vertices of curves and patches
//! are so many. Where these are too few for all curves, the shortest creases go first; where they
//! are too few for the junctions alone, these go at once.
//!
//! \param is_crease   #E.
//! \param num_vertices  of the result: see num_curve_vertices.
//! \param drop_share  in [0, 1]: of the creases, shortest first, that go whatever there is.
//! \return without curves if there is neither crease nor junction, or none is left.
//! \throw agvd::Cancelled  the progress callback returned false.
//! Cost: O(n), again for each tenth of the creases that is dropped.
[[nodiscard]] NetworkPlan plan_network(const agvd::Surface& surface,
                                       std::vector<std::uint8_t> is_crease,
                                       agvd::Index num_vertices, JunctionSet junctions = {},
                                       double drop_share = 0, int num_threads = 0,
                                       const agvd::Progress& progress = {});

//! Takes the shortest creases of a network away.
//!
//! \param share  in [0, 1]: of their number, rounded up. \param is_crease  #E; changed.
void drop_shortest(const agvd::Surface& surface, const CurveNetwork& network, double share,
                   std::vector<std::uint8_t>& is_crease);

//! Sum over the edges that are creases.
[[nodiscard]] double length_of(const agvd::Surface& surface,
                               std::span<const std::uint8_t> is_crease);

}  // namespace remesh
