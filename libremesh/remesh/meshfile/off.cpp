// OFF, and COFF, NOFF, STOFF, as text and binary: coordinates, corners, colours and texture
// coordinates; normals are skipped (format: Geomview manual, "OFF Files").
// Of a text each line holds one element, as most writers do it. The corners of a face may go on
// over the next lines, which hold nothing else: otherwise a line that lacks a corner would take one
// from the next face. A file with another layout runs out of lines, which is an error. Colours of
// uchar are written as whole numbers, others lie between 0 and 1.

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/materials.h"
#include "remesh/meshfile/ply_values.h"
#include "remesh/meshfile/polygon_soup.h"

namespace remesh {
namespace {

constexpr const char* face_color = "color";

// What stands behind the coordinates of each vertex: a normal, a colour, texture coordinates.
struct Extras {
    bool texture = false, color = false, normal = false, is_binary = false;
};

Extras read_keyword(TextScanner& scan) {
    if (!scan.find_word()) scan.fail_expecting("the keyword OFF");
    const bool texture = scan.take("ST"), color = scan.take("C"), normal = scan.take("N");
    if (scan.take("4") || scan.take("n")) {
        scan.fail_malformed(
            "4OFF and nOFF hold points that do not have three dimensions; export the file as OFF");
    }
    if (!scan.take("OFF") && !scan.take("off")) {
        scan.fail_expecting("the keyword OFF (or COFF, NOFF, STOFF)");
    }
    const bool is_binary = scan.has_word() && scan.take("BINARY");
    return {texture, color, normal, is_binary};
}

// The counts of vertices and faces. They are big endian, but some programs write the other order:
// that in which the data fit into the file.
PlyHeader binary_counts(const SourceFile& file, std::size_t at) {
    constexpr std::size_t size = 3 * sizeof(std::uint32_t);  // The last one is that of edges.
    if (file.bytes.size() - at >= size) {
        const std::uint64_t left = file.bytes.size() - at - size;
        for (const std::endian order : {std::endian::big, std::endian::little}) {
            const std::uint64_t vertices = load<std::uint32_t>(&file.bytes[at], order);
            const std::uint64_t faces = load<std::uint32_t>(&file.bytes[at + 4], order);
            if (12 * vertices + 8 * faces > left) continue;
            return {.byte_order = order,
                    .elements = {{"vertex", vertices, {}}, {"face", faces, {}}},
                    .size = at + size};
        }
    }
    file.fail_malformed(at,
                        "the file ends before the vertices and faces that it announces; it is "
                        "truncated: export the file again");
}

// The layout is that of a binary PLY: numbers of vertices, then lists of corners, each with a list
// of the parts of a colour, which are skipped.
MeshFile read_binary_off(SourceFile& file, std::size_t at, const Extras& extras) {
    file.is_binary = true;
    at = std::min(at + (file.bytes.compare(at, 2, "\r\n") == 0 ? 2 : 1), file.bytes.size());
    PlyHeader header = binary_counts(file, at);
    const auto add = [&](std::initializer_list<const char*> names) {
        for (const char* name : names) {
            header.elements[0].properties.push_back({name, PlyType::Float32});
        }
    };
    add({"x", "y", "z"});
    if (extras.normal) add({"nx", "ny", "nz"});
    if (extras.color) add({"red", "green", "blue", "alpha"});
    if (extras.texture) add({"s", "t"});
    header.elements[1].properties = {{"vertex_indices", PlyType::Int32, PlyType::Int32},
                                     {face_color, PlyType::Float32, PlyType::Int32}};
    MeshFile result = read_binary_ply(header, file);
    // The list stands there without colours as well.
    std::erase_if(result.attributes.declined, [](const DeclinedAttribute& one) {
        return one.name == std::string("face ") + face_color;
    });
    return result;
}

// The color among the numbers on the rest of a line.
// \param texture  gets the last two; null: there are none.
void take_color(TextScanner& scan, std::size_t index, const Extras& extras, TextColors& colors,
                SoupTexture* texture = nullptr) {
    const TextScanner::Numbers numbers = scan.numbers(9);
    const std::size_t count = numbers.count;
    const std::size_t before = extras.normal ? 3 : 0, after = extras.texture ? 2 : 0;
    if (extras.color && numbers.is_broken) colors.spoil();
    if (extras.color && count > before + after) {
        colors.take(index, std::span(numbers.values).subspan(before, count - before - after));
    }
    if (texture == nullptr) return;
    texture->is_broken =
        texture->is_broken || numbers.is_broken || count < before + after || scan.has_word();
    if (!texture->is_broken) texture->add(numbers.values[count - 2], numbers.values[count - 1]);
}

void find_element(TextScanner& scan, const char* kind, std::uint64_t index, std::uint64_t count) {
    if (scan.find_word()) return;
    scan.fail_malformed(
        "the file ends before ", kind, " ", index, " of ", count,
        "; it is truncated, or has several elements on a line: export the file again");
}

void append_color(std::string& bytes, const std::vector<const Attribute*>& colors, std::size_t i) {
    if (colors.empty()) return;
    if (colors.front()->type != NumberType::UInt8) {
        return append_to_line(bytes, intensities(colors, i));
    }
    std::array<int, 4> color{0, 0, 0, 255};
    for (std::size_t k = 0; k < colors.size(); ++k) {
        color[k] = static_cast<int>(colors[k]->values[i]);
    }
    append_to_line(bytes, color);
}

}  // namespace

// NOLINTNEXTLINE(performance-unnecessary-value-param): all readers have this type.
MeshFile read_off(SourceFile file) {
    TextScanner scan(file, 0, {.comment = '#'});
    const Extras extras = read_keyword(scan);
    if (extras.is_binary) return read_binary_off(file, scan.offset(), extras);
    if (!scan.find_word()) scan.fail_expecting("the number of vertices");
    const std::uint64_t num_vertices = scan.count("the number of vertices");
    const std::uint64_t num_faces = scan.count("the number of faces");
    scan.skip_line();

    PolygonSoup soup(file, 0);
    soup.reserve(num_vertices, num_faces);
    TextColors vertex_colors, face_colors;
    if (file.with_attributes && extras.texture) {
        soup.texture.name = "ST";
        soup.texture.is_of_vertices = true;
    }
    for (std::uint64_t v = 0; v < num_vertices; ++v) {
        find_element(scan, "vertex", v, num_vertices);
        soup.ticker.tick(2);
        soup.positions.push_back(scan.point());
        if (file.with_attributes && (extras.color || extras.texture)) {
            take_color(scan, v, extras, vertex_colors, extras.texture ? &soup.texture : nullptr);
        }
        scan.skip_line();
    }
    for (std::uint64_t f = 0; f < num_faces; ++f) {
        find_element(scan, "face", f, num_faces);
        const std::size_t start = scan.offset();
        const std::int64_t corners = scan.integer("the number of corners");
        if (corners < 0) file.fail_damaged(start, "face ", f, " has a negative number of corners");
        bool goes_on = false;
        for (std::int64_t k = 0; k < corners; ++k) {
            if (!scan.has_word()) goes_on = scan.find_word();
            soup.add_corner(scan.integer("a corner"), start);
        }
        if (goes_on && scan.has_word()) {
            file.fail_malformed(start, "face ", f, " has fewer than ", corners,
                                " corners; correct the line, or export the file again");
        }
        soup.end_polygon();
        if (file.with_attributes && scan.has_word())
            take_color(scan, f, {.color = true}, face_colors);
        scan.skip_line();
    }
    (void)scan.find_word();  // Skips comments: they do not count as a rest.
    const std::string rest = file.judge_rest(scan.offset(), "faces", num_faces);
    MeshFile result = std::move(soup).finish();
    if (file.with_attributes) {
        MeshAttributes attributes;
        if (extras.normal) attributes.normals = NumberType::Float32;
        std::move(vertex_colors).finish(num_vertices, ElementKind::Vertex, attributes);
        std::move(face_colors).finish(num_faces, ElementKind::Face, attributes);
        attach(std::move(attributes), result);
    }
    add_warning(result, rest);
    return result;
}

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
