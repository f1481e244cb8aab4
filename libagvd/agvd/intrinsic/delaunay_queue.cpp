#include "agvd/intrinsic/delaunay_queue.h"

#include <algorithm>

namespace agvd::detail {

void DelaunayQueue::push(Index edge) {
    const Index h = surface_.edge_half[edge];
    const Index twin = surface_.twin[h];
    if (twin == no_index || Surface::face(h) == Surface::face(twin)) return;
    if (!is_kept_.empty() && is_kept_[edge] != 0) return;
    const Quad quad = quad_at(surface_, h);
    if (!quad.should_flip()) return;
    heap_.push_back({quad.shortening(), edge});
    std::push_heap(heap_.begin(), heap_.end());
}

bool DelaunayQueue::flip_all(std::size_t most_flips) {
    constexpr std::size_t flip_work = 16;  // Steps that a flip counts for.
    while (!heap_.empty()) {
        if (ticker_ != nullptr) ticker_->tick(flip_work);
        const Waiting next = heap_.front();
        std::pop_heap(heap_.begin(), heap_.end());
        heap_.pop_back();
        const Index h = surface_.edge_half[next.edge];
        if (h == no_index) continue;  // The edge went with a vertex.
        const Index twin = surface_.twin[h];
        if (twin == no_index || Surface::face(h) == Surface::face(twin)) continue;
        // Where its faces have changed since, the edge waits once more if it fails still.
        if (quad_at(surface_, h).shortening() != next.shortening) continue;
        const Quad quad = quad_at(surface_, charts_, h);
        if (!quad.should_flip() || !quad.is_convex()) continue;
        if (num_flips_ == most_flips) return false;
        if (may_flip_ && !may_flip_(h)) continue;
        const std::array<Index, 2> faces{Surface::face(h), Surface::face(twin)};
        if (history_ != nullptr) history_->add_flip(h, twin, quad.shares());
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

}  // namespace agvd::detail
