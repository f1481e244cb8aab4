// Stages 1 and 2 of the diagram on what a change touches. The tally is corrected for every label
// that differs from the one before. Vertices that islands had relabelled get their own labels back
// before, so that islands are found anew as in a fresh run.
#include "agvd/update/update_labels.h"

#include <algorithm>
#include <utility>

#include "agvd/diagram/face_relays.h"
#include "agvd/diagram/label_vertices.h"
#include "agvd/mesh/one_ring.h"

namespace agvd {
namespace {

// Of an unlisted face; no_index: it is listed.
Index label_of(const Surface& surface, const EdgeLabels& labels, Index face) {
    return labels.mixed_index[face] == no_index ? labels.point_site[surface.mesh.triangles[face][0]]
                                                : no_index;
}

std::vector<Index> face_labels(const Surface& surface, const EdgeLabels& labels,
                               std::span<const Index> faces) {
    std::vector<Index> result;
    result.reserve(faces.size());
    for (const Index face : faces) result.push_back(label_of(surface, labels, face));
    return result;
}

std::vector<Nearest> vertex_labels(const EdgeLabels& labels, std::span<const Index> vertices) {
    std::vector<Nearest> result;
    result.reserve(vertices.size());
    for (const Index v : vertices) {
        result.push_back({labels.point_site[v], labels.vertex_distance[v]});
    }
    return result;
}

// By vertex: 1 for those that are not touched or belong to an unlisted face.
std::vector<std::uint8_t> fixed_vertices(const Surface& surface, const EdgeLabels& labels,
                                         std::span<const Index> touched) {
    std::vector<std::uint8_t> is_fixed(surface.num_vertices(), 1);
    for (const Index v : touched) {
        is_fixed[v] = 0;
        for_each_outgoing(surface, v, [&](Index h) {
            if (labels.mixed_index[Surface::face(h)] == no_index) is_fixed[v] = 1;
        });
    }
    return is_fixed;
}

void count_vertices(std::span<const Nearest> before, TouchedParts& touched, DiagramParts& parts) {
    for (Index i = 0; i < before.size(); ++i) {
        const Index v = touched.vertices()[i];
        const auto& [site, distance] = before[i];
        if (parts.labels.point_site[v] != site) {
            parts.tally.count_vertex(v, site, -1);
            parts.tally.count_vertex(v, parts.labels.point_site[v], 1);
        } else if (parts.labels.vertex_distance[v] == distance) {
            touched.clear_vertex(v);
        }
    }
}

void count_unlisted_faces(const Surface& surface, std::span<const Index> faces,
                          std::span<const Index> before, DiagramParts& parts) {
    for (Index i = 0; i < faces.size(); ++i) {
        const Index label = label_of(surface, parts.labels, faces[i]);
        if (label == before[i]) continue;
        parts.tally.count_face(faces[i], before[i], -1);
        parts.tally.count_face(faces[i], label, 1);
    }
}

void replace_row(Index edge, std::span<const Crossing> now, TouchedParts& touched,
                 DiagramParts& parts) {
    EdgeLabels& labels = parts.labels;
    const std::span<const Crossing> old = std::as_const(labels).on_edge(edge);
    const bool is_same = std::equal(old.begin(), old.end(), now.begin(), now.end());
    touched.settle_edge(edge, is_same);
    if (is_same) return;
    parts.tally.count_row(old, -1);
    parts.tally.count_row(now, 1);
    labels.crossings.release(labels.edge_rows[edge]);
    labels.edge_rows[edge] = labels.crossings.add(now);
}

}  // namespace

std::vector<Index> restore_labels(const Surface& surface, KeptDiagram& kept) {
    std::vector<Index> vertices;
    for (auto old = kept.absorbed.points.rbegin(); old != kept.absorbed.points.rend(); ++old) {
        Index& label = kept.parts.labels.point_site[old->point];
        const Index absorbed = std::exchange(label, old->site);
        recount_vertex(surface, old->point, absorbed, kept.parts);
        vertices.push_back(old->point);
    }
    kept.absorbed.points.clear();
    return vertices;
}

void update_vertices(const StageInput& input, TouchedParts& touched, DiagramParts& parts) {
    const Surface& surface = input.surface;
    const Propagation& propagation = input.propagation;
    EdgeLabels& labels = parts.labels;
    const std::vector<Index> faces_before = face_labels(surface, labels, touched.faces());
    const std::vector<Nearest> vertices_before = vertex_labels(labels, touched.vertices());
    list_mixed_faces(propagation, surface.num_faces(), labels);
    for (const Index v : touched.vertices()) {
        labels.vertex_distance[v] = propagation.vertex_distance[v];
        labels.point_site[v] = propagation.vertex_site[v].value();
    }
    take_nearer_sites(input, fixed_vertices(surface, labels, touched.vertices()),
                      positions_of(labels, touched.faces()), labels);
    count_vertices(vertices_before, touched, parts);
    count_unlisted_faces(surface, touched.faces(), faces_before, parts);
}

std::vector<Index> faces_with_stale_edges(const TouchedParts& touched, const EdgeLabels& labels) {
    std::vector<Index> faces;
    for (const Index face : touched.faces()) {
        if (labels.mixed_index[face] != no_index && !touched.holds_on_edges_of(face)) {
            faces.push_back(face);
        }
    }
    return faces;
}

void update_edges(const StageInput& input, std::span<const Index> faces, TouchedParts& touched,
                  DiagramParts& parts) {
    std::vector<Index> half_edges;
    for (const Index face : faces) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (is_labelled(input.surface, parts.labels, h) && !touched.holds_on_edge(h)) {
                half_edges.push_back(h);
            }
        }
    }
    for (const FoundRows& chunk : find_rows(input, half_edges, parts.labels)) {
        input.poller.poll();
        for (const FoundRows::Row& row : chunk.rows) {
            replace_row(row.edge, chunk.of(row), touched, parts);
        }
    }
    // Edges without label changes, or with an unlisted face, have no row any more.
    for (const Index face : touched.faces()) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Index edge = input.surface.edge[h];
            if (parts.labels.edge_rows[edge].count == 0 || touched.holds_on_edge(h)) continue;
            if (!touched.is_settled(edge)) replace_row(edge, {}, touched, parts);
        }
    }
}

}  // namespace agvd
