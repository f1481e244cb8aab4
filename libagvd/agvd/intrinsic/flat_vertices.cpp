// Vertices are divided into the cells of a grid. A cell removes those whose neighbours it owns,
// with charts and operations of its own, which are joined in the order of the cells; vertices on
// the rims of cells follow on one thread. Within a cell no two neighbours are removed in one round,
// and vertices of few edges go first, so that a point passes few operations.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "agvd/core/bucket_sort.h"
#include "agvd/core/parallel.h"
#include "agvd/intrinsic/vertex_ring.h"
#include "agvd/mesh/scale.h"

namespace agvd::detail {
namespace {

// Radians: the rounding of the sum of a vertex's angles in the input.
constexpr double angle_rounding = 1e-12;
// Vertices of a part, roughly: what fits into the caches.
constexpr double part_size = 1 << 13;
constexpr Index most_cells = 64;  // Along each axis.

// The data that parts share. A part changes only faces whose corners all belong to it. So no other
// part writes what it reads or writes, even across the edges of these faces.
struct Shared {
    Surface& surface;
    double min_length;
    std::vector<Index> part_of;  // By vertex.
    // By vertex: the round in which the last neighbour was removed.
    std::vector<std::uint32_t> round_of;
};

// Removes the vertices inside a part, or those that all parts have left (no_index).
class FlatRemover {
public:
    FlatRemover(Shared& shared, FaceCharts& charts, Index part, Ticker ticker)
        : shared_(shared), part_(part), ticker_(ticker), ring_(shared.surface, charts) {}

    // Rounds keep few the operations that a point passes along a line of vertices.
    // \return the vertices on the rim of the part.
    std::vector<Index> run(std::vector<Index> waiting) {
        std::vector<Index> on_rim;
        std::size_t most_edges = few_edges;
        while (!waiting.empty()) {
            ++round_;
            const Index before = num_removed_;
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
            if (num_removed_ > before) continue;
            if (!has_large) break;
            most_edges *= 2;
        }
        return on_rim;
    }

    [[nodiscard]] Index num_removed() const { return num_removed_; }
    [[nodiscard]] std::span<const FaceOperation> operations() const { return operations_; }

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

    // Whether the vertex has a short edge.
    [[nodiscard]] bool is_dense() const {
        return std::any_of(ring_.half_edges().begin(), ring_.half_edges().end(), [&](Index h) {
            return shared_.surface.length_of(h) < shared_.min_length;
        });
    }

    void record() {
        operations_.insert(operations_.end(), ring_.operations().begin(), ring_.operations().end());
        ++num_removed_;
        for (const Index w : ring_.corners()) shared_.round_of[w] = round_;
    }

    Shared& shared_;
    Index part_;
    Ticker ticker_;
    VertexRing ring_;
    std::uint32_t round_ = 0;
    Index num_removed_ = 0;
    std::vector<FaceOperation> operations_;
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
    const auto find = [&](Index v, std::vector<Index>& flat) {
        if (surface.outgoing[v] == no_index || surface.is_boundary_vertex(v)) return;
        bool is_short = false;
        for_each_outgoing(surface, v, [&](Index h) {
            is_short = is_short || surface.length_of(h) < shared.min_length;
        });
        if (is_short && is_flat(surface, v)) flat.push_back(v);
    };
    return parallel_collect<Index>(surface.num_vertices(), pass_grain, num_threads, find, poller);
}

// The parts are cells of a grid around the mesh. The number of cells along the longest side is
// chosen so that the parts of a round surface have the wanted size.
std::vector<Index> find_parts(const std::vector<Vec3>& positions, Ticker ticker) {
    MeshBox box;
    for (const Vec3& p : positions) {
        ticker.tick();
        box.add(p);
    }
    const double wanted =
        std::ceil(std::sqrt(static_cast<double>(positions.size()) / part_size / 2));
    const double num_cells = std::min(wanted, static_cast<double>(most_cells));
    const double cell = (box.high - box.low).maxCoeff() / num_cells;
    std::vector<Index> part_of;
    part_of.reserve(positions.size());
    for (const Vec3& p : positions) {
        ticker.tick();
        const Vec3 at = (p - box.low) / cell;
        const auto along = [&](double x) {
            return std::min(static_cast<Index>(std::max(x, 0.0)), most_cells - 1);
        };
        part_of.push_back((along(at.x()) * most_cells + along(at.y())) * most_cells +
                          along(at.z()));
    }
    return part_of;
}

void add_all(std::span<const FaceOperation> operations, FaceHistory& history) {
    for (const FaceOperation& made : operations) {
        std::visit([&](const auto& operation) { history.add(operation); }, made);
    }
}

struct ChangedPart {
    ChangedPart(Shared& shared, FaceCharts& whole, Index part, Ticker ticker)
        : charts(whole.part()), remover(shared, charts, part, ticker) {}

    FaceCharts charts;
    FlatRemover remover;
    std::vector<Index> left;
};

// Takes over parts in order, each as soon as all before are done.
struct PartsInOrder {
    FaceCharts& charts;
    FaceHistory& history;
    std::vector<std::unique_ptr<ChangedPart>> waiting;
    std::size_t next = 0;
    Index num_removed = 0;
    std::vector<Index> left = {};
    std::mutex mutex = {};

    void take(Index number, std::unique_ptr<ChangedPart> part) {
        const std::scoped_lock lock(mutex);
        waiting[number] = std::move(part);
        for (; next < waiting.size() && waiting[next]; ++next) {
            const std::unique_ptr<ChangedPart> done = std::move(waiting[next]);
            charts.take(done->charts);
            add_all(done->remover.operations(), history);
            num_removed += done->remover.num_removed();
            left.insert(left.end(), done->left.begin(), done->left.end());
        }
    }
};

void move_face(Surface& surface, Index from, Index to) {
    surface.mesh.triangles[to] = surface.mesh.triangles[from];
    for (Index k = 0; k < 3; ++k) {
        const Index old = 3 * from + k, now = 3 * to + k;
        // Where both faces of an edge move, the second join is right.
        const Index twin = surface.twin[old];
        surface.apex[now] = surface.apex[old];
        surface.twin[old] = no_index;
        join(surface, now, twin, surface.edge[old]);
        Index& outgoing = surface.outgoing[surface.tail(now)];
        if (outgoing == old) outgoing = now;
    }
}

void compact_edges(Surface& surface) {
    std::vector<Index> number(surface.num_edges(), no_index);
    Index count = 0;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (surface.edge_half[e] == no_index) continue;
        number[e] = count;
        surface.edge_half[count] = surface.edge_half[e];
        surface.length[count++] = surface.length[e];
    }
    surface.edge_half.resize(count);
    surface.length.resize(count);
    for (Index& e : surface.edge) e = number[e];
}

}  // namespace

Index remove_flat_vertices(Surface& surface, FaceCharts& charts, FaceHistory& history,
                           double min_length, int num_threads, Poller& poller) {
    Shared shared{surface, min_length, {}, {}};
    std::vector<Index> flat = find_flat(shared, num_threads, poller);
    if (flat.empty()) return 0;
    shared.part_of = find_parts(surface.mesh.positions, Ticker(poller));
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
    PartsInOrder parts{charts, history, std::vector<std::unique_ptr<ChangedPart>>(num_parts)};
    const auto remove_inside = [&](Index number, Index, Index) {
        auto part = std::make_unique<ChangedPart>(
            shared, charts, shared.part_of[flat[begin[number]]], Ticker(poller));
        part->left =
            part->remover.run({flat.begin() + begin[number], flat.begin() + begin[number + 1]});
        parts.take(number, std::move(part));
    };
    parallel_chunks(num_parts, 1, num_threads, remove_inside, poller);
    shared.round_of.assign(surface.num_vertices(), 0);
    FlatRemover remover(shared, charts, no_index, Ticker(poller));
    (void)remover.run(std::move(parts.left));
    add_all(remover.operations(), history);
    return parts.num_removed + remover.num_removed();
}

void compact_faces(Surface& surface, FaceHistory& history) {
    const auto is_gap = [&](Index f) { return surface.mesh.triangles[f][0] == no_index; };
    Index last = surface.num_faces();
    for (Index f = 0; f < last; ++f) {
        if (!is_gap(f)) continue;
        while (last > f && is_gap(last - 1)) --last;
        if (last <= f + 1) break;
        move_face(surface, --last, f);
        history.move_face(last, f);
    }
    while (last > 0 && is_gap(last - 1)) --last;
    surface.mesh.triangles.resize(last);
    surface.twin.resize(3 * last);
    surface.edge.resize(3 * last);
    surface.apex.resize(3 * last);
    history.drop_faces_from(last);
    compact_edges(surface);
}

}  // namespace agvd::detail
