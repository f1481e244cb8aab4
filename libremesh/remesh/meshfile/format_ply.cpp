// Writes PLY: coordinates in double, attributes under their names and types, texture coordinates as
// a list of each face.

#include "agvd/mesh/mesh.h"
#include "remesh/meshfile/append_number.h"
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/ply_header.h"

namespace remesh {
namespace {

NumberType stored_type(const Attribute& attribute) {
    return attribute.is_intensity ? NumberType::UInt8 : attribute.type;
}

std::string properties_of(const std::vector<Attribute>& attributes) {
    std::string text;
    for (const Attribute& attribute : attributes) {
        text += std::string("property ") + name_of(stored_type(attribute)) + ' ' + attribute.name +
                '\n';
    }
    return text;
}

std::string normal_properties(const MeshAttributes& attributes) {
    std::string text;
    if (!attributes.normals) return text;
    for (const char* name : {"nx", "ny", "nz"}) {
        text += std::string("property ") + name_of(*attributes.normals) + ' ' + name + '\n';
    }
    return text;
}

// What the labels are called: "comment material 0 brass".
std::string label_comments(const MeshAttributes& attributes) {
    std::string text;
    for (const Attribute& attribute : attributes.of_faces) {
        for (std::size_t i = 0; i < attribute.names.size(); ++i) {
            text += "comment " + attribute.name + ' ' + std::to_string(i) + ' ' +
                    attribute.names[i] + '\n';
        }
    }
    return text;
}

NumberType stored_type(const TextureCoordinates& texture) {
    return texture.type == NumberType::Float64 ? NumberType::Float64 : NumberType::Float32;
}

std::string texture_property(const TextureCoordinates& texture) {
    if (texture.empty()) return "";
    return std::string("property list uchar ") + name_of(stored_type(texture)) + ' ' +
           TextureCoordinates::name + '\n';
}

void append_texture(std::string& bytes, const TextureCoordinates& texture, std::size_t face) {
    if (texture.empty()) return;
    const CornerCoordinates& corners = texture.corners[face];
    append(bytes, std::uint8_t{is_whole(corners) ? std::uint8_t{6} : std::uint8_t{0}});
    if (!is_whole(corners)) return;
    for (const Vec2& corner : corners) {
        for (const double x : corner) append_number(bytes, stored_type(texture), x);
    }
}

void append_values(std::string& bytes, const std::vector<Attribute>& attributes, std::size_t i) {
    for (const Attribute& attribute : attributes) {
        const double value = attribute.values[i];
        append_number(bytes, stored_type(attribute), attribute.is_intensity ? 255 * value : value);
    }
}

}  // namespace

std::string format_ply(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    // "int" is what every reader knows; it does for all but the largest meshes.
    const char* const index_type = mesh.positions.size() <= INT32_MAX ? "int" : "uint";
    std::string bytes = "ply\nformat binary_little_endian 1.0\n" + label_comments(attributes) +
                        "element vertex " + std::to_string(mesh.positions.size()) +
                        "\nproperty double x\nproperty double y\nproperty double z\n" +
                        normal_properties(attributes) + properties_of(attributes.of_vertices) +
                        "element face " + std::to_string(mesh.triangles.size()) +
                        "\nproperty list uchar " + index_type + " vertex_indices\n" +
                        texture_property(attributes.texture) + properties_of(attributes.of_faces) +
                        "end_header\n";
    std::vector<Vec3> normals;
    if (attributes.normals) normals = vertex_normals(mesh);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        ticker.tick();
        for (const double x : mesh.positions[v]) append(bytes, x);
        if (attributes.normals) {
            for (const double x : normals[v]) append_number(bytes, *attributes.normals, x);
        }
        append_values(bytes, attributes.of_vertices, v);
    }
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        append(bytes, std::uint8_t{3});
        for (const Index v : mesh.triangles[f]) append(bytes, v);
        append_texture(bytes, attributes.texture, f);
        append_values(bytes, attributes.of_faces, f);
    }
    return bytes;
}

}  // namespace remesh
