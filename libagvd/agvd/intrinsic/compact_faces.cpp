#include "agvd/intrinsic/compact_faces.h"

#include "agvd/intrinsic/face_sides.h"

namespace agvd::detail {
namespace {

void move_face(Surface& surface, Index from, Index to) {
    surface.mesh.triangles[to] = surface.mesh.triangles[from];
    for (Index k = 0; k < 3; ++k) {
        const Index old = 3 * from + k, now = 3 * to + k;
        const Index twin = surface.twin[old];  // In a seam the second join is right.
        surface.apex[now] = surface.apex[old];
        surface.twin[old] = no_index;
        join(surface, now, twin, surface.edge[old]);
        Index& outgoing = surface.outgoing[surface.tail(now)];
        if (outgoing == old) outgoing = now;
    }
}

void compact_edges(Surface& surface) {
    std::vector<Index> number(surface.num_edges(), no_index);
    Index count = 0;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (surface.edge_half[e] == no_index) continue;
        number[e] = count;
        surface.edge_half[count] = surface.edge_half[e];
        surface.length[count++] = surface.length[e];
    }
    surface.edge_half.resize(count);
    surface.length.resize(count);
    surface.edge_half.shrink_to_fit();
    surface.length.shrink_to_fit();
    for (Index& e : surface.edge) e = number[e];
}

}  // namespace

void compact_faces(Surface& surface, FaceHistory& history) {
    const auto is_gap = [&](Index f) { return surface.mesh.triangles[f][0] == no_index; };
    Index last = surface.num_faces();
    for (Index f = 0; f < last; ++f) {
        if (!is_gap(f)) continue;
        while (last > f && is_gap(last - 1)) --last;
        if (last <= f + 1) break;
        move_face(surface, --last, f);
        history.move_face(last, f);
    }
    while (last > 0 && is_gap(last - 1)) --last;
    surface.mesh.triangles.resize(last);
    surface.twin.resize(3 * last);
    surface.edge.resize(3 * last);
    surface.apex.resize(3 * last);
    surface.mesh.triangles.shrink_to_fit();
    surface.twin.shrink_to_fit();
    surface.edge.shrink_to_fit();
    surface.apex.shrink_to_fit();
    history.drop_faces_from(last);
    compact_edges(surface);
}

}  // namespace agvd::detail
