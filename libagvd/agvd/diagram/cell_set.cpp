#include "agvd/diagram/cell_set.h"

#include <algorithm>
#include <utility>

namespace agvd {

std::vector<Index> faces_of_cells(const Surface& surface, const EdgeLabels& labels,
                                  const ArcStore& arcs, const CellSet& cells,
                                  std::span<const Index> seeds) {
    const auto is_reached = [&](Index face) {
        if (labels.mixed_index[face] == no_index) {
            return cells.has(labels.point_site[surface.mesh.triangles[face][0]]);
        }
        const auto parts = arcs.parts()[arcs.of_face(face).parts];
        return std::any_of(parts.begin(), parts.end(),
                           [&](const FaceArcs::CellPart& part) { return cells.has(part.site); });
    };
    std::vector<Index> faces;
    std::vector<std::uint8_t> is_seen(surface.num_faces(), 0);
    const auto visit = [&](Index face) {
        if (std::exchange(is_seen[face], 1) == 0 && is_reached(face)) faces.push_back(face);
    };
    for (const Index face : seeds) visit(face);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        for (Index h = 3 * faces[i]; h < 3 * faces[i] + 3; ++h) {
            if (surface.twin[h] != no_index) visit(Surface::face(surface.twin[h]));
        }
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

}  // namespace agvd
