// Writes glTF 2.0, binary or as JSON: one mesh, with positions, normals and texture coordinates in
// single precision and colours in bytes; a primitive for each material, and the materials with
// their images. Vertices are split where their corners' coordinates differ.

#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>

#include "remesh/meshfile/byte_source.h"
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/materials.h"
#include "remesh/meshfile/numbers.h"

namespace remesh {
namespace {

using GltfJson = nlohmann::json;

constexpr std::size_t largest_file = UINT32_MAX;

constexpr int of_vertices = 34962, of_corners = 34963;  // Targets of views.
constexpr int type_byte = 5121, type_index = 5125, type_float = 5126;

// The data of the file, and what the JSON says of them.
struct GltfBuffer {
    std::string bytes;
    GltfJson views = GltfJson::array(), accessors = GltfJson::array();

    // Describes the bytes appended since `begin`. \return the number of the view.
    std::size_t add_view(std::size_t begin) {
        views.push_back(
            {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes.size() - begin}});
        return views.size() - 1;
    }
    // \return the number of the accessor.
    std::size_t add(std::size_t begin, int target, GltfJson accessor) {
        add_view(begin);
        views.back()["target"] = target;
        accessor["bufferView"] = views.size() - 1;
        accessors.push_back(std::move(accessor));
        return accessors.size() - 1;
    }
};

// The file's vertices: those of a mesh, once for each pair of texture coordinates that they have.
struct GltfVertices {
    std::vector<Index> source;  // Vertices of the mesh.
    std::vector<Vec2> texture;  // Of these vertices; empty: there is none.
    std::vector<Triangle> triangles;
};

GltfVertices split_vertices(const MeshView& mesh, const TextureCoordinates& texture,
                            Ticker& ticker) {
    GltfVertices result;
    result.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    result.source.resize(mesh.positions.size());
    std::iota(result.source.begin(), result.source.end(), Index{0});
    if (texture.empty()) return result;
    // The first pair of a vertex takes its number, others take new ones.
    std::vector<bool> is_taken(mesh.positions.size(), false);
    result.texture.assign(mesh.positions.size(), Vec2::Zero());
    std::map<std::tuple<Index, double, double>, Index> known;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick(4);
        for (std::size_t k = 0; k < 3; ++k) {
            Index& v = result.triangles[f][k];
            const Vec2& corner = texture.corners[f][k];
            // Files count v downwards.
            const Vec2 p = corner.allFinite() ? Vec2(corner.x(), 1 - corner.y()) : Vec2(0, 0);
            const auto number = static_cast<Index>(result.source.size());
            const auto [entry, is_new] =
                known.try_emplace(std::tuple(v, p.x(), p.y()), is_taken[v] ? number : v);
            if (is_new && !is_taken[v]) {
                is_taken[v] = true;
                result.texture[v] = p;
            } else if (is_new) {
                result.source.push_back(v);
                result.texture.push_back(p);
            }
            v = entry->second;
        }
    }
    return result;
}

std::size_t add_texture(const std::vector<Vec2>& texture, Ticker& ticker, GltfBuffer& buffer) {
    const std::size_t begin = buffer.bytes.size();
    for (const Vec2& p : texture) {
        ticker.tick();
        for (const double x : p) append(buffer.bytes, static_cast<float>(x));
    }
    return buffer.add(begin, of_vertices,
                      {{"componentType", type_float}, {"count", texture.size()}, {"type", "VEC2"}});
}

// \param vectors  of the mesh's vertices.
std::size_t add_vectors(std::span<const Vec3> vectors, const GltfVertices& vertices, Ticker& ticker,
                        GltfBuffer& buffer) {
    const std::size_t begin = buffer.bytes.size();
    constexpr float largest = std::numeric_limits<float>::max();
    std::array<float, 3> low{largest, largest, largest}, high{-largest, -largest, -largest};
    for (const Index v : vertices.source) {
        ticker.tick();
        for (std::size_t k = 0; k < 3; ++k) {
            const auto x = static_cast<float>(vectors[v].data()[k]);
            low[k] = std::min(low[k], x);
            high[k] = std::max(high[k], x);
            append(buffer.bytes, x);
        }
    }
    return buffer.add(begin, of_vertices,
                      {{"componentType", type_float},
                       {"count", vertices.source.size()},
                       {"type", "VEC3"},
                       {"min", low},
                       {"max", high}});
}

// Rows take four bytes, as glTF wants it.
std::size_t add_colors(const std::vector<const Attribute*>& colors, const GltfVertices& vertices,
                       Ticker& ticker, GltfBuffer& buffer) {
    const std::size_t begin = buffer.bytes.size(), count = vertices.source.size();
    for (const Index i : vertices.source) {
        ticker.tick();
        for (const Attribute* part : colors) {
            append_number(buffer.bytes, NumberType::UInt8, 255 * intensity(*part, i));
        }
        if (colors.size() == 3) append(buffer.bytes, std::uint8_t{255});
    }
    const std::size_t accessor = buffer.add(begin, of_vertices,
                                            {{"componentType", type_byte},
                                             {"normalized", true},
                                             {"count", count},
                                             {"type", colors.size() == 3 ? "VEC3" : "VEC4"}});
    buffer.views.back()["byteStride"] = 4;
    return accessor;
}

std::size_t add_corners(std::span<const Triangle> triangles, Ticker& ticker, GltfBuffer& buffer) {
    const std::size_t begin = buffer.bytes.size();
    for (const Triangle& triangle : triangles) {
        ticker.tick();
        for (const Index v : triangle) append(buffer.bytes, v);
    }
    return buffer.add(
        begin, of_corners,
        {{"componentType", type_index}, {"count", 3 * triangles.size()}, {"type", "SCALAR"}});
}

// Removes the textures whose coordinates the file does not have.
void remove_textures(GltfJson& properties, bool has_coordinates) {
    std::vector<std::string> removed;
    for (auto& [key, value] : properties.items()) {
        if (!value.is_object()) continue;
        const bool is_texture = value.contains("index");
        const bool is_first = !value.contains("texCoord") || value["texCoord"] == 0;
        if (is_texture && !(has_coordinates && is_first)) {
            removed.push_back(key);
        } else {
            remove_textures(value, has_coordinates);
        }
    }
    for (const std::string& key : removed) properties.erase(key);
}

// Materials, textures and images of the file.
// \return the number of the material for each label.
std::vector<std::size_t> add_materials(const Attribute& labels, const MeshAttributes& attributes,
                                       GltfBuffer& buffer, GltfJson& root) {
    const GltfJson given = parsed(attributes.materials.json);
    if (given.is_object()) root.update(given);
    GltfJson& materials = root["materials"];
    if (!materials.is_array()) materials = GltfJson::array();
    std::map<std::string, std::size_t> number;
    for (GltfJson& material : materials) {
        const auto name = material.is_object() ? material.find("name") : material.end();
        if (name == material.end() || !name->is_string()) continue;
        number.try_emplace(name->get<std::string>(),
                           static_cast<std::size_t>(&material - &materials[0]));
        remove_textures(material, !attributes.texture.empty());
    }
    for (std::size_t i = 0; i < attributes.materials.images.size(); ++i) {
        const std::string& image = attributes.materials.images[i];
        if (image.empty()) continue;
        GltfJson& properties = root["images"][i];
        properties.erase("uri");
        if (!properties.contains("mimeType")) {
            properties["mimeType"] = image.starts_with("\x89PNG") ? "image/png" : "image/jpeg";
        }
        const std::size_t begin = buffer.bytes.size();
        buffer.bytes += image;
        properties["bufferView"] = buffer.add_view(begin);
    }
    std::vector<std::size_t> of_label;
    for (const std::string& label : labels.names) {
        const std::string name = as_utf8(label);
        const auto [entry, is_new] = number.try_emplace(name, materials.size());
        if (is_new && !name.empty()) materials.push_back({{"name", name}});
        of_label.push_back(entry->second);
    }
    if (materials.empty()) root.erase("materials");
    return of_label;
}

// One for each material, or one.
// \param primitive  without its corners.
GltfJson primitives_of(const std::vector<Triangle>& triangles, const GltfJson& primitive,
                       const MeshAttributes& attributes, Ticker& ticker, GltfBuffer& buffer,
                       GltfJson& root) {
    GltfJson primitives = GltfJson::array();
    const auto add = [&](std::span<const Triangle> some) -> GltfJson& {
        primitives.push_back(primitive);
        primitives.back()["indices"] = add_corners(some, ticker, buffer);
        return primitives.back();
    };
    const Attribute* const labels = find_attribute(attributes.of_faces, "material");
    if (labels == nullptr || labels->names.empty()) {
        add(triangles);
        return primitives;
    }
    std::vector<std::vector<Triangle>> of_label(labels->names.size());
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        of_label[static_cast<std::size_t>(labels->values[f])].push_back(triangles[f]);
    }
    for (std::size_t label = 0; label < of_label.size(); ++label) {
        if (of_label[label].empty()) continue;
        GltfJson& added = add(of_label[label]);
        if (labels->names[label].empty()) continue;
        added["material"] = label;  // Numbered below, when all corners are in the buffer.
    }
    // Images may have any size: corners come before them.
    const std::vector<std::size_t> material = add_materials(*labels, attributes, buffer, root);
    for (GltfJson& one : primitives) {
        if (one.contains("material"))
            one["material"] = material[one["material"].get<std::size_t>()];
    }
    return primitives;
}

void append_chunk(const char* type, std::string content, char padding, std::string& bytes) {
    content.resize((content.size() + 3) / 4 * 4, padding);
    append(bytes, static_cast<std::uint32_t>(content.size()));
    bytes.append(type, 4);
    bytes += content;
}

// The JSON, and the bytes of the buffer.
std::pair<GltfJson, std::string> make_file(const MeshView& mesh, const MeshAttributes& attributes,
                                           Ticker& ticker) {
    const GltfVertices vertices = split_vertices(mesh, attributes.texture, ticker);
    std::size_t size = vertices.source.size() * 36 + mesh.triangles.size() * 12;
    for (const std::string& image : attributes.materials.images) size += image.size();
    if (mesh.triangles.empty() ||
        size + attributes.materials.json.size() > largest_file - (1 << 20)) {
        throw InvalidInput(
            "a mesh without faces, or of more than 4 GB, cannot be written as "
            "glTF; write .ply");
    }
    GltfBuffer buffer;
    GltfJson primitive;
    primitive["attributes"]["POSITION"] = add_vectors(mesh.positions, vertices, ticker, buffer);
    if (attributes.normals) {
        primitive["attributes"]["NORMAL"] =
            add_vectors(vertex_normals(mesh), vertices, ticker, buffer);
    }
    if (!vertices.texture.empty()) {
        primitive["attributes"]["TEXCOORD_0"] = add_texture(vertices.texture, ticker, buffer);
    }
    if (const auto colors = colors_of(attributes.of_vertices); !colors.empty()) {
        primitive["attributes"]["COLOR_0"] = add_colors(colors, vertices, ticker, buffer);
    }
    GltfJson root = {{"asset", {{"version", "2.0"}, {"generator", "remesh"}}},
                     {"scene", 0},
                     {"scenes", GltfJson::array({{{"nodes", GltfJson::array({0})}}})},
                     {"nodes", GltfJson::array({{{"mesh", 0}}})}};
    const GltfJson primitives =
        primitives_of(vertices.triangles, primitive, attributes, ticker, buffer, root);
    root["meshes"] = GltfJson::array({{{"primitives", primitives}}});
    root["buffers"] = GltfJson::array({{{"byteLength", buffer.bytes.size()}}});
    root["bufferViews"] = buffer.views;
    root["accessors"] = buffer.accessors;
    return {root, std::move(buffer.bytes)};
}

}  // namespace

bool gltf_holds(const Attribute& attribute, ElementKind kind, const MeshAttributes& all) {
    if (kind == ElementKind::Face) return attribute.name == "material" && !attribute.names.empty();
    return is_color(attribute.name) && !colors_of(all.of_vertices).empty();
}

std::string format_glb(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    auto [root, buffer] = make_file(mesh, attributes, ticker);
    std::string chunks;
    append_chunk("JSON", text_of(root), ' ', chunks);
    append_chunk("BIN\0", std::move(buffer), '\0', chunks);
    std::string bytes = "glTF";
    append(bytes, std::uint32_t{2});
    append(bytes, static_cast<std::uint32_t>(12 + chunks.size()));
    return bytes + chunks;
}

std::string format_gltf(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    auto [root, buffer] = make_file(mesh, attributes, ticker);
    root["buffers"][0]["uri"] = "data:application/octet-stream;base64," + in_base64(buffer, ticker);
    return text_of(root) + '\n';
}

}  // namespace remesh
