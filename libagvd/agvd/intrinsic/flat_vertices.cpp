// Removes inner vertices whose angles sum to 2 pi, in parallel. The vertices are divided into the
// cells of a grid. A cell removes the vertices whose neighbours it owns, and records flips and
// merges on its own; the records are joined in the order of the cells, so that the result is the
// same for any number of threads. Vertices on the rims of cells follow on one thread.
//
// Within a cell vertices are removed in rounds: no two neighbours in one round, and vertices of few
// edges first. So the operations that a point passes stay few.
#include "agvd/intrinsic/flat_vertices.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "agvd/core/bucket_sort.h"
#include "agvd/core/parallel.h"
#include "agvd/intrinsic/face_sides.h"
#include "agvd/intrinsic/vertex_ring.h"
#include "agvd/mesh/one_ring.h"

namespace agvd::detail {
namespace {

// Radians: the rounding of the sum of a vertex's angles in the input.
constexpr double angle_rounding = 1e-12;
// The number of vertices of a part of the surface, roughly. Parts let threads work in parallel; the
// data of a part fits into the caches, and the memory of charts is used again. A run on 1.4 M faces
// that loses 643 000 vertices takes 5.1 s of user time and 410 MB; with one part it takes 5.7 s and
// 453 MB.
constexpr double part_size = 1 << 13;
constexpr Index most_cells = 64;  // Along each axis.

// The data that parts share. A part changes only faces whose corners all belong to it. So no other
// part writes what it reads or writes, even across the edges of these faces.
struct Shared {
    Surface& surface;
    const std::vector<std::uint8_t>& is_kept;
    double min_length;
    std::vector<Index> part_of;  // By vertex.
    // By vertex: the round in which the last neighbour was removed.
    std::vector<std::uint32_t> round_of;
};

// Removes the vertices inside a part, or those that all parts have left (no_index).
class FlatRemover {
public:
    FlatRemover(Shared& shared, FaceCharts& charts, FaceHistory& history, Index part, Ticker ticker)
        : shared_(shared),
          history_(history),
          part_(part),
          ticker_(ticker),
          ring_(shared.surface, charts) {}

    // Works in rounds of vertices no two of which are neighbours. If the vertices of a line were
    // removed one after the other, each would change the faces of the one before, and points would
    // pass as many operations as there are vertices.
    // \return the vertices on the rim of the part.
    std::vector<Index> run(std::vector<Index> waiting) {
        std::vector<Index> on_rim;
        std::size_t most_edges = few_edges;
        while (!waiting.empty()) {
            ++round_;
            const Index before = counts_.vertices;
            bool has_large = false;
            std::size_t num_left = 0;
            for (const Index v : waiting) {
                ticker_.tick(removal_work);
                if (shared_.round_of[v] == round_) {
                    waiting[num_left++] = v;
                    continue;
                }
                ring_.set(v);
                if (!is_inside(v)) {
                    on_rim.push_back(v);
                } else if (ring_.half_edges().size() > most_edges) {
                    has_large = true;
                    waiting[num_left++] = v;
                } else if (is_dense() && ring_.remove()) {
                    record();
                }
            }
            waiting.resize(num_left);
            if (counts_.vertices > before) continue;
            if (!has_large) break;
            most_edges *= 2;
        }
        return on_rim;
    }

    [[nodiscard]] const RemovalCounts& counts() const { return counts_; }

private:
    static constexpr std::size_t removal_work = 64;  // Ticks of a vertex.
    // Vertices of more edges wait: hubs of needles lose edges while other vertices are removed.
    static constexpr std::size_t few_edges = 8;

    [[nodiscard]] bool is_inside(Index v) const {
        if (part_ == no_index) return true;
        return shared_.part_of[v] == part_ &&
               std::all_of(ring_.half_edges().begin(), ring_.half_edges().end(), [&](Index h) {
                   return shared_.part_of[shared_.surface.head(h)] == part_;
               });
    }

    // Whether the vertex has a short edge, and none that is kept.
    [[nodiscard]] bool is_dense() const {
        bool is_short = false, is_free = true;
        for (const Index h : ring_.half_edges()) {
            const Index edge = shared_.surface.edge[h];
            is_short = is_short || shared_.surface.length[edge] < shared_.min_length;
            is_free = is_free && (shared_.is_kept.empty() || shared_.is_kept[edge] == 0);
        }
        return is_short && is_free;
    }

    void record() {
        for (const auto& [half_edge, twin, shares] : ring_.flips()) {
            history_.add_flip(half_edge, twin, shares);
        }
        for (const MergedFace& made : ring_.merged()) history_.add_merge(made);
        counts_.flips += ring_.flips().size();
        ++counts_.vertices;
        for (const Index w : ring_.corners()) shared_.round_of[w] = round_;
    }

    Shared& shared_;
    FaceHistory& history_;
    Index part_;
    Ticker ticker_;
    VertexRing ring_;
    std::uint32_t round_ = 0;
    RemovalCounts counts_;
};

// Multiplies the corners as complex numbers: when the product comes back to the upper half plane
// from the lower one, the angle has passed 2 pi.
bool is_flat(const Surface& surface, Index vertex) {
    Vec2 product(1, 0);
    Index num_turns = 0;
    for_each_outgoing(surface, vertex, [&](Index h) {
        const bool was_below = product.y() < 0;
        product = turned_by(product, surface.apex[h].normalized());
        if (was_below && product.y() >= 0) ++num_turns;
    });
    return std::abs(product.y()) < angle_rounding && product.x() > 0 &&
           num_turns == (product.y() < 0 ? 0 : 1);
}

// The inner vertices without curvature that have a short edge, ascending.
std::vector<Index> find_flat(const Shared& shared, int num_threads, Poller& poller) {
    const Surface& surface = shared.surface;
    std::vector<std::vector<Index>> found(num_chunks(surface.num_vertices(), pass_grain));
    const auto find = [&](Index chunk, Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            if (surface.outgoing[v] == no_index || surface.is_boundary_vertex(v)) continue;
            bool is_short = false;
            for_each_outgoing(surface, v, [&](Index h) {
                is_short = is_short || surface.length_of(h) < shared.min_length;
            });
            if (is_short && is_flat(surface, v)) found[chunk].push_back(v);
        }
    };
    parallel_chunks(surface.num_vertices(), pass_grain, num_threads, find, poller);
    std::vector<Index> flat;
    for (const std::vector<Index>& chunk : found) {
        poller.poll();
        flat.insert(flat.end(), chunk.begin(), chunk.end());
    }
    return flat;
}

// The parts are cells of a grid around the mesh. The number of cells along the longest side is
// chosen so that the parts of a round surface have the wanted size.
std::vector<Index> find_parts(const std::vector<Vec3>& positions, int num_threads, Poller& poller) {
    std::vector<Vec3> low(num_chunks(static_cast<Index>(positions.size()), pass_grain));
    std::vector<Vec3> high(low.size());
    const auto num_vertices = static_cast<Index>(positions.size());
    const auto measure = [&](Index chunk, Index begin, Index end) {
        low[chunk] = high[chunk] = positions[begin];
        for (Index v = begin; v < end; ++v) {
            low[chunk] = low[chunk].cwiseMin(positions[v]);
            high[chunk] = high[chunk].cwiseMax(positions[v]);
        }
    };
    parallel_chunks(num_vertices, pass_grain, num_threads, measure, poller);
    for (std::size_t i = 1; i < low.size(); ++i) {
        low[0] = low[0].cwiseMin(low[i]);
        high[0] = high[0].cwiseMax(high[i]);
    }
    const double wanted = std::ceil(std::sqrt(num_vertices / part_size / 2));
    const double num_cells = std::min(wanted, static_cast<double>(most_cells));
    const double cell = (high[0] - low[0]).maxCoeff() / num_cells;
    std::vector<Index> part_of(num_vertices);
    const auto sort = [&](Index, Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            const Vec3 at = (positions[v] - low[0]) / cell;
            const auto along = [&](double x) {
                return std::min(static_cast<Index>(std::max(x, 0.0)), most_cells - 1);
            };
            part_of[v] = (along(at.x()) * most_cells + along(at.y())) * most_cells + along(at.z());
        }
    };
    parallel_chunks(num_vertices, pass_grain, num_threads, sort, poller);
    return part_of;
}

struct ChangedPart {
    ChangedPart(FaceCharts& all_charts, FaceHistory& all_history)
        : charts(FaceCharts::Part{all_charts}), history(FaceHistory::Part{all_history}) {}

    FaceCharts charts;
    FaceHistory history;
    RemovalCounts counts;
    std::vector<Index> left;
};

// Takes over the records of parts in order, each as soon as all before are done.
class PartsInOrder {
public:
    PartsInOrder(std::size_t num_parts, FaceCharts& charts, FaceHistory& history)
        : charts_(charts), history_(history), waiting_(num_parts) {
        charts.make_places();
        history.start();
    }

    [[nodiscard]] std::unique_ptr<ChangedPart> make() const {
        return std::make_unique<ChangedPart>(charts_, history_);
    }
    void take(Index number, std::unique_ptr<ChangedPart> part) {
        const std::scoped_lock lock(mutex_);
        waiting_[number] = std::move(part);
        for (; next_ < waiting_.size() && waiting_[next_]; ++next_) {
            const std::unique_ptr<ChangedPart> done = std::move(waiting_[next_]);
            charts_.take(done->charts);
            history_.take(done->history);
            counts_.vertices += done->counts.vertices;
            counts_.flips += done->counts.flips;
            left_.insert(left_.end(), done->left.begin(), done->left.end());
        }
    }
    [[nodiscard]] const RemovalCounts& counts() const { return counts_; }
    [[nodiscard]] std::vector<Index> left() { return std::move(left_); }

private:
    FaceCharts& charts_;
    FaceHistory& history_;
    std::vector<std::unique_ptr<ChangedPart>> waiting_;
    std::size_t next_ = 0;
    RemovalCounts counts_;
    std::vector<Index> left_;
    std::mutex mutex_;
};

}  // namespace

RemovalCounts remove_flat_vertices(Surface& surface, FaceCharts& charts, FaceHistory& history,
                                   const std::vector<std::uint8_t>& is_kept, double min_length,
                                   int num_threads, Poller& poller) {
    Shared shared{surface, is_kept, min_length, {}, {}};
    std::vector<Index> flat = find_flat(shared, num_threads, poller);
    if (flat.empty()) return {};
    shared.part_of = find_parts(surface.mesh.positions, num_threads, poller);
    flat = sort_in_buckets(
        flat, most_cells * most_cells * most_cells, [&](Index v) { return shared.part_of[v]; },
        std::less<>(), Ticker(poller));
    std::vector<Index> begin{0};  // The first vertex of each part that has any.
    for (Index i = 1; i < flat.size(); ++i) {
        if (shared.part_of[flat[i]] != shared.part_of[flat[i - 1]]) begin.push_back(i);
    }
    const auto num_parts = static_cast<Index>(begin.size());
    begin.push_back(static_cast<Index>(flat.size()));
    // These are the numbers for vertices of grids, which have six edges.
    history.reserve(3 * flat.size(), 2 * flat.size());
    shared.round_of.assign(surface.num_vertices(), 0);
    PartsInOrder parts(num_parts, charts, history);
    const auto remove_inside = [&](Index number, Index, Index) {
        std::unique_ptr<ChangedPart> part = parts.make();
        FlatRemover remover(shared, part->charts, part->history,
                            shared.part_of[flat[begin[number]]], Ticker(poller));
        part->left = remover.run({flat.begin() + begin[number], flat.begin() + begin[number + 1]});
        part->counts = remover.counts();
        parts.take(number, std::move(part));
    };
    parallel_chunks(num_parts, 1, num_threads, remove_inside, poller);
    shared.round_of.assign(surface.num_vertices(), 0);
    FlatRemover remover(shared, charts, history, no_index, Ticker(poller));
    (void)remover.run(parts.left());
    return {parts.counts().vertices + remover.counts().vertices,
            parts.counts().flips + remover.counts().flips};
}

}  // namespace agvd::detail
