//! \file
//! Locally shortest paths on the surface: from a given path, between two points, and from a point
//! to its site after propagate(). None is shorter than the geodesic distance (up to rounding).
//! Held by GeodesicPath.OnRandomMeshesEveryPathIsLocallyShortest and ShortestPaths in
//! tests/agvd/paths, and ShortestPathsAgainstExact in tests/oracle.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "agvd/propagation/propagate.h"

namespace agvd {

//! A polyline on the surface, each piece of which is straight in one face.
struct GeodesicPath {
    //! The start, the points where the path crosses edges or touches vertices, and the end. Each is
    //! named in the face of the piece after it; the last in that of the piece before it.
    std::vector<SurfacePoint> points;
    std::vector<FaceId> faces;  //!< Of the piece from each point to the next; one fewer.
    double length = 0;          //!< Mesh units.
    //! At every vertex that the path touches between its ends, both sides have an angle of at least
    //! pi (less 1e-7) or the boundary; elsewhere the path is straight. False: there were too many
    //! rounds, or rounding hides whether a vertex is better passed on its other side.
    bool is_locally_shortest = false;
};

//! Straightens a path with its ends fixed, such as one along edges (see point_at). The result can
//! be reached from it without leaving the surface, and is never longer: handles and holes stay on
//! their side.
//!
//! A funnel gives the shortest path through the faces crossed ([lee1984]). If it bends at a vertex
//! with an angle below pi on the other side, it is led around that side, which is shorter, until
//! there is no such vertex ([xin2007]).
//! \param points  at least one; each shares a face with the next.
//! \param faces   of each piece; empty: any face that both points share, the nearest around a
//!                vertex.
//! \throw InvalidInput  two points in a row share no face (or not the given one).
//! \throw Cancelled     the progress callback returned false.
//! Cost: O(#crossed + degrees of the vertices passed) a round. One to three rounds for ten
//! crossings are usual; at most 500 and one for each crossing are made, and fewer where these would
//! look at more than 400 times as many crossings as there are at the start, and 200 000.
[[nodiscard]] GeodesicPath straighten_path(const Surface& surface,
                                           std::span<const SurfacePoint> points,
                                           std::span<const FaceId> faces = {},
                                           const Progress& progress = {});

//! The shortest path along edges between two points, straightened. There may be a shorter one on
//! the other side of a peak or a handle.
//!
//! \throw InvalidInput  the points lie on different components.
//! \throw Cancelled     the progress callback returned false.
//! Cost: that of an A* search over the vertices between both, and of straighten_path.
[[nodiscard]] GeodesicPath path_between(const Surface& surface, const SurfacePoint& from,
                                        const SurfacePoint& to, const Progress& progress = {});

//! The distances that lead to sites: those of a Propagation, or of a Diagram.
struct SiteDistances {
    std::span<const SiteId> site;      //!< #V, as Propagation::vertex_site.
    std::span<const double> distance;  //!< #V, as Propagation::vertex_distance.
};

//! Where a path is to end.
struct SiteGoal {
    SiteId site;         //!< Its number in SiteDistances.
    SurfacePoint point;  //!< Where it lies.
    //! From the start of the path, if known: a path of this length is looked for.
    double distance = 0;
};

//! A path from a point of a site's cell to the site.
//!
//! It is a shortest path where its length is the distance. Tried and straightened are the straight
//! lines to where the distances at the ends of an edge beside the point put the site, and paths
//! from vertex to vertex by falling distances, until one has the distance's length (up to 1e-9).
//! The shortest is returned; if none arrives, that of path_between.
//! \throw InvalidInput  the site lies on another component.
//! \throw Cancelled     the progress callback returned false.
//! Cost: that of straightening one path, or a few for each face around the point.
[[nodiscard]] GeodesicPath path_to_site(const Surface& surface, const SiteDistances& distances,
                                        const SiteGoal& goal, const SurfacePoint& point,
                                        const Progress& progress = {});

//! The same to the point's nearest site: to a point of it, to the nearest point of a line, or to
//! the rim of a region, from inside of which the path has no length. Where the faces on the way
//! have relays, as all have with PropagationOptions::relay_faces = all_faces(surface), the path
//! follows them: after an exact propagation it is a shortest path, and its length is the distance,
//! less what the site starts with, up to rounding. Elsewhere it leads to the place of the site that
//! is nearest in space.
//!
//! \param sites, propagation  propagate(surface, sites).
//! \throw InvalidInput  no site reaches the point.
//! Cost: O(sites), and sorting what belongs to shapes, which paths_to_sites() does once for all
//! points; then along relays O(faces crossed), and O(relays) at each vertex that the path meets.
[[nodiscard]] GeodesicPath path_to_site(const Surface& surface, std::span<const SurfacePoint> sites,
                                        const Propagation& propagation, const SurfacePoint& point,
                                        const Progress& progress = {});

// --- Many shortest paths at once
// ------------------------------------------------------------------

//! `{}` gives the defaults.
struct ShortestPathOptions {
    //! Relative error of the distances by which paths between pairs are found, in [0, 1). 0: the
    //! paths are shortest ones, and their lengths the distances up to rounding.
    double max_error = 0;
    int num_threads = 0;     //!< >= 0; 0: all cores. The same bytes for any number.
    Progress progress = {};  //!< Polled during the call; see agvd::poll.
};

//! A path from a point to its nearest site.
struct SitePath {
    SiteId site;        //!< Invalid: no site reaches the point, and the path has no points.
    GeodesicPath path;  //!< From the point to the site.
    double start = 0;   //!< What the site starts with where the path ends.
};

//! path_to_site() for each point.
//!
//! \param sites, propagation  propagate(surface, sites), with relays in all faces for shortest paths
//!                            (PropagationOptions::relay_faces).
//! \return a path for each point.
//! \throw InvalidSites  a point names a face that does not exist, or is off the face.
//! \throw Cancelled     the progress callback returned false.
//! Parallel. Cost: that of path_to_site() for each point.
[[nodiscard]] std::vector<SitePath> paths_to_sites(const Surface& surface,
                                                   std::span<const SurfacePoint> sites,
                                                   const Propagation& propagation,
                                                   std::span<const SurfacePoint> points,
                                                   const ShortestPathOptions& options = {});

//! Two points of a surface.
struct PointPair {
    SurfacePoint from;  //!< Where the path begins.
    SurfacePoint to;    //!< Where it ends.
};

//! The shortest path of each pair.
//!
//! Exact windows go from the points to which most pairs lead back, only where a path over them can
//! be as short as path_between() of some pair: in an ellipse around a pair's points.
//! \return a path for each pair, from `from` to `to`.
//! \throw InvalidOption  max_error is out of range.
//! \throw InvalidSites   a point names a face that does not exist, or is off the face.
//! \throw InvalidInput   the points of a pair lie on different components; the text names the pair.
//! \throw Cancelled      the progress callback returned false.
//! Cost: that of a SurfaceLayout; then for each different `to` O(n) quick steps and the windows in
//! its ellipses, and the paths.
[[nodiscard]] std::vector<GeodesicPath> shortest_paths(const Surface& surface,
                                                       std::span<const PointPair> pairs,
                                                       const ShortestPathOptions& options = {});

}  // namespace agvd
