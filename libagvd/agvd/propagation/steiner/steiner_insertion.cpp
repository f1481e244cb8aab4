#include "agvd/propagation/steiner/steiner_insertion.h"

#include <algorithm>

namespace agvd {

SteinerInsertion::SteinerInsertion(const Surface& surface, int points)
    : surface_(surface),
      points_(surface.num_edges(), static_cast<std::uint16_t>(points)),
      is_marked_(surface.num_edges(), false),
      visited_for_(surface.num_faces(), no_index) {}

void SteinerInsertion::mark_path(const SteinerFront& front, Index vertex) {
    Index h = surface_.outgoing[vertex];
    Index j = 0;
    for (bool is_end = true;; is_end = false) {
        const SteinerNode& node = front.node(h, j);
        if (j == 0 && !is_end) mark_around(surface_.tail(h));
        if (node.from == no_index) return;
        mark_face(Surface::face(node.from));
        if (node.parent_slot == FaceRing::site_slot) return;
        h = FaceRing::half_edge(node.from, node.parent_slot);
        j = FaceRing::number_of(node.parent_slot);
    }
}

void SteinerInsertion::mark_between(std::span<const double> distance, Index vertex) {
    std::vector<Index> waiting{Surface::face(surface_.outgoing[vertex])};
    visited_for_[waiting[0]] = vertex;
    while (!waiting.empty()) {
        const Index face = waiting.back();
        waiting.pop_back();
        if (!may_be_crossed(face, distance, vertex)) continue;
        mark_face(face);
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Index twin = surface_.twin[h];
            if (twin == no_index || visited_for_[Surface::face(twin)] == vertex) continue;
            visited_for_[Surface::face(twin)] = vertex;
            waiting.push_back(Surface::face(twin));
        }
    }
}

// A point x of the path has d(x) + |x - vertex| <= d(vertex), and a corner of its face is nearer to
// x than `reach` times the longest side. Distances in space are used: those of vertices do not
// exceed distances over the surface, even if faces do not lie in space.
bool SteinerInsertion::may_be_crossed(Index face, std::span<const double> distance,
                                      Index vertex) const {
    constexpr double reach = 0.58;  // 1 / sqrt(3), rounded up: an equilateral triangle's middle.
    const std::vector<Vec3>& positions = surface_.mesh.positions;
    double least = std::numeric_limits<double>::infinity();
    double longest = 0;
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const Index corner = surface_.tail(h);
        least = std::min(least, distance[corner] + (positions[corner] - positions[vertex]).norm());
        longest = std::max(longest, surface_.length_of(h));
    }
    return least <= distance[vertex] + 2 * reach * longest;
}

bool SteinerInsertion::insert() {
    bool has_room = false;
    for (Index e = 0; e < points_.size(); ++e) {
        if (!is_marked_[e] || points_[e] == max_steiner_points) continue;
        points_[e] = static_cast<std::uint16_t>(std::min(2 * points_[e] + 1, max_steiner_points));
        has_room = true;
    }
    is_marked_.assign(is_marked_.size(), false);
    visited_for_.assign(visited_for_.size(), no_index);
    return has_room;
}

void SteinerInsertion::mark_face(Index face) {
    for (Index h = 3 * face; h < 3 * face + 3; ++h) is_marked_[surface_.edge[h]] = true;
}

void SteinerInsertion::mark_around(Index vertex) {
    Index h = surface_.outgoing[vertex];
    do {
        const Index previous = Surface::previous(h);
        is_marked_[surface_.edge[h]] = true;
        is_marked_[surface_.edge[previous]] = true;  // The last one on a boundary.
        h = surface_.twin[previous];
    } while (h != no_index && h != surface_.outgoing[vertex]);
}

}  // namespace agvd
