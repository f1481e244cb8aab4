//! \file
//! The state of one run of the window engine: plain structs, which the passes of a run work on.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "agvd/propagation/corners.h"
#include "agvd/propagation/window/front_records.h"
#include "agvd/propagation/window/window_face.h"
#include "agvd/propagation/window/window_queue.h"
#include "agvd/propagation/window/window_store.h"

namespace agvd {

//! True for the faces whose windows are asked for after the run; empty: for all.
using KeptFaces = std::function<bool(Index face)>;

//! What the passes of a run only read.
struct FrontInput {
    const Surface& surface;
    const Corners& corners;  //!< Corners(surface).
    double max_error;        //!< Relative; 0: no window is merged.
    //! A run of no more half-edges gives no windows back.
    Index small_run;
    std::span<const float> bounds = {};  //!< #V, as in WindowFront::run().
    const KeptFaces* keeps = nullptr;    //!< Null: all.
};

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

struct FrontState {
    FrontInput input;
    WindowQueue queue;
    Ticker ticker = {};
    VertexTable vertices = {};
    EdgeTable edges = {};
    PseudoSourceTable pseudo_sources = {};
    WindowStore store = {};
    WatchList watched = {};
    FrontScratch scratch = {};
    double relative_error = 0;   //!< As WindowFront::relative_error().
    std::size_t num_served = 0;  //!< Windows.
};

//! A state in which nothing has started.
[[nodiscard]] FrontState make_front_state(const FrontInput& input, Ticker ticker);
//! Prepares the next run. Keeps the memory.
void reset(FrontState& front, WindowQueue::Order order);
[[nodiscard]] std::size_t bytes(const FrontState& front);

}  // namespace agvd
