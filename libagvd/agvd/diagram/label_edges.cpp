#include "agvd/diagram/label_edges.h"

#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/diagram/cell_tally.h"
#include "agvd/diagram/edge_relays.h"
#include "agvd/diagram/envelope.h"
#include "agvd/diagram/touched_parts.h"
#include "agvd/mesh/one_ring.h"

namespace agvd {
namespace {

constexpr Index grain = 512;

// A path through the relays of one face that is shorter than what the engine found.
struct ShorterPath {
    Index vertex;
    Index site;
    double distance;
};

// Those to corners that are not fixed.
void find_shorter_paths(const Surface& surface, const Propagation& propagation,
                        const std::vector<std::uint8_t>& is_fixed, Index mixed_index,
                        std::vector<ShorterPath>& out) {
    const Index face = propagation.mixed_faces[mixed_index];
    const Triangle& corners = surface.mesh.triangles[face];
    if ((is_fixed[corners[0]] & is_fixed[corners[1]] & is_fixed[corners[2]]) != 0) return;
    // No path through a relay is shorter than the straight line: most are told without roots. What
    // is nearer by less than this share is not worth another label.
    constexpr double least_gain = 1e-9;
    std::array<double, 3> limits;
    for (std::size_t k = 0; k < 3; ++k) {
        limits[k] = (1 - least_gain) * propagation.vertex_distance[corners[k]];
    }
    for (const Relay& relay : relays_of(propagation, mixed_index)) {
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
            if (distance >= limits[corner] || is_fixed[v] != 0) return;
            out.push_back({v, relay.site.value(), distance});
        };
        offer(k, to.tail);
        offer(at_head, to.head);
        offer(at_apex, to.apex);
    }
}

// #V: 1 for the vertices that keep what they have: those of an unlisted face, and those that are
// not touched.
std::vector<std::uint8_t> fixed_vertices(const Surface& surface, const EdgeLabels& labels,
                                         const TouchedParts& touched) {
    std::vector<std::uint8_t> is_fixed(surface.num_vertices(), touched.is_all() ? 0 : 1);
    for (const Index v : touched.vertices()) {
        is_fixed[v] = 0;
        for_each_outgoing(surface, v, [&](Index h) {
            if (labels.mixed_index[Surface::face(h)] == no_index) is_fixed[v] = 1;
        });
    }
    if (!touched.is_all()) return is_fixed;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        if (labels.mixed_index[f] != no_index) continue;
        for (const Index v : surface.mesh.triangles[f]) is_fixed[v] = 1;
    }
    return is_fixed;
}

// Fetches what labelling the edges of a listed face reads of its neighbours: first where their
// relays are, then, with `relays_too`, the relays. Always inline: g++ drops calls of functions that
// do nothing but prefetch.
[[gnu::always_inline]] inline void prefetch_neighbours(const Surface& surface,
                                                       const Propagation& propagation,
                                                       const RelayGroups& groups,
                                                       const EdgeLabels& labels, Index face,
                                                       bool relays_too) {
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const Index twin = surface.twin[h];
        if (twin == no_index || twin < h) continue;
        const Index* const neighbour = &labels.mixed_index[Surface::face(twin)];
        if (!relays_too) {
            __builtin_prefetch(neighbour);
            __builtin_prefetch(&surface.length[surface.edge[h]]);
            __builtin_prefetch(&surface.edge_half[surface.edge[h]]);
        } else if (*neighbour != no_index) {
            groups.prefetch(*neighbour);
            for (const Relay& r : relays_of(propagation, *neighbour)) __builtin_prefetch(&r);
        }
    }
}

// Whether this half-edge speaks for an edge all of whose faces are listed.
bool is_labelled(const Surface& surface, const EdgeLabels& labels, Index half_edge) {
    const Index twin = surface.twin[half_edge];
    return twin == no_index ||
           (half_edge < twin && labels.mixed_index[Surface::face(twin)] != no_index);
}

struct FoundRow {
    Index edge;
    Block crossings;
};

struct FoundRows {
    std::vector<FoundRow> rows;
    std::vector<Crossing> crossings;
};

class EdgeLabeller {
public:
    EdgeLabeller(const Surface& surface, const EdgeLabels& labels, EdgeRelays relays,
                 FoundRows& out)
        : surface_(surface), labels_(labels), edge_relays_(std::move(relays)), out_(out) {}

    void label(Index half_edge) {
        const Index edge = surface_.edge[half_edge];
        if (!edge_relays_.may_change(edge, relays_)) return;
        const double length = surface_.length[edge];
        const Index site_at_tail = labels_.point_site[surface_.tail(half_edge)];
        const Index site_at_head = labels_.point_site[surface_.head(half_edge)];
        double at, distance_there;
        if (site_at_tail != site_at_head &&
            find_single_crossing(relays_, length, site_at_tail, site_at_head, at, distance_there)) {
            begin_row(edge, 1);
            out_.crossings.push_back(
                {at / length, distance_there, site_at_tail, site_at_head, half_edge});
            return;
        }
        label_envelope(relays_, length, site_at_tail, site_at_head, scratch_, intervals_);
        const auto count = static_cast<Index>(intervals_.size()) - 1;
        if (count == 0) return;
        begin_row(edge, count);
        for (Index k = 0; k < count; ++k) {
            const Index before = intervals_[k].site;
            const Index after = intervals_[k + 1].site;
            const double x = intervals_[k].end * length;
            const double distance =
                std::max(distance_on_line(relays_, before, x), distance_on_line(relays_, after, x));
            out_.crossings.push_back({intervals_[k].end, distance, before, after, half_edge});
        }
    }

private:
    void begin_row(Index edge, Index count) {
        out_.rows.push_back({edge, {static_cast<Index>(out_.crossings.size()), count}});
    }

    const Surface& surface_;
    const EdgeLabels& labels_;
    EdgeRelays edge_relays_;
    FoundRows& out_;
    std::vector<LineRelay> relays_;
    std::vector<LabelInterval> intervals_;
    EnvelopeScratch scratch_;
};

void reserve_crossings(std::span<const FoundRows> found, EdgeLabels& labels) {
    std::size_t count = 0;
    for (const FoundRows& part : found) count += part.crossings.size();
    labels.crossings.reserve(count + count / 8);  // And those of cuts.
}

void replace_row(Index edge, std::span<const Crossing> now, TouchedParts& touched,
                 EdgeLabels& labels, CellTally& tally) {
    const std::span<const Crossing> old = labels.on_edge(edge);
    const bool is_same = std::equal(old.begin(), old.end(), now.begin(), now.end());
    touched.settle_edge(edge, is_same);
    if (is_same) return;
    tally.count_row(old, -1);
    tally.count_row(now, 1);
    labels.crossings.release(labels.edge_rows[edge]);
    labels.edge_rows[edge] = labels.crossings.add(now);
}

}  // namespace

void list_mixed_faces(const Surface& surface, const Propagation& propagation, EdgeLabels& labels) {
    labels.mixed_index.assign(surface.num_faces(), no_index);
    for (Index i = 0; i < propagation.mixed_faces.size(); ++i) {
        labels.mixed_index[propagation.mixed_faces[i]] = i;
    }
}

void label_vertices(const Surface& surface, const Propagation& propagation,
                    const TouchedParts& touched, std::span<const Index> mixed, int num_threads,
                    Poller& poller, EdgeLabels& labels) {
    if (touched.is_all()) {
        labels.vertex_distance = propagation.vertex_distance;
        labels.point_site.clear();
        labels.point_site.reserve(surface.num_vertices());
        for (const SiteId site : propagation.vertex_site) labels.point_site.push_back(site.value());
    }
    for (const Index v : touched.vertices()) {
        labels.vertex_distance[v] = propagation.vertex_distance[v];
        labels.point_site[v] = propagation.vertex_site[v].value();
    }
    const std::vector<std::uint8_t> is_fixed = fixed_vertices(surface, labels, touched);
    const auto count = static_cast<Index>(mixed.size());
    std::vector<std::vector<ShorterPath>> found(num_chunks(count, grain));
    const auto find = [&](Index chunk, Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            find_shorter_paths(surface, propagation, is_fixed, mixed[i], found[chunk]);
        }
    };
    parallel_chunks(count, grain, num_threads, find, poller);
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

void label_edges(const Surface& surface, const Propagation& propagation, const RelayGroups& groups,
                 std::span<const Index> mixed, int num_threads, Poller& poller,
                 TouchedParts& touched, EdgeLabels& labels, CellTally& tally) {
    const auto count = static_cast<Index>(mixed.size());
    std::vector<FoundRows> found(num_chunks(count, grain));
    const auto label_chunk = [&](Index chunk, Index begin, Index end) {
        EdgeLabeller labeller(surface, labels, {surface, propagation, groups, labels},
                              found[chunk]);
        Ticker ticker(poller);
        for (Index i = begin; i < end; ++i) {
            constexpr Index ahead = 2;
            for (const bool relays_too : {true, false}) {
                const Index later = i + (relays_too ? ahead : 2 * ahead);
                if (later >= end) continue;
                prefetch_neighbours(surface, propagation, groups, labels,
                                    propagation.mixed_faces[mixed[later]], relays_too);
            }
            const Index face = propagation.mixed_faces[mixed[i]];
            for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                if (is_labelled(surface, labels, h) && !touched.holds_on_edge(h)) labeller.label(h);
            }
            ticker.tick(1 + relays_of(propagation, mixed[i]).size());
        }
    };
    parallel_chunks(count, grain, num_threads, label_chunk, poller);
    if (touched.is_all()) reserve_crossings(found, labels);
    for (const FoundRows& part : found) {
        poller.poll();
        for (const FoundRow& row : part.rows) {
            replace_row(row.edge,
                        std::span(part.crossings).subspan(row.crossings.begin, row.crossings.count),
                        touched, labels, tally);
        }
    }
    for (const Index face : touched.faces()) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Index edge = surface.edge[h];
            if (labels.edge_rows[edge].count == 0 || touched.holds_on_edge(h)) continue;
            if (!touched.is_settled(edge)) replace_row(edge, {}, touched, labels, tally);
        }
    }
}

}  // namespace agvd
