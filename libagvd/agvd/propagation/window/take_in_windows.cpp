// Merges the windows that wait at a half-edge into its lower envelope. Windows that lose to the
// bounds of the edge's ends are dropped: one comparison, where the paths from both ends meet,
// decides for the whole interval. Windows mostly come in order along the edge, and one cut between
// neighbours is enough; the others are inserted one by one. At last neighbours that have not been
// served are merged as far as the error allows.
#include "agvd/propagation/window/take_in_windows.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "agvd/propagation/window/window_envelope.h"

namespace agvd {
namespace {

// Where the paths around the half-edge's ends meet.
double meeting_point(const WindowFace& face) {
    return (face.head_bound + face.length - face.tail_bound) / 2;
}

// By the paths around the half-edge's ends, which meet at `middle`.
bool is_beaten(const Window& w, const WindowFace& face, double middle) {
    const double at = std::min(std::max(w.begin, middle), w.end);
    const double around = std::min(face.tail_bound + at, face.head_bound + face.length - at) -
                          w.weight + path_rounding * (w.at_begin + face.length);
    return (around <= 0) | (around * around < (at - w.x) * (at - w.x) + w.y * w.y);
}

// Cuts a window off from the last one of an envelope; it ends where it begins if nothing is left.
// False if that is not enough.
bool comes_in_order(std::span<Window> envelope, Window& window) {
    const std::size_t size = envelope.size();
    if (size == 0 || !(envelope[size - 1].end > window.begin)) return true;
    if (size > 1 && envelope[size - 2].end > window.begin) return false;
    return cut_where_they_change(envelope[size - 1], window);
}

// Copies all windows, in order of their beginnings, into one run. Where windows begin together, the
// envelope's come first and then the last that came. The other runs are given back.
Index gather(FrontState& front, Index waiting, Index envelope) {
    WindowStore& store = front.store;
    RunArray<const Window*>& order = front.scratch.order;
    order.clear();
    if (envelope != no_index) {
        for (const Window& window : store[envelope]) order.push(&window);
    }
    for (Index run = waiting; run != no_index; run = store.next(run)) {
        for (const Window& window : store[run]) {
            Index place = order.extend(1);
            for (; place > 0 && window.begin < order[place - 1]->begin; --place) {
                order[place] = order[place - 1];
            }
            order[place] = &window;
        }
    }
    const Index all = store.take(order.size());
    Window* to = store[all].data();
    for (const Window* window : order) *to++ = *window;
    for (Index run = waiting; run != no_index;) {
        store.give_back(std::exchange(run, store.next(run)));
    }
    if (envelope != no_index) store.give_back(envelope);
    return all;
}

// Merges neighbours that are not served, as far as the error allows.
// \return how many windows are left.
Index merge_neighbours(FrontState& front, std::span<Window> windows) {
    Index kept = 0;
    for (Index i = 1; i < windows.size(); ++i) {
        Window& last = windows[kept];
        const Window& next = windows[i];
        if (!last.is_served && !next.is_served) {
            if (const auto merged = merge_windows(last, next, front.input.max_error)) {
                last = *merged;
                front.relative_error = std::max(front.relative_error, last.error / last.nearest());
                continue;
            }
        }
        windows[++kept] = next;
    }
    return kept + 1;
}

// \return the run of the envelope, of which `count` windows are left; no_index: none.
Index settle(FrontState& front, Index run, Index count) {
    if (front.input.max_error > 0 && count > 0) {
        count = merge_neighbours(front, front.store[run].first(count));
    }
    if (count == 0) {
        front.store.give_back(run);
        return no_index;
    }
    front.store.resize(run, count);
    assert(is_envelope(front.store[run]));
    return run;
}

// Inserts the windows of a run from place i on into the envelope that the first `kept` are: they
// do not come in order.
Index insert_rest(FrontState& front, Index run, Index kept, Index i, const WindowFace& face) {
    const std::span<Window> windows = front.store[run];
    const double middle = meeting_point(face);
    std::vector<Window>& envelope = front.scratch.envelope;
    envelope.assign(windows.begin(), windows.begin() + kept);
    for (; i < windows.size(); ++i) {
        Window& w = windows[i];
        if (!w.is_served && is_beaten(w, face, middle)) continue;
        if (!comes_in_order(envelope, w)) {
            insert_window(w, front.scratch.insertion, envelope);
        } else if (w.begin < w.end) {
            envelope.push_back(w);
        }
    }
    const auto count = static_cast<Index>(envelope.size());
    if (count > front.store.room(run)) {
        front.store.give_back(run);
        run = front.store.take(count);
    }
    front.store.resize(run, count);
    std::copy(envelope.begin(), envelope.end(), front.store[run].begin());
    return settle(front, run, count);
}

}  // namespace

void take_in_windows(FrontState& front, EdgeRecord& edge, const WindowFace& face) {
    assert(edge.half_edge == face.half_edge && edge.waiting != no_index);
    const Index waiting = std::exchange(edge.waiting, no_index);
    Index run = waiting;
    if (edge.windows != no_index || front.store.next(waiting) != no_index) {
        run = gather(front, waiting, edge.windows);
        edge.windows = no_index;
    }
    const std::span<Window> windows = front.store[run];
    const double middle = meeting_point(face);
    Index kept = 0;
    for (Index i = 0; i < windows.size(); ++i) {
        Window& w = windows[i];
        // The envelope's own are served and stay.
        if (!w.is_served && is_beaten(w, face, middle)) continue;
        if (!comes_in_order(windows.first(kept), w)) {
            edge.windows = insert_rest(front, run, kept, i, face);
            return;
        }
        if (w.begin == w.end) continue;
        if (kept < i) windows[kept] = w;
        ++kept;
    }
    edge.windows = settle(front, run, kept);
}

}  // namespace agvd
