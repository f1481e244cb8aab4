#include "remesh/meshfile/read_vertices.h"

#include "remesh/meshfile/text_scanner.h"

namespace remesh {

std::vector<Index> read_vertices(const std::filesystem::path& path, const MeshView& mesh,
                                 const Progress& progress) {
    Poller poller(progress);
    const SourceFile file = load_file(path, poller);
    Ticker ticker = file.ticker;
    std::vector<bool> is_corner(mesh.positions.size(), false);
    for (const Triangle& t : mesh.triangles) {
        ticker.tick();
        for (const Index v : t) is_corner[v] = true;
    }
    TextScanner scan(file, 0, {.comment = '#'});
    std::vector<Index> vertices;
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
        vertices.push_back(static_cast<Index>(value));
        if (scan.has_word()) scan.fail_expecting("the end of the line");
    }
    if (vertices.empty()) {
        scan.fail_malformed("the file holds no vertex; write lines of one vertex index");
    }
    return vertices;
}

}  // namespace remesh
