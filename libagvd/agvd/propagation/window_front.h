//! \file
//! Exact or error-bounded distances from one site, as far as it can be the nearest: windows through
//! a bucketed queue of half-edges.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "agvd/core/poller.h"
#include "agvd/core/run_array.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"
#include "agvd/propagation/corners.h"
#include "agvd/propagation/window.h"

namespace agvd {

//! The memory of one run, which the next one reuses. Not for use by two threads at once.
class WindowFront {
public:
    //! \param surface, corners  outlive the front; Corners(surface).
    //! \param max_error    relative; 0: no window is merged.
    //! \param ticker       of the thread that runs it.
    WindowFront(const Surface& surface, const Corners& corners, double max_error,
                Ticker ticker = {});

    //! Propagates from one site. Windows die where `bounds` are lower.
    //!
    //! \param bounds    #V upper bounds for the distance from the nearest of all sites, larger than
    //!                  any rounding of it.
    //! \param work_cap  the most windows that may be served through one half-edge in order of
    //!                  buckets; if more are, the run starts again with the nearest window first.
    //! \throw Cancelled  the next run begins anew.
    void run(const SurfacePoint& site, std::span<const float> bounds, Index work_cap);

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
    //! Calls each(half_edge, windows) for the half-edges that windows came through.
    template <typename Each>
    void for_each_half_edge(const Each& each) const {
        for (const EdgeRecord& e : edges_) {
            if (e.windows != no_index) each(e.half_edge, windows_of(e.windows));
        }
    }

    //! Vertices whose bounds mattered, and half-edges, have places in the order in which the last
    //! run came to them.
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
        return run == no_index ? std::span<const Window>() : windows_of(run);
    }

    //! Largest error of a window that was merged in the last run over its least distance; 0 if none
    //! was.
    [[nodiscard]] double relative_error() const { return relative_error_; }
    //! Windows served in the last run.
    [[nodiscard]] std::size_t num_windows() const { return num_served_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    // In which order half-edges are served. Any order gives the same distances up to rounding.
    enum class Order : std::uint8_t {
        Buckets,  // By a third of the mean edge length: quick, but how often a half-edge is served
                  // has no useful bound.
        Nearest,  // Nearest window first: slower, and bounded as in [mitchell1987].
    };
    struct EdgeRecord {
        Index half_edge;
        Index tail, head;                 // Records of its ends.
        Index waiting = no_index;         // List of runs of windows.
        Index windows = no_index;         // Run: the envelope of those that came.
        Index bucket = no_index;          // Where the half-edge waits.
        Index num_served = 0;             // Windows, against the cap.
        double apex_distance = infinity;  // Best distance of the opposite corner through this edge,
        double apex_ray = 0;              // and where its ray crosses the edge.
    };
    struct VertexRecord {
        Index vertex;
        double bound;                    // The lower of the two that follow.
        double outer_bound;              // Given by the caller.
        double upper = infinity;         // Of a path from this site.
        double low = infinity;           // Least that a window gives.
        double last_arrival = infinity;  // The last one that may turn here,
        Index num_turns = 0;             // and how many there were.
    };
    // Windows of a half-edge in ascending order along it. Their place has room for the next power
    // of two.
    struct Run {
        Index first;  // In pool_.
        Index count;
        Index next;
    };
    // The part of a window up to or from a limit, which may be the ray to the apex.
    struct Part {
        const Window* window = nullptr;  // In pool_.
        double limit = 0;
        bool is_apex = false;
    };
    // What of a window goes on through the other two half-edges.
    struct Division {
        Part right, left;
    };
    // Paths that arrive at a vertex around which they may turn.
    struct Turn {
        Index vertex;     // Its record.
        Index half_edge;  // Leaves the vertex; no_index: the direction is not known.
        Vec2 arrival;     // Towards where they come from, in the frame of the half-edge.
        double distance;
    };
    struct Face;

    [[nodiscard]] bool run_in(Order order, const SurfacePoint& site, Index work_cap);
    void start(const SurfacePoint& site);
    [[nodiscard]] Index vertex_record(Index vertex);
    [[nodiscard]] Index edge_record(Index half_edge, Index tail, Index head);
    void reach_vertex(Index record, double distance, float error, Index half_edge,
                      const Vec2& arrival);
    void bound_vertex(Index record, double distance);
    void send(Index half_edge, Index tail, Index head, std::span<const Window> windows);
    [[nodiscard]] std::span<const Window> windows_of(Index run) const {
        return {&pool_[runs_[run].first], runs_[run].count};
    }
    [[nodiscard]] Index take_run(Index count);
    void give_back(Index run);
    void schedule(Index item, Index& bucket, double distance);
    [[nodiscard]] bool next_item(Index& item);
    void prefetch(Index item) const;
    void serve_edge(Index record);
    void take_in(EdgeRecord& edge, const Face& face);
    void merge_neighbours();
    void reach_bent(const Face& face, double distance, double at, float error);
    [[nodiscard]] Division divide(Window& window, EdgeRecord& edge, const Face& face);
    [[nodiscard]] static bool lives(const Window& child, double begin_bound, double end_bound,
                                    double length, double spare, double to_corner);
    [[nodiscard]] static bool pass_right(const Part& part, const Face& face, Window& child);
    [[nodiscard]] static bool pass_left(const Part& part, const Face& face, Window& child);
    void emit(const Turn& turn);
    bool emit_fan(Index first, const Vec2* from, Index last, const Vec2* to, const VertexRecord& v);
    void emit_into(Index half_edge, double weight, float error, const Vec2* from, const Vec2* to);

    const Surface& surface_;
    const Corners& corners_;
    double per_bucket_;
    double max_error_;
    Ticker ticker_;
    std::span<const float> bounds_;
    Order queue_order_ = Order::Buckets;

    std::vector<Index> vertex_slot_;  // #V, #H: the record, if that record names it.
    std::vector<Index> edge_slot_;
    RunArray<VertexRecord> vertices_;
    RunArray<EdgeRecord> edges_;
    RunArray<Turn> turns_;
    RunArray<Window> pool_;
    RunArray<Run> runs_;
    std::array<Index, 33> free_runs_;  // By size class: list of runs.
    std::vector<Window> envelope_, scratch_;
    RunArray<const Window*> order_;
    RunArray<Division> divisions_;
    RunArray<Window> children_;
    std::vector<std::vector<Index>> buckets_;
    std::vector<std::pair<double, Index>> heap_;  // Order::Nearest.
    Index current_bucket_ = 0;
    Index next_in_bucket_ = 0;
    std::size_t num_waiting_ = 0;
    double relative_error_ = 0;
    std::size_t num_served_ = 0;
};

}  // namespace agvd
