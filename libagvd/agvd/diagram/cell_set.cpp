#include "agvd/diagram/cell_set.h"

#include <algorithm>
#include <utility>

namespace agvd {

bool CellSet::insert(const CellSet& other) {
    bool has_new = false;
    for (Index s = 0; s < has_.size(); ++s) {
        has_new = has_new || has_[s] < other.has_[s];
        has_[s] |= other.has_[s];
    }
    return has_new;
}

void CellSet::insert_those_in(Index face, const ArcStore& arcs) {
    for (const FaceArcs::CellPart& part : arcs.parts()[arcs.of_face(face).parts]) {
        insert(part.site);
    }
}

FaceList::FaceList(const Surface& surface, const EdgeLabels& labels, const ArcStore& arcs,
                   const CellSet& cells, std::span<const Index> seeds) {
    const auto is_reached = [&](Index face) {
        if (labels.mixed_index[face] == no_index) {
            return cells.has(labels.point_site[surface.mesh.triangles[face][0]]);
        }
        const auto parts = arcs.parts()[arcs.of_face(face).parts];
        return std::any_of(parts.begin(), parts.end(),
                           [&](const FaceArcs::CellPart& part) { return cells.has(part.site); });
    };
    std::vector<std::uint8_t> is_seen(surface.num_faces(), 0);
    const auto visit = [&](Index face) {
        if (std::exchange(is_seen[face], 1) == 0 && is_reached(face)) faces_.push_back(face);
    };
    for (const Index face : seeds) visit(face);
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        for (Index h = 3 * faces_[i]; h < 3 * faces_[i] + 3; ++h) {
            if (surface.twin[h] != no_index) visit(Surface::face(surface.twin[h]));
        }
    }
    std::sort(faces_.begin(), faces_.end());
    size_ = static_cast<Index>(faces_.size());
}

}  // namespace agvd
