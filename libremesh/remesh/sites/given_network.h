//! \file
//! Finds the curves of a surface that given sites carry.
#pragma once

#include "remesh/sites/network_plan.h"

namespace remesh {

struct GivenNetwork {
    NetworkPlan plan;   //!< Without curves if none is carried; does not set sites_for_all.
    CurveSites curves;  //!< The sites on the curves.
    std::vector<SurfacePoint> inner;  //!< The other sites, in their order.
    std::vector<Index> of_group;      //!< By group of `curves`: the number of its site.
    std::vector<Index> of_inner;      //!< By inner site: its number among all sites.
    Index dropped_curves = 0;         //!< Creases that the sites do not carry.
};

//! In spacings: nearer places are the same up to the decimals of a file or single precision.
inline constexpr double site_rounding = 1e-5;

struct GivenNetworkOptions {
    double spacing = 1;                //!< > 0, mesh units: mean distance of neighbouring sites.
    double tolerance = site_rounding;  //!< In spacings, >= site_rounding.
    double drop_share = 0;  //!< Share of the carried creases to drop, in [0, 1], shortest first.
    int num_threads = 0;    //!< >= 0; 0: all cores. The same for any number.
    Progress progress = {};
};

//! A site on an edge or vertex of the network, up to the tolerance, becomes a vertex of the
//! network. Of several sites at one place only the first does; the others are left out. Sites carry
//! a curve if one lies at each end, as many lie between as a triangulation needs, and no gap is
//! above four spacings. Creases that are not carried are dropped. All creases are dropped if part
//! of the boundary is not carried, since cells distinguish creases from the boundary by their sites
//! alone.
//!
//! \param is_crease  #E: 1 for the edges of creases.
//! \param sites      on the surface, no two at one place.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n) for each round in which creases are dropped; at most one round for each crease.
[[nodiscard]] GivenNetwork plan_given_network(const Surface& surface,
                                              std::vector<std::uint8_t> is_crease,
                                              std::span<const SurfacePoint> sites,
                                              const GivenNetworkOptions& options);

}  // namespace remesh
