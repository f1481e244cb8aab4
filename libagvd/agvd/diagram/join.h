//! \file
//! Joins the arcs of all faces into Voronoi edges, and the boundary into arcs between them.
#pragma once

#include "agvd/diagram/arc_store.h"
#include "agvd/diagram/diagram.h"

namespace agvd {

//! Keeps the Voronoi edges none of whose faces is traced again.
class ArcJoiner {
public:
    explicit ArcJoiner(const Surface& surface) : boundary_loops_(boundary_loops(surface)) {}

    //! To be called before a face loses its arcs.
    void forget(const ArcStore& arcs, Index face);

    //! Replaces points, edges and vertices of `diagram`. Edges stand in the order of the first of
    //! their ends in the faces, closed ones behind, then those on the boundary; branches become the
    //! first Voronoi vertices, then the label changes on the boundary. Whatever was kept.
    //! Cost: O(arcs of the new edges + boundary), and copying the others' points.
    //! \param mixed_faces  ascending: all faces that may have arcs.
    //! \param new_faces    ascending: those whose arcs are new since the last call.
    //! \param diagram      as the last call left it.
    void join(const Surface& surface, const EdgeLabels& labels, const ArcStore& arcs,
              std::span<const Index> mixed_faces, std::span<const Index> new_faces,
              Diagram& diagram);

private:
    // One end of an arc: 2 * arc + (0: tail, 1: head).
    using ArcEnd = Index;

    struct Edge {
        std::uint64_t key;  // Ascending in the diagram.
        ArcEnd first, last;
        Index left, right;
        Index first_point, num_points;  // No point: a free one.
        bool is_new;  // Its points are in new_points_, else in the diagram.
    };

    struct PointList {
        std::vector<SurfacePoint> points;
        std::vector<double> distances;

        void clear();
        void reverse_from(Index first);
        void append(std::span<const SurfacePoint> from_points,
                    std::span<const double> from_distances, const Edge& edge);
    };

    class Run;

    [[nodiscard]] bool is_vertex(Index node) const;
    [[nodiscard]] ArcEnd across(const ArcStore& arcs, ArcEnd end) const;
    void undo_edge(const ArcStore& arcs, Index name);

    std::vector<std::vector<Index>> boundary_loops_;
    std::vector<Index> edge_of_arc_;                    // no_index: none yet.
    std::vector<std::array<ArcEnd, 2>> crossing_ends_;  // One only: on the boundary.
    std::vector<Edge> edges_;
    std::vector<Index> free_edges_;  // Of edges_.
    std::vector<Index> order_;       // Of edges_, by key.
    PointList new_points_, spare_;
};

}  // namespace agvd
