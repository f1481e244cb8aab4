//! \file
//! Values at the vertices and faces of an input for those of its remesh.
#pragma once

#include "remesh/transfer/map_to_input.h"

namespace remesh {

//! Whether values are averaged or chosen.
enum class ValueKind {
    Number,  //!< Values between two values make sense, as with heights and colours.
    Label,   //!< They do not: each value of the result is one of the input's.
};

//! Values for the vertices of a result. Numbers are interpolated linearly in the input's triangles,
//! so that a value that is linear in space comes out up to rounding; a corner of weight 0 does not
//! count, even if its value is not finite. Labels are those of the nearest corner (the lowest
//! vertex, if several are as near).
//!
//! \param values  one for each vertex of the input.
//! \param places  on the input, one for each vertex of the result: InputMap::vertices.
//! \throw InvalidOption  there is not one value for each vertex.
//! Cost: O(#places).
[[nodiscard]] std::vector<double> transfer_vertex_values(std::span<const double> values,
                                                         const MeshView& input,
                                                         std::span<const SurfacePoint> places,
                                                         ValueKind kind);

//! Values for the faces of a result. Numbers are means over each face, labels those with the
//! largest part of its area (the least of equally large ones); both by 16 samples.
//!
//! \param values   one for each face of the input.
//! \param samples  one for each face of the result: InputMap::faces.
//! \throw InvalidOption  a face of the samples has no value.
//! Cost: O(#samples).
[[nodiscard]] std::vector<double> transfer_face_values(std::span<const double> values,
                                                       std::span<const FaceSamples> samples,
                                                       ValueKind kind);

}  // namespace remesh
