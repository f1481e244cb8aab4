//! \file
//! The parts of sampling: two ways to place points inside a component (sampling.cpp chooses).
#pragma once

#include <algorithm>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "agvd/mesh/topology.h"
#include "agvd/propagation/distance_bounds.h"
#include "remesh/curves/curve_sites.h"
#include "remesh/sites/sites.h"

namespace remesh {

//! Places sites strictly inside the faces of a surface whose boundary has its sites already.
//! \param rim      sites on the boundary, from which inner ones keep a distance.
//! \param count    of inner sites; shared by how many each component lacks at this spacing.
//! \param spacing  > 0: of all sites, in mesh units or in local lengths.
//! \param options  num_samples and boundary are ignored.
//! \throw as sample_sites.
[[nodiscard]] std::vector<SurfacePoint> sample_inner_sites(const Surface& surface,
                                                           std::span<const SurfacePoint> rim,
                                                           Index count, double spacing,
                                                           const SamplingOptions& options);

namespace detail {

//! The index in a list of sums, each with its part, of a part drawn by size.
//! \param pick  uniform in [0, 1).
[[nodiscard]] inline std::size_t pick_by_sums(std::span<const double> sums, double pick) {
    const auto found = std::upper_bound(sums.begin(), sums.end() - 1, pick * sums.back());
    return static_cast<std::size_t>(found - sums.begin());
}

//! Draws `count` area-uniform points strictly inside faces, no two at one position; the same for
//! the same seed and stream. There are fewer only if the component is so small for its coordinates
//! that double holds no more. With options.sizes areas count in squares of the local length.
[[nodiscard]] std::vector<SurfacePoint> scatter(const Surface& surface, const Component& component,
                                                Index count, std::uint64_t stream,
                                                const SamplingOptions& options);

//! Weighted sample elimination ([yuksel2015]): removes the most crowded point (of equals the last)
//! until `keep` are left besides the last `num_fixed`, which stay.
//! \param spacing  distance of the kept points in the densest packing.
//! \param unit     #points: of distances between a point and its neighbours; empty: mesh units. It
//!                 must not change much over a spacing.
//! \return  the kept points in their old order, without the fixed ones.
//! Cost: O(M log M) for M = points.size() spread over the area.
[[nodiscard]] std::vector<SurfacePoint> eliminate(const Surface& surface,
                                                  std::span<const SurfacePoint> points,
                                                  Index num_fixed, Index keep, double spacing,
                                                  int num_threads, const Progress& progress = {},
                                                  std::span<const double> unit = {});

//! Farthest point sampling ([eldar1997], on surfaces [moenning2003]): places `count` points
//! strictly inside faces, each next to the vertex that is farthest from the earlier points and from
//! `fixed`; without fixed points the first one is random. Distances follow edges and lines across
//! them: a few per cent too long. Long edges are split first.
//! \param fixed    points of the component.
//! \param spacing  > 0: expected distance of neighbours at the end, in mesh units or in local
//!                 lengths, as distances are.
//! \return  points at different positions; fewer than `count` only if the component is so small for
//! its coordinates that double holds no more. The same for the same seed and stream, whatever
//! num_threads.
//! Cost: O(n log n) for the first half of the points, and the same again for each doubling.
[[nodiscard]] std::vector<SurfacePoint> farthest_points(
    const Surface& surface, const Component& component, std::span<const SurfacePoint> fixed,
    Index count, double spacing, std::uint64_t stream, const SamplingOptions& options);

//! A queue of numbers by a value that only falls, largest first, the highest number of equals. An
//! outdated entry is never too late in the queue; pop() queues it again.
template <typename ValueOf>
class FallingQueue {
public:
    FallingQueue(ValueOf value_of, std::span<const Index> numbers) : value_of_(value_of) {
        std::vector<Entry> entries;
        entries.reserve(numbers.size());
        for (const Index i : numbers) entries.emplace_back(value_of_(i), i);
        queue_ = std::priority_queue<Entry>({}, std::move(entries));
    }

    [[nodiscard]] bool is_empty() const { return queue_.empty(); }
    void push(Index number) { queue_.emplace(value_of_(number), number); }
    //! \pre not empty.
    //! Cost: O(log n) for each entry whose value has fallen since.
    [[nodiscard]] Index pop() {
        while (true) {
            const auto [value, number] = queue_.top();
            queue_.pop();
            if (value_of_(number) == value) return number;
            push(number);
        }
    }

private:
    using Entry = std::pair<std::invoke_result_t<ValueOf, Index>, Index>;

    ValueOf value_of_;
    std::priority_queue<Entry> queue_;
};

//! The distance of a vertex from all sites, while sites are added.
struct DistanceOfVertex {
    const BoundsSearch& search;
    std::span<const double> unit = {};  //!< #V: of the distance; empty: mesh units.

    float operator()(Index vertex) const {
        const float distance = search.distance(vertex);
        return unit.empty() ? distance : static_cast<float>(distance / unit[vertex]);
    }
};

//! Progress ticks for the search that follows each added site.
inline constexpr std::size_t search_work = 256;

//! The vertices that have faces, farthest first. Those that no site reaches are at infinity.
[[nodiscard]] inline FallingQueue<DistanceOfVertex> farthest_vertices(const Surface& surface,
                                                                      DistanceOfVertex distance) {
    std::vector<Index> vertices;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (surface.outgoing[v] != no_index) vertices.push_back(v);
    }
    return {distance, vertices};
}

}  // namespace detail
}  // namespace remesh
