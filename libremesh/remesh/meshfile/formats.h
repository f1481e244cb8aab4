//! \file
//! The table of formats: names, extensions, readers and writers. Private.
#pragma once

#include <limits>

#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/source_file.h"

namespace remesh {

//! \throw IoError, InvalidInput, Cancelled  as read_mesh.
using MeshReader = MeshFile(SourceFile file);
MeshReader read_ply, read_obj, read_off, read_stl, read_vtk, read_medit, read_3mf, read_msh;
MeshReader read_vtp;   //!< And .vtu.
MeshReader read_gltf;  //!< Both kinds: the bytes tell.

//! \return the whole file's bytes. Attributes that the format cannot hold are left out.
using MeshWriter = std::string(const MeshView& mesh, const MeshAttributes& attributes,
                               Ticker ticker);
MeshWriter format_ply, format_obj, format_off, format_stl, format_vtk, format_vtp, format_vtu,
    format_medit, format_glb, format_gltf, format_3mf, format_msh;

//! Whether a format can hold an attribute, one of `all`.
using AttributeTest = bool(const Attribute& attribute, ElementKind kind, const MeshAttributes& all);
AttributeTest obj_holds, off_holds, stl_holds, medit_holds, gltf_holds, holds_3mf, msh_holds;

//! Unless the text of the parts is empty.
template <typename... Parts>
void add_warning(MeshFile& file, Parts... parts) {
    if (std::string text = joined(parts...); !text.empty())
        file.warnings.push_back(std::move(text));
}

//! Gives a file the attributes that were read with it, besides its texture coordinates; those of
//! faces belong to polygons yet.
void attach(MeshAttributes attributes, MeshFile& file);

//! #V: the coordinates of each vertex, those of its first corner (none: NaN). Empty if it has
//! several, or if there are none.
[[nodiscard]] std::vector<Vec2> coordinates_of_vertices(const MeshView& mesh,
                                                        const TextureCoordinates& texture);

//! The labels that a format writes which has one whole number of 32 bits with a sign for each
//! element: those of the name, or else the first; nullptr: there are none.
[[nodiscard]] const Attribute* labels_to_write(const std::vector<Attribute>& attributes,
                                               std::string_view name);

//! What is kept of MeshAttributes::materials.
enum class MaterialPlace { Nothing, Colors, All };

//! What has texture coordinates of its own.
enum class TexturePlace { Nothing, Vertices, Corners };

struct MeshFormat {
    const char* name;  //!< Lower case; the extension without its dot.
    MeshReader* read;
    MeshWriter* format;
    AttributeTest* holds;
    bool has_normals;  //!< At vertices.
    TexturePlace texture;
    double largest;  //!< Coordinate that it can hold.
    MaterialPlace materials = MaterialPlace::Nothing;
    //! For which programs take its numbers; empty: it is stored. Otherwise one of those without an
    //! own one, which mostly have millimetres or metres.
    const char* unit = nullptr;

    //! Whether coordinates are stored in single precision.
    [[nodiscard]] bool is_single() const { return largest < std::numeric_limits<double>::max(); }
};

//! With its dot, in lower case; empty if there is none.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

//! Whether the path or the format ends in .gz, and this build can compress.
[[nodiscard]] bool is_compressed(const MeshPath& path);

//! The format, of a table of them, with the extension of a path, before .gz.
//! \param known  the extensions of the table, for the text.
//! \throw IoError  there is none.
template <typename Format, std::size_t Count>
[[nodiscard]] const Format& require_format(const Format (&formats)[Count],
                                           const std::filesystem::path& path, const char* known) {
    const std::string extension = lower_extension(is_compressed({path}) ? path.stem() : path);
    for (const Format& format : formats) {
        if (extension == format.extension) return format;
    }
    throw IoError(joined(path.string(), ": unknown extension ",
                         in_quotes(path.extension().string()), "; use ", known));
}

//! The given format, or that of the path's extension (any case), either without .gz; nullptr:
//! unknown.
[[nodiscard]] const MeshFormat* find_format(const MeshPath& path);

//! As find_format.
//! \throw IoError  unknown; the text lists the known ones.
[[nodiscard]] const MeshFormat& require_format(const MeshPath& path);

}  // namespace remesh
