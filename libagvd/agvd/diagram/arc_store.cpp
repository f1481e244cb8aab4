#include "agvd/diagram/arc_store.h"

#include <utility>

namespace agvd {

void ArcStore::reserve_for(double times) {
    constexpr double spare = 1.1;
    const auto reserve = [&](auto& elements) {
        const auto size = static_cast<double>(elements.size());
        elements.reserve(static_cast<std::size_t>(spare * times * size));
    };
    reserve(faces_);
    reserve(arcs_);
    reserve(voronoi_vertices_);
    reserve(vertex_places_);
    reserve(points_);
    reserve(connections_);
    reserve(parts_);
}

void ArcStore::add(std::span<const Index> faces, const FaceArcs& chunk, Index first) {
    const auto mark = [&](Index i) {
        return i < chunk.faces.size() ? chunk.faces[i] : chunk.mark();
    };
    const FaceArcs::Mark begin = mark(first);
    const FaceArcs::Mark end = mark(first + static_cast<Index>(faces.size()));
    const LocalDiagram& local = chunk.local;
    const auto part = [](const auto& elements, Index from, Index to) {
        return std::span(elements).subspan(from, to - from);
    };
    new_points_.clear();
    for (Index p = begin.points; p < end.points; ++p) {
        new_points_.push_back({local.points[p], local.point_distance[p]});
    }
    Face all;
    all.points = points_.add(new_points_);
    all.connections = connections_.add(part(local.connections, begin.connections, end.connections));
    all.parts = parts_.add(part(chunk.parts, begin.parts, end.parts));
    all.arcs = arcs_.add(part(local.arcs, begin.arcs, end.arcs));
    new_voronoi_vertices_.clear();
    new_vertex_places_.clear();
    for (const LocalVoronoiVertex& voronoi_vertex :
         part(local.voronoi_vertices, begin.voronoi_vertices, end.voronoi_vertices)) {
        VoronoiVertex& added = new_voronoi_vertices_.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const Index arc = voronoi_vertex.arcs[k] - begin.arcs + all.arcs.begin;
            added.ends[k] = voronoi_vertex.at_tail[k] ? ArcEnd::tail_of(arc) : ArcEnd::head_of(arc);
        }
        added.sites = voronoi_vertex.sites;
        new_vertex_places_.push_back(
            {to_surface(*surface_, voronoi_vertex.face, voronoi_vertex.position),
             voronoi_vertex.distance});
    }
    all.voronoi_vertices = voronoi_vertices_.add(new_voronoi_vertices_);
    (void)vertex_places_.add(new_vertex_places_);

    const auto rename = [&](NodeId& node) {
        if (!node.is_voronoi_vertex()) return;
        node = NodeId::of_voronoi_vertex(node.voronoi_vertex() - begin.voronoi_vertices +
                                         all.voronoi_vertices.begin);
    };
    for (LocalArc& arc : arcs_[all.arcs]) {
        rename(arc.tail);
        rename(arc.head);
        arc.first_point += all.points.begin - begin.points;
    }
    FaceArcs::Mark from = begin;
    for (Index i = 0; i < faces.size(); ++i) {
        const FaceArcs::Mark to = mark(first + i + 1);
        const auto block = [&](const Block& of_all, Index FaceArcs::Mark::*place) {
            return Block{of_all.begin + from.*place - begin.*place, to.*place - from.*place};
        };
        faces_[take_slot(faces[i])] = {
            block(all.arcs, &FaceArcs::Mark::arcs),
            block(all.voronoi_vertices, &FaceArcs::Mark::voronoi_vertices),
            block(all.points, &FaceArcs::Mark::points),
            block(all.connections, &FaceArcs::Mark::connections),
            block(all.parts, &FaceArcs::Mark::parts),
            chunk.is_local[first + i] != 0};
        from = to;
    }
}

Index ArcStore::take_slot(Index face) {
    if (free_slots_.empty()) {
        free_slots_.push_back(static_cast<Index>(faces_.size()));
        faces_.emplace_back();
    }
    slots_[face] = free_slots_.back();
    free_slots_.pop_back();
    return slots_[face];
}

void ArcStore::remove(Index face) {
    const Index slot = std::exchange(slots_[face], no_index);
    if (slot == no_index) return;
    const Face& stored = faces_[slot];
    arcs_.release(stored.arcs);
    voronoi_vertices_.release(stored.voronoi_vertices);
    vertex_places_.release(stored.voronoi_vertices);
    points_.release(stored.points);
    connections_.release(stored.connections);
    parts_.release(stored.parts);
    free_slots_.push_back(slot);
}

}  // namespace agvd
