// Dijkstra's algorithm over the edges of a mesh, with an indexed 4-ary heap: the unit P0 in which
// benchmarks give times. It is written for speed, so that the unit is a fair one: flat arrays of
// arcs, lengths in float, memory that is used again.
#include "bench/p0.h"

#include <algorithm>
#include <limits>

#include "bench/timing.h"
#include "bench/workload.h"

namespace bench {
namespace {

using agvd::Index;
using agvd::no_index;

// Min-heap of vertices by their distance, with the place of each vertex, so that it can be moved
// up.
class VertexHeap {
public:
    VertexHeap(const std::vector<double>& key, Index num_vertices)
        : key_(key), place_(num_vertices, no_index) {}

    [[nodiscard]] bool empty() const { return heap_.empty(); }

    // The vertex's key is new or has decreased.
    void update(Index vertex) {
        Index at = place_[vertex];
        if (at == no_index) {
            at = static_cast<Index>(heap_.size());
            heap_.push_back(vertex);
        }
        const double key = key_[vertex];
        while (at > 0) {
            const Index parent = (at - 1) / 4;
            if (key_[heap_[parent]] <= key) break;
            put(at, heap_[parent]);
            at = parent;
        }
        put(at, vertex);
    }

    Index pop() {
        const Index top = heap_.front();
        place_[top] = no_index;
        const Index last = heap_.back();
        heap_.pop_back();
        if (!heap_.empty()) sink(last);
        return top;
    }

private:
    // Fills the hole at the root, children moving up, until `vertex` fits.
    void sink(Index vertex) {
        const double key = key_[vertex];
        const auto size = static_cast<Index>(heap_.size());
        Index at = 0;
        for (Index child = 1; child < size; child = 4 * at + 1) {
            const Index end = std::min(child + 4, size);
            Index least = child;
            double least_key = key_[heap_[child]];
            for (Index i = child + 1; i < end; ++i) {
                const double other = key_[heap_[i]];
                if (other < least_key) {
                    least = i;
                    least_key = other;
                }
            }
            if (least_key >= key) break;
            put(at, heap_[least]);
            at = least;
        }
        put(at, vertex);
    }

    void put(Index at, Index vertex) {
        heap_[at] = vertex;
        place_[vertex] = at;
    }

    const std::vector<double>& key_;
    std::vector<Index> heap_;
    std::vector<Index> place_;  // #V: index in heap_; no_index outside.
};

}  // namespace

EdgeGraph edge_graph(const agvd::Surface& surface) {
    EdgeGraph graph;
    graph.offsets.assign(surface.num_vertices() + 1, 0);
    for (const Index h : surface.edge_half) {
        ++graph.offsets[surface.tail(h) + 1];
        ++graph.offsets[surface.head(h) + 1];
    }
    for (Index v = 0; v < surface.num_vertices(); ++v) graph.offsets[v + 1] += graph.offsets[v];
    graph.arcs.resize(graph.offsets.back());
    std::vector<Index> next(graph.offsets.begin(), graph.offsets.end() - 1);
    for (const Index h : surface.edge_half) {
        const Index a = surface.tail(h);
        const Index b = surface.head(h);
        const auto length = static_cast<float>(surface.length_of(h));
        graph.arcs[next[a]++] = {b, length};
        graph.arcs[next[b]++] = {a, length};
    }
    return graph;
}

void sweep(const EdgeGraph& graph, std::span<const Index> sources, Sweep& result) {
    const auto num_vertices = static_cast<Index>(graph.offsets.size() - 1);
    result.distance.assign(num_vertices, std::numeric_limits<double>::infinity());
    result.label.assign(num_vertices, no_index);
    VertexHeap heap(result.distance, num_vertices);
    for (Index s = 0; s < sources.size(); ++s) {
        if (result.label[sources[s]] != no_index) continue;
        result.distance[sources[s]] = 0;
        result.label[sources[s]] = s;
        heap.update(sources[s]);
    }
    while (!heap.empty()) {
        const Index v = heap.pop();
        const double distance = result.distance[v];
        const Index label = result.label[v];
        for (Index i = graph.offsets[v]; i < graph.offsets[v + 1]; ++i) {
            const auto [head, length] = graph.arcs[i];
            const double through = distance + static_cast<double>(length);
            if (through < result.distance[head]) {
                result.distance[head] = through;
                result.label[head] = label;
                heap.update(head);
            }
        }
    }
}

P0::P0(const agvd::Surface& surface, std::span<const agvd::SurfacePoint> sites)
    : graph_(edge_graph(surface)) {
    for (const agvd::SurfacePoint& site : sites) sources_.push_back(nearest_corner(surface, site));
    sweep(graph_, sources_, sweep_);  // The first sweep also allocates memory, so it is not timed.
}

SweepSeconds P0::seconds() {
    constexpr int most_sweeps = 5;
    constexpr double long_enough = 0.5;
    std::vector<double> taken;
    double sum = 0;
    for (int i = 0; i < most_sweeps && sum < long_enough; ++i) {
        taken.push_back(time([this] { sweep(graph_, sources_, sweep_); }).cpu);
        sum += taken.back();
    }
    return {quickest(taken), median(taken)};
}

}  // namespace bench
