// Writes OBJ: vertices with colours and normals, faces with materials, groups and objects.

#include <algorithm>
#include <array>
#include <utility>

#include "remesh/io/formats.h"
#include "remesh/io/text_colors.h"
#include "remesh/io/text_format.h"
#include "remesh/transfer/vertex_normals.h"

namespace remesh {
namespace {

constexpr std::array label_statements = {std::pair{"o ", "object"}, std::pair{"g ", "group"},
                                         std::pair{"usemtl ", "material"}};

void append_vertex(std::string& bytes, const agvd::Vec3& p, std::size_t vertex,
                   const std::vector<const Attribute*>& colors) {
    append_line(bytes, "v ", p);
    if (colors.empty()) return;
    bytes.pop_back();
    std::array<float, 3> color{};
    for (std::size_t k = 0; k < 3; ++k) {
        color[k] = static_cast<float>(intensity(*colors[k], vertex));
    }
    append_line(bytes, " ", color);
}

// Statements for the labels that differ from those of the face before.
void append_labels(std::string& bytes, const std::vector<Attribute>& of_faces, std::size_t face) {
    for (const auto& [statement, name] : label_statements) {
        const Attribute* const labels = find_attribute(of_faces, name);
        if (labels == nullptr || labels->names.empty()) continue;
        const auto at = [&](std::size_t f) { return static_cast<std::size_t>(labels->values[f]); };
        const std::string& label = labels->names[at(face)];
        if (face == 0 ? label.empty() : at(face) == at(face - 1)) continue;
        bytes += statement + (label.empty() ? "none" : label) + '\n';
    }
}

}  // namespace

bool obj_holds(const Attribute& attribute, ElementKind kind, const MeshAttributes& all) {
    if (kind == ElementKind::Vertex) {
        return is_color(attribute.name) && attribute.name != "alpha" &&
               !colors_of(all.of_vertices).empty();
    }
    return !attribute.names.empty() &&
           std::any_of(label_statements.begin(), label_statements.end(),
                       [&](const auto& known) { return attribute.name == known.second; });
}

std::string format_obj(const agvd::MeshView& mesh, const MeshAttributes& attributes,
                       agvd::Ticker ticker) {
    std::string bytes;
    for (const std::string& file : attributes.material_files) bytes += "mtllib " + file + '\n';
    const std::vector<const Attribute*> colors = colors_of(attributes.of_vertices);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        ticker.tick(4);
        append_vertex(bytes, mesh.positions[v], v, colors);
    }
    if (attributes.normals) {
        for (const agvd::Vec3& normal : vertex_normals(mesh)) {
            ticker.tick(4);
            append_line(bytes, "vn ", normal.cast<float>().eval());
        }
    }
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        append_labels(bytes, attributes.of_faces, f);
        if (!attributes.normals) {
            const auto& [a, b, c] = mesh.triangles[f];
            append_line(bytes, "f ", std::array<std::uint64_t, 3>{a + 1ull, b + 1ull, c + 1ull});
            continue;
        }
        bytes += 'f';
        for (const agvd::Index v : mesh.triangles[f]) {
            const std::string number = std::to_string(v + 1ull);
            bytes.append(" ").append(number).append("//").append(number);
        }
        bytes += '\n';
    }
    return bytes;
}

}  // namespace remesh
