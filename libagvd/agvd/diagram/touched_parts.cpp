#include "agvd/diagram/touched_parts.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/one_ring.h"

namespace agvd {

TouchedParts::TouchedParts(const Surface& surface, std::span<const Index> faces)
    : surface_(surface),
      is_face_touched_(surface.num_faces(), 0),
      is_near_(surface.num_faces(), 0),
      is_vertex_touched_(surface.num_vertices(), 0) {
    for (const Index face : faces) {
        is_face_touched_[face] = 1;
        for (const Index v : surface.mesh.triangles[face]) {
            if (std::exchange(is_vertex_touched_[v], 1) == 0) vertices_.push_back(v);
        }
    }
    for (const Index v : vertices_) {
        for_each_outgoing(surface, v, [&](Index h) {
            const Index face = Surface::face(h);
            if (std::exchange(is_near_[face], 1) == 0) faces_.push_back(face);
        });
    }
    std::sort(faces_.begin(), faces_.end());
}

bool TouchedParts::holds_on_edge(Index half_edge) const {
    if (is_all_) return false;
    const Index twin = surface_.twin[half_edge];
    return is_face_touched_[Surface::face(half_edge)] == 0 &&
           (twin == no_index || is_face_touched_[Surface::face(twin)] == 0) &&
           is_vertex_touched_[surface_.tail(half_edge)] == 0 &&
           is_vertex_touched_[surface_.head(half_edge)] == 0;
}

bool TouchedParts::holds_in_face(Index face) const {
    return holds_on_edge(3 * face) && holds_on_edge(3 * face + 1) && holds_on_edge(3 * face + 2);
}

}  // namespace agvd
