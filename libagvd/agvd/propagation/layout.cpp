#include "agvd/propagation/layout.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "agvd/core/parallel.h"
#include "agvd/propagation/propagate.h"

namespace agvd {
namespace {

// Arcs are lengthened by this, which exceeds all roundings of an exact distance.
constexpr float arc_rounding = 1 + 0x1p-20F;

// From the apex of a half-edge's face straight to that across; below 0 where it misses the edge.
double flip_length(const Corners& corners, Index half_edge) {
    const double length = corners.length(half_edge);
    const Vec2 above = corners.apex(half_edge);
    const Vec2 across = corners.apex(corners.twin(half_edge));
    const Vec2 below(length - across.x(), -across.y());
    const double crossed = below.x() * above.y() - above.x() * below.y();
    if (crossed < 0 || crossed > length * (above.y() - below.y())) return -1;
    return (above - below).norm();
}

// By edges: a loop over half-edges would skip half. `is_shared`: other threads add arcs, too.
template <bool is_shared>
void add_arcs(const Surface& surface, const Corners& corners, Index begin, Index end,
              ArcGraph& graph) {
    const auto take_next = [&](Index vertex) {
        if constexpr (is_shared) {
            return std::atomic_ref(graph.ends[vertex]).fetch_add(1, std::memory_order_relaxed);
        }
        return graph.ends[vertex]++;
    };
    const auto add = [&](Index a, Index b, double length) {
        const float rounded = static_cast<float>(length) * arc_rounding;
        graph.arcs[take_next(a)] = {b, rounded};
        graph.arcs[take_next(b)] = {a, rounded};
    };
    constexpr Index ahead = 15;  // Edges.
    for (Index e = begin; e < end; ++e) {
        if (e + ahead < surface.num_edges()) {
            const Index twin = surface.twin[surface.edge_half[e + ahead]];
            if (twin != no_index) corners.prefetch(Surface::face(twin));
        }
        const Index h = surface.edge_half[e];
        const Index twin = surface.twin[h];
        add(corners.tail(h), corners.head(h), surface.length[e]);
        if (twin == no_index) continue;
        const double length = flip_length(corners, h);
        if (length > 0) add(corners.apex_vertex(h), corners.apex_vertex(twin), length);
    }
}

}  // namespace

Corners::Corners(const Surface& surface, int num_threads, const Progress& progress)
    : num_half_edges_(surface.twin.size()),
      corners_(std::make_unique_for_overwrite<Corner[]>(num_half_edges_)) {
    Poller poller(progress);
    std::vector<double> sums(num_chunks(surface.num_faces(), pass_grain), 0);
    parallel_chunks(
        surface.num_faces(), pass_grain, num_threads,
        [&](Index chunk, Index begin, Index end) {
            for (Index h = 3 * begin; h < 3 * end; ++h) {
                const double length = surface.length_of(h);
                corners_[h] = {surface.apex[h] / length, length, surface.twin[h], surface.tail(h)};
                sums[chunk] += length;
            }
        },
        poller);
    const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    mean_length_ = sum / static_cast<double>(std::max<std::size_t>(num_half_edges_, 1));
}

Corners Corners::cut_along(std::span<const Index> cut) const {
    Corners result;
    result.num_half_edges_ = num_half_edges_;
    result.mean_length_ = mean_length_;
    result.corners_ = std::make_unique_for_overwrite<Corner[]>(num_half_edges_);
    std::copy_n(corners_.get(), num_half_edges_, result.corners_.get());
    for (const Index h : cut) result.corners_[h].twin = no_index;
    return result;
}

ArcGraph::ArcGraph(const Surface& surface, const Corners& corners, int num_threads,
                   const Progress& progress)
    : offsets(surface.num_vertices() + 1, 0) {
    Poller poller(progress);
    Ticker ticker(poller);
    // An edge and a flip for each face, and one edge more on the boundary.
    for_each_ticked(surface.mesh.triangles, ticker, [&](const Triangle& triangle) {
        for (const Index v : triangle) offsets[v + 1] += 2;
    });
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        offsets[v + 1] += offsets[v] + (surface.is_boundary_vertex(v) ? 1 : 0);
    }
    ticker.poll();
    ends.assign(offsets.begin(), offsets.end() - 1);
    arcs = std::make_unique_for_overwrite<Arc[]>(offsets.back());
    const auto body = [&](Index, Index begin, Index end) {
        if (num_threads == 1) {
            add_arcs<false>(surface, corners, begin, end, *this);
        } else {
            add_arcs<true>(surface, corners, begin, end, *this);
        }
    };
    parallel_chunks(surface.num_edges(), pass_grain, num_threads, body, poller);
}

SurfaceLayout::SurfaceLayout(const Surface& surface, int num_threads, const Progress& progress)
    : corners_(std::make_shared<const Corners>(surface, num_threads, progress)),
      arcs_(std::make_shared<const ArcGraph>(surface, *corners_, num_threads, progress)) {}

}  // namespace agvd
