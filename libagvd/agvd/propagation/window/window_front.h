//! \file
//! Exact or error-bounded distances from one site, as far as it can be the nearest: windows through
//! a bucketed queue of half-edges, and beams from lines. The state is plain structs, a pass is a
//! free function.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/core/run_array.h"
#include "agvd/mesh/mesh.h"
#include "agvd/propagation/shape_source.h"
#include "agvd/propagation/window/beam.h"
#include "agvd/propagation/window/window.h"
#include "agvd/propagation/window/window_queue.h"

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
    std::vector<Index> record_of;  //!< #V: the record of a vertex, if that record names the vertex.
    RunArray<VertexRecord> records;

    //! no_index: the run has not come there.
    [[nodiscard]] Index find(Index vertex) const {
        const Index record = record_of[vertex];
        return record < records.size() && records[record].vertex == vertex ? record : no_index;
    }
    Index add(const VertexRecord& record) {
        return record_of[record.vertex] = records.push(record);
    }
    //! \param distance  of any path on the surface.
    void lower_bound(Index record, double distance) {
        VertexRecord& v = records[record];
        v.upper = std::min(v.upper, distance);
        v.bound = std::min(v.bound, v.upper);
    }
};

//! Records of which a run gives some back and uses them again. The field `next` links the free
//! ones.
template <typename Record, Index Record::*next>
struct ReusedRecords {
    RunArray<Record> records;
    Index first_free = no_index;

    //! \return its index.
    Index add(const Record& record) {
        if (first_free == no_index) return records.push(record);
        const Index at = first_free;
        first_free = std::exchange(records[at], record).*next;
        return at;
    }
    void give_back(Index record) { records[record].*next = std::exchange(first_free, record); }
    void clear() {
        records.clear();
        first_free = no_index;
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
struct EdgeTable : ReusedRecords<EdgeRecord, &EdgeRecord::next> {
    std::vector<Index> record_of;  //!< #H: the record of a half-edge, if it names the half-edge.
    Index num_arrivals = 0;        //!< Exceeds the number of records if some were used again.

    //! no_index: the run has not come there, or has given the record back.
    [[nodiscard]] Index find(Index half_edge) const {
        const Index record = record_of[half_edge];
        return record < records.size() && records[record].half_edge == half_edge ? record
                                                                                 : no_index;
    }
    Index add(const HalfEdgeEnds& ends) {
        return record_of[ends.half_edge] =
                   ReusedRecords::add({ends.half_edge, ends.tail, ends.head, num_arrivals++});
    }
    void give_back(Index record) {
        records[record].half_edge = no_index;
        ReusedRecords::give_back(record);
    }
    void clear() {
        ReusedRecords::clear();
        num_arrivals = 0;
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
struct PseudoSourceTable : ReusedRecords<PseudoSource, &PseudoSource::vertex> {
    PseudoSource take(Index record) {
        const PseudoSource source = records[record];
        give_back(record);
        return source;
    }
};

//! Beams that wait, and those that came into kept faces.
struct BeamTable : ReusedRecords<Beam, &Beam::tail> {
    Index num_served = 0;

    void give_back(Index record) {
        records[record].half_edge = no_index;
        ReusedRecords::give_back(record);
    }
    void clear() {
        ReusedRecords::clear();
        num_served = 0;
    }
};

//! True for the faces whose windows are asked for after the run; empty: for all.
using KeptFaces = std::function<bool(Index face)>;

//! Half-edges that are closed once the front is past them.
struct WatchList {
    static constexpr Index most_ahead = 15;

    std::array<Index, most_ahead + 1> first{};  //!< By bucket: list of records.
    Index num_closed = 0;                       //!< Buckets whose lists have been worked off.
};

//! What of a window goes on through the other two half-edges of a face.
struct Division {
    WindowPart right, left;
};

//! Memory that passes use again.
struct FrontScratch {
    std::vector<Window> envelope, insertion;
    RunArray<const Window*> order;
    RunArray<Division> divisions;
};

//! Fronts of a larger error take longer from few sites: windows that are farther off leave more of
//! their neighbours (bunny, one source: .005 24 P0, .01 39, .1 71). From 2000 sites .1 would save a
//! sixth.
inline constexpr double quickest_error = 5e-3;

//! Runs from site to site: the state of a run, on which its passes work, and what the last run
//! found. A run reuses the memory of the one before. Not for use by two threads at once.
struct WindowFront {
    const Surface& surface;
    const Corners& corners;
    double max_error;  //!< Relative, at most quickest_error; 0: no window is merged.
    Index small_run;   //!< A run of no more half-edges gives no windows back.
    std::span<const float> bounds = {};  //!< As in run_front().
    const KeptFaces* keeps = nullptr;    //!< Null: all.

    WindowQueue queue;
    Ticker ticker;
    VertexTable vertices = {};
    EdgeTable edges = {};
    PseudoSourceTable pseudo_sources = {};
    BeamTable beams = {};
    WindowStore store = {};
    WatchList watched = {};
    FrontScratch scratch = {};
    //! Largest error of a merged window of the last run over its least distance.
    double relative_error = 0;
    std::size_t num_served = 0;  //!< Windows served in the last run.

    //! The first two outlive the front. The default of small_run fits into the caches.
    WindowFront(const Surface& on, const Corners& its_corners, double largest_error,
                Ticker ticker_of_thread = {}, Index most_kept = 2048)
        : surface(on),
          corners(its_corners),
          max_error(std::min(largest_error, quickest_error)),
          small_run(most_kept),
          queue(buckets_per_edge / its_corners.mean_length()),
          ticker(ticker_of_thread) {
        vertices.record_of.assign(surface.num_vertices(), 0);
        edges.record_of.assign(surface.twin.size(), 0);
        reset(WindowQueue::Order::Buckets);
    }
    //! Prepares the next run. Keeps the memory. \param start  the least distance of the run.
    void reset(WindowQueue::Order order, double start = 0) {
        vertices.records.clear();
        edges.clear();
        pseudo_sources.clear();
        beams.clear();
        store.clear();
        queue.start(order, start);
        watched.first.fill(no_index);
        watched.num_closed = 0;
        num_served = 0;
        relative_error = 0;
    }
    [[nodiscard]] std::size_t bytes() const {
        return (vertices.record_of.capacity() + edges.record_of.capacity()) * sizeof(Index) +
               vertices.records.bytes() + edges.records.bytes() + pseudo_sources.records.bytes() +
               beams.records.bytes() + store.bytes() + queue.bytes();
    }

    //! Calls each(vertex, distance) for the vertices reached within their bound: the length of a
    //! path, which is the windows' distance and error.
    template <typename Each>
    void for_each_vertex(const Each& each) const {
        for (const VertexRecord& v : vertices.records) {
            if (std::min(v.low, v.upper) <= v.outer_bound) each(v.vertex, v.upper);
        }
    }
    //! Calls each(half_edge, windows) for the half-edges that windows came through, in the order in
    //! which the run came to them: all into kept faces, some into others.
    template <typename Each>
    void for_each_half_edge(const Each& each) const {
        const auto tell = [&](const EdgeRecord& e) {
            if (e.windows != no_index) each(e.half_edge, store[e.windows]);
        };
        if (edges.num_arrivals == edges.records.size()) {
            for (const EdgeRecord& e : edges.records) tell(e);
        } else {
            for (const Index record : edges.by_arrival()) tell(edges.records[record]);
        }
    }
    //! Calls each(beam) for the beams into kept faces.
    template <typename Each>
    void for_each_beam(const Each& each) const {
        for (const Beam& beam : beams.records) {
            if (beam.half_edge != no_index) each(beam);
        }
    }

private:
    static constexpr double buckets_per_edge = 3;
};

//! Whether half-edges are closed in this run: windows behind the front are given back.
[[nodiscard]] inline bool may_close(const WindowFront& front) {
    return front.keeps != nullptr && front.edges.num_arrivals > front.small_run &&
           front.queue.order() == WindowQueue::Order::Buckets;
}

//! Closes a half-edge in this bucket or later.
inline void watch(WindowFront& front, Index record, Index bucket) {
    WatchList& watched = front.watched;
    const Index next = watched.num_closed + 1;
    const Index slot = std::clamp(bucket, next, next + WatchList::most_ahead - 1);
    Index& list = watched.first[slot % watched.first.size()];
    front.edges.records[record].next = std::exchange(list, record);
}

//! \return the record of a vertex, which is made if there is none.
[[nodiscard]] inline Index vertex_record(WindowFront& front, Index vertex) {
    const Index record = front.vertices.find(vertex);
    if (record != no_index) return record;
    const float bound = front.bounds[vertex];
    return front.vertices.add({vertex, bound, bound});
}

//! Windows in the order of their beginnings.
struct SentWindows {
    Index run, count;
    double nearest;  //!< The least of their distances.
};

//! Adds windows to those that wait at a half-edge, and queues the half-edge.
inline void send(WindowFront& front, const HalfEdgeEnds& to, const SentWindows& windows) {
    if (windows.count == 0) {
        front.store.give_back(windows.run);
        return;
    }
    front.store.resize(windows.run, windows.count);
    Index record = front.edges.find(to.half_edge);
    if (record == no_index) {
        front.corners.prefetch(Surface::face(to.half_edge));
        record = front.edges.add(to);
    }
    EdgeRecord& edge = front.edges.records[record];
    assert(edge.tail == to.tail && edge.head == to.head);
    front.store.next(windows.run) = std::exchange(edge.waiting, windows.run);
    front.queue.push(FrontItem::half_edge(record), windows.nearest, edge.bucket);
    if (edge.bucket != no_index) edge.last_bucket = std::max(edge.last_bucket, edge.bucket);
}

//! The same for one window.
inline void send(WindowFront& front, const HalfEdgeEnds& to, const Window& window) {
    assert(window.begin < window.end && window.y <= 0);
    const Index run = front.store.take(1);
    front.store[run].front() = window;
    send(front, to, SentWindows{run, 1, window.nearest()});
}

//! The end of a path at a vertex. The path is straight there.
struct Arrival {
    double distance;  //!< From below: a real path of at most `error` more arrives.
    float error;
    Index half_edge;  //!< Leaves the vertex; no_index: the direction is not known.
    Vec2 direction;   //!< Towards where the path comes from, in the frame of the half-edge.
};

//! Takes in a path that arrives at a vertex. Makes a pseudo-source if the path may bend there.
void reach_vertex(WindowFront& front, Index record, const Arrival& arrival);

//! Merges the windows that wait, each run of them in ascending order, into the envelope of the
//! half-edge. Windows that are beaten by the bounds of the half-edge's ends are dropped.
//!
//! \param face  of the half-edge, with the bounds of its ends.
//! Cost: linear where windows come in order, as they nearly always do.
void take_in_windows(WindowFront& front, EdgeRecord& edge, const WindowFace& face);

//! Reaches the apex of the face, and decides which parts of a window go on to both sides.
[[nodiscard]] Division divide(WindowFront& front, const Window& w, EdgeRecord& edge,
                              const WindowFace& face);

//! Takes in the windows that wait, and sends on what has not been sent on. Drops what waits if 2^11
//! windows were sent on in the order of distance; the relative error is infinite then.
void serve_edge(WindowFront& front, Index record);

//! Sends the beam of a whole edge of a line into the face of a half-edge of it.
void emit_beam(WindowFront& front, Index side, double start);

//! Sends on the parts of a beam. It stays among the beams of the front if its face is kept.
void serve_beam(WindowFront& front, Index record);

//! Directions around a vertex, counter-clockwise.
struct Fan {
    double distance;  //!< Of the vertex, from below: the path is longer by at most `error`.
    float error;
    Index first;  //!< Leaves the vertex; its face is the first one.
    //! The same of the last face; no_index: to the boundary, or all around.
    Index last = no_index;
    //! Rays that bound the fan in these two faces, in their frames; none: the whole face.
    std::optional<Vec2> from = {}, to = {};
};

//! Sends windows through the edges opposite to the vertex. False if the boundary comes before the
//! last face.
bool emit_fan(WindowFront& front, const Fan& fan);

//! Sends beams from the sides of a line or a region, and windows from its vertices into the angles
//! between the beams.
void emit_from_shape(WindowFront& front, const ShapeSource& shape);

//! Closes the watched half-edges that the current bucket has left behind: their windows and records
//! are used again. No other result of the run changes.
void close_edges(WindowFront& front);

//! Propagates from one site. Windows die where `bounds` are lower.
//!
//! \param bounds    #V upper bounds for the distance from the nearest of all sites, larger than
//!                  any rounding of it.
//! \param work_cap  the most windows that may be served through one half-edge in order of buckets;
//!                  if more are, the run starts again with the nearest window first. There a
//!                  half-edge drops what comes after 2^11 windows, and relative_error is infinite.
//! \param keeps     windows of other faces may be given back once nothing can come there any more.
//!                  The results are the same.
//! \param start    distance of the site from itself, >= 0.
//! \throw Cancelled  the next run begins anew.
void run_front(WindowFront& front, const SurfacePoint& site, std::span<const float> bounds,
               Index work_cap, const KeptFaces& keeps = {}, double start = 0);

//! The same from a line or a region. No path crosses it: in front.corners its edges are cut.
void run_front(WindowFront& front, const ShapeSource& shape, std::span<const float> bounds,
               Index work_cap, const KeptFaces& keeps = {});

}  // namespace agvd
