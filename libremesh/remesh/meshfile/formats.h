//! \file
//! The table of formats: names, extensions, readers and writers. Private.
#pragma once

#include <filesystem>
#include <limits>
#include <string>

#include "agvd/core/progress.h"
#include "remesh/meshfile/read_mesh.h"
#include "remesh/meshfile/source_file.h"

namespace remesh {

[[nodiscard]] MeshFile read_ply(SourceFile file);
[[nodiscard]] MeshFile read_obj(SourceFile file);
[[nodiscard]] MeshFile read_off(SourceFile file);
[[nodiscard]] MeshFile read_stl(SourceFile file);
[[nodiscard]] MeshFile read_vtk(SourceFile file);
[[nodiscard]] MeshFile read_vtp(SourceFile file);
[[nodiscard]] MeshFile read_medit(SourceFile file);
[[nodiscard]] MeshFile read_gltf(SourceFile file);  //!< Both kinds: the bytes tell.
[[nodiscard]] MeshFile read_3mf(SourceFile file);

//! Unless it is empty.
inline void add_warning(const std::string& text, MeshFile& file) {
    if (!text.empty()) file.warnings.push_back(text);
}

//! Gives a file the attributes that were read with it, besides its texture coordinates; those of
//! faces belong to polygons yet.
void attach(MeshAttributes attributes, MeshFile& file);

//! The whole file's bytes. Attributes that the format cannot hold are left out.
[[nodiscard]] std::string format_ply(const MeshView& mesh, const MeshAttributes& attributes,
                                     Ticker ticker);
[[nodiscard]] std::string format_obj(const MeshView& mesh, const MeshAttributes& attributes,
                                     Ticker ticker);
[[nodiscard]] std::string format_off(const MeshView& mesh, const MeshAttributes& attributes,
                                     Ticker ticker);
[[nodiscard]] std::string format_stl(const MeshView& mesh, const MeshAttributes& attributes,
                                     Ticker ticker);
[[nodiscard]] std::string format_vtk(const MeshView& mesh, const MeshAttributes& attributes,
                                     Ticker ticker);
[[nodiscard]] std::string format_vtp(const MeshView& mesh, const MeshAttributes& attributes,
                                     Ticker ticker);
[[nodiscard]] std::string format_vtu(const MeshView& mesh, const MeshAttributes& attributes,
                                     Ticker ticker);
[[nodiscard]] std::string format_medit(const MeshView& mesh, const MeshAttributes& attributes,
                                       Ticker ticker);
[[nodiscard]] std::string format_glb(const MeshView& mesh, const MeshAttributes& attributes,
                                     Ticker ticker);
[[nodiscard]] std::string format_gltf(const MeshView& mesh, const MeshAttributes& attributes,
                                      Ticker ticker);
[[nodiscard]] std::string format_3mf(const MeshView& mesh, const MeshAttributes& attributes,
                                     Ticker ticker);

//! #V: the coordinates of each vertex, those of its first corner (none: NaN). Empty if it has
//! several, or if there are none.
[[nodiscard]] std::vector<Vec2> coordinates_of_vertices(const MeshView& mesh,
                                                        const TextureCoordinates& texture);

//! See MeshFormat::holds.
[[nodiscard]] bool obj_holds(const Attribute& attribute, ElementKind kind,
                             const MeshAttributes& all);
[[nodiscard]] bool off_holds(const Attribute& attribute, ElementKind kind,
                             const MeshAttributes& all);
[[nodiscard]] bool medit_holds(const Attribute& attribute, ElementKind kind,
                               const MeshAttributes& all);
[[nodiscard]] bool gltf_holds(const Attribute& attribute, ElementKind kind,
                              const MeshAttributes& all);
[[nodiscard]] bool holds_3mf(const Attribute& attribute, ElementKind kind,
                             const MeshAttributes& all);

//! What is kept of MeshAttributes::materials.
enum class MaterialPlace { Nothing, Colors, All };

//! What has texture coordinates of its own.
enum class TexturePlace { Nothing, Vertices, Corners };

struct MeshFormat {
    const char* name;  //!< Lower case; the extension without its dot.
    MeshFile (*read)(SourceFile);
    std::string (*format)(const MeshView&, const MeshAttributes&, Ticker);
    //! Whether it can hold an attribute, one of `all`.
    bool (*holds)(const Attribute&, ElementKind, const MeshAttributes& all);
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

//! "ply, obj, ... or glb" with `mark` before each name.
[[nodiscard]] std::string names_of_formats(const char* mark);

//! With its dot, in lower case; empty if there is none.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

//! Whether the path or the format ends in .gz, and this build can compress.
[[nodiscard]] bool is_compressed(const MeshPath& path);

//! The given format, or that of the path's extension (any case), either without .gz; nullptr:
//! unknown.
[[nodiscard]] const MeshFormat* find_format(const MeshPath& path);

//! As find_format.
//! \throw IoError  unknown; the text lists the known ones.
[[nodiscard]] const MeshFormat& require_format(const MeshPath& path);

}  // namespace remesh
