// The reader of files that name edges.
#include "remesh/meshfile/diagram_file.h"

#include "agvd/core/error.h"
#include "memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::MemoryFile file(data, size);
    try {
        const auto edges = remesh::read_edges(file.path());
        fuzz::require(!edges.empty(), "there is an edge");
        for (const auto& [a, b] : edges) {
            fuzz::require(a != agvd::no_index && b != agvd::no_index, "vertices are numbers");
        }
    } catch (const agvd::IoError&) {
    } catch (const agvd::InvalidInput&) {
    }
    return 0;
}
