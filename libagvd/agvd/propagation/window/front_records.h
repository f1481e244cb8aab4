//! \file
//! What one run of the window engine knows of vertices, half-edges and pseudo-sources: plain
//! records in tables.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "agvd/core/reused_memory.h"
#include "agvd/core/types.h"

namespace agvd {

struct VertexRecord {
    Index vertex;
    float outer_bound;               //!< Given by the caller.
    double bound;                    //!< The lower of outer_bound and upper.
    double upper = infinity;         //!< Length of a path from this site.
    double low = infinity;           //!< Least distance that a window gives.
    double last_arrival = infinity;  //!< Distance of the last pseudo-source here.
    Index num_pseudo_sources = 0;    //!< How many there were.
};

//! Records of the vertices that a run has come to.
struct VertexTable {
    std::vector<Index> place;  //!< #V: the record of a vertex, if that record names the vertex.
    RunArray<VertexRecord> records;

    //! no_index: the run has not come there.
    [[nodiscard]] Index find(Index vertex) const {
        const Index record = place[vertex];
        return record < records.size() && records[record].vertex == vertex ? record : no_index;
    }
    Index add(const VertexRecord& record) { return place[record.vertex] = records.push(record); }
    //! \param distance  of any path on the surface.
    void lower_bound(Index record, double distance) {
        VertexRecord& v = records[record];
        v.upper = std::min(v.upper, distance);
        v.bound = std::min(v.bound, v.upper);
    }
};

//! A half-edge to which windows are sent, and the records of its ends.
struct HalfEdgeEnds {
    Index half_edge;
    Index tail, head;
};

struct EdgeRecord {
    Index half_edge;                  //!< no_index: the record is free.
    Index tail, head;                 //!< Records of its ends.
    Index arrival;                    //!< How many half-edges came before.
    Index waiting = no_index;         //!< List of runs of windows that wait.
    Index windows = no_index;         //!< Run: the envelope of the windows that were taken in.
    Index bucket = no_index;          //!< Where the half-edge waits in the queue.
    Index last_bucket = 0;            //!< The last bucket that may still name it.
    Index num_served = 0;             //!< Windows sent on through its face.
    double apex_distance = infinity;  //!< Best distance of the opposite corner through this edge.
    double apex_ray = 0;              //!< Where the ray of that distance crosses the edge.
    Index next = no_index;            //!< In a list of watched half-edges, or of free records.
    bool is_watched = false;
};

//! Records of the half-edges that a run has come to.
struct EdgeTable {
    std::vector<Index> place;  //!< #H: the record of a half-edge, if it names the half-edge.
    RunArray<EdgeRecord> records;
    Index num_arrivals = 0;       //!< Exceeds the number of records if some were used again.
    Index first_free = no_index;  //!< List of free records.

    //! no_index: the run has not come there, or has given the record back.
    [[nodiscard]] Index find(Index half_edge) const {
        const Index record = place[half_edge];
        return record < records.size() && records[record].half_edge == half_edge ? record
                                                                                 : no_index;
    }
    Index add(const HalfEdgeEnds& ends) {
        const EdgeRecord record{ends.half_edge, ends.tail, ends.head, num_arrivals++};
        Index& at = place[ends.half_edge];
        if (first_free == no_index) return at = records.push(record);
        at = first_free;
        first_free = std::exchange(records[at], record).next;
        return at;
    }
    void give_back(Index record) {
        records[record].half_edge = no_index;
        records[record].next = std::exchange(first_free, record);
    }
    //! Those in use, in the order in which the run came to their half-edges.
    [[nodiscard]] std::vector<Index> by_arrival() const {
        std::vector<Index> used;
        for (Index i = 0; i < records.size(); ++i) {
            if (records[i].half_edge != no_index) used.push_back(i);
        }
        std::sort(used.begin(), used.end(),
                  [&](Index a, Index b) { return records[a].arrival < records[b].arrival; });
        return used;
    }
};

//! A path that arrives at a vertex around which it may bend.
struct PseudoSource {
    Index vertex;                 //!< Its record; of a free pseudo-source the next free one.
    Index half_edge;              //!< Leaves the vertex; no_index: the direction is not known.
    double arrival_x, arrival_y;  //!< Towards where the path comes from, in the half-edge's frame.
    double distance;
};

//! Pseudo-sources that wait.
struct PseudoSourceTable {
    RunArray<PseudoSource> records;
    Index first_free = no_index;

    Index add(const PseudoSource& source) {
        if (first_free == no_index) return records.push(source);
        const Index record = first_free;
        first_free = std::exchange(records[record], source).vertex;
        return record;
    }
    PseudoSource take(Index record) {
        const PseudoSource source = records[record];
        records[record].vertex = std::exchange(first_free, record);
        return source;
    }
};

}  // namespace agvd
