// Writes binary glTF 2.0: one mesh, with positions, normals and texture coordinates in single
// precision and colours in bytes. Vertices are split where their corners' coordinates differ.

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>

#include "agvd/core/error.h"
#include "remesh/io/append_number.h"
#include "remesh/io/formats.h"
#include "remesh/io/text_colors.h"
#include "remesh/transfer/vertex_normals.h"

namespace remesh {
namespace {

using GlbJson = nlohmann::ordered_json;

constexpr int of_vertices = 34962, of_corners = 34963;  // Targets of views.
constexpr int type_byte = 5121, type_index = 5125, type_float = 5126;

// The data of the file, and what the JSON says of them.
struct GlbBuffer {
    std::string bytes;
    GlbJson views = GlbJson::array(), accessors = GlbJson::array();

    // Describes the bytes appended since `begin`. \return the number of the accessor.
    std::size_t add(std::size_t begin, int target, GlbJson accessor) {
        views.push_back({{"buffer", 0},
                         {"byteOffset", begin},
                         {"byteLength", bytes.size() - begin},
                         {"target", target}});
        accessor["bufferView"] = views.size() - 1;
        accessors.push_back(std::move(accessor));
        return accessors.size() - 1;
    }
};

// The file's vertices: those of a mesh, once for each pair of texture coordinates that they have.
struct GlbVertices {
    std::vector<agvd::Index> source;  // Vertices of the mesh.
    std::vector<agvd::Vec2> texture;  // Likewise; empty: there is none.
    std::vector<agvd::Triangle> triangles;
};

GlbVertices split_vertices(const agvd::MeshView& mesh, const TextureCoordinates& texture,
                           agvd::Ticker& ticker) {
    GlbVertices result;
    result.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    result.source.resize(mesh.positions.size());
    std::iota(result.source.begin(), result.source.end(), agvd::Index{0});
    if (texture.empty()) return result;
    // The first pair of a vertex takes its number, others take new ones.
    std::vector<bool> is_taken(mesh.positions.size(), false);
    result.texture.assign(mesh.positions.size(), agvd::Vec2::Zero());
    std::map<std::tuple<agvd::Index, double, double>, agvd::Index> known;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick(4);
        for (std::size_t k = 0; k < 3; ++k) {
            agvd::Index& v = result.triangles[f][k];
            const agvd::Vec2& corner = texture.corners[f][k];
            // Files count v downwards.
            const agvd::Vec2 p =
                corner.allFinite() ? agvd::Vec2(corner.x(), 1 - corner.y()) : agvd::Vec2(0, 0);
            const auto number = static_cast<agvd::Index>(result.source.size());
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

std::vector<agvd::Vec3> taken(std::span<const agvd::Vec3> vectors, const GlbVertices& vertices) {
    std::vector<agvd::Vec3> result;
    result.reserve(vertices.source.size());
    for (const agvd::Index v : vertices.source) result.push_back(vectors[v]);
    return result;
}

std::size_t add_texture(const std::vector<agvd::Vec2>& texture, agvd::Ticker& ticker,
                        GlbBuffer& buffer) {
    const std::size_t begin = buffer.bytes.size();
    for (const agvd::Vec2& p : texture) {
        ticker.tick();
        for (const double x : p) append(buffer.bytes, static_cast<float>(x));
    }
    return buffer.add(begin, of_vertices,
                      {{"componentType", type_float}, {"count", texture.size()}, {"type", "VEC2"}});
}

std::size_t add_vectors(const std::vector<agvd::Vec3>& vectors, agvd::Ticker& ticker,
                        GlbBuffer& buffer) {
    const std::size_t begin = buffer.bytes.size();
    constexpr float largest = std::numeric_limits<float>::max();
    std::array<float, 3> low{largest, largest, largest}, high{-largest, -largest, -largest};
    for (const agvd::Vec3& v : vectors) {
        ticker.tick();
        for (std::size_t k = 0; k < 3; ++k) {
            const auto x = static_cast<float>(v.data()[k]);
            low[k] = std::min(low[k], x);
            high[k] = std::max(high[k], x);
            append(buffer.bytes, x);
        }
    }
    return buffer.add(begin, of_vertices,
                      {{"componentType", type_float},
                       {"count", vectors.size()},
                       {"type", "VEC3"},
                       {"min", low},
                       {"max", high}});
}

// Rows take four bytes, as glTF wants it.
std::size_t add_colors(const std::vector<const Attribute*>& colors, const GlbVertices& vertices,
                       agvd::Ticker& ticker, GlbBuffer& buffer) {
    const std::size_t begin = buffer.bytes.size(), count = vertices.source.size();
    for (const agvd::Index i : vertices.source) {
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

std::size_t add_corners(const std::vector<agvd::Triangle>& triangles, agvd::Ticker& ticker,
                        GlbBuffer& buffer) {
    const std::size_t begin = buffer.bytes.size();
    for (const agvd::Triangle& triangle : triangles) {
        ticker.tick();
        for (const agvd::Index v : triangle) append(buffer.bytes, v);
    }
    return buffer.add(
        begin, of_corners,
        {{"componentType", type_index}, {"count", 3 * triangles.size()}, {"type", "SCALAR"}});
}

void append_chunk(const char* type, std::string content, char padding, std::string& bytes) {
    content.resize((content.size() + 3) / 4 * 4, padding);
    append(bytes, static_cast<std::uint32_t>(content.size()));
    bytes.append(type, 4);
    bytes += content;
}

}  // namespace

bool glb_holds(const Attribute& attribute, ElementKind kind, const MeshAttributes& all) {
    return kind == ElementKind::Vertex && is_color(attribute.name) &&
           !colors_of(all.of_vertices).empty();
}

std::string format_glb(const agvd::MeshView& mesh, const MeshAttributes& attributes,
                       agvd::Ticker ticker) {
    constexpr std::size_t largest_file = UINT32_MAX;
    const GlbVertices vertices = split_vertices(mesh, attributes.texture, ticker);
    if (mesh.triangles.empty() ||
        vertices.source.size() * 36 + mesh.triangles.size() * 12 > largest_file - 4096) {
        throw agvd::InvalidInput(
            "a mesh without faces, or of more than 4 GB, cannot be written as "
            ".glb; write .ply");
    }
    GlbBuffer buffer;
    GlbJson primitive;
    primitive["attributes"]["POSITION"] =
        add_vectors(taken(mesh.positions, vertices), ticker, buffer);
    if (attributes.normals) {
        primitive["attributes"]["NORMAL"] =
            add_vectors(taken(vertex_normals(mesh), vertices), ticker, buffer);
    }
    if (!vertices.texture.empty()) {
        primitive["attributes"]["TEXCOORD_0"] = add_texture(vertices.texture, ticker, buffer);
    }
    if (const auto colors = colors_of(attributes.of_vertices); !colors.empty()) {
        primitive["attributes"]["COLOR_0"] = add_colors(colors, vertices, ticker, buffer);
    }
    primitive["indices"] = add_corners(vertices.triangles, ticker, buffer);
    const GlbJson root = {
        {"asset", {{"version", "2.0"}, {"generator", "remesh"}}},
        {"scene", 0},
        {"scenes", GlbJson::array({{{"nodes", GlbJson::array({0})}}})},
        {"nodes", GlbJson::array({{{"mesh", 0}}})},
        {"meshes", GlbJson::array({{{"primitives", GlbJson::array({primitive})}}})},
        {"buffers", GlbJson::array({{{"byteLength", buffer.bytes.size()}}})},
        {"bufferViews", buffer.views},
        {"accessors", buffer.accessors}};
    std::string chunks;
    append_chunk("JSON", root.dump(), ' ', chunks);
    append_chunk("BIN\0", std::move(buffer.bytes), '\0', chunks);
    std::string bytes = "glTF";
    append(bytes, std::uint32_t{2});
    append(bytes, static_cast<std::uint32_t>(12 + chunks.size()));
    return bytes + chunks;
}

}  // namespace remesh
