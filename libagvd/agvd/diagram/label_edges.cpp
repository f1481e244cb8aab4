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

// Labels some edges one after the other.
void label_some(const StageInput& input, const EdgeLabels& labels,
                std::span<const Index> half_edges, FoundRows& out) {
    const Surface& surface = input.surface;
    RelayGatherer gatherer(surface, input.propagation, labels);
    std::vector<LineRelay> relays;  // Of the edge at hand.
    EnvelopeScratch scratch;
    Ticker ticker(input.poller);
    for (std::size_t i = 0; i < half_edges.size(); ++i) {
        constexpr std::size_t ahead = 3;
        if (i + 2 * ahead < half_edges.size()) {
            prefetch_across(input, labels, half_edges[i + 2 * ahead], false);
        }
        if (i + ahead < half_edges.size()) {
            prefetch_across(input, labels, half_edges[i + ahead], true);
        }
        const Index h = half_edges[i];
        const Index mixed = labels.mixed_index[Surface::face(h)];
        ticker.tick(1 + relays_of(input.propagation, mixed).size());
        const Index edge = surface.edge[h];
        if (!gatherer.may_change(edge, relays)) continue;
        const Index begin = size_of(out.crossings);
        label_line(relays, LineId::of_edge(h),
                   {surface.length[edge], labels.point_site[surface.tail(h)],
                    labels.point_site[surface.head(h)]},
                   scratch, out.crossings);
        const Index count = size_of(out.crossings) - begin;
        if (count > 0) out.rows.push_back({edge, {begin, count}});
    }
}

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

}  // namespace

void label_edges(const StageInput& input, EdgeLabels& labels) {
    labels.edge_rows.assign(input.surface.num_edges(), {});
    const std::vector<Index> half_edges = labelled_edges(input, labels);
    constexpr Index grain = 512;
    std::vector<FoundRows> found(num_chunks(size_of(half_edges), grain));
    const auto label_chunk = [&](Index chunk, Index begin, Index end) {
        label_some(input, labels, std::span(half_edges).subspan(begin, end - begin), found[chunk]);
    };
    parallel_chunks(size_of(half_edges), grain, input.num_threads, label_chunk, input.poller);
    std::size_t num_crossings = 0;
    for (const FoundRows& chunk : found) num_crossings += chunk.crossings.size();
    labels.crossings.reserve(num_crossings + num_crossings / 8);  // And those of cuts.
    for (const FoundRows& chunk : found) {
        input.poller.poll();
        const auto begin = size_of(labels.crossings);
        for (const auto& [edge, row] : chunk.rows) {
            labels.edge_rows[edge] = {begin + row.begin, row.count};
        }
        labels.crossings.insert(labels.crossings.end(), chunk.crossings.begin(),
                                chunk.crossings.end());
    }
}

}  // namespace agvd
