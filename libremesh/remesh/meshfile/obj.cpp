// Wavefront OBJ: vertices (v, also with colours) and faces (f), materials, groups and objects;
// texture coordinates of corners (vt); every other statement is skipped, and so are normals of a
// corner: vertices are never split along their seams (format: Wavefront, Advanced Visualizer
// Manual, appendix B1).

#include <algorithm>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/obj_attributes.h"
#include "remesh/meshfile/polygon_soup.h"
#include "remesh/meshfile/text_scanner.h"

namespace remesh {
namespace {

struct ObjCorner {
    std::int64_t vertex;         // From 0.
    std::string_view rest = {};  // What follows it: vt, /vn or vt/vn.
};

// The file counts from 1, or with negative numbers back from the last vertex so far. What follows
// (/vt, //vn, /vt/vn) must look like that.
ObjCorner read_corner(TextScanner& scan, const SourceFile& file, std::size_t num_vertices) {
    ObjCorner corner{};
    const std::size_t start = scan.offset();
    const std::int64_t number = scan.integer("a corner (v, v/vt, v//vn or v/vt/vn)", '/');
    const std::size_t slash = scan.offset();
    if (scan.take("/")) {
        corner.rest = scan.rest_of_word();
        if (corner.rest.find_first_not_of("0123456789-/") != std::string_view::npos) {
            file.fail_malformed(slash,
                                "expected texture and normal numbers after a corner's '/'; "
                                "correct the line, or export the file again");
        }
    }
    const auto count = static_cast<std::int64_t>(num_vertices);
    if (number == 0 || number < -count) {
        file.fail_unusable(start, "a face names vertex " + std::to_string(number) +
                                      (number == 0 ? ", but OBJ counts vertices from 1"
                                                   : ", but only " + std::to_string(count) +
                                                         " vertices come before it") +
                                      "; correct the face, or export the file again");
    }
    corner.vertex = number > 0 ? number - 1 : count + number;
    return corner;
}

// Flat drawings have two coordinates: 2 or 3, as the vertex that comes next has.
int count_coordinates(TextScanner& scan) {
    const std::size_t start = scan.offset();
    int count = 0;
    while (count < 3 && !scan.word().empty()) ++count;
    scan.go_to(start);
    return std::max(count, 2);
}

// The texture coordinates of the last corner so far. Those that do not exist are found at the end.
void take_coordinates(std::string_view rest, PolygonSoup& soup) {
    rest = rest.substr(0, rest.find('/'));
    if (rest.empty()) return;
    std::int64_t number = 0;
    const auto [last, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    SoupTexture& texture = soup.texture;
    if (number < 0) number += static_cast<std::int64_t>(texture.values.size()) + 1;
    if (error != std::errc{} || last != rest.data() + rest.size() || number < 1 ||
        number > no_index) {
        texture.is_broken = true;
        return;
    }
    texture.set_corner(soup.num_corners(), static_cast<Index>(number - 1));
}

}  // namespace

// NOLINTNEXTLINE(performance-unnecessary-value-param): all readers have this type.
MeshFile read_obj(SourceFile file) {
    TextScanner scan(file, 0, {.comment = '#', .continues = true});
    PolygonSoup soup(file, 1);
    ObjAttributes attributes(file.with_attributes);
    int num_coordinates = 3;
    while (scan.find_word()) {
        soup.ticker.tick();
        const std::string_view statement = scan.word();
        if (statement == "v") {
            if (soup.positions.empty()) num_coordinates = count_coordinates(scan);
            soup.positions.push_back(scan.point(num_coordinates));
            if (num_coordinates == 2 && scan.has_word()) {
                scan.fail_expecting("the end of the line, as vertices before have two coordinates");
            }
            if (scan.has_word()) attributes.take_color(soup.positions.size() - 1, scan);
        } else if (statement == "vt") {
            attributes.take_texture(scan, soup.texture);
        } else if (statement == "f") {
            while (scan.has_word()) {
                const std::size_t start = scan.offset();
                const ObjCorner corner = read_corner(scan, file, soup.positions.size());
                soup.add_corner(corner.vertex, start);
                if (attributes.is_wanted()) take_coordinates(corner.rest, soup);
            }
            soup.end_polygon();
        } else {
            attributes.take(statement, soup.num_polygons(), scan);
        }
        scan.skip_line();
    }
    const std::size_t num_vertices = soup.positions.size(), num_polygons = soup.num_polygons();
    MeshFile result = std::move(soup).finish();
    attach(std::move(attributes).finish(num_vertices, num_polygons), result);
    if (num_coordinates == 2) {
        add_warning(file.path.string() + ": the vertices have two coordinates; z = 0 is taken",
                    result);
    }
    return result;
}

}  // namespace remesh
