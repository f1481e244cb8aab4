// Labels the edges of the mesh: the stretches of each edge and the sites that are nearest there.
// Edges are labelled in chunks in parallel, by the lower envelope of their relays (envelope.h), and
// stored in their order. Reads of the face across an edge miss the cache, so they are prefetched
// some edges ahead.
#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/diagram/envelope.h"
#include "agvd/diagram/gather_relays.h"
#include "agvd/diagram/stages.h"

namespace agvd {
namespace {

// The label changes on the edges of one chunk.
struct FoundRows {
    struct Row {
        Index edge;
        Block crossings;  // Not empty.
    };
    std::vector<Row> rows;
    std::vector<Crossing> crossings;
};

// Fetches what labelling an edge reads of the face across it: first where its relays are, then,
// with `relays_too`, the relays. Always inline: g++ drops calls of functions that do nothing but
// prefetch.
[[gnu::always_inline]] inline void prefetch_across(const StageInput& in, const EdgeLabels& labels,
                                                   Index half_edge, bool relays_too) {
    const Index twin = in.surface.twin[half_edge];
    if (twin == no_index) return;
    const Index* const neighbour = &labels.mixed_index[Surface::face(twin)];
    if (!relays_too) {
        __builtin_prefetch(neighbour);
        __builtin_prefetch(&in.surface.length[in.surface.edge[half_edge]]);
        __builtin_prefetch(&in.surface.edge_half[in.surface.edge[half_edge]]);
    } else {
        for (const Relay& r : relays_of(in.propagation, *neighbour)) __builtin_prefetch(&r);
    }
}

// Labels edges one after the other. One for each thread.
class EdgeLabeller {
public:
    EdgeLabeller(const StageInput& in, const EdgeLabels& labels, FoundRows& out)
        : surface_(in.surface),
          labels_(labels),
          gatherer_(in.surface, in.propagation, labels),
          out_(out) {}

    void label(Index half_edge) {
        const Index edge = surface_.edge[half_edge];
        if (!gatherer_.may_change(edge, relays_)) return;
        const auto begin = static_cast<Index>(out_.crossings.size());
        label_line(relays_, LineId::of_edge(half_edge),
                   {surface_.length[edge], labels_.point_site[surface_.tail(half_edge)],
                    labels_.point_site[surface_.head(half_edge)]},
                   scratch_, out_.crossings);
        const Index count = static_cast<Index>(out_.crossings.size()) - begin;
        if (count > 0) out_.rows.push_back({edge, {begin, count}});
    }

private:
    const Surface& surface_;
    const EdgeLabels& labels_;
    RelayGatherer gatherer_;
    FoundRows& out_;
    std::vector<LineRelay> relays_;  // Of the edge at hand.
    EnvelopeScratch scratch_;
};

// The lower half-edge of each edge all of whose faces are mixed.
std::vector<Index> labelled_edges(const StageInput& in, const EdgeLabels& labels) {
    std::vector<Index> half_edges;
    Ticker ticker(in.poller);
    for (const Index face : in.propagation.mixed_faces) {
        ticker.tick();
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Index twin = in.surface.twin[h];
            if (twin == no_index ||
                (h < twin && labels.mixed_index[Surface::face(twin)] != no_index)) {
                half_edges.push_back(h);
            }
        }
    }
    return half_edges;
}

// Chunk after chunk of the half-edges.
std::vector<FoundRows> find_rows(const StageInput& input, std::span<const Index> half_edges,
                                 const EdgeLabels& labels) {
    constexpr Index grain = 512;
    const auto count = static_cast<Index>(half_edges.size());
    std::vector<FoundRows> found(num_chunks(count, grain));
    const auto label_chunk = [&](Index chunk, Index begin, Index end) {
        EdgeLabeller labeller(input, labels, found[chunk]);
        Ticker ticker(input.poller);
        for (Index i = begin; i < end; ++i) {
            constexpr Index ahead = 3;
            if (i + 2 * ahead < end) {
                prefetch_across(input, labels, half_edges[i + 2 * ahead], false);
            }
            if (i + ahead < end) prefetch_across(input, labels, half_edges[i + ahead], true);
            labeller.label(half_edges[i]);
            const Index mixed = labels.mixed_index[Surface::face(half_edges[i])];
            ticker.tick(1 + relays_of(input.propagation, mixed).size());
        }
    };
    parallel_chunks(count, grain, input.num_threads, label_chunk, input.poller);
    return found;
}

}  // namespace

void label_edges(const StageInput& input, EdgeLabels& labels) {
    labels.edge_rows.assign(input.surface.num_edges(), {});
    const std::vector<FoundRows> found = find_rows(input, labelled_edges(input, labels), labels);
    std::size_t num_crossings = 0;
    for (const FoundRows& chunk : found) num_crossings += chunk.crossings.size();
    labels.crossings.reserve(num_crossings + num_crossings / 8);  // And those of cuts.
    for (const FoundRows& chunk : found) {
        input.poller.poll();
        const auto begin = static_cast<Index>(labels.crossings.size());
        for (const auto& [edge, row] : chunk.rows) {
            labels.edge_rows[edge] = {begin + row.begin, row.count};
        }
        labels.crossings.insert(labels.crossings.end(), chunk.crossings.begin(),
                                chunk.crossings.end());
    }
}

}  // namespace agvd
