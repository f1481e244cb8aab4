//! \file
//! The arcs of all faces, some of which are traced again now and then. What belongs to a face
//! (arcs, Voronoi vertices and their places, points, connections, parts) is one block in each of
//! several pools with free lists, so that faces can be emptied and filled again without renaming
//! the others.
#pragma once

#include "agvd/core/reused_memory.h"
#include "agvd/diagram/arc_end.h"
#include "agvd/diagram/face_arcs.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"

namespace agvd {

//! As in FaceArcs, but for indices: Voronoi vertices, and the arcs around them, are known by their
//! places in the pools, which last as long as the face keeps its arcs.
class ArcStore {
public:
    //! What a face has.
    struct Face {
        Block arcs, voronoi_vertices, points, connections, parts;
        bool is_local = false;  //!< They depend on no relays of other faces.
    };
    struct Point {
        Vec2 position;  //!< In the face's own frame.
        double distance;
    };
    //! The arcs and cells around a Voronoi vertex, counter-clockwise: ends[i], then sites[i].
    struct VoronoiVertex {
        std::array<ArcEnd, 3> ends;
        std::array<Index, 3> sites;
    };
    //! Where a Voronoi vertex lies.
    struct VertexPlace {
        SurfacePoint point;
        double distance;
    };

    //! \param surface  outlives this.
    explicit ArcStore(const Surface& surface)
        : surface_(&surface), slots_(surface.num_faces(), no_index) {}

    //! No face ever had arcs.
    [[nodiscard]] bool is_empty() const { return faces_.empty(); }
    //! Makes room for so many times as much.
    void reserve_for(double times);
    //! Gives faces that have none the arcs of the faces of a chunk, from the first-th on.
    void add(std::span<const Index> faces, const FaceArcs& chunk, Index first);
    //! Takes them away again, if there are any.
    void remove(Index face);

    //! Calls change(site) for every site that is named here.
    template <typename Change>
    void for_each_site(const Change& change);

    //! Empty for a face without arcs.
    [[nodiscard]] const Face& of_face(Index face) const {
        static constexpr Face none{};
        return slots_[face] == no_index ? none : faces_[slots_[face]];
    }
    [[nodiscard]] const BlockPool<LocalArc>& arcs() const { return arcs_; }
    [[nodiscard]] const BlockPool<VoronoiVertex>& voronoi_vertices() const {
        return voronoi_vertices_;
    }
    //! In the places of the Voronoi vertices.
    [[nodiscard]] const BlockPool<VertexPlace>& vertex_places() const { return vertex_places_; }
    [[nodiscard]] const BlockPool<Point>& points() const { return points_; }
    [[nodiscard]] const BlockPool<Connection>& connections() const { return connections_; }
    [[nodiscard]] const BlockPool<FaceArcs::CellPart>& parts() const { return parts_; }

    //! Starts to load what a face has, in three steps: call for the same face with 0, 1 and 2.
    //! Always inline: g++ drops calls of functions that do nothing but prefetch.
    [[gnu::always_inline]] void prefetch(Index face, int step) const {
        if (step == 0) {
            __builtin_prefetch(&slots_[face]);
        } else if (slots_[face] == no_index) {
            return;
        } else if (step == 1) {
            __builtin_prefetch(&faces_[slots_[face]]);
        } else {
            const Face& stored = faces_[slots_[face]];
            if (stored.arcs.count > 0) __builtin_prefetch(&arcs_[stored.arcs.begin]);
            if (stored.parts.count > 0) __builtin_prefetch(&parts_[stored.parts.begin]);
        }
    }

private:
    // The arcs of a chunk from `first_arc` on are stored from `stored_at` on.
    [[nodiscard]] Block add_voronoi_vertices(std::span<const LocalVoronoiVertex> local,
                                             Index first_arc, Index stored_at);
    // From the names of a chunk, counted from `begin`, to places in the pools.
    void rename_in_arcs(const Face& stored, const FaceArcs::Mark& begin);
    [[nodiscard]] Index take_slot(Index face);

    const Surface* surface_;
    std::vector<Index> slots_;  // #F: where in faces_; no_index: no arcs.
    std::vector<Face> faces_;
    std::vector<Index> free_slots_;
    BlockPool<LocalArc> arcs_;
    BlockPool<VoronoiVertex> voronoi_vertices_;
    BlockPool<VertexPlace> vertex_places_;
    BlockPool<Point> points_;
    BlockPool<Connection> connections_;
    BlockPool<FaceArcs::CellPart> parts_;

    // Of the faces at hand.
    std::vector<Point> new_points_;
    std::vector<VoronoiVertex> new_voronoi_vertices_;
    std::vector<VertexPlace> new_vertex_places_;
};

template <typename Change>
void ArcStore::for_each_site(const Change& change) {
    for (LocalArc& arc : arcs_) {
        change(arc.left);
        change(arc.right);
    }
    for (VoronoiVertex& voronoi_vertex : voronoi_vertices_) {
        for (Index& site : voronoi_vertex.sites) change(site);
    }
    for (Connection& connection : connections_) change(connection.site);
    for (FaceArcs::CellPart& part : parts_) change(part.site);
}

}  // namespace agvd
