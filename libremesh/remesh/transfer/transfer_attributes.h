//! \file
//! The attributes of a file for its remesh.
#pragma once

#include <span>
#include <string_view>

#include "remesh/meshfile/read_mesh.h"
#include "remesh/transfer/map_to_input.h"
#include "remesh/transfer/transfer_corners.h"

namespace remesh {

//! The same attributes for the result: numbers and colours are interpolated (faces: means), labels
//! are chosen (transfer_vertex_values, transfer_face_values), texture coordinates are those of each
//! face's side of the seams (transfer_corner_values).
//!
//! \param input   as read from the file.
//! \param result  its remesh.
//! \param map     of the result; `faces` are needed only if there are attributes of faces.
//! \param options  of texture coordinates.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(result) for each attribute; texture coordinates: see transfer_corner_values.
[[nodiscard]] MeshAttributes transfer_attributes(const MeshFile& input, const MeshView& result,
                                                 const InputMap& map,
                                                 const CornerOptions& options = {});

//! Gives the first vertices and faces of a result the values of the input's that they are.
//!
//! \param vertices, faces  of the input, for the first ones of the result: see KeptPart.
//! \param result  of transfer_attributes(input, ...).
//! Cost: O(kept) for each attribute.
void keep_attributes(const MeshAttributes& input, std::span<const Index> vertices,
                     std::span<const Index> faces, MeshAttributes& result);

//! The attribute of that name.
//! \param what  such as "bunny.ply has no vertex property", for the error.
//! \throw InvalidOption  there is none; the text lists those that exist.
[[nodiscard]] const Attribute& require_attribute(const std::vector<Attribute>& attributes,
                                                 std::string_view name, const std::string& what);

//! Labels of faces for RemeshOptions::face_labels: equal for equal values, numbered from 0.
[[nodiscard]] std::vector<Index> face_labels_of(const Attribute& attribute);

//! A text with a line for each vertex of a result: where it lies on the input, as `FACE B0 B1 B2`.
//! FACE counts the faces of the file from 0; the barycentric coordinates belong to its corners in
//! the file's order. A face with more than three corners was cut into triangles; there the line has
//! also the three vertices of the file (from 0) to which the coordinates belong:
//! `FACE B0 B1 B2 V0 V1 V2`. Numbers have the shortest decimals that read back as the same double.
//! \param input  needs mesh.triangles and face_polygon.
[[nodiscard]] std::string format_map(const MeshFile& input, std::span<const SurfacePoint> places);

}  // namespace remesh
