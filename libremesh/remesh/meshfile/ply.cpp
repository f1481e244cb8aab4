// PLY, ascii and both binaries: the coordinates of element "vertex", the corners of element "face",
// and their other properties as attributes, texture coordinates as such; triangle strips. Every
// other element is skipped (format: Greg Turk, "The PLY Polygon File Format", 1994).

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/ply_attributes.h"
#include "remesh/meshfile/ply_strips.h"
#include "remesh/meshfile/ply_texture.h"
#include "remesh/meshfile/polygon_soup.h"

namespace remesh {
namespace {

// The coordinates of vertices, unless faces have some of their own.
std::array<const PlyProperty*, 2> find_texture(const PlyElement& vertices, const PlyHeader& header,
                                               const SourceFile& file, MeshAttributes& attributes) {
    const std::array pair = texture_pair(vertices);
    if (!file.with_attributes || pair[0] == nullptr) return {nullptr, nullptr};
    const auto has_own = [](const PlyElement& element) {
        return element.name == "face" && texture_list(element) != nullptr;
    };
    if (std::none_of(header.elements.begin(), header.elements.end(), has_own)) return pair;
    for (const PlyProperty* one : pair) {
        attributes.declined.push_back(
            {"vertex " + one->name, "the faces have texture coordinates of their own"});
    }
    return {nullptr, nullptr};
}

template <typename Values>
void read_vertices(Values& values, const PlyElement& element, const PlyHeader& header,
                   const SourceFile& file, PolygonSoup& soup, MeshAttributes& attributes) {
    const std::array axes = {element.find("x"), element.find("y"), element.find("z")};
    for (const PlyProperty* axis : axes) {
        if (axis == nullptr || axis->size_type) {
            file.fail_malformed(
                0, "element vertex lacks the numbers x, y and z; export the file again");
        }
    }
    const std::array pair = find_texture(element, header, file, attributes);
    if (pair[0] != nullptr) {
        soup.texture.name = "vertex " + pair[0]->name + ' ' + pair[1]->name;
        soup.texture.type = std::max(pair[0]->type, pair[1]->type);
        soup.texture.is_of_vertices = true;
    }
    // By property: the axis it is, 3 and 4 for the texture coordinates, or 5.
    const std::array used = {axes[0], axes[1], axes[2], pair[0], pair[1]};
    std::vector<Eigen::Index> axis_of;
    for (const PlyProperty& property : element.properties) {
        axis_of.push_back(std::find(used.begin(), used.end(), &property) - used.begin());
    }
    const std::array known = texture_pair(element);  // Those that do not count as well.
    PlyAttributes others(element, ElementKind::Vertex,
                         {axes[0], axes[1], axes[2], known[0], known[1]}, file, attributes);
    for (std::uint64_t v = 0; v < element.count; ++v) {
        soup.ticker.tick(2);
        values.begin(element, v);
        const std::size_t start = values.offset();
        Vec3 p;
        Vec2 coordinates(0, 0);
        for (std::size_t i = 0; i < axis_of.size(); ++i) {
            if (axis_of[i] < 3) {
                p[axis_of[i]] = values.real(element.properties[i].type);
            } else if (axis_of[i] < 5) {
                const std::optional<double> number = values.attribute(element.properties[i].type);
                soup.texture.is_broken = soup.texture.is_broken || !number;
                coordinates[axis_of[i] - 3] = number.value_or(0);
            } else {
                others.take(values, i);
            }
        }
        if (pair[0] != nullptr) soup.texture.add(coordinates.x(), coordinates.y());
        if (!p.allFinite()) {
            file.fail_unusable(start, name_of(element, v) +
                                          " has a coordinate that is not finite; "
                                          "correct or delete the vertex");
        }
        values.end();
        soup.positions.push_back(p);
    }
    std::move(others).finish(attributes);
}

template <typename Values>
void read_faces(Values& values, const PlyElement& element, const SourceFile& file,
                PolygonSoup& soup, MeshAttributes& attributes) {
    const PlyProperty& corners = require_corners(element, file);
    const PlyProperty* const texture = file.with_attributes ? texture_list(element) : nullptr;
    if (texture != nullptr) {
        soup.texture.name = "face " + texture->name;
        soup.texture.type = texture->type;
    }
    PlyAttributes others(element, ElementKind::Face, {&corners, texture}, file, attributes);
    std::vector<double> coordinates;
    for (std::uint64_t f = 0; f < element.count; ++f) {
        values.begin(element, f);
        const std::size_t num_before = soup.num_corners();
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (&property == texture) {
                coordinates = read_texture_list(values, property, file, soup.texture);
                continue;
            }
            if (&property != &corners) {
                others.take(values, i);
                continue;
            }
            for (std::int64_t k = read_length(values, property, file); k > 0; --k) {
                const std::size_t start = values.offset();
                soup.add_corner(values.integer(property.type), start);
            }
            soup.end_polygon();
        }
        if (texture != nullptr) {
            set_texture(coordinates, soup.num_corners() - num_before, soup);
        }
        values.end();
    }
    std::move(others).finish(attributes);
}

// Where strips add triangles, not each face has a value.
void decline_face_values(MeshAttributes& attributes) {
    for (const Attribute& attribute : attributes.of_faces) {
        attributes.declined.push_back(
            {"face " + attribute.name, "the triangles of strips have no such value"});
    }
    attributes.of_faces.clear();
}

// What was passed over may have been read at the wrong place: faces then lack corners, and numbers
// are next to zero.
bool looks_misread(const MeshFile& file) {
    constexpr double least = std::numeric_limits<float>::min();
    return file.dropped_polygons > 0 ||
           std::any_of(file.mesh.positions.begin(), file.mesh.positions.end(), [&](const Vec3& p) {
               return (p.array() != 0 && p.array().abs() < least).any();
           });
}

template <typename Values>
MeshFile read_body(Values values, const PlyHeader& header, const SourceFile& file) {
    PolygonSoup soup(file, 0);
    MeshAttributes attributes;
    bool has_vertices = false, has_faces = false;
    std::uint64_t num_strip_lists = 0;
    std::size_t begin = values.offset();  // Of the last element.
    for (const PlyElement& element : header.elements) {
        begin = values.offset();
        if (element.name == "vertex" && !std::exchange(has_vertices, true)) {
            soup.reserve(element.count, 0);
            read_vertices(values, element, header, file, soup, attributes);
        } else if (element.name == "face" && !std::exchange(has_faces, true)) {
            soup.reserve(0, element.count);
            read_faces(values, element, file, soup, attributes);
        } else if (element.name == "tristrips") {
            num_strip_lists += element.count;
            read_strips(values, element, file, soup);
        } else if (!element.properties.empty()) {
            if (file.with_attributes) {
                attributes.declined.push_back(
                    {"element " + element.name, "only vertices and faces are carried over"});
            }
            for (std::uint64_t i = 0; i < element.count; ++i) {
                soup.ticker.tick(element.properties.size());
                skip_element(values, element, i, file);
            }
        }
    }
    if (num_strip_lists > 0) decline_face_values(attributes);
    MeshFile result = std::move(soup).finish();
    attach(std::move(attributes), result);
    if (header.elements.empty()) return result;
    const PlyElement& last = header.elements.back();
    const std::size_t end = values.offset();
    const std::size_t size = last.count > 0 ? (end - begin) / last.count : 0;  // Of one, the mean.
    const std::uint64_t num_more =
        file.is_binary && size > 0 ? (file.bytes.size() - end) / size : 0;
    const std::string kind = last.name + " elements";
    add_warning(header.warning, result);
    add_warning(values.warning(), result);
    if (file.is_lenient && (!result.warnings.empty() || num_more > 0) && looks_misread(result)) {
        file.fail_malformed(header.size,
                            "the data are not what the header announces, not even leniently: "
                            "faces lack corners, or coordinates are next to zero; export the file "
                            "again");
    }
    add_warning(file.judge_rest(end, kind.c_str(), last.count, num_more), result);
    return result;
}

}  // namespace

MeshFile read_binary_ply(const PlyHeader& header, const SourceFile& file) {
    return read_body(BinaryValues(file, header), header, file);
}

MeshFile read_ply(SourceFile file) {
    const PlyHeader header = read_ply_header(file);
    if (!header.byte_order) return read_body(AsciiValues(file, header), header, file);
    file.is_binary = true;
    return read_binary_ply(header, file);
}

}  // namespace remesh
