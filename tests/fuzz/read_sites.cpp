// The reader of sites files, for a grid of 18 faces with one vertex that is in none.
#include "remesh/meshfile/diagram_file.h"

#include <cmath>

#include "agvd/core/error.h"
#include "memory_file.h"
#include "support/shapes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    agvd::TriangleMesh mesh = shapes::grid(3);
    mesh.positions.emplace_back(5, 5, 5);
    const fuzz::MemoryFile file(data, size);
    try {
        const auto sites = remesh::read_sites(file.path(), mesh.view()).sites;
        fuzz::require(!sites.empty(), "there is a site");
        for (const auto& [face, b] : sites) {
            fuzz::require(face.value() < mesh.triangles.size(), "faces are in range");
            fuzz::require(b[0] >= 0 && b[1] >= 0 && b[2] >= 0, "no coordinate is negative");
            fuzz::require(std::abs(b[0] + b[1] + b[2] - 1) < 1e-12, "coordinates sum to 1");
        }
    } catch (const agvd::IoError&) {
    } catch (const agvd::InvalidInput&) {
    }
    return 0;
}
