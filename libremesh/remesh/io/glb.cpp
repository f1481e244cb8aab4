// Binary glTF 2.0 (.glb): the triangles of all nodes of the scene, with their transforms applied.
// Colours of vertices, texture coordinates and materials of triangles are attributes (format:
// Khronos Group, glTF 2.0 Specification).

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "remesh/io/face_labels.h"
#include "remesh/io/formats.h"
#include "remesh/io/glb_container.h"
#include "remesh/io/polygon_soup.h"
#include "remesh/io/strip_triangles.h"
#include "remesh/io/text_colors.h"

namespace remesh {
namespace {

using agvd::Vec3;
using Transform = Eigen::Affine3d;

constexpr const char* texture_name = "TEXCOORD_0";

constexpr std::uint64_t mode_triangles = 4, mode_strip = 5, mode_fan = 6;

class GlbReader {
public:
    explicit GlbReader(SourceFile& file) : file_(file), glb_(file), soup_(file, 0) {}

    MeshFile read() {
        if (glb_.list(glb_.root(), "scenes").empty()) {
            for (std::uint64_t m = 0; m < glb_.list(glb_.root(), "meshes").size(); ++m) {
                read_mesh(m, Transform::Identity());
            }
        } else {
            read_nodes(glb_.at("scenes", glb_.number(glb_.root(), "scene").value_or(0)));
        }
        const std::size_t num_vertices = soup_.positions.size();
        MeshFile result = std::move(soup_).finish();
        if (file_.with_attributes) attach(finish_attributes(num_vertices), result);
        if (num_others_ > 0) {
            add_warning(file_.path.string() + ": " + std::to_string(num_others_) +
                            " primitives of points or lines are passed over",
                        result);
        }
        return result;
    }

private:
    // In the order of the file, children after their parent. A node has one parent at most.
    void read_nodes(const nlohmann::json& scene) {
        struct Open {
            std::uint64_t node;
            Transform parent;
        };
        std::vector<Open> open;
        std::vector<bool> is_seen(glb_.list(glb_.root(), "nodes").size(), false);
        const auto push = [&](const nlohmann::json& nodes, const Transform& parent) {
            for (std::size_t i = nodes.size(); i-- > 0;) {
                if (!nodes[i].is_number_unsigned()) glb_.fail("a node is no whole number from 0");
                open.push_back({nodes[i].get<std::uint64_t>(), parent});
            }
        };
        push(glb_.list(scene, "nodes"), Transform::Identity());
        while (!open.empty()) {
            const auto [index, parent] = open.back();
            open.pop_back();
            soup_.ticker.tick(16);
            const nlohmann::json& node = glb_.at("nodes", index);
            if (is_seen[index]) glb_.fail("node " + std::to_string(index) + " has several parents");
            is_seen[index] = true;
            const Transform transform = parent * transform_of(node);
            if (const auto mesh = glb_.number(node, "mesh")) read_mesh(*mesh, transform);
            push(glb_.list(node, "children"), transform);
        }
    }

    [[nodiscard]] Transform transform_of(const nlohmann::json& node) const {
        Transform transform = Transform::Identity();
        if (const auto matrix = glb_.numbers(node, "matrix", 16)) {
            transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(matrix->data());
            return transform;
        }
        if (const auto t = glb_.numbers(node, "translation", 3)) {
            transform.translate(Vec3((*t)[0], (*t)[1], (*t)[2]));
        }
        if (const auto r = glb_.numbers(node, "rotation", 4)) {
            const Eigen::Quaterniond rotation((*r)[3], (*r)[0], (*r)[1], (*r)[2]);
            if (rotation.norm() > 0) transform.rotate(rotation.normalized());
        }
        if (const auto s = glb_.numbers(node, "scale", 3)) {
            transform.scale(Vec3((*s)[0], (*s)[1], (*s)[2]));
        }
        return transform;
    }

    void read_mesh(std::uint64_t index, const Transform& transform) {
        // By accessor: primitives may share them.
        std::map<std::uint64_t, std::size_t> first_vertex, first_coordinates;
        for (const nlohmann::json& primitive : glb_.list(glb_.at("meshes", index), "primitives")) {
            if (!primitive.is_object()) glb_.fail("a primitive is no object");
            const std::uint64_t mode = glb_.number(primitive, "mode").value_or(mode_triangles);
            if (mode < mode_triangles || mode > mode_fan) {
                ++num_others_;
                continue;
            }
            const auto attributes = primitive.find("attributes");
            if (attributes == primitive.end() || !attributes->is_object()) {
                glb_.fail("a primitive has no attributes");
            }
            const auto positions = glb_.number(*attributes, "POSITION");
            if (!positions) glb_.fail("a primitive has no positions");
            const auto [entry, is_new] =
                first_vertex.try_emplace(*positions, soup_.positions.size());
            if (is_new) read_vertices(*positions, *attributes, transform);
            const std::uint64_t count = glb_.array(*positions).num_rows;
            const std::size_t num_before = soup_.num_polygons(), num_corners = soup_.num_corners();
            read_faces(primitive, mode, entry->second, count, transform.linear().determinant() < 0);
            add_materials(primitive, soup_.num_polygons() - num_before);
            if (!file_.with_attributes) continue;
            if (const auto texture = glb_.number(*attributes, texture_name)) {
                const auto [coordinates, is_first] =
                    first_coordinates.try_emplace(*texture, soup_.texture.values.size());
                if (is_first) read_texture(glb_.array(*texture));
                set_texture(num_corners, entry->second, coordinates->second, count);
            }
        }
    }

    void read_vertices(std::uint64_t accessor, const nlohmann::json& attributes,
                       const Transform& transform) {
        const GlbArray array = glb_.array(accessor);
        if (array.num_columns != 3) glb_.fail("positions do not have three coordinates");
        const std::size_t first = soup_.positions.size();
        for (std::uint64_t row = 0; row < array.num_rows; ++row) {
            soup_.ticker.tick(4);
            const Vec3 p = transform * Vec3(glb_.value(array, row, 0), glb_.value(array, row, 1),
                                            glb_.value(array, row, 2));
            if (!p.allFinite()) {
                file_.fail_unusable(
                    array.offset + row * array.stride,
                    "vertex " + std::to_string(row) + " of accessor " + std::to_string(accessor) +
                        " has a coordinate that is not finite; correct or delete the "
                        "vertex");
            }
            soup_.positions.push_back(p);
        }
        if (file_.with_attributes) read_attributes(attributes, first, array.num_rows);
    }

    void read_attributes(const nlohmann::json& attributes, std::size_t first, std::uint64_t count) {
        for (const auto& [name, accessor] : attributes.items()) {
            if (name == "POSITION") continue;
            if (name == "COLOR_0" && accessor.is_number_unsigned()) {
                read_colors(glb_.array(accessor.get<std::uint64_t>()), first, count);
            } else if (name == "NORMAL") {
                has_normals_ = true;
            } else if (name != texture_name) {
                declined_[name] =
                    "only positions, normals, TEXCOORD_0 and COLOR_0 are carried over";
            }
        }
    }

    // Files count v downwards.
    void read_texture(const GlbArray& array) {
        SoupTexture& texture = soup_.texture;
        texture.name = texture_name;
        texture.type = NumberType::Float32;
        texture.is_broken = texture.is_broken || array.num_columns != 2;
        for (std::uint64_t row = 0; row < array.num_rows && !texture.is_broken; ++row) {
            soup_.ticker.tick();
            texture.add(glb_.value(array, row, 0), 1 - glb_.value(array, row, 1));
        }
    }

    // Of the corners since the first `num_before`.
    // \param first_vertex, first  what a primitive of `count` vertices calls 0.
    void set_texture(std::size_t num_before, std::size_t first_vertex, std::size_t first,
                     std::uint64_t count) {
        SoupTexture& texture = soup_.texture;
        texture.is_broken = texture.is_broken || texture.values.size() - first < count;
        for (std::size_t c = num_before; c < soup_.num_corners() && !texture.is_broken; ++c) {
            texture.set_corner(c + 1,
                               static_cast<agvd::Index>(first + soup_.corner(c) - first_vertex));
        }
    }

    void read_colors(const GlbArray& colors, std::size_t first, std::uint64_t count) {
        if (colors.num_rows != count) glb_.fail("there is not one colour for each vertex");
        std::array<double, 4> numbers{};
        for (std::uint64_t row = 0; row < count; ++row) {
            soup_.ticker.tick();
            for (std::size_t k = 0; k < colors.num_columns; ++k) {
                numbers[k] = glb_.value(colors, row, k);
            }
            colors_.take(first + row, std::span(numbers).first(colors.num_columns));
        }
    }

    // \param first   the vertex that the primitive calls 0, of `count`.
    // \param turned  the transform is a reflection.
    void read_faces(const nlohmann::json& primitive, std::uint64_t mode, std::size_t first,
                    std::uint64_t count, bool turned) {
        GlbArray indices{.num_rows = count};
        const auto accessor = glb_.number(primitive, "indices");
        if (accessor) {
            indices = glb_.array(*accessor);
            if (indices.num_columns != 1) glb_.fail("indices have several columns");
        }
        const auto corner = [&](std::uint64_t i) {
            if (!accessor) return Corner{static_cast<std::int64_t>(first + i), 0};
            const std::size_t offset = indices.offset + i * indices.stride;
            const double index = glb_.value(indices, i, 0);
            if (index >= 0 && index < static_cast<double>(count) && index == std::floor(index)) {
                return Corner{static_cast<std::int64_t>(first) + static_cast<std::int64_t>(index),
                              offset};
            }
            file_.fail_unusable(offset, "a face names vertex " + std::to_string(index) +
                                            " of a primitive with " + std::to_string(count) +
                                            " vertices, counted from 0; export the file again");
        };
        if (mode == mode_strip) {
            StripTriangles strip(soup_);
            if (turned && indices.num_rows > 0) add(strip, corner(0));
            for (std::uint64_t i = 0; i < indices.num_rows; ++i) add(strip, corner(i));
            strip.end();
            return;
        }
        if (mode == mode_triangles && indices.num_rows % 3 != 0) {
            glb_.fail("the number of corners of a primitive is no multiple of three");
        }
        const bool is_fan = mode == mode_fan;
        for (std::uint64_t i = is_fan ? 1 : 0; i + (is_fan ? 1 : 2) < indices.num_rows;
             i += is_fan ? 1 : 3) {
            std::array<Corner, 3> corners = {corner(is_fan ? 0 : i), corner(is_fan ? i : i + 1),
                                             corner(is_fan ? i + 1 : i + 2)};
            if (turned) std::swap(corners[1], corners[2]);
            for (const Corner& c : corners) soup_.add_corner(c.vertex, c.offset);
            soup_.end_polygon();
        }
    }

    struct Corner {
        std::int64_t vertex;
        std::size_t offset;
    };
    static void add(StripTriangles& strip, const Corner& c) { strip.add(c.vertex, c.offset); }

    void add_materials(const nlohmann::json& primitive, std::size_t num_faces) {
        if (!file_.with_attributes) return;
        std::string name;
        if (const auto material = glb_.number(primitive, "material")) {
            const nlohmann::json& properties = glb_.at("materials", *material);
            const auto found = properties.find("name");
            name = found != properties.end() && found->is_string()
                       ? found->get<std::string>()
                       : "material_" + std::to_string(*material);
            has_materials_ = true;
        }
        materials_.add(materials_.number_of(std::move(name)), num_faces);
    }

    MeshAttributes finish_attributes(std::size_t num_vertices) {
        MeshAttributes attributes;
        if (has_normals_) attributes.normals = NumberType::Float32;
        for (const auto& [name, reason] : declined_) attributes.declined.push_back({name, reason});
        std::move(colors_).finish(num_vertices, ElementKind::Vertex, attributes);
        if (has_materials_) {
            attributes.of_faces.push_back(std::move(materials_).finish("material"));
        }
        return attributes;
    }

    SourceFile& file_;
    GlbContainer glb_;
    PolygonSoup soup_;
    std::size_t num_others_ = 0;  // Primitives that are no faces.
    bool has_normals_ = false, has_materials_ = false;
    TextColors colors_;
    std::map<std::string, std::string> declined_;  // Reasons by name.
    FaceLabels materials_;
};

}  // namespace

MeshFile read_glb(SourceFile file) { return GlbReader(file).read(); }

}  // namespace remesh
