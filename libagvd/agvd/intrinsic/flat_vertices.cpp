#include "agvd/intrinsic/flat_vertices.h"

#include <algorithm>
#include <cmath>

#include "agvd/core/parallel.h"
#include "agvd/intrinsic/face_sides.h"
#include "agvd/intrinsic/vertex_ring.h"
#include "agvd/mesh/one_ring.h"

namespace agvd::detail {
namespace {

// Radians: rounding of the sum of a vertex's angles in the input.
constexpr double flat_enough = 1e-12;
// Faces whose vertices go before those of others: what is read and written fits into the caches,
// and charts of faces that are gone serve again. All at once take twice the time, and 40 MB more
// for 1.4 M faces.
constexpr Index part_size = 1 << 12;

class FlatVertices {
public:
    FlatVertices(Surface& surface, FaceCharts& charts, FaceHistory& history,
                 const std::vector<std::uint8_t>& is_kept, double min_length, Ticker& ticker)
        : surface_(surface),
          history_(history),
          is_kept_(is_kept),
          min_length_(min_length),
          ticker_(ticker),
          ring_(surface, charts),
          round_of_(surface.num_vertices(), 0) {}

    RemovalCounts run(std::vector<std::vector<Index>> parts) {
        std::size_t num_flat = 0;
        for (const std::vector<Index>& part : parts) num_flat += part.size();
        history_.reserve(3 * num_flat, 2 * num_flat);  // For grids, whose vertices have six edges.
        for (std::vector<Index>& part : parts) remove_all(std::move(part));
        return counts_;
    }

private:
    static constexpr std::size_t removal_work = 64;  // Steps that a vertex counts for.
    // Vertices of more edges wait: hubs of needles lose them while others go.
    static constexpr std::size_t few_edges = 8;

    // Rounds of vertices no two of which are neighbours: one after the other along a line, each
    // would change the faces of the one before, and points would pass as many operations as there
    // are vertices.
    void remove_all(std::vector<Index> waiting) {
        std::size_t most_edges = few_edges;
        while (!waiting.empty()) {
            ++round_;
            const Index before = counts_.vertices;
            bool has_large = false;
            std::size_t num_left = 0;
            for (const Index v : waiting) {
                ticker_.tick(removal_work);
                if (round_of_[v] == round_) {
                    waiting[num_left++] = v;
                    continue;
                }
                ring_.set(v);
                if (ring_.half_edges().size() > most_edges) {
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
    }

    // The vertex has a short edge, and none that is kept.
    [[nodiscard]] bool is_dense() const {
        bool is_short = false, is_free = true;
        for (const Index h : ring_.half_edges()) {
            is_short = is_short || surface_.length_of(h) < min_length_;
            is_free = is_free && (is_kept_.empty() || is_kept_[surface_.edge[h]] == 0);
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
        for (const Index w : ring_.corners()) round_of_[w] = round_;
    }

    Surface& surface_;
    FaceHistory& history_;
    const std::vector<std::uint8_t>& is_kept_;
    double min_length_;
    Ticker& ticker_;
    VertexRing ring_;
    std::vector<std::uint32_t> round_of_;  // By vertex: of the last neighbour that went.
    std::uint32_t round_ = 0;
    RemovalCounts counts_;
};

// The corners' product as complex numbers: on the upper half plane again after the lower one it has
// passed 2 pi.
bool is_flat(const Surface& surface, Index vertex) {
    Vec2 product(1, 0);
    Index num_turns = 0;
    for_each_outgoing(surface, vertex, [&](Index h) {
        const bool was_below = product.y() < 0;
        product = turned_by(product, surface.apex[h].normalized());
        if (was_below && product.y() >= 0) ++num_turns;
    });
    return std::abs(product.y()) < flat_enough && product.x() > 0 &&
           num_turns == (product.y() < 0 ? 0 : 1);
}

// Flat vertices inside with a short edge, in parts that lie close to each other.
std::vector<std::vector<Index>> find_flat(const Surface& surface, double min_length,
                                          int num_threads, Poller& poller) {
    constexpr Index grain = 1 << 14;  // Vertices.
    std::vector<std::vector<Index>> chunks(num_chunks(surface.num_vertices(), grain));
    const auto find = [&](Index chunk, Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            if (surface.outgoing[v] == no_index || surface.is_boundary_vertex(v)) continue;
            bool is_short = false;
            for_each_outgoing(surface, v, [&](Index h) {
                is_short = is_short || surface.length_of(h) < min_length;
            });
            if (is_short && is_flat(surface, v)) chunks[chunk].push_back(v);
        }
    };
    parallel_chunks(surface.num_vertices(), grain, num_threads, find, poller);
    std::vector<std::vector<Index>> parts(num_chunks(surface.num_faces(), part_size));
    for (const std::vector<Index>& chunk : chunks) {
        poller.poll();
        for (const Index v : chunk) {
            parts[Surface::face(surface.outgoing[v]) / part_size].push_back(v);
        }
    }
    return parts;
}

}  // namespace

RemovalCounts remove_flat_vertices(Surface& surface, FaceCharts& charts, FaceHistory& history,
                                   const std::vector<std::uint8_t>& is_kept, double min_length,
                                   int num_threads, Poller& poller) {
    Ticker ticker(poller);
    return FlatVertices(surface, charts, history, is_kept, min_length, ticker)
        .run(find_flat(surface, min_length, num_threads, poller));
}

namespace {

void move_face(Surface& surface, Index from, Index to) {
    surface.mesh.triangles[to] = surface.mesh.triangles[from];
    for (Index k = 0; k < 3; ++k) {
        const Index old = 3 * from + k, now = 3 * to + k;
        Index twin = surface.twin[old];
        if (twin != no_index && Surface::face(twin) == from) twin = 3 * to + twin % 3;
        surface.apex[now] = surface.apex[old];
        surface.twin[old] = no_index;
        join(surface, now, twin, surface.edge[old]);
        Index& outgoing = surface.outgoing[surface.tail(now)];
        if (outgoing == old) outgoing = now;
    }
}

void compact_edges(Surface& surface, std::vector<std::uint8_t>& is_kept) {
    std::vector<Index> number(surface.num_edges(), no_index);
    Index count = 0;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (surface.edge_half[e] == no_index) continue;
        number[e] = count;
        if (!is_kept.empty()) is_kept[count] = is_kept[e];
        surface.edge_half[count] = surface.edge_half[e];
        surface.length[count++] = surface.length[e];
    }
    if (!is_kept.empty()) is_kept.resize(count);
    surface.edge_half.resize(count);
    surface.length.resize(count);
    surface.edge_half.shrink_to_fit();
    surface.length.shrink_to_fit();
    for (Index& e : surface.edge) e = number[e];
}

}  // namespace

void compact_faces(Surface& surface, FaceCharts& charts, FaceHistory& history,
                   std::vector<std::uint8_t>& is_kept) {
    const auto is_gap = [&](Index f) { return surface.mesh.triangles[f][0] == no_index; };
    Index last = surface.num_faces();
    for (Index f = 0; f < last; ++f) {
        if (!is_gap(f)) continue;
        while (last > f && is_gap(last - 1)) --last;
        if (last <= f + 1) break;
        move_face(surface, --last, f);
        history.move_face(last, f);
        charts.move_face(last, f);
    }
    while (last > 0 && is_gap(last - 1)) --last;
    surface.mesh.triangles.resize(last);
    surface.twin.resize(3 * last);
    surface.edge.resize(3 * last);
    surface.apex.resize(3 * last);
    surface.mesh.triangles.shrink_to_fit();
    surface.twin.shrink_to_fit();
    surface.edge.shrink_to_fit();
    surface.apex.shrink_to_fit();
    history.drop_faces_from(last);
    compact_edges(surface, is_kept);
}

}  // namespace agvd::detail
