#include "agvd/propagation/distance_bounds.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "agvd/core/parallel.h"
#include "agvd/propagation/site_placement.h"

namespace agvd {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
// Each step is rounded up by more than all roundings of the exact distance.
constexpr float round_up = 1 + 0x1p-20F;

// Distance and site in one number, in the order of (distance, site): floats above 0 are ordered
// like their bits.
using Key = std::uint64_t;

Key to_key(float distance, Index site) {
    return Key{std::bit_cast<std::uint32_t>(distance)} << 32 | site;
}
float distance_of(Key key) { return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32)); }
Index site_of(Key key) { return static_cast<Index>(key); }

// Label-correcting in buckets of distance; the vertices of a bucket are relaxed side by side.
class BoundsFront {
public:
    BoundsFront(const ArcGraph& graph, double mean_edge, int num_threads)
        : graph_(graph),
          num_threads_(num_threads),
          per_bucket_(static_cast<float>(2 / mean_edge)),
          keys_(graph.ends.size(), to_key(infinity, no_index)),
          queued_in_(keys_.size(), no_index) {}

    void start(Index vertex, double distance, Index site) {
        const Key key = to_key(static_cast<float>(distance) * round_up, site);
        if (key >= keys_[vertex]) return;
        keys_[vertex] = key;
        queue(vertex);
    }

    void run() {
        constexpr Index grain = 512;
        std::vector<Index> bucket;
        std::vector<std::vector<Index>> changed;
        for (; current_ < buckets_.size(); ++current_) {
            while (!buckets_[current_].empty()) {
                bucket.clear();
                for (const Index v : buckets_[current_]) {
                    if (queued_in_[v] != current_) continue;
                    queued_in_[v] = no_index;
                    bucket.push_back(v);
                }
                buckets_[current_].clear();
                const auto count = static_cast<Index>(bucket.size());
                changed.resize(num_chunks(count, grain));
                parallel_chunks(count, grain, num_threads_,
                                [&](Index chunk, Index begin, Index end) {
                                    changed[chunk].clear();
                                    for (Index i = begin; i < end; ++i) {
                                        if (i + 4 < end) graph_.prefetch(bucket[i + 4]);
                                        relax_arcs(bucket[i], changed[chunk]);
                                    }
                                });
                for (const auto& part : changed) {
                    for (const Index v : part) queue(v);
                }
            }
            std::vector<Index>().swap(buckets_[current_]);
        }
    }

    [[nodiscard]] DistanceBounds result() const {
        DistanceBounds bounds;
        bounds.distance.reserve(keys_.size());
        bounds.site.reserve(keys_.size());
        for (const Key key : keys_) {
            bounds.distance.push_back(distance_of(key));
            bounds.site.push_back(site_of(key));
        }
        bounds.peak_bytes = keys_.size() * (3 * sizeof(Index) + sizeof(Key) + sizeof(float));
        return bounds;
    }

private:
    void queue(Index vertex) {
        constexpr float last_bucket = 1 << 20;
        const float place = std::min(distance_of(keys_[vertex]) * per_bucket_, last_bucket);
        const Index bucket = std::max(static_cast<Index>(place), current_);
        if (queued_in_[vertex] <= bucket) return;
        queued_in_[vertex] = bucket;
        if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
        buckets_[bucket].push_back(vertex);
    }

    void relax_arcs(Index vertex, std::vector<Index>& changed) {
        constexpr auto relaxed = std::memory_order_relaxed;
        const Key from = std::atomic_ref(keys_[vertex]).load(relaxed);
        for (Index i = graph_.offsets[vertex]; i < graph_.ends[vertex]; ++i) {
            const ArcGraph::Arc& arc = graph_.arcs[i];
            const Key key = to_key(distance_of(from) + arc.length, site_of(from));
            std::atomic_ref best(keys_[arc.head]);
            Key old = best.load(relaxed);
            while (key < old) {
                if (best.compare_exchange_weak(old, key, relaxed)) {
                    changed.push_back(arc.head);
                    break;
                }
            }
        }
    }

    const ArcGraph& graph_;
    int num_threads_;
    float per_bucket_;
    std::vector<Key> keys_;         // #V
    std::vector<Index> queued_in_;  // #V: the bucket in which a vertex waits.
    std::vector<std::vector<Index>> buckets_;
    Index current_ = 0;
};

}  // namespace

DistanceBounds distance_bounds(const Surface& surface, const ArcGraph& graph, double mean_edge,
                               std::span<const SurfacePoint> sites, int num_threads) {
    BoundsFront front(graph, mean_edge, num_threads);
    for (Index s = 0; s < sites.size(); ++s) {
        if (const auto vertex = vertex_of(surface, sites[s])) {
            front.start(*vertex, 0, s);
            continue;
        }
        const auto start_in_face = [&](const SurfacePoint& point) {
            for (Index k = 0; k < 3; ++k) {
                const Index h = 3 * point.face.value() + k;
                front.start(surface.tail(h), position_in_frame(surface, point, h).norm(), s);
            }
        };
        start_in_face(sites[s]);
        const auto half_edge = half_edge_of(sites[s]);
        if (half_edge && surface.twin[*half_edge] != no_index) {
            start_in_face(across_edge(surface, sites[s], *half_edge));
        }
    }
    front.run();
    return front.result();
}

}  // namespace agvd
