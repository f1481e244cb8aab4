// Writes OBJ: vertices with colours and normals, texture coordinates, each once, and faces with
// materials, groups and objects.

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "agvd/mesh/mesh.h"
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/text_colors.h"
#include "remesh/meshfile/text_format.h"

namespace remesh {
namespace {

constexpr std::array label_statements = {std::pair{"o ", "object"}, std::pair{"g ", "group"},
                                         std::pair{"usemtl ", "material"}};

void append_vertex(std::string& bytes, const Vec3& p, std::size_t vertex,
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

// Numbers of texture coordinates, from 1.
class ObjTexture {
public:
    // Appends the lines vt.
    ObjTexture(const TextureCoordinates& texture, Ticker& ticker, std::string& bytes) {
        const bool is_single = texture.type == NumberType::Float32;
        for (const CornerCoordinates& corners : texture.corners) {
            ticker.tick(4);
            for (const Vec2& p : corners) {
                if (!is_whole(corners)) {
                    number_.push_back(0);
                    continue;
                }
                const auto [known, is_new] = known_.try_emplace({p.x(), p.y()}, known_.size() + 1);
                number_.push_back(known->second);
                if (!is_new) continue;
                if (is_single) {
                    append_line(bytes, "vt ", p.cast<float>().eval());
                } else {
                    append_line(bytes, "vt ", p);
                }
            }
        }
    }

    // 0: there is none.
    [[nodiscard]] std::size_t operator()(std::size_t face, std::size_t corner) const {
        return number_.empty() ? 0 : number_[3 * face + corner];
    }

private:
    std::map<std::pair<double, double>, std::size_t> known_;
    std::vector<std::size_t> number_;
};

void append_face(std::string& bytes, const Triangle& triangle, std::size_t face, bool has_normals,
                 const ObjTexture& texture) {
    bytes += 'f';
    for (std::size_t k = 0; k < 3; ++k) {
        const std::string number = std::to_string(triangle[k] + 1ull);
        bytes.append(" ").append(number);
        if (texture(face, k) > 0) bytes.append("/").append(std::to_string(texture(face, k)));
        if (has_normals) bytes.append(texture(face, k) > 0 ? "/" : "//").append(number);
    }
    bytes += '\n';
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

std::string format_obj(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    std::string bytes;
    for (const std::string& file : attributes.material_files) bytes += "mtllib " + file + '\n';
    const std::vector<const Attribute*> colors = colors_of(attributes.of_vertices);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        ticker.tick(4);
        append_vertex(bytes, mesh.positions[v], v, colors);
    }
    if (attributes.normals) {
        for (const Vec3& normal : vertex_normals(mesh)) {
            ticker.tick(4);
            append_line(bytes, "vn ", normal.cast<float>().eval());
        }
    }
    const ObjTexture texture(attributes.texture, ticker, bytes);
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        append_labels(bytes, attributes.of_faces, f);
        append_face(bytes, mesh.triangles[f], f, attributes.normals.has_value(), texture);
    }
    return bytes;
}

}  // namespace remesh
