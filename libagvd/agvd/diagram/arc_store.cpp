// The arcs of a chunk are copied together into each pool; what they say of each other, counted from
// the chunk's beginning, becomes places in the pools. A face that is traced again gives its blocks
// back first.
#include "agvd/diagram/arc_store.h"

#include <cassert>
#include <utility>

#include "agvd/diagram/face_relays.h"

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

namespace {

template <typename T>
std::span<const T> part(const std::vector<T>& elements, Index from, Index to) {
    return std::span(elements).subspan(from, to - from);
}

}  // namespace

void ArcStore::add(std::span<const Index> faces, const FaceArcs& chunk, Index first) {
    const FaceArcs::Mark begin = chunk.begin_of(first);
    const FaceArcs::Mark end = chunk.begin_of(first + static_cast<Index>(faces.size()));
    const LocalDiagram& local = chunk.local;
    new_points_.clear();
    for (Index p = begin.points; p < end.points; ++p) {
        new_points_.push_back({local.points[p], local.point_distance[p]});
    }
    Face all;
    all.points = points_.add(new_points_);
    all.connections = connections_.add(part(local.connections, begin.connections, end.connections));
    all.parts = parts_.add(part(chunk.parts, begin.parts, end.parts));
    all.arcs = arcs_.add(part(local.arcs, begin.arcs, end.arcs));
    all.voronoi_vertices = add_voronoi_vertices(
        part(local.voronoi_vertices, begin.voronoi_vertices, end.voronoi_vertices), begin.arcs,
        all.arcs.begin);
    rename_in_arcs(all, begin);

    FaceArcs::Mark from = begin;
    for (Index i = 0; i < faces.size(); ++i) {
        const FaceArcs::Mark to = chunk.begin_of(first + i + 1);
        const auto block = [&](const Block& of_all, Index FaceArcs::Mark::*place) {
            return Block{of_all.begin + from.*place - begin.*place, to.*place - from.*place};
        };
        assert(slots_[faces[i]] == no_index);
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

Block ArcStore::add_voronoi_vertices(std::span<const LocalVoronoiVertex> local, Index first_arc,
                                     Index stored_at) {
    new_voronoi_vertices_.clear();
    new_vertex_places_.clear();
    for (const LocalVoronoiVertex& voronoi_vertex : local) {
        VoronoiVertex& added = new_voronoi_vertices_.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const Index arc = voronoi_vertex.arcs[k] - first_arc + stored_at;
            added.ends[k] = voronoi_vertex.at_tail[k] ? ArcEnd::tail_of(arc) : ArcEnd::head_of(arc);
        }
        added.sites = voronoi_vertex.sites;
        new_vertex_places_.push_back(
            {to_surface(*surface_, voronoi_vertex.face, voronoi_vertex.position),
             voronoi_vertex.distance});
    }
    const Block stored = voronoi_vertices_.add(new_voronoi_vertices_);
    const Block places = vertex_places_.add(new_vertex_places_);
    assert(places.begin == stored.begin);  // Both pools are used alike.
    (void)places;
    return stored;
}

void ArcStore::rename_in_arcs(const Face& stored, const FaceArcs::Mark& begin) {
    const auto rename = [&](NodeId& node) {
        if (!node.is_voronoi_vertex()) return;
        node = NodeId::of_voronoi_vertex(node.voronoi_vertex() - begin.voronoi_vertices +
                                         stored.voronoi_vertices.begin);
    };
    for (LocalArc& arc : arcs_[stored.arcs]) {
        rename(arc.tail);
        rename(arc.head);
        arc.first_point += stored.points.begin - begin.points;
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
