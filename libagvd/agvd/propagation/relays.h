//! \file
//! What every propagation engine hands to the diagram: for each vertex its distance and nearest
//! site, and, in the faces where labels meet, the relays through which distances reach them.
#pragma once

#include <span>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"

namespace agvd {

//! An additively weighted point seen from inside a face ([meng2023] Sec. 4.2): a point p of the
//! face has distance weight + |image - p| from `site` through the relay. The image (x, y) is given
//! in the frame of `half_edge` of that face. With y < 0 the image lies across that edge: only
//! chords through [begin, end] of the edge
//! are straight, others bend at the nearer end of the interval. With y >= 0 the image lies in the
//! (convex) face itself and sees all of it.
struct Relay {
    double x = 0;  //!< Of the image, along the half-edge, mesh units.
    double y = 0;  //!< Of the image, to the left of the half-edge.
    //! Distance from the site to the image. An image that stands for several may lie farther off
    //! than the site, with a weight below 0.
    double weight = 0;
    //! Visible interval on the half-edge, 0 <= begin <= end <= length.
    double begin = 0;
    double end = 0;              //!< See begin.
    SiteId site;                 //!< Whose image it is.
    Index half_edge = no_index;  //!< In whose frame the image lies.
};

//! [begin, end) of Propagation::relays.
struct RelayRange {
    Index begin = 0;  //!< First relay.
    Index end = 0;    //!< One past the last relay.
    //! Whether both ends are equal.
    friend bool operator==(const RelayRange&, const RelayRange&) = default;
};

//! Distances that differ by less than this share are tied: it is a few hundred roundings of a
//! path's length.
inline constexpr double tie_tolerance = 1e-13;

//! Whether a site is nearer than another one, or tied with it and of a lower number.
[[nodiscard]] inline bool is_nearer(double distance, Index site, double other_distance,
                                    Index other_site) {
    const double slack = tie_tolerance * distance;
    if (distance < other_distance - slack) return true;
    return distance <= other_distance + slack && site < other_site;
}

//! Distances are lengths of real paths: but for rounding, they are never below the exact geodesic
//! distance.
struct Propagation {
    std::vector<SiteId> vertex_site;      //!< #V; invalid where no site reaches.
    std::vector<double> vertex_distance;  //!< #V; infinity where no site reaches.

    //! Ascending: vertices that a site reaches, but no window. Their distance is the length of a
    //! path along edges and across pairs of faces, rounded up. Windows with errors leave such gaps;
    //! exact windows do where lengths of edges differ by more than rounding allows.
    std::vector<Index> vertices_off_windows;

    //! Faces that may hold more than one label, ascending. Contract: an edge between a listed and
    //! an unlisted face, and a whole unlisted face, lie in the cell of their vertices' one site.
    std::vector<Index> mixed_faces;
    std::vector<RelayRange> relay_ranges;  //!< #mixed: where the relays of each mixed face stand.
    //! Ordered by face.
    std::vector<Relay> relays;

    //! Certified: no distance, at a vertex or through the relays, exceeds the exact one by more
    //! than this share of it (rounding in double apart). The Steiner engine's bound holds at the
    //! vertices only. Infinity: nothing is certified.
    double certified_error = std::numeric_limits<double>::infinity();

    std::size_t peak_bytes = 0;  //!< Most bytes held at once beyond the mesh, result included.
    //! Work done: graph nodes reached (in the last round of insertions), or windows served.
    std::size_t num_nodes = 0;
};

//! The relays of one mixed face.
[[nodiscard]] inline std::span<const Relay> relays_of(const Propagation& propagation,
                                                      Index mixed_index) {
    const auto [begin, end] = propagation.relay_ranges[mixed_index];
    return std::span(propagation.relays).subspan(begin, end - begin);
}

}  // namespace agvd
