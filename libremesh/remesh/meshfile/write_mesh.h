//! \file
//! Writes PLY, OBJ, OFF, STL, VTK, Medit, 3MF and glTF.
#pragma once

#include "remesh/meshfile/read_mesh.h"

namespace remesh {

//! Writes a temporary file and renames it, so that a failed or interrupted run does not change an
//! old file (see write_file_atomically). Binary little-endian PLY with double coordinates, OBJ and
//! OFF with the shortest decimals that read back as the same double, binary STL (float by the
//! format's nature), binary VTK with double coordinates, Medit and 3MF as OBJ, GLB in float;
//! GLTF with all in one file; compressed if .gz follows the extension.
//!
//! \throw IoError       the extension is unknown or the file cannot be written; says which
//!        and why.
//! \throw InvalidInput  read_mesh could not read it back: an index is out of range, a
//!        coordinate is not finite (STL, GLB: beyond float).
//! Cost: O(n) time; holds the whole file in memory.
//! \throw Cancelled     the progress callback returned false; an old file is unchanged.
void write_mesh(const std::filesystem::path& path, const MeshView& mesh,
                const Progress& progress = {});

//! The bytes that write_mesh writes, for write_files_atomically.
//! \throw IoError, InvalidInput, Cancelled  as write_mesh.
[[nodiscard]] std::string format_mesh(const std::filesystem::path& path, const MeshView& mesh,
                                      const Progress& progress = {});

//! The same with attributes, in the format that `path` names. PLY holds all, under their names and
//! types. Normals are those of the mesh. What the format cannot hold is left out: see
//! remove_unwritable; of texture coordinates those of faces with a corner that has none, but that
//! GLB has zeros there.
//! \throw InvalidInput  also: an attribute does not have one value for each vertex or face,
//!        or one of its values has no name while others have.
[[nodiscard]] std::string format_mesh(const MeshPath& path, const MeshView& mesh,
                                      const MeshAttributes& attributes,
                                      const Progress& progress = {});

[[nodiscard]] inline std::string format_mesh(const std::filesystem::path& path,
                                             const MeshView& mesh, const MeshAttributes& attributes,
                                             const Progress& progress = {}) {
    return format_mesh(MeshPath{path}, mesh, attributes, progress);
}

//! Removes the attributes that the format cannot hold. VTK and OFF hold texture coordinates without
//! seams.
//! \return what they were: "vertex quality", "face label", "corner texcoord", "material colours", ...
//! \throw IoError  the format is unknown.
std::vector<std::string> remove_unwritable(const MeshPath& path, MeshAttributes& attributes);
inline std::vector<std::string> remove_unwritable(const std::filesystem::path& path,
                                                  MeshAttributes& attributes) {
    return remove_unwritable(MeshPath{path}, attributes);
}

//! What happens to the unit of length: empty where the format stores it, or counts in it, or has
//! none and the unit is the metre or the millimetre. Numbers are never converted.
//! \param unit  MeshAttributes::unit.  \throw IoError  the format is unknown.
[[nodiscard]] std::string describe_unit(const MeshPath& path, const std::string& unit);

//! Figures of what the positions lose in a format of single precision.
struct RoundingLoss {
    double largest_shift = 0;  //!< Of a vertex, in mesh units.
    double diagonal = 0;       //!< Of the bounding box.
    double shortest_edge = 0;  //!< Of those that have a length; 0: there is none.
    Index merged = 0;          //!< Vertices that come to lie on others, but did not before.
    Vec3 middle{0, 0, 0};      //!< Of the bounding box.

    //! Whether the shape suffers: vertices merge, or the shift is above 5 % of the shortest edge or
    //! above 10^-6 of the diagonal. A mesh near the origin has 10^-7.
    [[nodiscard]] bool matters() const;
};

//! \return zeros for a format of double precision. Cost: O(n) expected.
//! \throw IoError  the format is unknown.  \throw Cancelled
[[nodiscard]] RoundingLoss rounding_loss(const MeshPath& path, const MeshView& mesh,
                                         const Progress& progress = {});

//! The loss and its remedy in words; empty unless it matters.
[[nodiscard]] std::string describe(const RoundingLoss& loss, const MeshPath& path);

//! Whether read_mesh and write_mesh know the format, or the extension if no format is given.
[[nodiscard]] bool is_known_mesh_format(const MeshPath& path);
//! The same: true for "out.ply", "out.OBJ", ...
[[nodiscard]] inline bool is_known_mesh_extension(const std::filesystem::path& path) {
    return is_known_mesh_format({path});
}

//! The name of the format: "ply", "obj", ...
//! \throw IoError  it is unknown; the text lists the known ones.
[[nodiscard]] std::string mesh_format(const MeshPath& path);

//! All names, with `mark` before each: "ply, obj, off or stl".
[[nodiscard]] std::string mesh_formats(const char* mark = "");

}  // namespace remesh
