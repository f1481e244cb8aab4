// Wavefront OBJ: vertices (v, also with colours) and faces (f), materials, groups and objects;
// every other statement is skipped, and so are texture coordinates and normals of a corner:
// vertices are never split along their seams (format: Wavefront, Advanced Visualizer Manual,
// appendix B1).

#include "remesh/io/formats.h"
#include "remesh/io/obj_attributes.h"
#include "remesh/io/polygon_soup.h"
#include "remesh/io/text_scanner.h"

namespace remesh {
namespace {

// A corner's vertex, from 0: the file counts from 1, or with negative numbers back from the last
// vertex so far. What follows it (/vt, //vn, /vt/vn) must look like that and is not used.
std::int64_t read_corner(TextScanner& scan, const SourceFile& file, std::size_t num_vertices) {
    const std::size_t start = scan.offset();
    const std::int64_t number = scan.integer("a corner (v, v/vt, v//vn or v/vt/vn)", '/');
    const std::size_t slash = scan.offset();
    if (scan.take("/")) {
        if (scan.rest_of_word().find_first_not_of("0123456789-/") != std::string_view::npos) {
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
    return number > 0 ? number - 1 : count + number;
}

}  // namespace

// NOLINTNEXTLINE(performance-unnecessary-value-param): all readers have this type.
MeshFile read_obj(SourceFile file) {
    TextScanner scan(file, 0, {.comment = '#', .continues = true});
    PolygonSoup soup(file, 1);
    ObjAttributes attributes(file.with_attributes);
    while (scan.find_word()) {
        soup.ticker.tick();
        const std::string_view statement = scan.word();
        if (statement == "v") {
            soup.positions.push_back(scan.point());
            if (scan.has_word()) attributes.take_color(soup.positions.size() - 1, scan);
        } else if (statement == "f") {
            while (scan.has_word()) {
                const std::size_t start = scan.offset();
                soup.add_corner(read_corner(scan, file, soup.positions.size()), start);
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
    return result;
}

}  // namespace remesh
