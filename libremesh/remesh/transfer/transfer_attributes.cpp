#include "remesh/transfer/transfer_attributes.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "agvd/core/error.h"
#include "remesh/transfer/transfer_values.h"

namespace remesh {
namespace {

ValueKind kind_of(const Attribute& attribute) {
    return is_label(attribute) ? ValueKind::Label : ValueKind::Number;
}

Attribute with_values(const Attribute& given, std::vector<double> values) {
    if (is_integer(given.type)) {
        for (double& value : values) value = std::round(value);
    }
    return {given.name, given.type, std::move(values), given.names, given.is_intensity};
}

template <typename Number>
void append_number(std::string& text, Number value) {
    char digits[32];  // The longest double takes 24.
    const auto [last, error] = std::to_chars(std::begin(digits), std::end(digits), value);
    text.append(digits, last);
    text += ' ';
}

// Whether the triangle is a part of a larger polygon, whose triangles follow each other.
bool is_part(const std::vector<Index>& face_polygon, Index face) {
    const Index polygon = face_polygon[face];
    return (face > 0 && face_polygon[face - 1] == polygon) ||
           (face + 1 < face_polygon.size() && face_polygon[face + 1] == polygon);
}

}  // namespace

MeshAttributes transfer_attributes(const MeshFile& input, const MeshView& mesh, const InputMap& map,
                                   const CornerOptions& options) {
    const MeshAttributes& given = input.attributes;
    MeshAttributes result{.normals = given.normals,
                          .material_files = given.material_files,
                          .materials = given.materials,
                          .unit = given.unit,
                          .declined = given.declined};
    for (const Attribute& attribute : given.of_vertices) {
        result.of_vertices.push_back(
            with_values(attribute, transfer_vertex_values(attribute.values, input.mesh.view(),
                                                          map.vertices, kind_of(attribute))));
    }
    for (const Attribute& attribute : given.of_faces) {
        result.of_faces.push_back(with_values(
            attribute, transfer_face_values(attribute.values, map.faces, kind_of(attribute))));
    }
    if (!given.texture.empty()) {
        result.texture = {
            .type = given.texture.type,
            .corners = transfer_corner_values(given.texture.corners, input.mesh.view(), mesh,
                                              map.vertices, options)};
    }
    return result;
}

void keep_attributes(const MeshAttributes& input, std::span<const Index> vertices,
                     std::span<const Index> faces, MeshAttributes& result) {
    const auto keep = [](const std::vector<Attribute>& from, std::span<const Index> elements,
                         std::vector<Attribute>& to) {
        for (std::size_t a = 0; a < from.size(); ++a) {
            for (std::size_t i = 0; i < elements.size(); ++i) {
                to[a].values[i] = from[a].values[elements[i]];
            }
        }
    };
    keep(input.of_vertices, vertices, result.of_vertices);
    keep(input.of_faces, faces, result.of_faces);
    for (std::size_t i = 0; i < faces.size() && !input.texture.empty(); ++i) {
        result.texture.corners[i] = input.texture.corners[faces[i]];
    }
}

const Attribute& require_attribute(const std::vector<Attribute>& attributes, std::string_view name,
                                   const std::string& what) {
    if (const Attribute* const found = find_attribute(attributes, name)) return *found;
    throw InvalidOption(what + " '" + std::string(name) +
                        (attributes.empty() ? "', nor any other; use a file that has it"
                                            : "'; use " + names_of(attributes)));
}

std::vector<Index> face_labels_of(const Attribute& attribute) {
    std::vector<double> distinct = attribute.values;
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    std::vector<Index> labels;
    labels.reserve(attribute.values.size());
    for (const double value : attribute.values) {
        const auto found = std::lower_bound(distinct.begin(), distinct.end(), value);
        labels.push_back(static_cast<Index>(found - distinct.begin()));
    }
    return labels;
}

std::string format_map(const MeshFile& input, std::span<const SurfacePoint> places) {
    std::string text;
    for (const SurfacePoint& place : places) {
        const Index face = place.face.value();
        append_number(text, input.face_polygon[face]);
        for (const double b : place.barycentric) append_number(text, b);
        if (is_part(input.face_polygon, face)) {
            for (const Index v : input.mesh.triangles[face]) append_number(text, v);
        }
        text.back() = '\n';
    }
    return text;
}

}  // namespace remesh
