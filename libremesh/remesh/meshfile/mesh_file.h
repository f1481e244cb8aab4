//! \file
//! Meshes in files, with what the format can hold: PLY, OBJ, OFF, STL, VTK, VTP, Medit, 3MF and
//! glTF. A damaged file is refused by name, line or byte, and a file that is written is whole or
//! not there. Held by ReadMesh.* and AtomicFile.* in tests/remesh/meshfile.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! Texture coordinates of a face's corners, in their order: u to the right, v upwards. A corner
//! without a value has NaN for both.
using CornerCoordinates = std::array<Vec2, 3>;

//! Corners without values.
[[nodiscard]] CornerCoordinates no_coordinates();

//! Whether all three corners have values.
[[nodiscard]] inline bool is_whole(const CornerCoordinates& corners) {
    return corners[0].allFinite() && corners[1].allFinite() && corners[2].allFinite();
}

//! Whether two corners at one point have the same coordinates.
class CornerAgreement {
public:
    //! Values that differ by less than this share of the range of all values are rounding.
    static constexpr double tolerance = 1e-6;

    //! \param values  outlive this.
    explicit CornerAgreement(std::span<const CornerCoordinates> values);

    //! \param f, i  a face and its corner; \param g, j  another one.
    [[nodiscard]] bool operator()(Index f, std::size_t i, Index g, std::size_t j) const {
        const Vec2 &a = values_[f][i], &b = values_[g][j];
        const bool is_a = a.allFinite(), is_b = b.allFinite();
        return is_a && is_b ? (a - b).cwiseAbs().maxCoeff() <= most_ : is_a == is_b;
    }

private:
    std::span<const CornerCoordinates> values_;
    double most_ = 0;
};

//! The edges where two faces have different coordinates at one of the ends, or where only one of
//! them has any. Vertices at the same position count as one, so that meshes that are split along
//! their seams have them too. For RemeshOptions::texture_seams.
//!
//! \param values  #F
//! \return pairs of vertices, those of the first face at the edge; each edge once.
//! \throw InvalidOption  there is not one value for each face.
//! Cost: O(#F log #F).
[[nodiscard]] std::vector<std::array<Index, 2>> find_texture_seams(
    const MeshView& mesh, std::span<const CornerCoordinates> values, Ticker ticker = {});

//! How a file stores a number.
enum class NumberType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

//! Whether the type holds integers only.
[[nodiscard]] constexpr bool is_integer(NumberType type) { return type < NumberType::Float32; }

//! What has a value.
enum class ElementKind { Vertex, Face };

//! A number for each vertex or each face. What has several components, such as a colour, is one
//! attribute for each.
struct Attribute {
    std::string name;                       //!< As PLY calls it: "quality", "red", "material", ...
    NumberType type = NumberType::Float64;  //!< As in the file.
    std::vector<double> values = {};        //!< All types fit; NaN and infinity may occur.
    //! Of labels that have names, such as materials: value i is called names[i].
    std::vector<std::string> names = {};
    //! A part of a colour, from 0 to 1, of a text format. PLY stores it as uchar.
    bool is_intensity = false;
};

//! Texture coordinates. Formats that count v downwards (GLB) are turned round.
struct TextureCoordinates {
    //! What they are called among the attributes, as in PLY.
    static constexpr const char* name = "texcoord";

    //! That of the file; unset: decimals of a text, which binary PLY and GLB store as float, as
    //! most programs read no others.
    std::optional<NumberType> type = {};
    std::vector<CornerCoordinates> corners = {};  //!< #F: one for each triangle; empty: none.
    //! Of an input: find_texture_seams. Where there are none, each vertex has one value.
    std::vector<std::array<Index, 2>> seams = {};

    //! Whether there are none.
    [[nodiscard]] bool empty() const { return corners.empty(); }
};

//! How the materials look that the label `material` of faces names, in the terms of glTF 2.0.
struct Materials {
    //! JSON, an object: its lists `materials`, each with the name of its label, `textures`,
    //! `samplers`, `images` and `extensionsUsed`. Empty: unknown.
    std::string json = {};
    std::vector<std::string> images = {};  //!< The bytes of each image (PNG, JPEG); empty: no file.

    //! Whether nothing is known.
    [[nodiscard]] bool empty() const { return json.empty(); }
};

//! What a file holds and cannot be carried over.
struct DeclinedAttribute {
    std::string name;    //!< Of the property.
    std::string reason;  //!< Why not, for people.
};

//! All values of a file.
struct MeshAttributes {
    std::vector<Attribute> of_vertices = {};  //!< #V values each.
    std::vector<Attribute> of_faces = {};     //!< #F values each: one for each triangle.
    TextureCoordinates texture = {};          //!< Of the triangles' corners.
    //! The type of the file's normals at vertices, which are not stored: those of a result are
    //! computed anew.
    std::optional<NumberType> normals = {};
    std::vector<std::string> material_files = {};  //!< OBJ: the names behind each mtllib.
    Materials materials = {};                      //!< 3MF: colours; glTF: images, too.
    //! Of length, as 3MF calls it: "millimeter", "inch", ...; that of glTF is "meter". Empty: the
    //! format has none. Coordinates are never converted.
    std::string unit = {};
    std::vector<DeclinedAttribute> declined = {};  //!< Such as normals of faces.

    //! Whether nothing is stored.
    [[nodiscard]] bool empty() const {
        return of_vertices.empty() && of_faces.empty() && texture.empty();
    }
};

//! The attribute of that name, or nullptr.
[[nodiscard]] const Attribute* find_attribute(const std::vector<Attribute>& attributes,
                                              std::string_view name);

//! Their names, with commas.
[[nodiscard]] std::string names_of(const std::vector<Attribute>& attributes);

//! What the parts of a colour are called.
inline constexpr std::array color_names = {"red", "green", "blue", "alpha"};

//! Whether the name is one of these.
[[nodiscard]] bool is_color(std::string_view name);

//! Whether values between two values make no sense: integers that are no colours.
[[nodiscard]] bool is_label(const Attribute& attribute);

//! Whether the number can be stored in the type without a change but that of precision.
[[nodiscard]] bool is_value_of(NumberType type, double value);

//! Turns values of polygons into those of the triangles that they were cut into.
//! \param face_polygon  see MeshFile.
void spread_to_triangles(const std::vector<Index>& face_polygon, std::vector<Attribute>& of_faces);

//! Where a mesh is read or written, and how.
struct MeshPath {
    //! /dev/stdin and /dev/stdout are the streams of the process, whatever they are connected to.
    std::filesystem::path path;
    //! "ply", "obj", ...; empty: the extension names it, in any case. Either may end in ".gz":
    //! compressed. On reading the file itself tells whether it is.
    std::string format = {};
};

//! What was read from a file.
struct MeshFile {
    TriangleMesh mesh;           //!< As in the file: order kept, defects too.
    Index polygons = 0;          //!< Faces of more than three corners, triangulated.
    Index dropped_polygons = 0;  //!< Faces of fewer than three corners (lines), left out.
    Index welded_vertices = 0;   //!< STL only: corners merged at equal positions.
    //! #F: the polygon (face of the file, from 0) each triangle came from.
    std::vector<Index> face_polygon;
    MeshAttributes attributes;          //!< With ReadOptions::with_attributes.
    std::vector<std::string> warnings;  //!< What was skipped, with the file's name.
    //! What a Medit file wants kept, for the members of RemeshOptions of these names. Edges and
    //! ridges: pairs of vertices.
    std::vector<std::array<Index, 2>> feature_edges = {};
    std::vector<std::array<Index, 2>> locked_edges = {};  //!< Required edges, likewise.
    std::vector<Index> locked = {};                       //!< Required vertices.
};

//! `{}` gives the defaults.
struct ReadOptions {
    //! What a reader passes over is a warning, not an error: whole elements beyond those that the
    //! header announces; in ascii PLY values left over at the end of a line, in PLY lines of the
    //! header without a keyword. A binary STL that announces none is read as far as it goes.
    bool is_lenient = false;
    //! Also read colours, labels and other properties. They take 8 bytes for each value.
    bool with_attributes = false;
    std::string format = {};  //!< See MeshPath.
    Progress progress = {};   //!< Polled during the call; see poll.
};

//! The format is ReadOptions::format, or that of the extension: ply (ascii and both binaries), obj
//! (v, v/vt, v//vn and v/vt/vn, negative indices; never split along texture seams), off (OFF, COFF,
//! NOFF, STOFF), stl (ascii, binary; welded at equal positions), vtk (legacy), vtp and vtu (VTK's
//! XML), mesh (Medit, ascii), msh (Gmsh, 2.2 and 4.1), 3mf, glb, gltf (which may name files beside
//! it); each also compressed with gzip. /dev/stdin is the standard input. Coordinates are kept in
//! double. A quad is cut along the shorter of its inner diagonals, a larger polygon by clipping
//! ears.
//!
//! \throw IoError       the file is missing, empty, unreadable, truncated, malformed or
//!        longer than its header announces (a few stray bytes are only a warning), or the extension
//!        is unknown; the text names the file, the line (or byte) and the remedy.
//! \throw InvalidInput  the file reads well but is no usable mesh: no face (a point cloud),
//!        an index out of range, a coordinate that is not finite; the text names file and element.
//! Cost: O(file size), and O(k^2) for each polygon of k corners. Memory follows the size of the
//! file, never a count that it announces.
//! \throw Cancelled     the progress callback returned false.
[[nodiscard]] MeshFile read_mesh(const std::filesystem::path& path, const Progress& progress = {});
//! The same with options.
[[nodiscard]] MeshFile read_mesh(const std::filesystem::path& path, const ReadOptions& options);

//! The same from the bytes of a file.
//! \param name  for texts, and for the format if options.format is empty; a .gltf may not name files
//!              beside it that are not there.
[[nodiscard]] MeshFile read_mesh_bytes(std::string bytes, const std::filesystem::path& name,
                                       const ReadOptions& options = {});

//! Appends the corners.size() - 2 triangles of one polygon, oriented like it.
//!
//! A quad is cut along the shorter of the diagonals that lie inside; a larger polygon by clipping
//! ears (Meisters 1975) in the projection along its normal. A polygon that has no ear left (it
//! crosses itself, or has no area) is finished as a fan: no triangulation is correct.
//!
//! \param polygon    at least three indices into positions, which may repeat.
//! Cost: O(k log k) for k corners, typically; O(1) for k <= 4.
void append_triangles(std::span<const Index> polygon, std::span<const Vec3> positions,
                      Ticker& ticker, std::vector<Triangle>& triangles);

// --- Writing -----------------------------------------------------------------------------------

//! Writes a temporary file and renames it, so that a failed or interrupted run does not change an
//! old file (see write_file_atomically). Binary little-endian PLY with double coordinates, OBJ and
//! OFF with the shortest decimals that read back as the same double, binary STL (float by the
//! format's nature), binary VTK with double coordinates, Medit, Gmsh (2.2) and 3MF as OBJ, GLB in
//! float; GLTF with all in one file; compressed if .gz follows the extension.
//!
//! \throw IoError       the extension is unknown or the file cannot be written; says which
//!        and why.
//! \throw InvalidInput  read_mesh could not read it back: an index is out of range, a
//!        coordinate is not finite (STL, GLB: beyond float).
//! Cost: O(n) time; holds the whole file in memory.
//! \throw Cancelled     the progress callback returned false; an old file is unchanged.
void write_mesh(const std::filesystem::path& path, const MeshView& mesh,
                const Progress& progress = {});

//! The bytes that write_mesh writes, for write_files_atomically, with attributes. PLY holds all,
//! under their names and types. Normals are those of the mesh. What the format cannot hold is left
//! out: see remove_unwritable; of texture coordinates those of faces with a corner that has none,
//! but that GLB has zeros there.
//! \throw IoError, InvalidInput, Cancelled  as write_mesh; InvalidInput also: an attribute does not have one value for each vertex or face,
//!        or one of its values has no name while others have.
[[nodiscard]] std::string format_mesh(const MeshPath& path, const MeshView& mesh,
                                      const MeshAttributes& attributes,
                                      const Progress& progress = {});

//! The same, in the format that the extension names.
[[nodiscard]] inline std::string format_mesh(const std::filesystem::path& path,
                                             const MeshView& mesh,
                                             const MeshAttributes& attributes = {},
                                             const Progress& progress = {}) {
    return format_mesh(MeshPath{path}, mesh, attributes, progress);
}

//! The same PLY as text, for programs that read no other; numbers are the shortest that read back.
//! \param bytes  of a binary PLY, of this library or another one.
//! \throw IoError  they are none.
[[nodiscard]] std::string ply_as_text(std::string bytes);

//! Removes the attributes that the format cannot hold. VTK and OFF hold texture coordinates without
//! seams.
//! \return what they were: "vertex quality", "face label", "corner texcoord", "material colours", ...
//! \throw IoError  the format is unknown.
std::vector<std::string> remove_unwritable(const MeshPath& path, MeshAttributes& attributes);
//! The same, for the format that the extension names.
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
