// Pairs half-edges without sorting all of them. Half-edges that run from a lower to a higher vertex
// are listed at their tails; every other half-edge searches for its twin in the list of its head.
// Then walks around all vertices are counted: they pass every half-edge only if the faces around
// each vertex form one fan. Passes run in parallel; the result does
// not depend on the number of threads.
#include "agvd/mesh/connectivity.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <numeric>
#include <utility>

#include "agvd/core/half_edge.h"
#include "agvd/core/parallel.h"

namespace agvd {
namespace {

// Lists from this length on are sorted: those of hubs have thousands of elements.
constexpr Index long_list = 16;
constexpr auto relaxed = std::memory_order_relaxed;

// Access to a number that several threads change, or one thread alone, which costs nothing.
struct Shared {
    static Index add_one(Index& number) { return std::atomic_ref(number).fetch_add(1, relaxed); }
    static Index exchange(Index& number, Index value) {
        return std::atomic_ref(number).exchange(value, relaxed);
    }
    static void lower(Index& number, Index value) {
        const std::atomic_ref least(number);
        Index old = least.load(relaxed);
        while (value < old && !least.compare_exchange_weak(old, value, relaxed)) {
        }
    }
};
struct Alone {
    static Index add_one(Index& number) { return number++; }
    static Index exchange(Index& number, Index value) { return std::exchange(number, value); }
    static void lower(Index& number, Index value) { number = std::min(number, value); }
};

// Half-edges that run up, from the lower to the higher vertex, are listed at their tails. Each
// half-edge that runs down searches for its twin in the list of its head. This takes half the
// memory of sorting all half-edges. The order in a list does not matter, so threads may fill the
// lists in parallel.
template <typename Access>
class Pairing {
public:
    Pairing(const MeshView& mesh, int num_threads, const Progress& progress)
        : triangles_(mesh.triangles),
          num_threads_(num_threads),
          poller_(progress),
          end_(mesh.positions.size() + 1, 0),
          result_{std::vector<Index>(3 * mesh.triangles.size(), no_index),
                  std::vector<Index>(mesh.positions.size(), no_index)} {}

    std::optional<Connectivity> run() {
        if (!list_ups() || !check_lists() || !join_downs()) return std::nullopt;
        std::vector<Up>().swap(ups_);
        std::vector<Index>().swap(end_);
        find_outgoing();
        if (!are_single_fans()) return std::nullopt;
        return std::move(result_);
    }

private:
    struct Up {
        Index head, half_edge;
    };

    // Calls each(half-edge, tail, head) for the sides of all faces.
    template <typename Each>
    void for_each_side(const Each& each) {
        const auto body = [&](Index, Index begin, Index end) {
            for (Index f = begin; f < end; ++f) {
                const Triangle& t = triangles_[f];
                each(3 * f, t[0], t[1]);
                each(3 * f + 1, t[1], t[2]);
                each(3 * f + 2, t[2], t[0]);
            }
        };
        parallel_chunks(static_cast<Index>(triangles_.size()), pass_grain, num_threads_, body,
                        poller_);
    }

    // False if a face repeats a corner.
    bool list_ups() {
        std::atomic<bool> has_loop = false;
        for_each_side([&](Index, Index tail, Index head) {
            if (tail < head) Access::add_one(end_[tail + 1]);
            if (tail == head) has_loop.store(true, relaxed);
        });
        if (has_loop) return false;
        std::partial_sum(end_.begin(), end_.end(), end_.begin());
        poller_.poll();
        ups_.resize(end_.back());
        poller_.poll();
        for_each_side([&](Index h, Index tail, Index head) {
            if (tail < head) ups_[Access::add_one(end_[tail])] = {head, h};
        });
        return true;  // end_[v] has moved to the end of the list of v.
    }

    [[nodiscard]] std::span<Up> list_of(Index vertex) {
        const Index begin = vertex == 0 ? 0 : end_[vertex - 1];
        return std::span(ups_).subspan(begin, end_[vertex] - begin);
    }

    // False if two faces run up along the same edge.
    bool check_lists() {
        std::atomic<bool> has_equal = false;
        const auto num_vertices = static_cast<Index>(result_.outgoing.size());
        const auto body = [&](Index, Index begin, Index end) {
            Ticker ticker(poller_);
            for (Index v = begin; v < end; ++v) {
                if (has_equal_heads(list_of(v), ticker)) has_equal.store(true, relaxed);
            }
        };
        parallel_chunks(num_vertices, pass_grain, num_threads_, body, poller_);
        return !has_equal;
    }

    // Sorts a long list, for binary search.
    static bool has_equal_heads(std::span<Up> list, Ticker& ticker) {
        const bool is_long = list.size() >= long_list;
        if (is_long) sort_ticked(list, ticker, has_lower_head);
        for (std::size_t i = 0; i < list.size(); ++i) {
            const std::size_t last = is_long ? std::min(i + 2, list.size()) : list.size();
            for (std::size_t j = i + 1; j < last; ++j) {
                if (list[i].head == list[j].head) return true;
            }
        }
        return false;
    }

    static bool has_lower_head(const Up& a, const Up& b) { return a.head < b.head; }

    // The half-edge from `tail` up to `head`, or no_index.
    [[nodiscard]] Index find_up(Index tail, Index head) {
        const std::span<const Up> list = list_of(tail);
        auto up = list.begin();
        if (list.size() >= long_list) {
            up = std::lower_bound(list.begin(), list.end(), Up{head, 0}, has_lower_head);
            return up != list.end() && up->head == head ? up->half_edge : no_index;
        }
        while (up != list.end() && up->head != head) ++up;
        return up != list.end() ? up->half_edge : no_index;
    }

    // False if two faces run down along an edge that one runs up.
    bool join_downs() {
        std::vector<Index>& twin = result_.twin;
        std::atomic<bool> has_equal = false;
        for_each_side([&](Index h, Index tail, Index head) {
            if (tail < head) return;
            const Index up = find_up(head, tail);
            if (up == no_index) return;
            twin[h] = up;
            if (Access::exchange(twin[up], h) != no_index) has_equal.store(true, relaxed);
        });
        return !has_equal;
    }

    void find_outgoing() {
        std::vector<Index>& outgoing = result_.outgoing;
        for_each_side([&](Index h, Index tail, Index) { Access::lower(outgoing[tail], h); });
        Ticker ticker(poller_);
        for (Index h = 0; h < result_.twin.size(); ++h) {
            ticker.tick();
            if (result_.twin[h] == no_index) outgoing[triangles_[h / 3][h % 3]] = h;
        }
    }

    // Counts the half-edges that walks around all vertices pass. These are all half-edges only if
    // the faces around each vertex are one fan. Two faces that run the same way along an edge
    // without a third face belong to two fans.
    [[nodiscard]] bool are_single_fans() {
        const auto num_vertices = static_cast<Index>(result_.outgoing.size());
        std::vector<std::size_t> seen(num_chunks(num_vertices, pass_grain), 0);
        const auto body = [&](Index chunk, Index begin, Index end) {
            std::size_t count = 0;
            for (Index v = begin; v < end; ++v) {
                const Index first = result_.outgoing[v];
                if (first == no_index) continue;
                Index h = first;
                do {
                    ++count;
                    h = result_.twin[previous_half_edge(h)];
                } while (h != no_index && h != first);
            }
            seen[chunk] = count;
        };
        parallel_chunks(num_vertices, pass_grain, num_threads_, body, poller_);
        return std::accumulate(seen.begin(), seen.end(), std::size_t{0}) == result_.twin.size();
    }

    std::span<const Triangle> triangles_;
    int num_threads_;
    Poller poller_;
    std::vector<Index> end_;  // #V + 1: ends of the vertices' lists.
    std::vector<Up> ups_;     // By tail.
    Connectivity result_;
};

}  // namespace

std::optional<Connectivity> find_connectivity(const MeshView& mesh, int num_threads,
                                              const Progress& progress) {
    if (num_threads == 1) return Pairing<Alone>(mesh, num_threads, progress).run();
    return Pairing<Shared>(mesh, num_threads, progress).run();
}

}  // namespace agvd
