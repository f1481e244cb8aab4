//! \file
//! What a remesh is too coarse to show, how far it lies from its input, and its worst angle.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/topology.h"
#include "remesh/names.h"

namespace remesh {

//! Parts of a result that are smaller than the spacing of its vertices. All lengths in mesh units.
struct Verdict {
    double spacing = 0;  //!< Mean edge length of the result.

    Index small_components = 0;        //!< Fewer vertices than least_component_vertices.
    Index samples_for_components = 0;  //!< About as many give each component enough.

    //! Connected parts of the result whose two sides are nearer to each other than their edges are
    //! long. Both sides of a plate are one part.
    Index thin_walls = 0;
    double thinnest_wall = 0;     //!< Least distance between the sides of these.
    Index samples_for_walls = 0;  //!< About as many give edges as short as that.

    double largest_distance = 0;   //!< Of the input's vertices from the result: see judge_result.
    Vec3 farthest = Vec3::Zero();  //!< The vertex of the input that is so far.
    double diagonal = 0;           //!< Of the input's bounding box.

    double min_angle = 0;          //!< Radians; of the faces of the result.
    double small_angle_share = 0;  //!< Of these faces: those with an angle below pi / 6.
    Index faces_without_area = 0;  //!< Of these faces.
};

//! A component with fewer vertices is hard to recognise.
inline constexpr Index least_component_vertices = 12;

//! The input's vertices, or as many of them, evenly chosen by number, are compared with the result.
inline constexpr Index most_compared_vertices = 30'000;

//! \param input        the cleaned input; at least one vertex.
//! \param result       #V x 3 positions, #F x 3 indices; at least one face.
//! \param topology     of `result`.
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O((#V + min(input vertices, most_compared_vertices)) log #F).
[[nodiscard]] Verdict judge_result(const MeshView& input, const MeshView& result,
                                   const Topology& topology, int num_threads = 0,
                                   const Progress& progress = {});

}  // namespace remesh
