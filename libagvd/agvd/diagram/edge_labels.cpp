#include "agvd/diagram/edge_labels.h"

#include <algorithm>

#include "agvd/core/parallel.h"

namespace agvd {
namespace {

constexpr Index grain = 256;

void list_mixed_faces(const Surface& surface, const Propagation& propagation, EdgeLabels& labels) {
    labels.mixed_index.assign(surface.num_faces(), no_index);
    for (Index i = 0; i < propagation.mixed_faces.size(); ++i) {
        labels.mixed_index[propagation.mixed_faces[i]] = i;
    }
}

void label_vertices(const Surface& surface, const Propagation& propagation, int num_threads,
                    EdgeLabels& labels) {
    const auto num_mixed = static_cast<Index>(propagation.mixed_faces.size());
    std::vector<std::array<Nearest, 3>> at_corner(num_mixed);
    parallel_chunks(num_mixed, grain, num_threads, [&](Index, Index begin, Index end) {
        std::vector<PlanarRelay> relays;
        for (Index i = begin; i < end; ++i) {
            relays.clear();
            append_planar(surface, relays_of(propagation, i), {}, relays);
            const auto corners = face_corners(surface, propagation.mixed_faces[i]);
            for (std::size_t k = 0; k < 3; ++k) at_corner[i][k] = nearest(relays, corners[k]);
        }
    });

    labels.vertex_distance = propagation.vertex_distance;
    labels.vertex_site.reserve(surface.num_vertices());
    for (const SiteId site : propagation.vertex_site) labels.vertex_site.push_back(site.value());
    std::vector<bool> is_fixed(surface.num_vertices(), false);
    for (Index f = 0; f < surface.num_faces(); ++f) {
        if (labels.mixed_index[f] != no_index) continue;
        for (const Index v : surface.mesh.triangles[f]) is_fixed[v] = true;
    }
    for (Index i = 0; i < num_mixed; ++i) {
        const Triangle& corners = surface.mesh.triangles[propagation.mixed_faces[i]];
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = corners[k];
            const Nearest& found = at_corner[i][k];
            if (is_fixed[v] || found.site == no_index) continue;
            if (is_nearer(found.distance, found.site, labels.vertex_distance[v],
                          labels.vertex_site[v])) {
                labels.vertex_distance[v] = found.distance;
                labels.vertex_site[v] = found.site;
            }
        }
    }
}

void list_edges(const Surface& surface, EdgeLabels& labels) {
    labels.edge_index.assign(surface.num_edges(), no_index);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        const Index twin = surface.twin[h];
        const bool all_listed =
            labels.mixed_index[Surface::face(h)] != no_index &&
            (twin == no_index || labels.mixed_index[Surface::face(twin)] != no_index);
        if (!all_listed) continue;
        labels.edge_index[e] = static_cast<Index>(labels.edges.size());
        labels.edges.push_back(e);
    }
}

// The relays of both faces and of the two ends, in the frame of the edge's edge_half.
void gather_relays(const Surface& surface, const Propagation& propagation, const EdgeLabels& labels,
                   Index edge, std::vector<PlanarRelay>& relays) {
    relays.clear();
    const Index h = surface.edge_half[edge];
    const Index twin = surface.twin[h];
    const double length = surface.length[edge];
    append_planar(surface, relays_of(propagation, labels.mixed_index[Surface::face(h)]),
                  from_face_frame(surface, h), relays);
    if (twin != no_index) {
        const Motion turn{{-1, 0}, {length, 0}};
        append_planar(surface, relays_of(propagation, labels.mixed_index[Surface::face(twin)]),
                      compose(turn, from_face_frame(surface, twin)), relays);
    }
    const Index a = surface.tail(h);
    const Index b = surface.head(h);
    relays.push_back(point_relay({0, 0}, labels.vertex_distance[a], labels.vertex_site[a]));
    relays.push_back(point_relay({length, 0}, labels.vertex_distance[b], labels.vertex_site[b]));
}

}  // namespace

EdgeLabels label_edges(const Surface& surface, const Propagation& propagation, int num_threads) {
    EdgeLabels labels;
    list_mixed_faces(surface, propagation, labels);
    label_vertices(surface, propagation, num_threads, labels);
    list_edges(surface, labels);

    const auto num_edges = static_cast<Index>(labels.edges.size());
    std::vector<std::vector<Crossing>> found(num_chunks(num_edges, grain));
    std::vector<std::vector<EdgeRelay>> won(found.size());
    std::vector<Index> num_won(num_edges);
    labels.crossing_counts.resize(num_edges);
    parallel_chunks(num_edges, grain, num_threads, [&](Index chunk, Index begin, Index end) {
        EnvelopeScratch scratch;
        std::vector<PlanarRelay> relays;
        std::vector<LabelInterval> intervals;
        std::vector<EnvelopePiece> pieces;
        for (Index i = begin; i < end; ++i) {
            const Index e = labels.edges[i];
            const Index h = surface.edge_half[e];
            gather_relays(surface, propagation, labels, e, relays);
            const Vec2 head(surface.length[e], 0);
            label_envelope(relays, {0, 0}, head, labels.vertex_site[surface.tail(h)],
                           labels.vertex_site[surface.head(h)], scratch, intervals, &pieces);
            num_won[i] = static_cast<Index>(pieces.size());
            for (const EnvelopePiece& piece : pieces) {
                won[chunk].push_back(
                    {piece.from, piece.weight, piece.begin, piece.end, piece.site});
            }
            labels.crossing_counts[i] = static_cast<Index>(intervals.size()) - 1;
            for (std::size_t k = 0; k + 1 < intervals.size(); ++k) {
                const Vec2 p = intervals[k].end * head;
                const double distance =
                    std::max(reach_from(relays, intervals[k].site, p).distance,
                             reach_from(relays, intervals[k + 1].site, p).distance);
                found[chunk].push_back(
                    {intervals[k].end, distance, intervals[k].site, intervals[k + 1].site});
            }
        }
    });
    Index offset = 0;
    for (const Index count : labels.crossing_counts) {
        labels.crossing_offsets.push_back(offset);
        offset += count;
    }
    labels.relay_offsets.assign(1, 0);
    for (const Index count : num_won) {
        labels.relay_offsets.push_back(labels.relay_offsets.back() + count);
    }
    for (const auto& part : won) {
        labels.relays.insert(labels.relays.end(), part.begin(), part.end());
    }
    for (const auto& part : found) {
        labels.crossings.insert(labels.crossings.end(), part.begin(), part.end());
    }
    return labels;
}

}  // namespace agvd
