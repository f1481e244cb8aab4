//! \file
//! Distances from the nearest site at vertices and at any other points, everywhere or within a
//! radius; and the k nearest sites of each vertex.
//! Held by Distances and KNearest in tests/agvd/paths, and DistancesAgainstExact in tests/oracle.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "agvd/propagation/propagate.h"

namespace agvd {

//! `{}` gives the defaults.
struct DistanceOptions {
    SitePoints points = {};              //!< What the points given as sites stand for.
    std::vector<SiteShape> shapes = {};  //!< Lines and regions, besides the points.
    //! Mesh units, >= 0: what is farther away is not reached.
    double max_distance = std::numeric_limits<double>::infinity();
    double max_error = default_max_error;  //!< Relative, in [0, 1); 0: exact in double.
    int num_threads = 0;                   //!< >= 0; 0: all cores. The same bytes for any number.
    Progress progress = {};                //!< Polled during the call; see agvd::poll.
};

//! What sites reach.
struct Distances {
    std::vector<Index> vertices;          //!< Ascending: those that a site reaches.
    std::vector<SiteId> vertex_site;      //!< #vertices: the nearest site of each.
    std::vector<double> vertex_distance;  //!< #vertices: its distance.
    std::vector<SiteId> point_site;       //!< #points; invalid where no site reaches.
    std::vector<double> point_distance;   //!< #points; infinity where no site reaches.
    double certified_error = 0;           //!< As Propagation::certified_error.
};

//! Distances along the surface from the nearest site.
//!
//! With a radius only a patch of the surface is looked at: the faces that are near a site in space
//! and connected to it by such faces; with shapes the whole surface is.
//! \param sites   as in propagate(), with options.points and options.shapes.
//! \param points  where distances are wanted besides the vertices; may be empty.
//! \throw InvalidOption  an option is out of range.
//! \throw InvalidSites   a site or a point names a face that does not exist, or is off the face.
//! \throw Cancelled      the progress callback returned false.
//! Cost: propagate() on the patch, and O(relays) in the face of each point.
[[nodiscard]] Distances find_distances(const Surface& surface, std::span<const SurfacePoint> sites,
                                       std::span<const SurfacePoint> points,
                                       const DistanceOptions& options = {});

// --- The k nearest sites ------------------------------------------------------------------------

//! `{}` gives the defaults.
struct KNearestOptions {
    SitePoints points = {};                //!< What the points given as sites stand for.
    std::vector<SiteShape> shapes = {};    //!< Lines and regions, besides the points.
    double max_error = default_max_error;  //!< Relative, in [0, 1); 0: exact in double.
    int num_threads = 0;                   //!< >= 0; 0: all cores. The same bytes for any number.
    Progress progress = {};                //!< Polled during the call; see agvd::poll.
};

//! Sites of each vertex, the nearest first; of tied ones (see is_nearer) that of the lower number.
struct KNearest {
    Index k = 0;                   //!< Sites of each vertex.
    std::vector<SiteId> site;      //!< #V x k, row by row; invalid where fewer sites reach.
    std::vector<double> distance;  //!< #V x k; infinity where fewer sites reach.
    double certified_error = 0;    //!< As Propagation::certified_error.
};

//! The k nearest sites of each vertex.
//!
//! Windows of each site go as far as it may be one of the k nearest: where k others are nearer at a
//! point, they are so at all points that shortest paths reach through it. Bounds of the k-th
//! distance come from a search along edges in which a vertex takes k sites.
//! \param sites  as in propagate(). Of sites at one place all count. No line hides what lies beyond
//!               it.
//! \param k      >= 1; more than there are sites leaves the rest of each row empty.
//! \throw InvalidOption  k is 0, or an option is out of range.
//! \throw InvalidSites   as propagate().
//! \throw Cancelled      the progress callback returned false.
//! Cost: about k times the windows of propagate(), and k sweeps over the edges. Memory: O(k #V).
[[nodiscard]] KNearest k_nearest_sites(const Surface& surface, std::span<const SurfacePoint> sites,
                                       Index k, const KNearestOptions& options = {});

}  // namespace agvd
