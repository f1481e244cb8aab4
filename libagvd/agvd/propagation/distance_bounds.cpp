// A label-correcting search over the arcs of ArcGraph in slabs of distance, whose vertices threads
// search in chunks. A vertex holds distance and site in one 64-bit number, which threads lower
// atomically: the least one is unique, whatever the order of the threads.
#include "agvd/propagation/distance_bounds.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "agvd/core/parallel.h"
#include "agvd/propagation/layout.h"
#include "agvd/propagation/shape_source.h"
#include "agvd/propagation/site_placement.h"

namespace agvd {
namespace {

constexpr float unreached = std::numeric_limits<float>::infinity();
// First lengths are rounded up by more than all roundings of the exact distance.
constexpr float length_rounding = 1 + 0x1p-20F;

// Not below the exact sum: roundings must not make a path of thousands of arcs too short.
float sum_rounded_up(float a, float b) {
    const float sum = a + b;
    const float larger = std::max(a, b), smaller = std::min(a, b);
    const bool is_short = smaller > sum - larger;  // Exact, as smaller <= larger.
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(sum) + (is_short ? 1U : 0U));
}

// In the order of (distance, site): floats >= 0 are ordered like their bits.
using Key = std::uint64_t;

Key to_key(float distance, Index site) {
    return Key{std::bit_cast<std::uint32_t>(distance)} << 32 | site;
}
float distance_of(Key key) { return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32)); }
Index site_of(Key key) { return static_cast<Index>(key); }

// Lowers a key. True if it did. `is_shared`: other threads may lower it, too.
template <bool is_shared>
bool lower(Key& best, Key key) {
    if constexpr (is_shared) {
        constexpr auto relaxed = std::memory_order_relaxed;
        std::atomic_ref shared(best);
        Key old = shared.load(relaxed);
        while (key < old) {
            if (shared.compare_exchange_weak(old, key, relaxed)) return true;
        }
        return false;
    }
    if (key >= best) return false;
    best = key;
    return true;
}

// Where the graph does not fit into caches, slabs of several steps load it less often. Smaller
// graphs take longer with them, since sites search vertices that other sites own.
Index good_num_steps(const ArcGraph& graph) {
    constexpr std::size_t cached = std::size_t{1} << 24;  // Bytes, roughly.
    return graph.bytes() > cached ? 4 : 1;
}

}  // namespace

// The vertices of a slab are divided into chunks, which are searched in parallel. The search of a
// chunk proceeds in steps of half a mean edge to the end of the slab.
BoundsSearch::BoundsSearch(const Surface& surface, const SurfaceLayout& layout, int num_threads,
                           Index num_steps)
    : surface_(surface),
      graph_(layout.arcs()),
      num_threads_(num_threads),
      num_steps_(num_steps > 0 ? num_steps : good_num_steps(graph_)),
      per_step_(static_cast<float>(2 / layout.corners()->mean_length())),
      keys_(graph_.ends.size(), to_key(unreached, no_index)),
      queued_in_(keys_.size(), no_index) {}

void BoundsSearch::reach(Index vertex, Index site, double distance) {
    const Key key = to_key(static_cast<float>(distance) * length_rounding, site);
    if (key >= keys_[vertex]) return;
    keys_[vertex] = key;
    queue(vertex);
}

void BoundsSearch::add(const SurfacePoint& point, Index site, double start) {
    if (const auto vertex = vertex_of(surface_, point)) {
        reach(*vertex, site, start);
        return;
    }
    for_each_side(surface_, point, [&](const SurfacePoint& p, Index) {
        for (Index h = 3 * p.face.value(); h < 3 * p.face.value() + 3; ++h) {
            reach(surface_.tail(h), site, start + position_in_frame(surface_, p, h).norm());
        }
    });
}

void BoundsSearch::add(const SiteShape& shape, Index site) {
    const ShapeSource source = shape_source(surface_, shape);
    for (const Index v : source.vertices) reach(v, site, source.start);
    for (const Index h : source.sides) {
        const Vec2& apex = surface_.apex[h];
        if (apex.x() < 0 || apex.x() > surface_.length_of(h)) continue;
        reach(surface_.tail(Surface::previous(h)), site, source.start + apex.y());
    }
}

void BoundsSearch::run(const Progress& progress) {
    constexpr Index grain = 512;
    Poller poller(progress);
    Ticker ticker(poller);
    std::vector<Index> slab;
    std::vector<Chunk> chunks;
    for (current_ = 0; current_ < slabs_.size(); ++current_) {
        while (!slabs_[current_].empty()) {
            slab.clear();
            for (const Index v : slabs_[current_]) {
                if (queued_in_[v] != current_) continue;
                queued_in_[v] = no_index;
                slab.push_back(v);
            }
            slabs_[current_].clear();
            const auto count = static_cast<Index>(slab.size());
            ticker.tick(count);
            const Index num = num_chunks(count, grain);
            if (chunks.size() < num) chunks.resize(num);
            const auto search = [&](Index chunk, Index begin, Index end) {
                const auto starts = std::span<const Index>(slab).subspan(begin, end - begin);
                if (num_threads_ == 1) {
                    search_slab<false>(starts, chunks[chunk], Ticker(poller));
                } else {
                    search_slab<true>(starts, chunks[chunk], Ticker(poller));
                }
            };
            parallel_chunks(count, grain, num_threads_, search, poller);
            for (const Chunk& chunk : std::span(chunks).first(num)) {
                for (const Index v : chunk.beyond) queue(v);
            }
        }
        std::vector<Index>().swap(slabs_[current_]);
    }
    current_ = 0;
}

float BoundsSearch::distance(Index vertex) const { return distance_of(keys_[vertex]); }
Index BoundsSearch::site(Index vertex) const { return site_of(keys_[vertex]); }

// The number of steps from the beginning of the current slab to a distance.
Index BoundsSearch::steps_to(float distance) const {
    constexpr float last_step = 1 << 20;
    const auto step = static_cast<Index>(std::min(distance * per_step_, last_step));
    const Index first = current_ * num_steps_;
    return std::max(step, first) - first;
}

void BoundsSearch::queue(Index vertex) {
    const Index slab = current_ + steps_to(distance_of(keys_[vertex])) / num_steps_;
    if (queued_in_[vertex] <= slab) return;
    queued_in_[vertex] = slab;
    if (slab >= slabs_.size()) slabs_.resize(slab + 1);
    slabs_[slab].push_back(vertex);
}

template <bool is_shared>
void BoundsSearch::search_slab(std::span<const Index> starts, Chunk& chunk, Ticker ticker) {
    chunk.beyond.clear();
    chunk.steps.resize(num_steps_);
    const auto key_of = [this](Index vertex) {
        return std::atomic_ref(keys_[vertex]).load(std::memory_order_relaxed);
    };
    const auto wait = [&](Index vertex, Key key) {
        const Index step =
            num_steps_ == 1 ? 0 : std::min(steps_to(distance_of(key)), num_steps_ - 1);
        chunk.steps[step].push_back({key, vertex});
    };
    const float slab_end = static_cast<float>((current_ + 1) * num_steps_) / per_step_;
    for (const Index v : starts) wait(v, key_of(v));
    for (std::vector<Chunk::Waiting>& step : chunk.steps) {
        for (std::size_t i = 0; i < step.size(); ++i) {
            if (i + 4 < step.size()) graph_.prefetch(step[i + 4].vertex);
            const auto [from, vertex] = step[i];
            ticker.tick();
            if (key_of(vertex) != from) continue;  // It was lowered since, and waits again.
            for (Index a = graph_.offsets[vertex]; a < graph_.ends[vertex]; ++a) {
                const auto [head, length] = graph_.arcs[a];
                // Most arcs end here.
                if (distance_of(from) + length > distance_of(key_of(head))) continue;
                const Key key = to_key(sum_rounded_up(distance_of(from), length), site_of(from));
                if (!lower<is_shared>(keys_[head], key)) continue;
                if (distance_of(key) < slab_end) {
                    wait(head, key);
                } else {
                    chunk.beyond.push_back(head);
                }
            }
        }
        step.clear();
    }
}

DistanceBounds distance_bounds(const Surface& surface, const SurfaceLayout& layout,
                               std::span<const SurfacePoint> sites, int num_threads,
                               const Progress& progress, std::span<const double> starts,
                               std::span<const SiteShape> shapes) {
    BoundsSearch search(surface, layout, num_threads);
    for (Index s = 0; s < sites.size(); ++s) search.add(sites[s], s, start_of(starts, s));
    const auto first_shape = static_cast<Index>(sites.size());
    for (Index s = 0; s < shapes.size(); ++s) search.add(shapes[s], first_shape + s);
    search.run(progress);
    DistanceBounds bounds;
    bounds.distance.resize(surface.num_vertices());
    bounds.site.resize(surface.num_vertices());
    const auto take = [&](Index, Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            bounds.distance[v] = search.distance(v);
            bounds.site[v] = search.site(v);
        }
    };
    constexpr Index grain = 1 << 16;  // Vertices.
    parallel_chunks(surface.num_vertices(), grain, num_threads, take);
    return bounds;
}

}  // namespace agvd
