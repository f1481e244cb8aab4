// Labels vertices by the nearest site over the relays of the faces around them, and edges by the
// lower envelope of their relays (envelope.h): chunks in parallel, stored in order. Reads of the
// face across an edge miss the cache, so they are prefetched some edges ahead.
#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/diagram/envelope.h"
#include "agvd/diagram/gather_relays.h"
#include "agvd/diagram/stages.h"

namespace agvd {
namespace {

// A path through the relays of one face that is shorter than what the engine found.
struct ShorterPath {
    Index vertex;
    Index site;
    double distance;
};

// Appends the paths to corners that are asked for.
void find_shorter_paths(const StageInput& input, const EdgeLabels& labels,
                        std::span<const std::uint8_t> is_wanted, Index mixed_index,
                        std::vector<ShorterPath>& out) {
    const Surface& surface = input.surface;
    const Index face = input.propagation.mixed_faces[mixed_index];
    const Triangle& corners = surface.mesh.triangles[face];
    if ((is_wanted[corners[0]] | is_wanted[corners[1]] | is_wanted[corners[2]]) == 0) return;
    // No path through a relay is shorter than the straight line, which excludes most relays without
    // a square root. A gain of less than this share changes no label.
    constexpr double least_gain = 1e-9;
    std::array<double, 3> limits;
    for (std::size_t k = 0; k < 3; ++k) {
        limits[k] = (1 - least_gain) * labels.vertex_distance[corners[k]];
    }
    for (const Relay& relay : relays_of(input.propagation, mixed_index)) {
        const Index h = relay.half_edge;
        const Index k = h - 3 * face;
        const double length = surface.length_of(h);
        const Vec2& apex = surface.apex[h];
        const auto may_gain = [&](Index corner, double dx, double dy) {
            const double limit = limits[corner] - relay.weight;
            return limit > 0 && dx * dx + dy * dy < limit * limit;
        };
        const Index at_head = k == 2 ? 0 : k + 1;
        const Index at_apex = k == 0 ? 2 : k - 1;
        if (!may_gain(k, relay.x, relay.y) && !may_gain(at_head, relay.x - length, relay.y) &&
            !may_gain(at_apex, relay.x - apex.x(), relay.y - apex.y())) {
            continue;
        }
        const CornerDistances to = corner_distances(relay, length, apex);
        const auto offer = [&](Index corner, double distance) {
            const Index v = corners[corner];
            if (distance >= limits[corner] || is_wanted[v] == 0) return;
            out.push_back({v, relay.site.value(), distance});
        };
        offer(k, to.tail);
        offer(at_head, to.head);
        offer(at_apex, to.apex);
    }
}

// The label changes on the edges of one chunk.
struct FoundRows {
    struct Row {
        Index edge;
        Block crossings;  // Not empty.
    };
    std::vector<Row> rows;
    std::vector<Crossing> crossings;
};

// Fetches what labelling an edge reads of the face across it; with `relays_too` its relays. Inline
// by force: g++ drops calls of functions that only prefetch.
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
                std::span<const Index> half_edges, bool may_guess, FoundRows& out) {
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
        bool is_guess = false;
        if (!gatherer.may_change(edge, relays, may_guess ? &is_guess : nullptr)) continue;
        const Index begin = size_of(out.crossings);
        const Index a = labels.point_site[surface.tail(h)];
        const Index b = labels.point_site[surface.head(h)];
        if (is_guess) {
            out.crossings.push_back({guessed, guessed, a, b, LineId::of_edge(h)});
        } else {
            label_line(relays, LineId::of_edge(h), {surface.length[edge], a, b}, scratch,
                       out.crossings);
        }
        if (input.chord) {
            settle_crossings(relays, surface.length[edge], std::span(out.crossings).subspan(begin));
        }
        const Index count = size_of(out.crossings) - begin;
        if (count > 0) out.rows.push_back({edge, {begin, count}});
    }
}

}  // namespace

void label_vertices(const StageInput& input, std::span<const Index> positions,
                    std::span<const std::uint8_t> is_wanted, EdgeLabels& labels) {
    constexpr Index grain = 512;
    const auto count = static_cast<Index>(positions.size());
    std::vector<std::vector<ShorterPath>> found(num_chunks(count, grain));
    const auto find = [&](Index chunk, Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            find_shorter_paths(input, labels, is_wanted, positions[i], found[chunk]);
        }
    };
    parallel_chunks(count, grain, input.num_threads, find, input.poller);
    for (const auto& paths : found) {
        for (const ShorterPath& path : paths) {
            double& distance = labels.vertex_distance[path.vertex];
            Index& site = labels.point_site[path.vertex];
            if (!is_nearer(path.distance, path.site, distance, site)) continue;
            distance = path.distance;
            site = path.site;
        }
    }
}

void label_edges(const StageInput& input, std::span<const Index> half_edges, EdgeLabels& labels,
                 bool may_guess) {
    constexpr Index grain = 512;
    const auto count = static_cast<Index>(half_edges.size());
    std::vector<FoundRows> found(num_chunks(count, grain));
    const auto label_chunk = [&](Index chunk, Index begin, Index end) {
        label_some(input, labels, half_edges.subspan(begin, end - begin), may_guess, found[chunk]);
    };
    parallel_chunks(count, grain, input.num_threads, label_chunk, input.poller);
    if (labels.crossings.empty()) {
        std::size_t num_crossings = 0;
        for (const FoundRows& chunk : found) num_crossings += chunk.crossings.size();
        labels.crossings.reserve(num_crossings + num_crossings / 8);  // And those of cuts.
    }
    for (const FoundRows& chunk : found) {
        input.poller.poll();
        const auto begin = size_of(labels.crossings);
        for (const auto& [edge, row] : chunk.rows) {
            labels.edge_rows[edge] = {begin + row.begin, row.count};
        }
        append_to<Crossing>(labels.crossings, chunk.crossings);
    }
}

void find_guessed(const StageInput& input, std::vector<Index>& half_edges, EdgeLabels& labels) {
    for (Index& h : half_edges) h = input.surface.edge_half[input.surface.edge[h]];
    std::sort(half_edges.begin(), half_edges.end());
    half_edges.erase(std::unique(half_edges.begin(), half_edges.end()), half_edges.end());
    std::erase_if(half_edges, [&](Index h) {
        const auto row = labels.on_edge(input.surface.edge[h]);
        return row.empty() || row[0].distance != guessed;
    });
    label_edges(input, half_edges, labels);
}

}  // namespace agvd
