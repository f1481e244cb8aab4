// glTF 2.0 (.glb and .gltf): the triangles of all nodes of the scene, with their transforms
// applied. Colours of vertices, texture coordinates and materials of triangles are attributes; the
// materials are kept with their images (format: Khronos Group, glTF 2.0 Specification).

#include <algorithm>
#include <cmath>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/gltf_document.h"
#include "remesh/meshfile/materials.h"
#include "remesh/meshfile/polygon_soup.h"

namespace remesh {
namespace {

using Transform = Eigen::Affine3d;

constexpr const char* texture_name = "TEXCOORD_0";

constexpr std::uint64_t mode_triangles = 4, mode_strip = 5, mode_fan = 6;

class GltfReader {
public:
    explicit GltfReader(SourceFile& file) : file_(file), gltf_(file), soup_(file, 0) {}

    MeshFile read() {
        if (gltf_.list(gltf_.root(), "scenes").empty()) {
            for (std::uint64_t m = 0; m < gltf_.list(gltf_.root(), "meshes").size(); ++m) {
                read_mesh(m, Transform::Identity());
            }
        } else {
            read_nodes(gltf_.at("scenes", gltf_.number(gltf_.root(), "scene").value_or(0)));
        }
        MeshFile result = std::move(soup_).finish();
        if (file_.with_attributes) {
            attach(finish_attributes(result.mesh.positions.size()), result);
        }
        result.attributes.unit = "meter";
        if (num_others_ > 0) {
            add_warning(result, file_.path.string(), ": ", num_others_,
                        " primitives of points or lines are skipped");
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
        std::vector<bool> is_seen(gltf_.list(gltf_.root(), "nodes").size(), false);
        const auto push = [&](const nlohmann::json& nodes, const Transform& parent) {
            for (std::size_t i = nodes.size(); i-- > 0;) {
                if (!nodes[i].is_number_unsigned()) {
                    gltf_.fail("a node is not a whole number from 0");
                }
                open.push_back({nodes[i].get<std::uint64_t>(), parent});
            }
        };
        push(gltf_.list(scene, "nodes"), Transform::Identity());
        while (!open.empty()) {
            const auto [index, parent] = open.back();
            open.pop_back();
            soup_.ticker.tick(16);
            const nlohmann::json& node = gltf_.at("nodes", index);
            if (is_seen[index]) gltf_.fail("node ", index, " has several parents");
            is_seen[index] = true;
            const Transform transform = parent * transform_of(node);
            if (const auto mesh = gltf_.number(node, "mesh")) read_mesh(*mesh, transform);
            push(gltf_.list(node, "children"), transform);
        }
    }

    [[nodiscard]] Transform transform_of(const nlohmann::json& node) const {
        Transform transform = Transform::Identity();
        if (const auto matrix = gltf_.numbers(node, "matrix", 16)) {
            transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(matrix->data());
            return transform;
        }
        if (const auto t = gltf_.numbers(node, "translation", 3)) {
            transform.translate(Vec3((*t)[0], (*t)[1], (*t)[2]));
        }
        if (const auto r = gltf_.numbers(node, "rotation", 4)) {
            const Eigen::Quaterniond rotation((*r)[3], (*r)[0], (*r)[1], (*r)[2]);
            if (rotation.norm() > 0) transform.rotate(rotation.normalized());
        }
        if (const auto s = gltf_.numbers(node, "scale", 3)) {
            transform.scale(Vec3((*s)[0], (*s)[1], (*s)[2]));
        }
        return transform;
    }

    void read_mesh(std::uint64_t index, const Transform& transform) {
        // By accessor: primitives may share them.
        std::map<std::uint64_t, std::size_t> first_vertex, first_coordinates;
        for (const nlohmann::json& primitive :
             gltf_.list(gltf_.at("meshes", index), "primitives")) {
            if (!primitive.is_object()) gltf_.fail("a primitive is not an object");
            const std::uint64_t mode = gltf_.number(primitive, "mode").value_or(mode_triangles);
            if (mode < mode_triangles || mode > mode_fan) {
                ++num_others_;
                continue;
            }
            const nlohmann::json& attributes = GltfDocument::member(primitive, "attributes");
            if (!attributes.is_object()) gltf_.fail("a primitive has no attributes");
            const auto positions = gltf_.number(attributes, "POSITION");
            if (!positions) gltf_.fail("a primitive has no positions");
            const auto [entry, is_new] =
                first_vertex.try_emplace(*positions, soup_.positions.size());
            if (is_new) read_vertices(*positions, attributes, transform);
            const std::uint64_t count = gltf_.array(*positions).num_rows;
            const std::size_t num_before = soup_.num_polygons(), num_corners = soup_.num_corners();
            read_faces(primitive, mode, entry->second, count, transform.linear().determinant() < 0);
            add_materials(primitive, soup_.num_polygons() - num_before);
            if (!file_.with_attributes) continue;
            if (const auto texture = gltf_.number(attributes, texture_name)) {
                const auto [coordinates, is_first] =
                    first_coordinates.try_emplace(*texture, soup_.texture.values.size());
                if (is_first) read_texture(gltf_.array(*texture));
                set_texture(num_corners, entry->second, coordinates->second, count);
            }
        }
    }

    void read_vertices(std::uint64_t accessor, const nlohmann::json& attributes,
                       const Transform& transform) {
        const GltfArray array = gltf_.array(accessor);
        if (array.num_columns != 3) gltf_.fail("positions do not have three coordinates");
        const std::size_t first = soup_.positions.size();
        for (std::uint64_t row = 0; row < array.num_rows; ++row) {
            soup_.ticker.tick(4);
            const Vec3 p = transform * Vec3(gltf_.value(array, row, 0), gltf_.value(array, row, 1),
                                            gltf_.value(array, row, 2));
            if (!p.allFinite()) {
                file_.fail_unusable(
                    gltf_.place(array, row), "vertex ", row, " of accessor ", accessor,
                    " has a coordinate that is not finite; correct or delete the vertex");
            }
            soup_.positions.push_back(p);
        }
        if (file_.with_attributes) read_attributes(attributes, first, array.num_rows);
    }

    void read_attributes(const nlohmann::json& attributes, std::size_t first, std::uint64_t count) {
        for (const auto& [name, accessor] : attributes.items()) {
            if (name == "POSITION") continue;
            if (name == "COLOR_0" && accessor.is_number_unsigned()) {
                read_colors(gltf_.array(accessor.get<std::uint64_t>()), first, count);
            } else if (name == "NORMAL") {
                has_normals_ = true;
            } else if (name != texture_name) {
                declined_[name] =
                    "only positions, normals, TEXCOORD_0 and COLOR_0 are carried over";
            }
        }
    }

    // Files count v downwards.
    void read_texture(const GltfArray& array) {
        SoupTexture& texture = soup_.texture;
        texture.name = texture_name;
        texture.type = NumberType::Float32;
        texture.is_broken = texture.is_broken || array.num_columns != 2;
        for (std::uint64_t row = 0; row < array.num_rows && !texture.is_broken; ++row) {
            soup_.ticker.tick();
            texture.add(gltf_.value(array, row, 0), 1 - gltf_.value(array, row, 1));
        }
    }

    // Of the corners since the first `num_before`.
    // \param first_vertex, first  what a primitive of `count` vertices calls 0.
    void set_texture(std::size_t num_before, std::size_t first_vertex, std::size_t first,
                     std::uint64_t count) {
        SoupTexture& texture = soup_.texture;
        texture.is_broken = texture.is_broken || texture.values.size() - first < count;
        for (std::size_t c = num_before; c < soup_.num_corners() && !texture.is_broken; ++c) {
            texture.set_corner(c + 1, static_cast<Index>(first + soup_.corner(c) - first_vertex));
        }
    }

    void read_colors(const GltfArray& colors, std::size_t first, std::uint64_t count) {
        if (colors.num_rows != count) gltf_.fail("there is not one colour for each vertex");
        std::array<double, 4> numbers{};
        for (std::uint64_t row = 0; row < count; ++row) {
            soup_.ticker.tick();
            for (std::size_t k = 0; k < colors.num_columns; ++k) {
                numbers[k] = gltf_.value(colors, row, k);
            }
            colors_.take(first + row, std::span(numbers).first(colors.num_columns));
        }
    }

    // Corners are checked here, so that the soup needs no place for errors.
    // \param first   the vertex that the primitive calls 0, of `count`.
    // \param turned  the transform is a reflection.
    void read_faces(const nlohmann::json& primitive, std::uint64_t mode, std::size_t first,
                    std::uint64_t count, bool turned) {
        GltfArray indices{.num_rows = count};
        const auto accessor = gltf_.number(primitive, "indices");
        if (accessor) {
            indices = gltf_.array(*accessor);
            if (indices.num_columns != 1) gltf_.fail("indices have several columns");
        }
        const auto corner = [&](std::uint64_t i) {
            const double index = accessor ? gltf_.value(indices, i, 0) : static_cast<double>(i);
            if (index >= 0 && index < static_cast<double>(count) && index == std::floor(index)) {
                return static_cast<std::int64_t>(first) + static_cast<std::int64_t>(index);
            }
            file_.fail_unusable(gltf_.place(indices, i), "a face names vertex ", index,
                                " of a primitive with ", count,
                                " vertices, counted from 0; export the file again");
        };
        if (mode == mode_strip) {
            StripTriangles strip(soup_);
            if (turned && indices.num_rows > 0) strip.add(corner(0), 0);
            for (std::uint64_t i = 0; i < indices.num_rows; ++i) strip.add(corner(i), 0);
            return strip.end();
        }
        if (mode == mode_triangles && indices.num_rows % 3 != 0) {
            gltf_.fail("the number of corners of a primitive is not a multiple of three");
        }
        // The second corner of each triangle; the first one of a fan is that of all.
        const bool is_fan = mode == mode_fan;
        for (std::uint64_t i = 1; i + 1 < indices.num_rows; i += is_fan ? 1 : 3) {
            std::array corners = {corner(is_fan ? 0 : i - 1), corner(i), corner(i + 1)};
            if (turned) std::swap(corners[1], corners[2]);
            for (const std::int64_t c : corners) soup_.add_corner(c, 0);
            soup_.end_polygon();
        }
    }

    void add_materials(const nlohmann::json& primitive, std::size_t num_faces) {
        if (!file_.with_attributes) return;
        std::string name;
        if (const auto material = gltf_.number(primitive, "material")) {
            static_cast<void>(gltf_.at("materials", *material));  // Is there such?
            if (material_names_.empty()) name_materials();
            name = material_names_[*material];
        }
        materials_.add(materials_.number_of(std::move(name)), num_faces);
    }

    // Different materials have different names.
    void name_materials() {
        std::set<std::string> taken = {""};
        for (std::size_t m = 0; m < gltf_.list(gltf_.root(), "materials").size(); ++m) {
            const std::string name = one_line(GltfDocument::text(gltf_.at("materials", m), "name"));
            material_names_.push_back(
                unique_name(name.empty() ? "material_" + std::to_string(m) : name, taken));
        }
    }

    // \param declined  gets the images that cannot be read; these keep their URI.
    Materials finish_materials(std::vector<DeclinedAttribute>& declined) const {
        nlohmann::json kept;
        for (const char* key : {"materials", "textures", "samplers", "extensionsUsed"}) {
            const nlohmann::json& all = gltf_.list(gltf_.root(), key);
            if (!all.empty()) kept[key] = all;
        }
        for (std::size_t m = 0; m < material_names_.size(); ++m) {
            kept["materials"][m]["name"] = material_names_[m];
        }
        Materials result;
        for (std::size_t i = 0; i < gltf_.list(gltf_.root(), "images").size(); ++i) {
            const nlohmann::json& image = gltf_.at("images", i);
            kept["images"].push_back(image);
            try {
                result.images.push_back(gltf_.image(image));
            } catch (const IoError& error) {
                result.images.emplace_back();
                declined.push_back({"image " + std::to_string(i), error.what()});
            }
        }
        result.json = text_of(kept);
        return result;
    }

    MeshAttributes finish_attributes(std::size_t num_vertices) {
        MeshAttributes attributes;
        if (has_normals_) attributes.normals = NumberType::Float32;
        for (const auto& [name, reason] : declined_) attributes.declined.push_back({name, reason});
        std::move(colors_).finish(num_vertices, ElementKind::Vertex, attributes);
        if (!material_names_.empty()) {
            attributes.materials = finish_materials(attributes.declined);
            attributes.of_faces.push_back(std::move(materials_).finish("material"));
        }
        return attributes;
    }

    SourceFile& file_;
    GltfDocument gltf_;
    PolygonSoup soup_;
    std::size_t num_others_ = 0;  // Primitives that are no faces.
    bool has_normals_ = false;
    TextColors colors_;
    std::map<std::string, std::string> declined_;  // Reasons by name.
    std::vector<std::string> material_names_;      // Empty: no face has one.
    FaceLabels materials_;
};

}  // namespace

MeshFile read_gltf(SourceFile file) { return GltfReader(file).read(); }

}  // namespace remesh
