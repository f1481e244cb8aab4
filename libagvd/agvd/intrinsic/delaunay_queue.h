//! \file
//! Makes a triangulation Delaunay by flips. Private.
#pragma once

#include <functional>
#include <utility>

#include "agvd/core/parallel.h"
#include "agvd/intrinsic/operations.h"

namespace agvd::detail {

//! The edges that fail the Delaunay condition. The edge that a flip shortens most is flipped first:
//! on needles that takes half the flips of first in, first out.
class DelaunayQueue {
public:
    //! \param history   records every flip; or null.
    //! \param ticker    outlives this: flips tick it; or null.
    //! \param may_flip  asked for the half-edge of an edge before it flips; or none.
    DelaunayQueue(Surface& surface, FaceCharts& charts, FaceHistory* history, Ticker* ticker,
                  std::function<bool(Index half_edge)> may_flip = {})
        : surface_(surface),
          charts_(charts),
          history_(history),
          ticker_(ticker),
          may_flip_(std::move(may_flip)) {}

    //! Tests an edge, and adds it to the queue if it fails.
    void push(Index edge) {
        const std::optional<Waiting> waiting = test(edge);
        if (!waiting) return;
        heap_.push_back(*waiting);
        std::push_heap(heap_.begin(), heap_.end());
    }
    //! The same for all edges. On a good mesh most of the work is this test, and few edges fail it.
    //! \param num_threads  0: all cores. The result is the same for any number.
    void push_all(int num_threads, Poller& poller) {
        const auto find = [&](Index e, std::vector<Waiting>& found) {
            if (surface_.edge_half[e] == no_index) return;  // The edge was removed.
            if (const auto waiting = test(e)) found.push_back(*waiting);
        };
        const std::vector<Waiting> found =
            parallel_collect<Waiting>(surface_.num_edges(), pass_grain, num_threads, find, poller);
        heap_.insert(heap_.end(), found.begin(), found.end());
        std::make_heap(heap_.begin(), heap_.end());
    }
    //! Until the queue is empty, or `most_flips` were made in all; false if edges are left.
    bool flip_all(std::size_t most_flips) {
        constexpr std::size_t flip_work = 16;  // Ticks of a flip.
        while (!heap_.empty()) {
            if (ticker_ != nullptr) ticker_->tick(flip_work);
            const Waiting next = heap_.front();
            std::pop_heap(heap_.begin(), heap_.end());
            heap_.pop_back();
            const Index h = surface_.edge_half[next.edge];
            if (h == no_index) continue;  // The edge was removed with a vertex.
            const Index twin = surface_.twin[h];
            if (twin == no_index || Surface::face(h) == Surface::face(twin)) continue;
            // If its faces have changed since, the edge is queued again if it still fails.
            if (quad_at(surface_, h).shortening() != next.shortening) continue;
            const Quad quad = quad_at(surface_, charts_, h);
            if (!quad.should_flip() || !quad.is_convex()) continue;
            if (num_flips_ == most_flips) return false;
            if (may_flip_ && !may_flip_(h)) continue;
            const std::array<Index, 2> faces{Surface::face(h), Surface::face(twin)};
            if (history_ != nullptr) history_->add(FaceFlip{h, twin, quad.shares()});
            flip(surface_, charts_, h, quad);
            ++num_flips_;
            for (const Index face : faces) {
                for (Index side = 3 * face; side < 3 * face + 3; ++side) {
                    if (surface_.edge[side] != next.edge) push(surface_.edge[side]);
                }
            }
        }
        return true;
    }

    [[nodiscard]] std::size_t num_flips() const { return num_flips_; }

private:
    struct Waiting {
        double shortening;  // The length after the flip over the length before.
        Index edge;

        // Reversed, so that the least is on top of a heap.
        [[nodiscard]] bool operator<(const Waiting& other) const {
            return shortening != other.shortening ? shortening > other.shortening
                                                  : edge > other.edge;
        }
    };

    [[nodiscard]] std::optional<Waiting> test(Index edge) const {
        const Index h = surface_.edge_half[edge];
        const Index twin = surface_.twin[h];
        if (twin == no_index || Surface::face(h) == Surface::face(twin)) return std::nullopt;
        const Quad quad = quad_at(surface_, h);
        if (!quad.should_flip()) return std::nullopt;
        return Waiting{quad.shortening(), edge};
    }

    Surface& surface_;
    FaceCharts& charts_;
    FaceHistory* history_;
    Ticker* ticker_;
    std::function<bool(Index half_edge)> may_flip_;
    std::vector<Waiting> heap_;
    std::size_t num_flips_ = 0;
};

}  // namespace agvd::detail
