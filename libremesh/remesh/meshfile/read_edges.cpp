#include "remesh/meshfile/read_edges.h"

#include "remesh/meshfile/text_scanner.h"

namespace remesh {

std::vector<std::array<Index, 2>> read_edges(const std::filesystem::path& path,
                                             const Progress& progress) {
    Poller poller(progress);
    const SourceFile file = load_file(path, poller);
    TextScanner scan(file, 0, {.comment = '#'});
    const auto vertex = [&] {
        const std::size_t start = scan.offset();
        const std::int64_t value = scan.integer("a vertex index");
        if (value < 0 || value >= no_index) {
            file.fail_malformed(start, "the vertex index " + std::to_string(value) +
                                           " is out of range; count vertices from 0");
        }
        return static_cast<Index>(value);
    };
    std::vector<std::array<Index, 2>> edges;
    while (scan.find_word()) {
        const Index first = vertex();
        edges.push_back({first, vertex()});
        if (scan.has_word()) scan.fail_expecting("the end of the line");
    }
    if (edges.empty()) {
        scan.fail_malformed("the file holds no edge; write lines of two vertex indices");
    }
    return edges;
}

}  // namespace remesh
