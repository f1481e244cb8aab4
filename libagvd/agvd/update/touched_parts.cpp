#include "agvd/update/touched_parts.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/one_ring.h"

namespace agvd {

TouchedParts::TouchedParts(const Surface& surface, std::span<const Index> faces)
    : surface_(surface),
      is_face_touched_(surface.num_faces(), 0),
      is_near_(surface.num_faces(), 0),
      is_vertex_touched_(surface.num_vertices(), 0),
      edge_states_(surface.num_edges(), EdgeState::Unknown) {
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
    const Index twin = surface_.twin[half_edge];
    return is_face_touched_[Surface::face(half_edge)] == 0 &&
           (twin == no_index || is_face_touched_[Surface::face(twin)] == 0) &&
           is_vertex_touched_[surface_.tail(half_edge)] == 0 &&
           is_vertex_touched_[surface_.head(half_edge)] == 0;
}

bool TouchedParts::holds_on_edges_of(Index face) const {
    return holds_on_edge(3 * face) && holds_on_edge(3 * face + 1) && holds_on_edge(3 * face + 2);
}

// Itself, or one of its corners.
bool TouchedParts::is_touched(Index face) const {
    const Triangle& corners = surface_.mesh.triangles[face];
    return is_face_touched_[face] != 0 || is_vertex_touched_[corners[0]] != 0 ||
           is_vertex_touched_[corners[1]] != 0 || is_vertex_touched_[corners[2]] != 0;
}

bool TouchedParts::holds_in_face(Index face, bool is_local) const {
    if (holds_on_edges_of(face)) return true;
    if (!is_local || is_touched(face)) return false;
    const Index first = 3 * face;
    return edge_states_[surface_.edge[first]] != EdgeState::Other &&
           edge_states_[surface_.edge[first + 1]] != EdgeState::Other &&
           edge_states_[surface_.edge[first + 2]] != EdgeState::Other;
}

}  // namespace agvd
