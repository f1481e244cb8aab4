//! \file
//! Where the vertices and faces of a result lie on its input, and the input's values there.
//! Held by MapToInput.FittedVerticesGetTheNearestPointOfTheirSheet in tests/remesh/transfer.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/meshfile/mesh_file.h"

namespace remesh {

//! `{}` gives the defaults.
struct MapOptions {
    bool with_faces = false;  //!< Also map the faces.
    int num_threads = 0;      //!< >= 0; 0: all cores.
    Progress progress = {};   //!< Polled during the call; see poll.
};

//! Faces of the input at points that are spread evenly over a face of the result.
using FaceSamples = std::array<Index, 16>;

//! Where the elements of a result lie on the input.
struct InputMap {
    std::vector<SurfacePoint> vertices;  //!< #V of the result: points of the input.
    std::vector<FaceSamples> faces;      //!< #F of the result; empty without with_faces.
};

//! For each vertex of a result the nearest point of the input on its sheet: within the distance of
//! its site only the part counts that is connected with the site there, so walls may be as thin as
//! they like; and not across edges with more than two faces, unless the site lies on one. A vertex
//! at its site up to rounding stays there bit for bit. Samples of faces are found likewise, from
//! their corners.
//! \param input   what remesh() got: any triangles, also dirty ones.
//! \param sites   of the result's vertices, on `input`: RemeshResult::sites.
//! \throw InvalidOption  num_threads < 0, or there is not one site for each vertex.
//! \throw Cancelled      the progress callback returned false.
//! Cost: O(#F of the input); for each vertex the faces of the input between it and its site, for
//! each face of the result 16 times those along a quarter of its width.
[[nodiscard]] InputMap map_to_input(const MeshView& input, const MeshView& result,
                                    std::span<const SurfacePoint> sites,
                                    const MapOptions& options = {});

//! Whether values are averaged or chosen.
enum class ValueKind {
    Number,  //!< Values between two values make sense, as with heights and colours.
    Label,   //!< They do not: each value of the result is one of the input's.
};

//! Values for the vertices of a result. Numbers are interpolated linearly in the input's triangles,
//! so that a value that is linear in space comes out up to rounding; a corner of weight 0 does not
//! count, even if its value is not finite. Labels are those of the nearest corner (the lowest
//! vertex, if several are as near).
//! \param values  one for each vertex of the input.
//! \param points  on the input, one for each vertex of the result: InputMap::vertices.
//! \throw InvalidOption  there is not one value for each vertex.
//! Cost: O(#points).
[[nodiscard]] std::vector<double> transfer_vertex_values(std::span<const double> values,
                                                         const MeshView& input,
                                                         std::span<const SurfacePoint> points,
                                                         ValueKind kind);

//! Values for the faces of a result. Numbers are means over each face, labels those with the
//! largest part of its area (the least of equally large ones); both by 16 samples.
//! \param values   one for each face of the input.
//! \param samples  one for each face of the result: InputMap::faces.
//! \throw InvalidOption  a face of the samples has no value.
//! Cost: O(#samples).
[[nodiscard]] std::vector<double> transfer_face_values(std::span<const double> values,
                                                       std::span<const FaceSamples> samples,
                                                       ValueKind kind);

//! `{}` gives the defaults.
struct CornerOptions {
    int num_threads = 0;     //!< >= 0; 0: all cores.
    Progress progress = {};  //!< Polled during the call; see poll.
};

//! Texture coordinates for the corners of a result's faces, interpolated at the nearest point on
//! that side of the seams on which the face lies (its centroid, or the side nearest to all three
//! corners). No face spans a jump, and faces on one side have the same bits at a common corner;
//! corners beyond a seam get the coordinates at it. Without seams each vertex has one value.
//! \param values  #F of the input; NaN where a corner has none: so has what lies there.
//! \param points  where the result's vertices lie on the input: InputMap::vertices.
//! \return #F of the result.
//! \throw InvalidOption  num_threads < 0, or there is not one value for each face of the
//!        input or not one point for each vertex of the result.
//! \throw Cancelled      the progress callback returned false.
//! Cost: O(#F log #F) of the input; for each face of the result, if there are seams, 13 searches
//! over a quarter of its width.
[[nodiscard]] std::vector<CornerCoordinates> transfer_corner_values(
    std::span<const CornerCoordinates> values, const MeshView& input, const MeshView& result,
    std::span<const SurfacePoint> points, const CornerOptions& options = {});

//! The same attributes for the result: numbers and colours are interpolated (faces: means), labels
//! are chosen (transfer_vertex_values, transfer_face_values), texture coordinates are those of each
//! face's side of the seams (transfer_corner_values).
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
[[nodiscard]] std::string format_map(const MeshFile& input, std::span<const SurfacePoint> points);

}  // namespace remesh
