//! \file
//! What a mesh file holds besides coordinates and corners.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "agvd/core/types.h"
#include "remesh/meshfile/texture_seams.h"

namespace remesh {

//! How a file stores a number.
enum class NumberType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

//! Whether the type holds integers only.
[[nodiscard]] constexpr bool is_integer(NumberType type) { return type < NumberType::Float32; }

//! What has a value.
enum class ElementKind { Vertex, Face };

//! A number for each vertex or each face. What has several components, such as a colour, is one
//! attribute for each.
struct Attribute {
    std::string name;                       //!< That of PLY: "quality", "red", "material", ...
    NumberType type = NumberType::Float64;  //!< That of the file.
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

//! Whether the name is that of a part of a colour: red, green, blue or alpha.
[[nodiscard]] bool is_color(std::string_view name);

//! Whether values between two values make no sense: integers that are no colours.
[[nodiscard]] bool is_label(const Attribute& attribute);

//! Whether the number can be stored in the type without a change but that of precision.
[[nodiscard]] bool is_value_of(NumberType type, double value);

//! Turns values of polygons into those of the triangles that they were cut into.
//! \param face_polygon  see MeshFile.
void spread_to_triangles(const std::vector<Index>& face_polygon, std::vector<Attribute>& of_faces);

}  // namespace remesh
