#include "agvd/diagram/earlier_parts.h"

#include <algorithm>
#include <array>
#include <utility>

#include "agvd/mesh/one_ring.h"

namespace agvd {

EarlierParts::EarlierParts(const Surface& surface, const DiagramParts& parts,
                           std::span<const Index> changed_faces)
    : surface_(surface),
      parts_(parts),
      is_face_changed_(surface.num_faces(), 0),
      is_vertex_changed_(surface.num_vertices(), 0),
      is_near_(surface.num_faces(), 0) {
    const auto mark_around = [&](Index vertex) {
        for_each_outgoing(surface, vertex, [&](Index h) { is_near_[Surface::face(h)] = 1; });
    };
    const auto mark = [&](Index face) {
        is_face_changed_[face] = 1;
        for (const Index v : surface.mesh.triangles[face]) {
            if (std::exchange(is_vertex_changed_[v], 1) == 0) mark_around(v);
        }
    };
    for (const Index face : changed_faces) mark(face);
    for (const Index face : parts.mended_faces) mark(face);
}

void EarlierParts::settle_vertices(EdgeLabels& labels, std::vector<std::uint8_t>& is_fixed) const {
    for (Index v = 0; v < surface_.num_vertices(); ++v) {
        if (is_vertex_changed_[v] != 0) continue;
        labels.point_site[v] = parts_.vertex_site[v];
        labels.vertex_distance[v] = parts_.labels.vertex_distance[v];
        is_fixed[v] = 1;
    }
}

void EarlierParts::compare_vertices(const EdgeLabels& labels) {
    for (Index v = 0; v < surface_.num_vertices(); ++v) {
        if (is_vertex_changed_[v] == 0) continue;
        const bool is_same = labels.point_site[v] == parts_.vertex_site[v] &&
                             labels.vertex_distance[v] == parts_.labels.vertex_distance[v];
        is_vertex_changed_[v] = is_same ? 0 : 1;
    }
}

bool EarlierParts::holds_on_edge(Index half_edge) const {
    if (!is_near_change(Surface::face(half_edge))) return true;
    const Index twin = surface_.twin[half_edge];
    return is_face_changed_[Surface::face(half_edge)] == 0 &&
           (twin == no_index || is_face_changed_[Surface::face(twin)] == 0) &&
           is_vertex_changed_[surface_.tail(half_edge)] == 0 &&
           is_vertex_changed_[surface_.head(half_edge)] == 0;
}

bool EarlierParts::holds_in_face(Index face) const {
    if (!is_near_change(face)) return true;
    return holds_on_edge(3 * face) && holds_on_edge(3 * face + 1) && holds_on_edge(3 * face + 2);
}

bool EarlierParts::is_cut(Index face) const {
    const Index mixed = parts_.labels.mixed_index[face];
    return std::binary_search(
        parts_.labels.cut_faces.begin(), parts_.labels.cut_faces.end(), CutFace{mixed, 0, 0},
        [](const CutFace& a, const CutFace& b) { return a.mixed_index < b.mixed_index; });
}

void EarlierParts::append_arcs(Index face, const EdgeLabels& labels, FaceArcs& out) const {
    const Index mixed = parts_.labels.mixed_index[face];
    const FaceArcs& from = parts_.chunks[mixed / DiagramParts::grain];
    const FaceArcs::Mark begin = from.faces[mixed % DiagramParts::grain];
    const FaceArcs::Mark end = mixed % DiagramParts::grain + 1 < from.faces.size()
                                   ? from.faces[mixed % DiagramParts::grain + 1]
                                   : from.mark();
    const FaceArcs::Mark to = out.mark();

    // The same crossing by its new name.
    struct Renamed {
        Index old_begin = 0, count = 0;
        Index begin = 0;
    };
    std::array<Renamed, 3> rows;
    for (std::size_t k = 0; k < 3; ++k) {
        const Index edge = surface_.edge[3 * face + k];
        const Index row = parts_.labels.edge_row[edge];
        if (row == no_index) continue;
        const CrossingRow& old = parts_.labels.rows[row];
        if (old.count == 0) continue;
        rows[k] = {old.begin, old.count, labels.rows[labels.edge_row[edge]].begin};
    }
    const auto crossing = [&](Index old) {
        for (const Renamed& row : rows) {
            const Index place = old - row.old_begin;  // Large if before it.
            if (place < row.count) return row.begin + place;
        }
        return no_index;
    };
    const auto node = [&](Index old) {
        return old < LocalDiagram::first_branch ? crossing(old)
                                                : old - begin.branches + to.branches;
    };
    const auto old_points = static_cast<Index>(parts_.labels.point_site.size());
    const auto new_points = static_cast<Index>(labels.point_site.size());
    const auto interval = [&](Index old) {
        return old < surface_.num_vertices() ? old : new_points + crossing(old - old_points);
    };

    const LocalDiagram& local = from.local;
    LocalDiagram& result = out.local;
    const auto append = [](const auto& source, Index first, Index last, auto& target) {
        target.insert(target.end(), source.begin() + first, source.begin() + last);
    };
    append(local.points, begin.points, end.points, result.points);
    append(local.point_distance, begin.points, end.points, result.point_distance);
    append(from.parts, begin.parts, end.parts, out.parts);
    for (Index i = begin.arcs; i < end.arcs; ++i) {
        LocalArc arc = local.arcs[i];
        arc.tail = node(arc.tail);
        arc.head = node(arc.head);
        arc.first_point = arc.first_point - begin.points + to.points;
        result.arcs.push_back(arc);
    }
    for (Index i = begin.branches; i < end.branches; ++i) {
        LocalBranch branch = local.branches[i];
        for (Index& arc : branch.arcs) arc = arc - begin.arcs + to.arcs;
        result.branches.push_back(branch);
    }
    for (Index i = begin.connections; i < end.connections; ++i) {
        const Connection& c = local.connections[i];
        result.connections.push_back({interval(c.a), interval(c.b), c.site});
    }
}

}  // namespace agvd
