//! \file
//! Exact or error-bounded distances from one site, as far as it can be the nearest: windows through
//! a bucketed queue of half-edges.
#pragma once

#include <limits>
#include <span>

#include "agvd/mesh/mesh.h"
#include "agvd/propagation/window/front_state.h"

namespace agvd {

//! Runs from site to site, and what the last run found. A run reuses the memory of the one before.
//! Not for use by two threads at once.
class WindowFront {
public:
    //! \param surface, corners  outlive the front; Corners(surface).
    //! \param max_error    relative; 0: no window is merged.
    //! \param ticker       of the thread that runs it.
    //! \param small_run    half-edges of a run that gives no windows back; the default fits into
    //!                     the caches as it is.
    WindowFront(const Surface& surface, const Corners& corners, double max_error,
                Ticker ticker = {}, Index small_run = 2048)
        : state_(make_front_state({surface, corners, max_error, small_run}, ticker)) {}

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
        for (const VertexRecord& v : state_.vertices.records) {
            if (is_reached(v)) each(ReachedVertex{v.vertex, v.upper});
        }
    }
    //! Calls each(half_edge, windows) for the half-edges that windows came through, in the order in
    //! which the run came to them: all into kept faces, some into others.
    template <typename Each>
    void for_each_half_edge(const Each& each) const {
        const EdgeTable& edges = state_.edges;
        const auto tell = [&](const EdgeRecord& e) {
            if (e.windows != no_index) each(e.half_edge, state_.store[e.windows]);
        };
        if (edges.num_arrivals == edges.records.size()) {
            for (const EdgeRecord& e : edges.records) tell(e);
        } else {
            for (const Index record : edges.by_arrival()) tell(edges.records[record]);
        }
    }

    //! Largest error of a window that was merged in the last run over its least distance; 0 if none
    //! was.
    [[nodiscard]] double relative_error() const { return state_.relative_error; }
    //! Windows served in the last run.
    [[nodiscard]] std::size_t num_windows() const { return state_.num_served; }
    [[nodiscard]] std::size_t bytes() const { return agvd::bytes(state_); }

private:
    [[nodiscard]] static bool is_reached(const VertexRecord& v) {
        return std::min(v.low, v.upper) <= v.outer_bound;
    }

    FrontState state_;
};

}  // namespace agvd
