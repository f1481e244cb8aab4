// Writes OFF; with colours of vertices COFF, with normals NOFF, with texture coordinates STOFF.
// Colours of uchar are whole numbers, others lie between 0 and 1.

#include <array>

#include "agvd/mesh/mesh.h"
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/text_colors.h"
#include "remesh/meshfile/text_format.h"

namespace remesh {
namespace {

// In place of the line end.
template <typename Row>
void append_to_line(std::string& bytes, const Row& row) {
    bytes.pop_back();
    append_line(bytes, " ", row);
}

void append_color(std::string& bytes, const std::vector<const Attribute*>& colors, std::size_t i) {
    if (colors.empty()) return;
    if (colors.front()->type == NumberType::UInt8) {
        std::array<int, 4> color{0, 0, 0, 255};
        for (std::size_t k = 0; k < colors.size(); ++k) {
            color[k] = static_cast<int>(colors[k]->values[i]);
        }
        append_to_line(bytes, color);
        return;
    }
    std::array<float, 4> color{0, 0, 0, 1};
    for (std::size_t k = 0; k < colors.size(); ++k) {
        color[k] = static_cast<float>(intensity(*colors[k], i));
    }
    append_to_line(bytes, color);
}

}  // namespace

bool off_holds(const Attribute& attribute, ElementKind kind, const MeshAttributes& all) {
    return is_color(attribute.name) &&
           !colors_of(kind == ElementKind::Vertex ? all.of_vertices : all.of_faces).empty();
}

std::string format_off(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    const auto vertex_colors = colors_of(attributes.of_vertices);
    const auto face_colors = colors_of(attributes.of_faces);
    std::vector<Vec3> normals;
    if (attributes.normals) normals = vertex_normals(mesh);
    const std::vector<Vec2> texture = coordinates_of_vertices(mesh, attributes.texture);
    std::string bytes = std::string(texture.empty() ? "" : "ST") +
                        (vertex_colors.empty() ? "" : "C") + (normals.empty() ? "" : "N") +
                        "OFF\n" + std::to_string(mesh.positions.size()) + ' ' +
                        std::to_string(mesh.triangles.size()) + " 0\n";
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        ticker.tick(4);
        append_line(bytes, "", mesh.positions[v]);
        if (!normals.empty()) append_to_line(bytes, normals[v].cast<float>().eval());
        append_color(bytes, vertex_colors, v);
        if (!texture.empty()) append_to_line(bytes, texture[v]);
    }
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        append_line(bytes, "3 ", mesh.triangles[f]);
        append_color(bytes, face_colors, f);
    }
    return bytes;
}

}  // namespace remesh
