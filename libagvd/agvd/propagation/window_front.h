//! \file
//! Exact or error-bounded distances from one site, as far as it can be the nearest: windows through
//! a bucketed queue of half-edges.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "agvd/core/poller.h"
#include "agvd/core/run_array.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"
#include "agvd/propagation/corners.h"
#include "agvd/propagation/window_face.h"
#include "agvd/propagation/window_queue.h"
#include "agvd/propagation/window_store.h"

namespace agvd {

//! True for the faces whose windows are asked for after the run; empty: for all.
using KeptFaces = std::function<bool(Index face)>;

//! The memory of one run, which the next one reuses. Not for use by two threads at once.
class WindowFront {
public:
    //! \param surface, corners  outlive the front; Corners(surface).
    //! \param max_error    relative; 0: no window is merged.
    //! \param ticker       of the thread that runs it.
    //! \param small_run    half-edges of a run that gives no windows back; the default fits into
    //!                     the caches as it is.
    WindowFront(const Surface& surface, const Corners& corners, double max_error,
                Ticker ticker = {}, Index small_run = 2048);

    //! Propagates from one site. Windows die where `bounds` are lower.
    //!
    //! \param bounds    #V upper bounds for the distance from the nearest of all sites, larger than
    //!                  any rounding of it.
    //! \param work_cap  the most windows that may be served through one half-edge in order of
    //!                  buckets; if more are, the run starts again with the nearest window first.
    //!                  There a half-edge drops what comes after most_windows, and the run's
    //!                  relative_error() is infinite.
    //! \param keeps     windows of other faces may be given back once nothing can come there any
    //!                  more. That changes nothing else.
    //! \throw Cancelled  the next run begins anew.
    void run(const SurfacePoint& site, std::span<const float> bounds, Index work_cap,
             const KeptFaces& keeps = {});

    struct ReachedVertex {
        Index vertex;
        double distance;  //!< Of a real path: the windows' distance and error.
    };
    //! Calls each(ReachedVertex) for the vertices reached within their bound.
    template <typename Each>
    void for_each_vertex(const Each& each) const {
        for (const VertexRecord& v : vertices_) {
            if (std::min(v.low, v.upper) <= v.outer_bound) each(ReachedVertex{v.vertex, v.upper});
        }
    }
    //! Calls each(half_edge, windows) for the half-edges that windows came through, in the order in
    //! which the run came to them: all into kept faces, some into others.
    template <typename Each>
    void for_each_half_edge(const Each& each) const {
        const auto tell = [&](const EdgeRecord& e) {
            if (e.windows != no_index) each(e.half_edge, store_[e.windows]);
        };
        if (num_arrivals_ == edges_.size()) {
            for (const EdgeRecord& e : edges_) tell(e);
        } else {
            for (const Index record : records_by_arrival()) tell(edges_[record]);
        }
    }

    //! Vertices whose bounds mattered, and half-edges, have places in the order in which the last
    //! run came to them. Half-edges only if the run kept all faces.
    [[nodiscard]] Index num_vertices() const { return vertices_.size(); }
    [[nodiscard]] Index num_half_edges() const { return edges_.size(); }
    //! no_index: the run did not come there.
    [[nodiscard]] Index place_of_vertex(Index vertex) const {
        const Index slot = vertex_slot_[vertex];
        return slot < vertices_.size() && vertices_[slot].vertex == vertex ? slot : no_index;
    }
    [[nodiscard]] Index place_of_half_edge(Index half_edge) const {
        const Index slot = edge_slot_[half_edge];
        return slot < edges_.size() && edges_[slot].half_edge == half_edge ? slot : no_index;
    }
    //! Infinity where the vertex was not reached within its bound.
    [[nodiscard]] ReachedVertex vertex_at(Index place) const {
        const VertexRecord& v = vertices_[place];
        return {v.vertex, std::min(v.low, v.upper) <= v.outer_bound ? v.upper : infinity};
    }
    [[nodiscard]] Index half_edge_at(Index place) const { return edges_[place].half_edge; }
    //! May be none.
    [[nodiscard]] std::span<const Window> windows_at(Index place) const {
        const Index run = edges_[place].windows;
        return run == no_index ? std::span<const Window>() : store_[run];
    }

    //! Largest error of a window that was merged in the last run over its least distance; 0 if none
    //! was.
    [[nodiscard]] double relative_error() const { return relative_error_; }
    //! Windows served in the last run.
    [[nodiscard]] std::size_t num_windows() const { return num_served_; }
    [[nodiscard]] std::size_t bytes() const;

    //! Real meshes stay below 700. Around a spike that is 10^9 times as long as wide,
    //! windows circle until rounding ends it: a million of them, each copied a thousand times.
    static constexpr Index most_windows = 1 << 11;

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    struct EdgeRecord {
        Index half_edge;                  // no_index: waits to be used again.
        Index tail, head;                 // Records of its ends.
        Index arrival;                    // How many half-edges came before.
        Index waiting = no_index;         // List of runs of windows.
        Index windows = no_index;         // Run: the envelope of those that came.
        Index bucket = no_index;          // Where the half-edge waits.
        Index last_bucket = 0;            // The last one that may still name it.
        Index num_served = 0;             // Windows, against the cap.
        double apex_distance = infinity;  // Best distance of the opposite corner through this edge,
        double apex_ray = 0;              // and where its ray crosses the edge.
        Index next = no_index;            // In a list of watched_, or of free records.
        bool is_watched = false;
    };
    struct VertexRecord {
        Index vertex;
        float outer_bound;               // Given by the caller.
        double bound;                    // The lower of that and `upper`.
        double upper = infinity;         // Of a path from this site.
        double low = infinity;           // Least that a window gives.
        double last_arrival = infinity;  // The last one that may bend here,
        Index num_pseudo_sources = 0;    // and how many there were.
    };
    // What of a window goes on through the other two half-edges.
    struct Division {
        WindowPart right, left;
    };
    // Windows on their way to a half-edge.
    struct Arrivals {
        Index run, count;
        double nearest;  // The least of their distances.
    };
    // A path that arrives at a vertex around which it may bend.
    struct PseudoSource {
        Index vertex;                 // Its record; of a free one the next.
        Index half_edge;              // Leaves the vertex; no_index: the direction is not known.
        double arrival_x, arrival_y;  // Towards where they come from, in the half-edge's frame.
        double distance;
    };

    [[nodiscard]] bool run_in(WindowQueue::Order order, const SurfacePoint& site, Index work_cap);
    void start(const SurfacePoint& site);
    [[nodiscard]] std::optional<FrontItem> next_item();
    void prefetch(FrontItem item) const;
    [[nodiscard]] Index vertex_record(Index vertex);
    void reach_vertex(Index record, double distance, float error, Index half_edge,
                      const Vec2& arrival);
    // By any path on the surface.
    void bound_vertex(Index record, double distance) {
        VertexRecord& v = vertices_[record];
        v.upper = std::min(v.upper, distance);
        v.bound = std::min(v.bound, v.upper);
    }
    [[nodiscard]] Index edge_record(Index half_edge, Index tail, Index head);
    [[nodiscard]] std::vector<Index> records_by_arrival() const;

    [[nodiscard]] bool may_close() const {
        return keeps_ != nullptr && num_arrivals_ > small_run_ &&
               queue_.order() == WindowQueue::Order::Buckets;
    }
    void watch(Index record, Index bucket);
    void close_edges();
    void close_or_watch(Index record);

    void send(Index half_edge, Index tail, Index head, const Window& window);
    void wait(const Arrivals& arrivals, Index half_edge, Index tail, Index head);
    void serve_edge(Index record);
    void take_in(EdgeRecord& edge, const WindowFace& face);
    [[nodiscard]] Index most_windows_through(const EdgeRecord& edge, const WindowFace& face) const;
    void drop_waiting(EdgeRecord& edge);
    [[nodiscard]] Index gather(Index waiting, Index envelope);
    [[nodiscard]] Index insert_rest(Index run, Index kept, Index i, const WindowFace& face);
    [[nodiscard]] Index settle(Index run, Index count);
    [[nodiscard]] Index merge_neighbours(std::span<Window> windows);
    [[nodiscard]] Division divide(const Window& window, EdgeRecord& edge, const WindowFace& face);
    void reach_bent(const WindowFace& face, double distance, double at, float error);
    double reach_apex(const Window& window, double ray, const WindowFace& face);
    [[nodiscard]] static Division split(const Window& window, double ray, double at_apex,
                                        EdgeRecord& edge);
    template <auto part>
    [[nodiscard]] Arrivals pass_on(const WindowFace& face, Index most);
    void emit(const PseudoSource& source);
    bool emit_fan(Index first, const Vec2* from, Index last, const Vec2* to, const VertexRecord& v);
    void emit_into(Index half_edge, double weight, float error, const Vec2* from, const Vec2* to);

    const Surface& surface_;
    const Corners& corners_;
    double max_error_;
    Ticker ticker_;
    Index small_run_;
    double close_factor_;
    std::span<const float> bounds_;
    const KeptFaces* keeps_ = nullptr;  // During a run; null: all.

    std::vector<Index> vertex_slot_;  // #V, #H: the record, if that record names it.
    std::vector<Index> edge_slot_;
    RunArray<VertexRecord> vertices_;
    RunArray<EdgeRecord> edges_;
    Index num_arrivals_ = 0;  // Of half-edges; more than records if some were used again.
    Index free_edge_ = no_index;
    RunArray<PseudoSource> pseudo_sources_;
    Index free_pseudo_source_ = no_index;
    WindowStore store_;
    WindowQueue queue_;
    static constexpr Index most_watched_ahead = 15;
    std::array<Index, most_watched_ahead + 1> watched_{};  // By bucket: list of records.
    Index num_closed_buckets_ = 0;
    std::vector<Window> envelope_, scratch_;
    RunArray<const Window*> order_;
    RunArray<Division> divisions_;
    double relative_error_ = 0;
    std::size_t num_served_ = 0;
};

}  // namespace agvd
