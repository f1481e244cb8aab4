#include "agvd/diagram/edge_labels.h"

#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/diagram/edge_relays.h"
#include "agvd/diagram/envelope.h"

namespace agvd {
namespace {

constexpr Index grain = 512;

void list_mixed_faces(const Surface& surface, const Propagation& propagation, EdgeLabels& labels) {
    labels.mixed_index.assign(surface.num_faces(), no_index);
    for (Index i = 0; i < propagation.mixed_faces.size(); ++i) {
        labels.mixed_index[propagation.mixed_faces[i]] = i;
    }
}

void label_vertices(const Surface& surface, const Propagation& propagation,
                    std::span<const RelayReach> reaches, EdgeLabels& labels) {
    labels.vertex_distance = propagation.vertex_distance;
    labels.point_site.reserve(surface.num_vertices());
    for (const SiteId site : propagation.vertex_site) labels.point_site.push_back(site.value());
    std::vector<std::uint8_t> is_fixed(surface.num_vertices(), 0);
    for (Index f = 0; f < surface.num_faces(); ++f) {
        if (labels.mixed_index[f] != no_index) continue;
        for (const Index v : surface.mesh.triangles[f]) is_fixed[v] = 1;
    }
    for (const RelayReach& reach : reaches) {
        const Index next = Surface::next(reach.half_edge);
        const auto offer = [&](Index v, double distance) {
            if (is_fixed[v] != 0 ||
                !is_nearer(distance, reach.site, labels.vertex_distance[v], labels.point_site[v])) {
                return;
            }
            labels.vertex_distance[v] = distance;
            labels.point_site[v] = reach.site;
        };
        offer(surface.tail(reach.half_edge), reach.tail);
        offer(surface.tail(next), reach.head);
        offer(surface.tail(Surface::next(next)), reach.apex);
    }
}

// Whether this half-edge speaks for an edge all of whose faces are listed.
bool is_labelled(const Surface& surface, const EdgeLabels& labels, Index half_edge) {
    const Index twin = surface.twin[half_edge];
    return twin == no_index ||
           (half_edge < twin && labels.mixed_index[Surface::face(twin)] != no_index);
}

struct FoundRows {
    std::vector<CrossingRow> rows;
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
            out_.rows.push_back({edge, static_cast<Index>(out_.crossings.size()), 1});
            out_.crossings.push_back({at / length, distance_there, site_at_tail, site_at_head});
            return;
        }
        label_envelope(relays_, length, site_at_tail, site_at_head, scratch_, intervals_);
        const auto count = static_cast<Index>(intervals_.size()) - 1;
        if (count == 0) return;
        out_.rows.push_back({edge, static_cast<Index>(out_.crossings.size()), count});
        for (Index k = 0; k < count; ++k) {
            const Index before = intervals_[k].site;
            const Index after = intervals_[k + 1].site;
            const double x = intervals_[k].end * length;
            const double distance =
                std::max(distance_on_line(relays_, before, x), distance_on_line(relays_, after, x));
            out_.crossings.push_back({intervals_[k].end, distance, before, after});
        }
    }

private:
    const Surface& surface_;
    const EdgeLabels& labels_;
    EdgeRelays edge_relays_;
    FoundRows& out_;
    std::vector<LineRelay> relays_;
    std::vector<LabelInterval> intervals_;
    EnvelopeScratch scratch_;
};

void append_rows(const std::vector<FoundRows>& found, EdgeLabels& labels) {
    for (const FoundRows& part : found) {
        const auto offset = static_cast<Index>(labels.crossings.size());
        for (CrossingRow row : part.rows) {
            labels.edge_row[row.edge] = static_cast<Index>(labels.rows.size());
            row.begin += offset;
            labels.rows.push_back(row);
        }
        labels.crossings.insert(labels.crossings.end(), part.crossings.begin(),
                                part.crossings.end());
    }
}

}  // namespace

EdgeLabels label_edges(const Surface& surface, const Propagation& propagation,
                       std::span<const RelayReach> reaches, int num_threads) {
    EdgeLabels labels;
    list_mixed_faces(surface, propagation, labels);
    label_vertices(surface, propagation, reaches, labels);
    labels.edge_row.assign(surface.num_edges(), no_index);

    const auto num_mixed = static_cast<Index>(propagation.mixed_faces.size());
    std::vector<FoundRows> found(num_chunks(num_mixed, grain));
    parallel_chunks(num_mixed, grain, num_threads, [&](Index chunk, Index begin, Index end) {
        EdgeLabeller labeller(surface, labels, {surface, propagation, reaches, labels},
                              found[chunk]);
        for (Index i = begin; i < end; ++i) {
            const Index face = propagation.mixed_faces[i];
            for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                if (is_labelled(surface, labels, h)) labeller.label(h);
            }
        }
    });
    append_rows(found, labels);
    return labels;
}

}  // namespace agvd
