#include "agvd/mesh/cut_surface.h"

#include <numeric>
#include <string>
#include <utility>

#include "agvd/core/error.h"

namespace agvd {
namespace {

// Whether the surface goes on across a half-edge.
bool goes_on(const Surface& surface, std::span<const std::uint8_t> is_cut, Index half_edge) {
    return surface.twin[half_edge] != no_index && is_cut[surface.edge[half_edge]] == 0;
}

}  // namespace

OpenedSurface cut_along(const Surface& surface, std::span<const std::uint8_t> is_cut,
                        int num_threads, const Progress& progress) {
    if (is_cut.size() != surface.num_edges()) {
        throw InvalidOption("there are " + std::to_string(is_cut.size()) + " marks for " +
                            std::to_string(surface.num_edges()) +
                            " edges; give one for each edge of the surface");
    }
    std::vector<Index> original(surface.num_vertices());
    std::iota(original.begin(), original.end(), Index{0});
    TriangleMesh mesh = surface.mesh;
    Connectivity connectivity{surface.twin, surface.outgoing};
    for (Index h = 0; h < connectivity.twin.size(); ++h) {
        if (is_cut[surface.edge[h]] != 0) connectivity.twin[h] = no_index;
    }
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        std::vector<Index> firsts;  // The first half-edge of each wedge.
        for_each_outgoing(surface, v, [&](Index h) {
            if (!goes_on(surface, is_cut, h)) firsts.push_back(h);
        });
        for (std::size_t i = 0; i < firsts.size(); ++i) {
            Index copy = v;
            if (i > 0) {
                copy = static_cast<Index>(mesh.positions.size());
                mesh.positions.push_back(mesh.positions[v]);
                connectivity.outgoing.push_back(no_index);
                original.push_back(v);
            }
            connectivity.outgoing[copy] = firsts[i];
            for (Index h = firsts[i];; h = surface.twin[Surface::previous(h)]) {
                mesh.triangles[Surface::face(h)][h % 3] = copy;
                if (!goes_on(surface, is_cut, Surface::previous(h))) break;
            }
        }
    }
    std::vector<double> side_length;
    if (surface.has_own_lengths) {
        for (Index h = 0; h < surface.twin.size(); ++h) side_length.push_back(surface.length_of(h));
    }
    return {
        build_surface(std::move(mesh), std::move(connectivity), side_length, num_threads, progress),
        std::move(original)};
}

}  // namespace agvd
