#include "agvd/diagram/diagram.h"

#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/diagram/cuts.h"
#include "agvd/diagram/earlier_parts.h"
#include "agvd/diagram/edge_relays.h"
#include "agvd/diagram/islands.h"
#include "agvd/diagram/join.h"
#include "agvd/mesh/face_area.h"

namespace agvd {
namespace {

// Areas and Euler characteristics: the open cell is a union of open pieces of triangles, open
// intervals of inner edges and cuts, and inner points, and for a surface without its boundary their
// alternating sum is the Euler characteristic.
class CellMeasurer {
public:
    CellMeasurer(const Surface& surface, const EdgeLabels& labels, Diagram& diagram)
        : surface_(surface), labels_(labels), diagram_(diagram) {
        diagram.cell_area.assign(diagram.num_sites, 0);
        diagram.cell_euler.assign(diagram.num_sites, 0);
    }

    void run(std::span<const FaceArcs> chunks) {
        add_faces_of_one_label();
        for (const FaceArcs& chunk : chunks) {
            for (const FaceArcs::CellPart& part : chunk.parts) {
                count(part.site, part.pieces);
                if (part.site != no_index) diagram_.cell_area[part.site] += part.area;
            }
        }
        for (const CrossingRow& row : labels_.rows) add_row(row);
        for (const Cut& cut : labels_.cuts) count(labels_.point_site[cut.from], -1);
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            if (surface_.outgoing[v] != no_index) count(labels_.point_site[v], 1);
        }
        for (const InnerPoint& point : labels_.inner_points) count(point.site, 1);
    }

private:
    void count(Index site, int change) {
        if (site != no_index) diagram_.cell_euler[site] += change;
    }

    // Also takes out the first interval of each inner edge, and what is on the boundary: one edge
    // of it leaves each of its vertices.
    void add_faces_of_one_label() {
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            const Triangle& corners = surface_.mesh.triangles[f];
            for (Index k = 0; k < 3; ++k) {
                const Index h = 3 * f + k;
                if (h < surface_.twin[h]) count(labels_.point_site[corners[k]], -1);
            }
            if (labels_.mixed_index[f] != no_index) continue;
            const Index site = labels_.point_site[corners[0]];
            count(site, 1);
            if (site != no_index) diagram_.cell_area[site] += face_area(surface_, f);
        }
    }

    void add_row(const CrossingRow& row) {
        if (row.edge < CrossingRow::first_cut &&
            surface_.twin[surface_.edge_half[row.edge]] == no_index) {
            return;
        }
        for (Index c = row.begin; c < row.begin + row.count; ++c) {
            count(labels_.crossings[c].site_after, -1);
        }
    }

    const Surface& surface_;
    const EdgeLabels& labels_;
    Diagram& diagram_;
};

// #mixed: 1 for the faces that are labelled or traced and those across their edges: their relays
// are asked for.
template <typename IsDone>
std::vector<std::uint8_t> faces_to_ask(const Surface& surface, const Propagation& propagation,
                                       const IsDone& is_done) {
    std::vector<std::uint8_t> is_asked;
    is_asked.reserve(propagation.mixed_faces.size());
    for (const Index face : propagation.mixed_faces) {
        bool is_near = is_done(face);
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Index twin = surface.twin[h];
            is_near = is_near || (twin != no_index && is_done(Surface::face(twin)));
        }
        is_asked.push_back(is_near ? 1 : 0);
    }
    return is_asked;
}

}  // namespace

Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                      const Propagation& propagation, const DiagramOptions& options,
                      EarlierParts* earlier, DiagramParts& parts) {
    constexpr Index grain = DiagramParts::grain;
    poll(options.progress, 0);
    const SitePlacement placement(surface, sites);
    std::vector<std::uint8_t> is_asked;
    if (earlier != nullptr) {
        is_asked = faces_to_ask(surface, propagation, [&](Index face) {  // Sites: each time.
            return earlier->is_near_change(face) || !placement.in_face(face).empty();
        });
    }
    RelayGroups groups(propagation, is_asked, options.num_threads);
    parts.labels = label_edges(surface, propagation, groups, earlier, options.num_threads);
    EdgeLabels& labels = parts.labels;
    parts.vertex_site = labels.point_site;
    cut_faces(surface, propagation, placement, groups, options.num_threads, labels);
    const std::vector<Index> joined_points = join_points(surface, labels);
    poll(options.progress, 0.5);

    const auto num_mixed = static_cast<Index>(propagation.mixed_faces.size());
    parts.chunks = std::vector<FaceArcs>(num_chunks(num_mixed, grain));
    parts.mended_faces.clear();
    std::vector<std::uint8_t> is_chunk_stale(parts.chunks.size(), 1);
    std::vector<std::uint8_t> is_stale;
    bool is_first = true;
    while (true) {
        parallel_chunks(
            num_mixed, grain, options.num_threads, [&](Index chunk, Index begin, Index end) {
                if (is_chunk_stale[chunk] == 0) return;
                trace_faces(surface, propagation, groups, labels, is_first ? earlier : nullptr,
                            options.chord_tolerance, begin, end, parts.chunks[chunk]);
            });
        is_first = false;
        is_stale.assign(num_mixed, 0);
        if (absorb_islands(surface, sites, parts.chunks, joined_points, labels, is_stale) == 0) {
            break;
        }
        is_chunk_stale.assign(parts.chunks.size(), 0);
        for (Index i = 0; i < num_mixed; ++i) {
            if (is_stale[i] == 0) continue;
            parts.mended_faces.push_back(propagation.mixed_faces[i]);
            is_chunk_stale[i / grain] = 1;
        }
        if (earlier == nullptr) continue;
        is_asked = faces_to_ask(surface, propagation, [&](Index face) {
            const Index mixed = labels.mixed_index[face];
            return mixed != no_index && is_chunk_stale[mixed / grain] != 0;
        });
        groups = {propagation, is_asked, options.num_threads};
    }
    poll(options.progress, 0.9);

    Diagram diagram;
    diagram.num_sites = static_cast<Index>(sites.size());
    join_arcs(surface, labels, parts.chunks, diagram);
    CellMeasurer(surface, labels, diagram).run(parts.chunks);
    diagram.nearest_site.reserve(surface.num_vertices());
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        diagram.nearest_site.push_back(SiteId(labels.point_site[v]));
    }
    diagram.nearest_distance = labels.vertex_distance;
    poll(options.progress, 1);
    return diagram;
}

Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                      const Propagation& propagation, const DiagramOptions& options) {
    DiagramParts parts;
    return build_diagram(surface, sites, propagation, options, nullptr, parts);
}

}  // namespace agvd
