//! \file
//! The vertex farthest from all sites, while sites are added.
#pragma once

#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "agvd/propagation/distance_bounds.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Progress ticks for the search that follows each added site.
inline constexpr std::size_t search_work = 256;

//! A queue of vertices by distance, farthest first. Distances only decrease, so an outdated entry
//! is never too late in the queue; pop() queues it again.
class FarthestVertex {
public:
    //! \param search  of the surface; outlives this. Sites may be added and run at any time.
    //! \param unit    #V: of the distance at each vertex; empty: mesh units. Outlives this.
    //! Cost: O(#V).
    FarthestVertex(const Surface& surface, const BoundsSearch& search,
                   std::span<const double> unit = {})
        : search_(search), unit_(unit) {
        std::vector<Entry> entries;
        entries.reserve(surface.num_vertices());
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            if (surface.outgoing[v] != no_index) entries.emplace_back(distance(v), v);
        }
        queue_ = std::priority_queue<Entry>({}, std::move(entries));
    }

    [[nodiscard]] bool is_empty() const { return queue_.empty(); }

    //! Removes and returns the farthest vertex in the queue: the highest index of equals. Vertices
    //! that no site reaches are at infinity.
    //! \pre not empty.
    //! Cost: O(log #V) for each vertex that has come nearer since.
    [[nodiscard]] Index pop() {
        while (true) {
            const auto [distance, v] = queue_.top();
            queue_.pop();
            if (this->distance(v) == distance) return v;
            push(v);
        }
    }
    void push(Index vertex) { queue_.emplace(distance(vertex), vertex); }

private:
    using Entry = std::pair<float, Index>;

    [[nodiscard]] float distance(Index vertex) const {
        const float distance = search_.distance(vertex);
        return unit_.empty() ? distance : static_cast<float>(distance / unit_[vertex]);
    }

    const BoundsSearch& search_;
    std::span<const double> unit_;
    std::priority_queue<Entry> queue_;
};

}  // namespace remesh::detail
