//! \file
//! Which curves of a surface the caller's own sites carry.
#pragma once

#include "remesh/sampling/network_plan.h"

namespace remesh {

struct GivenNetwork {
    NetworkPlan plan;   //!< Without curves if none is carried; nothing is counted for all.
    CurveSites curves;  //!< The sites on these.
    std::vector<agvd::SurfacePoint> inner;  //!< The others, in their order.
    std::vector<agvd::Index> of_group;      //!< By group of `curves`: its number among the sites.
    std::vector<agvd::Index> of_inner;      //!< Likewise.
    agvd::Index dropped_curves = 0;         //!< Creases that the sites do not carry.
};

//! In spacings: nearer places are one, but for the decimals of a file or single precision.
inline constexpr double site_rounding = 1e-5;

struct GivenNetworkOptions {
    double spacing = 1;                //!< > 0, mesh units: of the sites.
    double tolerance = site_rounding;  //!< In spacings, >= site_rounding.
    double drop_share = 0;  //!< In [0, 1]: of the creases carried, shortest first, that go as well.
    int num_threads = 0;    //!< >= 0; 0: all cores. The same for any number.
    agvd::Progress progress = {};
};

//! A site that lies on an edge or vertex of the network, up to the tolerance, becomes a vertex of
//! it; of several at one place the first, and the others are left out. Sites carry a curve that has
//! one at each end, as many between as a triangulation needs, and no gap above four spacings.
//! Creases that are not carried are dropped; all are if part of the boundary is not, since cells
//! tell the two apart by their sites alone.
//!
//! \param is_crease  #E. \param sites  on the surface, no two at one place.
//! \throw agvd::Cancelled  the progress callback returned false.
//! Cost: O(n) for each time that creases are dropped; at most as often as there are creases.
[[nodiscard]] GivenNetwork plan_given_network(const agvd::Surface& surface,
                                              std::vector<std::uint8_t> is_crease,
                                              std::span<const agvd::SurfacePoint> sites,
                                              const GivenNetworkOptions& options);

}  // namespace remesh
