//! \file
//! Joins the arcs of all faces into Voronoi edges, and the boundary into arcs between them.
#pragma once

#include "agvd/core/poller.h"
#include "agvd/diagram/cell_set.h"
#include "agvd/diagram/diagram.h"

namespace agvd {

//! Keeps the Voronoi edges none of whose faces is traced again.
class ArcJoiner {
public:
    explicit ArcJoiner(const Surface& surface) : boundary_loops_(boundary_loops(surface)) {}

    //! To be called before a face loses its arcs.
    void forget(const ArcStore& arcs, Index face);

    //! Joins new arcs with each other and with old ones.
    //! Cost: O(arcs of the new edges + edges).
    //! \param new_faces  ascending: those whose arcs are new since the last call.
    void join(const EdgeLabels& labels, const ArcStore& arcs, std::span<const Index> new_faces,
              Ticker ticker);

    //! How many loops bound each of these cells; 0 for others. Cost: O(edges + boundary).
    [[nodiscard]] std::vector<Index> count_loops(const Surface& surface, const EdgeLabels& labels,
                                                 const ArcStore& arcs, const CellSet& cells) const;

    //! Replaces edges, vertices and points of `diagram`. Edges stand in the order of the first of
    //! their ends in the faces, then come closed edges, then those on the boundary. Voronoi
    //! vertices inside the surface come first, then the label changes on the boundary. The order
    //! does not depend on what was kept from earlier calls.
    //! Cost: O(edges + points of new ones + boundary), and copying the points of the others.
    //! \param diagram  as the last call left it; of no use any more if the ticker throws.
    void draw(const Surface& surface, const EdgeLabels& labels, const ArcStore& arcs, Ticker ticker,
              Diagram& diagram);

    void renumber(const Renumbering& renumbering);

    //! A face beside each edge between cells, of those that one of the cells is beside.
    [[nodiscard]] std::vector<Index> faces_beside(const ArcStore& arcs, const CellSet& cells) const;

private:
    // One end of an arc: 2 * arc + (0: tail, 1: head).
    using ArcEnd = Index;
    static constexpr ArcEnd tail_of(Index arc) { return 2 * arc; }
    static constexpr ArcEnd head_of(Index arc) { return 2 * arc + 1; }
    static constexpr ArcEnd other_end(ArcEnd end) { return end ^ 1; }
    [[nodiscard]] static Index node_at(const ArcStore& arcs, ArcEnd end) {
        const LocalArc& arc = arcs.arcs()[end / 2];
        return end % 2 == 0 ? arc.tail : arc.head;
    }

    struct Edge {
        std::uint64_t key;  // Ascending in the diagram.
        ArcEnd last;
        Index left, right;
        Index first_point, num_points;  // In the diagram, but for new ones.
        bool is_new;

        [[nodiscard]] bool is_closed() const { return key >> 63 != 0; }
    };

    struct FaceVoronoiVertices {
        Index face;
        Block voronoi_vertices;
    };
    class Run;
    class LoopCounter;
    class Nodes;
    class Drawing;

    [[nodiscard]] bool is_vertex(Index node) const;
    [[nodiscard]] ArcEnd across(const ArcStore& arcs, ArcEnd end) const;

    std::vector<std::vector<Index>> boundary_loops_;
    std::vector<Index> edge_of_arc_;                    // no_index: none yet; or one that is gone.
    std::vector<std::array<ArcEnd, 2>> crossing_ends_;  // One only: on the boundary.
    std::vector<Edge> edges_;
    std::vector<ArcEnd> first_ends_;  // By edge; no_index: it is gone.
    std::vector<Index> order_;        // Of edges: old ones by key, then new ones.
    std::vector<Index> free_edges_;   // Gone, and no arc says that it is of them.
    std::vector<Index> forgotten_;    // Faces, since the last call of join().
    std::vector<FaceVoronoiVertices> voronoi_vertices_;  // By face.
    // Memory for the next points.
    std::vector<SurfacePoint> points_;
    std::vector<double> point_distance_;
    std::vector<Passage> passages_;
};

}  // namespace agvd
