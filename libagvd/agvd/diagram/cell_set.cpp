#include "agvd/diagram/cell_set.h"

#include <algorithm>

namespace agvd {

void CellSet::insert(const CellSet& other) {
    for (Index s = 0; s < has_.size(); ++s) has_[s] |= other.has_[s];
}

void CellSet::insert_those_in(Index face, const ArcStore& arcs) {
    for (const FaceArcs::CellPart& part : arcs.parts()[arcs.of_face(face).parts]) {
        insert(part.site);
    }
}

FaceList::FaceList(const Surface& surface, const EdgeLabels& labels, const ArcStore& arcs,
                   const CellSet& cells) {
    const auto is_reached = [&](Index face) {
        if (labels.mixed_index[face] == no_index) {
            return cells.has(labels.point_site[surface.mesh.triangles[face][0]]);
        }
        const auto parts = arcs.parts()[arcs.of_face(face).parts];
        return std::any_of(parts.begin(), parts.end(),
                           [&](const FaceArcs::CellPart& part) { return cells.has(part.site); });
    };
    for (Index face = 0; face < surface.num_faces(); ++face) {
        if (is_reached(face)) faces_.push_back(face);
    }
    size_ = static_cast<Index>(faces_.size());
}

}  // namespace agvd
