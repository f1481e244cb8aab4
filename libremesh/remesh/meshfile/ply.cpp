// PLY, ascii and both binaries: the coordinates of element "vertex", the corners of element "face",
// texture coordinates (a pair of numbers of each vertex, or a list of each face with a pair for
// each corner, as MeshLab writes it), and the other properties as attributes; triangle strips
// (lists of vertices, where -1 ends a strip). Other elements are skipped (format: Greg Turk, "The
// PLY Polygon File Format", 1994). Written are coordinates in double, and texture coordinates as
// lists of faces.

#include <utility>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/ply_values.h"
#include "remesh/meshfile/polygon_soup.h"

namespace remesh {
namespace {

bool is_normal(const std::string& name) { return name == "nx" || name == "ny" || name == "nz"; }

// Why a property is not carried over; null: it is. Normals are computed anew, and other lists have
// no single value.
const char* reason_against(const PlyProperty& property, const PlyElement& element,
                           ElementKind kind) {
    if (property.size_type) return "lists are not carried over";
    if (kind == ElementKind::Face && is_normal(property.name)) {
        return "normals of faces are not carried over";
    }
    return element.find(property.name) == &property ? nullptr
                                                    : "another property has the same name";
}

// Takes the values of an element's other properties, one element after the other.
class PlyAttributes {
public:
    // Decides which properties are carried over. Those that are not are listed in `attributes`,
    // with the reason, and so is the type of normals.
    // \param used  properties that the reader needs itself.
    // \param file  without with_attributes nothing is carried over.
    PlyAttributes(const PlyElement& element, ElementKind kind,
                  const std::vector<const PlyProperty*>& used, const SourceFile& file,
                  MeshAttributes& attributes)
        : element_(element),
          kind_(kind),
          file_(file),
          column_(element.properties.size(), no_column) {
        if (!file.with_attributes) return;
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (std::find(used.begin(), used.end(), &property) != used.end()) continue;
            if (const char* const reason = reason_against(property, element, kind)) {
                attributes.declined.push_back({element.name + " " + property.name, reason});
            } else if (kind == ElementKind::Vertex && is_normal(property.name)) {
                attributes.normals = property.type;
            } else {
                column_[i] = columns_.size();
                columns_.push_back({{.name = property.name, .type = property.type}});
            }
        }
        // No value takes less than a byte, so that memory follows the bytes that are there.
        const std::uint64_t most = file.bytes.size() / std::max<std::size_t>(1, column_.size());
        for (Column& column : columns_) {
            column.attribute.values.reserve(std::min(element.count, most));
        }
    }

    // Reads or skips a value.
    // \param property  index in the element; none of those that are used.
    template <typename Values>
    void take(Values& values, std::size_t property) {
        const PlyProperty& type = element_.properties[property];
        if (column_[property] == no_column) {
            skip_property(values, type, file_);
            return;
        }
        const std::optional<double> value = values.attribute(type.type);
        Column& column = columns_[column_[property]];
        column.is_broken = column.is_broken || !value;
        column.attribute.values.push_back(value.value_or(0));
    }

    // Moves the attributes to `attributes`; those that hold other words than numbers are declined.
    void finish(MeshAttributes& attributes) && {
        auto& target = kind_ == ElementKind::Vertex ? attributes.of_vertices : attributes.of_faces;
        for (Column& column : columns_) {
            if (column.is_broken) {
                attributes.declined.push_back({element_.name + " " + column.attribute.name,
                                               "some of its values are not of its type"});
            } else {
                target.push_back(std::move(column.attribute));
            }
        }
    }

private:
    static constexpr std::size_t no_column = ~std::size_t{0};
    struct Column {
        Attribute attribute;
        bool is_broken = false;
    };

    const PlyElement& element_;
    ElementKind kind_;
    const SourceFile& file_;
    std::vector<std::size_t> column_;  // By property: index into columns_.
    std::vector<Column> columns_;
};

template <typename Values>
void read_strips(Values& values, const PlyElement& element, const SourceFile& file,
                 PolygonSoup& soup) {
    const PlyProperty& corners = require_corners(element, file);
    for (std::uint64_t i = 0; i < element.count; ++i) {
        values.begin(element, i);
        for (const PlyProperty& property : element.properties) {
            if (&property != &corners) {
                skip_property(values, property, file);
                continue;
            }
            StripTriangles strip(soup);
            for (std::int64_t k = read_length(values, property, file); k > 0; --k) {
                const std::size_t start = values.offset();
                const std::int64_t vertex = values.integer(property.type);
                soup.ticker.tick();
                vertex == -1 ? strip.end() : strip.add(vertex, start);
            }
            strip.end();
        }
        values.end();
    }
}

// The two numbers of an element that are texture coordinates; null: it has none. One name of a
// pair alone is an ordinary property.
std::array<const PlyProperty*, 2> texture_pair(const PlyElement& element) {
    constexpr std::array<std::array<const char*, 2>, 4> names = {
        {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}};
    const auto is_real = [](const PlyProperty* property) {
        return property != nullptr && !property->size_type && !is_integer(property->type);
    };
    for (const auto& [u, v] : names) {
        const std::array pair = {element.find(u), element.find(v)};
        if (is_real(pair[0]) && is_real(pair[1])) return pair;
    }
    return {nullptr, nullptr};
}

// The list of an element's corners that are texture coordinates, or nullptr.
const PlyProperty* texture_list(const PlyElement& element) {
    const PlyProperty* const list = element.find(TextureCoordinates::name);
    return list != nullptr && list->size_type && !is_integer(list->type) ? list : nullptr;
}

// Gives the last corners so far their coordinates, two numbers each; an empty list is none.
void set_texture(std::span<const double> numbers, std::size_t num_corners, PolygonSoup& soup) {
    SoupTexture& texture = soup.texture;
    if (numbers.empty()) return;
    if (numbers.size() != 2 * num_corners) {
        texture.is_broken = true;
        return;
    }
    for (std::size_t k = 0; k < num_corners; ++k) {
        texture.add(numbers[2 * k], numbers[2 * k + 1]);
        texture.set_corner(soup.num_corners() - num_corners + k + 1,
                           static_cast<Index>(texture.values.size() - 1));
    }
}

// The coordinates of vertices, unless faces have some of their own.
std::array<const PlyProperty*, 2> find_texture(const PlyElement& vertices, const PlyHeader& header,
                                               const SourceFile& file, MeshAttributes& attributes) {
    const std::array pair = texture_pair(vertices);
    if (!file.with_attributes || pair[0] == nullptr) return {nullptr, nullptr};
    const auto has_own = [](const PlyElement& element) {
        return element.name == "face" && texture_list(element) != nullptr;
    };
    if (std::ranges::none_of(header.elements, has_own)) return pair;
    for (const PlyProperty* one : pair) {
        attributes.declined.push_back(
            {"vertex " + one->name, "the faces have texture coordinates of their own"});
    }
    return {nullptr, nullptr};
}

template <typename Values>
double read_coordinate(Values& values, NumberType type, SoupTexture& texture) {
    const std::optional<double> number = values.attribute(type);
    texture.is_broken = texture.is_broken || !number;
    return number.value_or(0);
}

template <typename Values>
void read_vertices(Values& values, const PlyElement& element, const PlyHeader& header,
                   const SourceFile& file, PolygonSoup& soup, MeshAttributes& attributes) {
    const std::array axes = {element.find("x"), element.find("y"), element.find("z")};
    for (const PlyProperty* axis : axes) {
        if (axis == nullptr || axis->size_type) {
            file.fail_damaged(0, "element vertex lacks the numbers x, y and z");
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
    const std::array known = texture_pair(element);  // No attributes, also where they do not count.
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
                coordinates[axis_of[i] - 3] =
                    read_coordinate(values, element.properties[i].type, soup.texture);
            } else {
                others.take(values, i);
            }
        }
        if (pair[0] != nullptr) soup.texture.add(coordinates.x(), coordinates.y());
        if (!p.allFinite()) {
            file.fail_unusable(
                start, name_of(element, v),
                " has a coordinate that is not finite; correct or delete the vertex");
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
    std::vector<double> coordinates;  // Of a face: they may stand before the corners.
    for (std::uint64_t f = 0; f < element.count; ++f) {
        values.begin(element, f);
        const std::size_t num_before = soup.num_corners();
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (&property == texture) {
                coordinates.clear();
                for (std::int64_t k = read_length(values, property, file); k > 0; --k) {
                    coordinates.push_back(read_coordinate(values, property.type, soup.texture));
                }
            } else if (&property == &corners) {
                for (std::int64_t k = read_length(values, property, file); k > 0; --k) {
                    const std::size_t start = values.offset();
                    soup.add_corner(values.integer(property.type), start);
                }
                soup.end_polygon();
            } else {
                others.take(values, i);
            }
        }
        if (texture != nullptr) {
            set_texture(coordinates, soup.num_corners() - num_before, soup);
        }
        values.end();
    }
    std::move(others).finish(attributes);
}

// What was skipped may have been read at the wrong place: faces then lack corners, and numbers
// are next to zero.
bool looks_misread(const MeshFile& file) {
    constexpr double least = std::numeric_limits<float>::min();
    return file.dropped_polygons > 0 ||
           std::ranges::any_of(file.mesh.positions, [&](const Vec3& p) {
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
    if (num_strip_lists > 0) {
        for (const Attribute& attribute : std::exchange(attributes.of_faces, {})) {
            attributes.declined.push_back(
                {"face " + attribute.name, "the triangles of strips have no such value"});
        }
    }
    MeshFile result = std::move(soup).finish();
    attach(std::move(attributes), result);
    if (header.elements.empty()) return result;
    const PlyElement& last = header.elements.back();
    const std::size_t end = values.offset();
    const std::size_t size = last.count > 0 ? (end - begin) / last.count : 0;  // Of one, the mean.
    const std::uint64_t num_more =
        file.is_binary && size > 0 ? (file.bytes.size() - end) / size : 0;
    const std::string kind = last.name + " elements";
    add_warning(result, header.warning);
    add_warning(result, values.warning());
    if (file.is_lenient && (!result.warnings.empty() || num_more > 0) && looks_misread(result)) {
        file.fail_damaged(header.size,
                          "the data are not what the header announces, not even leniently: faces "
                          "lack corners, or coordinates are next to zero");
    }
    add_warning(result, file.judge_rest(end, kind.c_str(), last.count, num_more));
    return result;
}

NumberType stored_type(const Attribute& attribute) {
    return attribute.is_intensity ? NumberType::UInt8 : attribute.type;
}

std::string property_of(NumberType type, const std::string& name) {
    return joined("property ", name_of(type), " ", name, "\n");
}

std::string properties_of(const std::vector<Attribute>& attributes) {
    std::string text;
    for (const Attribute& one : attributes) text += property_of(stored_type(one), one.name);
    return text;
}

// What the labels are called: "comment material 0 brass".
std::string label_comments(const MeshAttributes& attributes) {
    std::string text;
    for (const Attribute& attribute : attributes.of_faces) {
        for (std::size_t i = 0; i < attribute.names.size(); ++i) {
            if (attribute.names[i].empty()) continue;
            text += joined("comment ", attribute.name, " ", i, " ", attribute.names[i], "\n");
        }
    }
    return text;
}

NumberType stored_type(const TextureCoordinates& texture) {
    return texture.type == NumberType::Float64 ? NumberType::Float64 : NumberType::Float32;
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

MeshFile read_binary_ply(const PlyHeader& header, const SourceFile& file) {
    return read_body(BinaryValues(file, header), header, file);
}

MeshFile read_ply(SourceFile file) {
    const PlyHeader header = read_ply_header(file);
    if (!header.byte_order) return read_body(AsciiValues(file, header), header, file);
    file.is_binary = true;
    return read_binary_ply(header, file);
}

std::string ply_as_text(std::string bytes) {
    const SourceFile file{.path = "PLY", .bytes = std::move(bytes), .is_binary = true};
    const PlyHeader header = read_ply_header(file);
    std::string text = file.bytes.substr(0, header.size);
    const std::size_t format = text.find("binary_"), end = text.find("_endian", format);
    if (!header.byte_order || end == std::string::npos) return file.bytes;
    text.replace(format, end + std::string_view("_endian").size() - format, "ascii");
    BinaryValues values(file, header);
    const auto add = [&](NumberType type) {
        if (is_integer(type)) {
            append_shortest(text, values.integer(type));
        } else if (type == NumberType::Float32) {
            append_shortest(text, static_cast<float>(values.real(type)));
        } else {
            append_shortest(text, values.real(type));
        }
        text += ' ';
    };
    for (const PlyElement& element : header.elements) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            values.begin(element, i);
            for (const PlyProperty& property : element.properties) {
                std::int64_t count = 1;
                if (property.size_type) {
                    count = read_length(values, property, file);
                    append_shortest(text, count);
                    text += ' ';
                }
                while (count-- > 0) add(property.type);
            }
            if (!element.properties.empty()) text.back() = '\n';
        }
    }
    return text;
}

std::string format_ply(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    // "int" is what every reader knows; it does for all but the largest meshes.
    const char* const index_type = mesh.positions.size() <= INT32_MAX ? "int" : "uint";
    std::string bytes = joined("ply\nformat binary_little_endian 1.0\n", label_comments(attributes),
                               "element vertex ", mesh.positions.size(),
                               "\nproperty double x\nproperty double y\nproperty double z\n");
    for (const char* name : {"nx", "ny", "nz"}) {
        if (attributes.normals) bytes += property_of(*attributes.normals, name);
    }
    bytes += joined(properties_of(attributes.of_vertices), "element face ", mesh.triangles.size(),
                    "\nproperty list uchar ", index_type, " vertex_indices\n");
    if (!attributes.texture.empty()) {
        bytes += joined("property list uchar ", name_of(stored_type(attributes.texture)), " ",
                        TextureCoordinates::name, "\n");
    }
    bytes += properties_of(attributes.of_faces) + "end_header\n";
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
