#include "agvd/propagation/distance_bounds.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

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

struct Arc {
    Index head;
    float length;
};

// Arcs of each vertex side by side.
struct ArcGraph {
    std::vector<Index> offsets;  // #V + 1
    std::vector<Index> ends;     // #V: some places stay empty.
    std::vector<Arc> arcs;

    void add(Index tail, Index head, double length) {
        arcs[ends[tail]++] = {head, static_cast<float>(length) * round_up};
    }
    void prefetch(Index tail) const {
        __builtin_prefetch(&arcs[offsets[tail]]);
        __builtin_prefetch(&arcs[offsets[tail] + 8]);
    }
};

// The straight line from the apex of a half-edge's face to the apex across it; below 0 where it
// misses the edge.
double flip_length(const Corners& corners, Index half_edge) {
    const double length = corners.length(half_edge);
    const Vec2 above = corners.apex(half_edge);
    const Vec2 across = corners.apex(corners.twin(half_edge));
    const Vec2 below(length - across.x(), -across.y());
    const double crossed = below.x() * above.y() - above.x() * below.y();
    if (crossed < 0 || crossed > length * (above.y() - below.y())) return -1;
    return (above - below).norm();
}

ArcGraph build_graph(const Surface& surface, const Corners& corners) {
    ArcGraph graph;
    graph.offsets.assign(surface.num_vertices() + 1, 0);
    const auto num_half_edges = static_cast<Index>(surface.twin.size());
    // An edge and a flip for each half-edge that leaves, and the last edge on the boundary.
    for (Index h = 0; h < num_half_edges; ++h) {
        graph.offsets[corners.tail(h) + 1] += 2;
        if (corners.twin(h) == no_index) ++graph.offsets[corners.head(h) + 1];
    }
    for (Index v = 0; v < surface.num_vertices(); ++v) graph.offsets[v + 1] += graph.offsets[v];
    graph.ends.assign(graph.offsets.begin(), graph.offsets.end() - 1);
    graph.arcs.resize(graph.offsets.back());
    for (Index h = 0; h < num_half_edges; ++h) {
        if (h + 30 < num_half_edges) {
            const Index ahead = corners.twin(h + 30);
            if (ahead != no_index) corners.prefetch(Surface::face(ahead));
        }
        const Index tail = corners.tail(h);
        const Index head = corners.head(h);
        const Index twin = corners.twin(h);
        graph.add(tail, head, corners.length(h));
        if (twin == no_index) {
            graph.add(head, tail, corners.length(h));
        } else if (h < twin) {
            const double length = flip_length(corners, h);
            if (!(length > 0)) continue;
            graph.add(corners.apex_vertex(h), corners.apex_vertex(twin), length);
            graph.add(corners.apex_vertex(twin), corners.apex_vertex(h), length);
        }
    }
    return graph;
}

// Label-correcting in buckets of distance; the vertices of a bucket are relaxed side by side.
class BoundsFront {
public:
    BoundsFront(const Surface& surface, const Corners& corners, int num_threads)
        : graph_(build_graph(surface, corners)),
          num_threads_(num_threads),
          keys_(surface.num_vertices(), to_key(infinity, no_index)),
          queued_in_(surface.num_vertices(), no_index) {
        const double sum = std::accumulate(surface.length.begin(), surface.length.end(), 0.0);
        constexpr double share = 0.5;  // Of the mean edge.
        per_bucket_ = static_cast<float>(surface.num_edges() / (share * sum));
    }

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
        bounds.peak_bytes = graph_.arcs.capacity() * sizeof(Arc) +
                            keys_.size() * (5 * sizeof(Index) + sizeof(Key) + sizeof(float));
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
            const Arc& arc = graph_.arcs[i];
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

    ArcGraph graph_;
    int num_threads_;
    float per_bucket_;
    std::vector<Key> keys_;         // #V
    std::vector<Index> queued_in_;  // #V: the bucket in which a vertex waits.
    std::vector<std::vector<Index>> buckets_;
    Index current_ = 0;
};

}  // namespace

DistanceBounds distance_bounds(const Surface& surface, const Corners& corners,
                               std::span<const SurfacePoint> sites, int num_threads) {
    BoundsFront front(surface, corners, num_threads);
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
