//! \file
//! First half of the diagram: the labels on mesh vertices and edges, computed once and shared by
//! the faces around them, so that neighbouring faces cannot disagree.
#pragma once

#include "agvd/diagram/diagram.h"
#include "agvd/diagram/envelope.h"

namespace agvd {

//! A change of label on a mesh edge.
struct Crossing {
    double at;        //!< In [0, 1] along the edge's edge_half.
    double distance;  //!< From both sites.
    Index site_before;
    Index site_after;
};

//! A relay that won on an edge: what the edge hands on to the face on its far side. Through [begin,
//! end] of the edge and nowhere else, so that inside a face every label hangs together with an
//! interval of its own on the boundary.
struct EdgeRelay {
    Vec2 image;  //!< In the frame of the edge_half; y < 0: serves its face, y > 0: the other one.
    double weight;
    double begin, end;
    Index site;
};

struct EdgeLabels {
    std::vector<Index> vertex_site;       //!< #V; no_index where no site reaches.
    std::vector<double> vertex_distance;  //!< #V.
    std::vector<Index> mixed_index;       //!< #F: position in mixed_faces; no_index: unlisted.

    std::vector<Index> edges;             //!< Edges whose faces are all listed, ascending.
    std::vector<Index> edge_index;        //!< #E: position in `edges`; no_index: one label.
    std::vector<Index> crossing_offsets;  //!< #edges: where the edge's crossings begin.
    std::vector<Index> crossing_counts;   //!< #edges.
    std::vector<Crossing> crossings;      //!< Edge after edge, along each edge_half; may have gaps.

    std::vector<Index> relay_offsets;  //!< #edges + 1 offsets into relays.
    std::vector<EdgeRelay> relays;

    [[nodiscard]] std::span<const EdgeRelay> relays_on(Index labelled_edge) const {
        const Index begin = relay_offsets[labelled_edge];
        return std::span(relays).subspan(begin, relay_offsets[labelled_edge + 1] - begin);
    }
    [[nodiscard]] std::span<const Crossing> on_edge(Index edge) const {
        const Index i = edge_index[edge];
        if (i == no_index) return {};
        return std::span(crossings).subspan(crossing_offsets[i], crossing_counts[i]);
    }
};

[[nodiscard]] inline std::span<const Relay> relays_of(const Propagation& propagation,
                                                      Index mixed_index) {
    const Index begin = propagation.relay_offsets[mixed_index];
    return std::span(propagation.relays)
        .subspan(begin, propagation.relay_offsets[mixed_index + 1] - begin);
}

//! A vertex all of whose faces are listed takes the nearest site over the relays of those faces
//! (which may be nearer than the engine's graph knows); an edge all of whose faces are listed gets
//! the envelope of the relays of both sides and of its ends.
//! Cost: O(relays) a listed face and a crossing.
[[nodiscard]] EdgeLabels label_edges(const Surface& surface, const Propagation& propagation,
                                     int num_threads);

}  // namespace agvd
