#include "remesh/io/read_vertices.h"

#include "remesh/io/text_scanner.h"

namespace remesh {

std::vector<agvd::Index> read_vertices(const std::filesystem::path& path,
                                       const agvd::MeshView& mesh, const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    const SourceFile file = load_file(path, poller);
    agvd::Ticker ticker = file.ticker;
    std::vector<bool> is_corner(mesh.positions.size(), false);
    for (const agvd::Triangle& t : mesh.triangles) {
        ticker.tick();
        for (const agvd::Index v : t) is_corner[v] = true;
    }
    TextScanner scan(file, 0, {.comment = '#'});
    std::vector<agvd::Index> vertices;
    while (scan.find_word()) {
        ticker.tick(16);
        const std::size_t start = scan.offset();
        const std::int64_t value = scan.integer("a vertex index");
        if (value < 0 || static_cast<std::uint64_t>(value) >= is_corner.size()) {
            file.fail_unusable(start, "there is no vertex " + std::to_string(value) +
                                          ": the mesh has " + std::to_string(is_corner.size()) +
                                          " vertices, counted from 0; correct the line");
        }
        if (!is_corner[static_cast<std::size_t>(value)]) {
            file.fail_unusable(start, "vertex " + std::to_string(value) +
                                          " is in no face; use a vertex of a face");
        }
        vertices.push_back(static_cast<agvd::Index>(value));
        if (scan.has_word()) scan.fail_expecting("the end of the line");
    }
    if (vertices.empty()) {
        scan.fail_malformed("the file holds no vertex; write lines of one vertex index");
    }
    return vertices;
}

}  // namespace remesh
