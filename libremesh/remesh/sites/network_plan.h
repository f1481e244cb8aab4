//! \file
//! Shares a number of sites between the curves of a surface and the patches between them, or finds
//! the curves that given sites carry.
#pragma once

#include "remesh/curves/curve_sites.h"
#include "remesh/sites/size_field.h"

namespace remesh {

//! A network with what sampling needs of it.
struct NetworkPlan {
    CurveNetwork network;
    CutSurface cut;                          //!< The surface, cut along the network.
    std::vector<std::vector<double>> along;  //!< By curve: positions of its sites, mesh units.
    std::vector<Index> intervals;            //!< By curve: number of intervals between them.
    JunctionSet junctions;                   //!< The given ones; none if the sites are too few.
    LockedElements locked;                   //!< The given ones; none if the sites are too few.
    double spacing = 0;             //!< Of neighbouring sites: mesh units, or local lengths.
    double length = 0;              //!< Of the creases kept, mesh units.
    double dropped_length = 0;      //!< Of the creases dropped, mesh units.
    Index sites_for_junctions = 0;  //!< Fewest vertices that keep the junctions.
    Index sites_for_all = 0;        //!< Fewest vertices that keep all curves.
    Index sites_for_boundary = 0;   //!< Fewest vertices that keep it and what is locked.
};

//! Finds the network, and the spacing at which curves and patches together have num_vertices
//! vertices. If these are too few, the shortest creases are dropped; if too few for the junctions,
//! all of these; then the boundary has fewer corners. If they are still too few for the boundary
//! and what is locked, only sites_for_boundary is set.
//! \param is_crease     #E: 1 for the edges of creases.
//! \param num_vertices  of the result: see num_curve_vertices.
//! \param sizes           spacings are in local lengths; null: in mesh units.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n), once more for each tenth of the creases that is dropped.
[[nodiscard]] NetworkPlan plan_network(const Surface& surface, std::vector<std::uint8_t> is_crease,
                                       Index num_vertices, JunctionSet junctions = {},
                                       int num_threads = 0, const Progress& progress = {},
                                       const SizeField* sizes = nullptr,
                                       LockedElements locked = {});

//! The fewest vertices of a network of boundary, junctions, what is locked, and these creases.
//! \param is_crease  #E. Cost: O(n).
[[nodiscard]] Index fewest_network_vertices(const Surface& surface,
                                            std::vector<std::uint8_t> is_crease, double spacing,
                                            const JunctionSet& junctions,
                                            const LockedElements& locked);

//! Whether an edge is marked.
[[nodiscard]] inline bool has_creases(std::span<const std::uint8_t> is_crease) {
    return std::ranges::any_of(is_crease, [](auto c) { return c != 0; });
}

//! The total length of the creases, mesh units.
[[nodiscard]] double length_of(const Surface& surface, std::span<const std::uint8_t> is_crease);

//! Given sites, sorted into those on curves and the others.
struct GivenSites {
    CurveSites curves;                //!< The sites on the curves.
    std::vector<SurfacePoint> inner;  //!< The other sites, in their order.
    //! By copy of `curves`, then by inner site: the number of the site among all.
    std::vector<Index> number;
};

struct GivenNetwork : GivenSites {
    NetworkPlan plan;          //!< Does not set sites_for_all.
    bool has_boundary = true;  //!< False: the sites do not carry it, and there are no curves.
    Index dropped_curves = 0;  //!< Creases that the sites do not carry.
};

//! In spacings: nearer points are the same up to the decimals of a file or single precision.
inline constexpr double site_rounding = 1e-5;

struct GivenNetworkOptions {
    double spacing = 1;                //!< > 0, mesh units: mean distance of neighbouring sites.
    double tolerance = site_rounding;  //!< In spacings, >= site_rounding.
    int num_threads = 0;               //!< >= 0; 0: all cores. The same for any number.
    Progress progress = {};
};

//! A site on the network, up to the tolerance, becomes a vertex of it; of several at one position
//! only the first. Sites carry a curve if one lies at each end, enough between for a triangulation,
//! and no gap is above four spacings, except on the boundary. Other creases are dropped: all, if
//! part of the boundary is not carried.
//! \param is_crease  #E: 1 for the edges of creases.
//! \param sites      on the surface, no two at one position.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n) for each round in which creases are dropped; at most one round for each crease.
[[nodiscard]] GivenNetwork plan_given_network(const Surface& surface,
                                              std::vector<std::uint8_t> is_crease,
                                              std::span<const SurfacePoint> sites,
                                              const GivenNetworkOptions& options);

}  // namespace remesh
