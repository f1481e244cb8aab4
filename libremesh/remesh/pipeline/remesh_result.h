//! \file
//! What remesh() gives: the mesh, and what was done for it.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "agvd/mesh/mesh_view.h"
#include "agvd/mesh/surface_point.h"
#include "remesh/clean/clean_counts.h"
#include "remesh/dual/delaunay.h"
#include "remesh/guarantee/site_reason.h"
#include "remesh/pipeline/remesh_options.h"
#include "remesh/relax/relax_options.h"
#include "remesh/topology/topology.h"

namespace remesh {

//! What became of the creases.
struct FeatureCounts {
    agvd::Index curves = 0;     //!< Chains between nodes, and closed ones; the boundary's included.
    agvd::Index nodes = 0;      //!< Corners, ends and junctions.
    agvd::Index vertices = 0;   //!< Of the result, on curves and nodes.
    double length = 0;          //!< Of the creases that were kept, mesh units.
    double dropped_length = 0;  //!< Of those for which the sites are too few, or lie elsewhere.
    agvd::Index uncarried_curves = 0;  //!< Creases that given sites do not lie on.
    agvd::Index samples_for_all = 0;   //!< Fewest with which all are kept.
    agvd::Index thinned_patches = 0;   //!< Parts between curves too narrow for Voronoi cells.
    //! Creases were dropped as no mesh with all of them was found, or only such as
    //! self-intersect.
    bool gave_up = false;
};

//! What became of the edges that more than two faces share in the input.
struct JunctionCounts {
    agvd::Index edges = 0;     //!< Of the cleaned input, those of several sheets counted once.
    agvd::Index curves = 0;    //!< Chains of them between nodes, and closed ones.
    agvd::Index vertices = 0;  //!< Of the result, on these.
    //! Edges of the input along which each sheet got points of its own: no mesh with the same ones
    //! was found, or the options do not allow for it.
    agvd::Index apart_edges = 0;
    agvd::Index samples_for_all = 0;  //!< No fewer have the same points everywhere.
    agvd::Index welded_edges = 0;     //!< Edges of the result with more than two faces.
};

//! Plain values owned by the caller; nothing points back into the input.
struct RemeshResult {
    //! Oriented 2-manifold with the topology of the cleaned input; with Junctions::Keep, its sheets
    //! welded at junctions.
    agvd::TriangleMesh mesh;
    std::vector<agvd::SurfacePoint> sites;  //!< One per output vertex: where it lies on the input
                                            //!< (faces are the caller's).
    CleanCounts cleaned;                    //!< What was repaired on the input before.
    Topology input_topology;                //!< Of the cleaned input.
    agvd::Index refined_faces = 0;          //!< Faces that propagation saw, long edges split.
    agvd::Index components_dropped = 0;     //!< See drop_components.
    agvd::Index sites_added = 0;            //!< By topology repair and against self-intersections.
    std::map<SiteReason, agvd::Index> added_because = {};  //!< The same by reason.
    agvd::Index sites_moved = 0;        //!< Onto the boundary, or from where they owned nothing.
    agvd::Index sites_removed = 0;      //!< Vertices taken away to keep the count.
    agvd::Index sites_dropped = 0;      //!< Given sites that own nothing (e.g. duplicates).
    int repair_rounds = 0;              //!< Rounds of moving and adding.
    agvd::Index unfitted_vertices = 0;  //!< Back on the surface: triangles met there.
    std::vector<RelaxLevel> relaxation = {};  //!< Empty: the sites were not relaxed.
    //! Components whose cells could not be made to give their topology: the surface was thinned to
    //! their sites instead (agvd::thin).
    agvd::Index components_from_faces = 0;
    FeatureCounts features = {};
    JunctionCounts junctions = {};
    DelaunayCounts delaunay = {};  //!< Edges that failed, were flipped, still fail.
    //! Self-intersecting pairs of faces of the result, and, if that is not 0, of the cleaned input.
    //! That sheets touch at a junction does not count where they have the same points there. Unset:
    //! without CGAL.
    std::optional<agvd::Index> self_intersections = {};
    agvd::Index input_self_intersections = 0;
    //! Of the last propagation: see agvd::Propagation. Infinity: nothing is certified.
    double certified_error = std::numeric_limits<double>::infinity();
    std::size_t propagation_bytes = 0;  //!< Peak of the last propagation, beyond the mesh.
    std::vector<std::pair<Stage, double>> seconds = {};  //!< Wall time spent in each stage.
};

}  // namespace remesh
