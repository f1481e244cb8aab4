// Points and stretches of one label that touch are united; what is not united with its cell's site
// is an island, and gets the label of a neighbouring cell that is connected to its own site.
#include <algorithm>
#include <map>
#include <utility>

#include "agvd/core/union_find.h"
#include "agvd/diagram/stages.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// By site. A site that is no_index has no cell.
using CellSet = std::vector<std::uint8_t>;

bool has(const CellSet& cells, Index site) { return site != no_index && cells[site] != 0; }

// --- Where sites lie ---------------------------------------------------------------------------

// The interval of an edge that holds a point on it, if it is of the point's site.
Index interval_of(const StageInput& in, const EdgeLabels& labels, Index point, Index half_edge) {
    const Surface& surface = in.surface;
    const Index e = surface.edge[half_edge];
    const bool forward = surface.edge_half[e] == half_edge;
    const double at = in.points[point].barycentric[(half_edge + (forward ? 1 : 0)) % 3];
    const Index tail = surface.tail(surface.edge_half[e]);
    const Index head = surface.head(surface.edge_half[e]);
    Index holder = tail;
    Index label = labels.point_site[tail];
    for_each_crossing(labels, labels.edge_rows[e], tail, head,
                      [&](Index c, Index, Index, Index after, Index site_after) {
                          if (labels.crossings[c].at > at) return;
                          holder = after;
                          label = site_after;
                      });
    return label == in.site_of_point[point] ? holder : no_index;
}

}  // namespace

Index holder_of(const StageInput& input, const EdgeLabels& labels, Index i) {
    const SurfacePoint& point = input.points[i];
    const Index site = input.site_of_point[i];
    if (const auto vertex = vertex_of(input.surface, point)) {
        return labels.point_site[*vertex] == site ? *vertex : no_index;
    }
    const auto half_edge = half_edge_of(point);
    if (half_edge) return interval_of(input, labels, i, *half_edge);
    // A site inside an unlisted face owns the face.
    const Index face = point.face.value();
    const Index v = input.surface.mesh.triangles[face][0];
    return labels.mixed_index[face] == no_index && labels.point_site[v] == site ? v : no_index;
}

namespace {

// The sites all of whose points belong to other cells. Islands that are absorbed change nothing of
// it.
CellSet find_displaced(const StageInput& input, Index num_sites, const EdgeLabels& labels) {
    CellSet displaced(num_sites, 1);
    for (Index i = 0; i < input.points.size(); ++i) {
        if (holder_of(input, labels, i) != no_index) displaced[input.site_of_point[i]] = 0;
    }
    for (const InnerPoint& point : labels.inner_points) displaced[point.site] = 0;
    return displaced;
}

// --- Islands -----------------------------------------------------------------------------------

// The cells that may have islands: all others are bounded by one loop, which each part would need
// for itself, and own the position of their site.
CellSet find_cells_in_doubt(const Diagram& complex, const CellSet& displaced, Ticker ticker) {
    Cells cells;
    collect_loops(complex, ticker, cells);
    CellSet in_doubt(displaced.size());
    for (Index s = 0; s < in_doubt.size(); ++s) {
        const Index num_loops = cells.cell_loops[s + 1] - cells.cell_loops[s];
        in_doubt[s] = num_loops > 1 || (num_loops == 1 && has(displaced, s)) ? 1 : 0;
    }
    return in_doubt;
}

// The label changes on an edge or a cut, and the points at its ends.
struct Row {
    Block* crossings;
    Index from, to;
};

struct IslandSearch {
    const StageInput& in;
    const CellSet& in_doubt;
    std::span<const Index> faces;  // All that the cells in doubt reach into.
    DiagramParts& parts;
    UnionFind sets;                   // Of nodes.
    CellSet is_mainland;              // By root: whether the set holds a point of its site.
    std::map<Index, Index> new_site;  // By root of an island.
    std::vector<Row> island_rows;     // With an interval on an island.
};

// Ascending: the faces that any of these cells reaches into, as far as they are connected to an
// edge between cells.
std::vector<Index> faces_of_cells(const Surface& surface, const DiagramParts& parts,
                                  const CellSet& cells) {
    const auto is_reached = [&](Index face) {
        if (parts.labels.mixed_index[face] == no_index) {
            return has(cells, parts.labels.point_site[surface.mesh.triangles[face][0]]);
        }
        const auto in_face =
            elements_of(parts.arcs.parts, parts.arcs.faces[parts.labels.mixed_index[face]].parts);
        return std::any_of(in_face.begin(), in_face.end(),
                           [&](const CellPart& part) { return has(cells, part.site); });
    };
    std::vector<Index> faces;
    std::vector<std::uint8_t> is_seen(surface.num_faces(), 0);
    const auto visit = [&](Index face) {
        if (std::exchange(is_seen[face], 1) == 0 && is_reached(face)) faces.push_back(face);
    };
    for (const JoinedEdges::Edge& edge : parts.joined.edges) {
        if (has(cells, edge.left) || has(cells, edge.right)) {
            visit(parts.arcs.arcs[edge.first.arc()].face);
        }
    }
    for (std::size_t i = 0; i < faces.size(); ++i) {
        for (Index h = 3 * faces[i]; h < 3 * faces[i] + 3; ++h) {
            if (surface.twin[h] != no_index) visit(Surface::face(surface.twin[h]));
        }
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

// Along edges and cuts of one label.
void unite_points(IslandSearch& search) {
    const Surface& surface = search.in.surface;
    const EdgeLabels& labels = search.parts.labels;
    for (const Index f : search.faces) {
        const Triangle& t = surface.mesh.triangles[f];
        if (labels.mixed_index[f] == no_index) {
            if (!has(search.in_doubt, labels.point_site[t[0]])) continue;
            search.sets.unite(t[0], t[1]);
            search.sets.unite(t[1], t[2]);
            continue;
        }
        for (Index k = 0; k < 3; ++k) {
            const Index twin = surface.twin[3 * f + k];
            if (twin < 3 * f + k || !has(search.in_doubt, labels.point_site[t[k]])) continue;
            if (labels.edge_rows[surface.edge[3 * f + k]].count > 0) continue;
            search.sets.unite(t[k], t[k == 2 ? 0 : k + 1]);
        }
    }
    for (const Cut& cut : labels.cuts) {
        if (cut.row.count == 0) search.sets.unite(cut.from.point, cut.to.point);
    }
}

// Through faces.
void unite_connected(IslandSearch& search) {
    const Arcs& arcs = search.parts.arcs;
    for (const Index face : search.faces) {
        const Index position = search.parts.labels.mixed_index[face];
        if (position == no_index) continue;
        for (const Connection& c :
             elements_of(arcs.connections, arcs.faces[position].connections)) {
            if (has(search.in_doubt, c.site)) search.sets.unite(c.a, c.b);
        }
    }
}

void find_mainland(IslandSearch& search) {
    const EdgeLabels& labels = search.parts.labels;
    search.is_mainland.assign(labels.num_nodes(), 0);
    for (Index i = 0; i < labels.inner_points.size(); ++i) {
        if (!has(search.in_doubt, labels.inner_points[i].site)) continue;
        search.is_mainland[search.sets.root(search.in.surface.num_vertices() + i)] = 1;
    }
    for (Index i = 0; i < search.in.points.size(); ++i) {
        if (!has(search.in_doubt, search.in.site_of_point[i])) continue;
        const Index node = holder_of(search.in, labels, i);
        if (node != no_index) search.is_mainland[search.sets.root(node)] = 1;
    }
}

bool is_island(IslandSearch& search, Index node, Index site) {
    return has(search.in_doubt, site) && search.is_mainland[search.sets.root(node)] == 0;
}

// Calls back for each row of these faces that has crossings.
template <typename Callback>
void for_each_row(IslandSearch& search, const Callback& callback) {
    const Surface& surface = search.in.surface;
    EdgeLabels& labels = search.parts.labels;
    for (const Index f : search.faces) {
        if (labels.mixed_index[f] == no_index) continue;
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            const Index e = surface.edge[h];
            if (surface.edge_half[e] != h || labels.edge_rows[e].count == 0) continue;
            callback(Row{&labels.edge_rows[e], surface.tail(h), surface.head(h)});
        }
    }
    for (Cut& cut : labels.cuts) {
        if (cut.row.count > 0) callback(Row{&cut.row, cut.from.point, cut.to.point});
    }
}

// Islands go to the lowest-numbered cell beside them that is connected to its site there.
void choose_new_sites(IslandSearch& search) {
    const auto give = [&](Index island, Index site) {
        const auto [found, is_new] = search.new_site.try_emplace(search.sets.root(island), site);
        if (!is_new) found->second = std::min(found->second, site);
    };
    for_each_row(search, [&](const Row& row) {
        bool has_island = false;
        for_each_crossing(search.parts.labels, *row.crossings, row.from, row.to,
                          [&](Index, Index a, Index site_a, Index b, Index site_b) {
                              const bool is_a = is_island(search, a, site_a);
                              const bool is_b = is_island(search, b, site_b);
                              has_island = has_island || is_a || is_b;
                              if (is_a && !is_b) give(a, site_b);
                              if (is_b && !is_a) give(b, site_a);
                          });
        if (has_island) search.island_rows.push_back(row);
    });
}

Index new_site_of(IslandSearch& search, Index node, Index site) {
    const auto found = search.new_site.find(search.sets.root(node));
    return found == search.new_site.end() ? site : found->second;
}

void add_faces_of_line(const IslandSearch& search, LineId line, std::vector<Index>& faces) {
    if (line.is_cut()) {
        faces.push_back(search.parts.labels.cuts[line.cut()].face);
        return;
    }
    faces.push_back(Surface::face(line.half_edge()));
    const Index twin = search.in.surface.twin[line.half_edge()];
    if (twin != no_index) faces.push_back(Surface::face(twin));
}

// Keeps the crossings between different sites.
void relabel_row(IslandSearch& search, const Row& row, std::vector<Index>& stale_faces) {
    EdgeLabels& labels = search.parts.labels;
    std::vector<Crossing> kept;
    bool is_changed = false;
    for_each_crossing(labels, *row.crossings, row.from, row.to,
                      [&](Index c, Index before, Index old_before, Index after, Index old_after) {
                          Crossing crossing = labels.crossings[c];
                          crossing.site_before = new_site_of(search, before, old_before);
                          crossing.site_after = new_site_of(search, after, old_after);
                          is_changed = is_changed || crossing.site_before != old_before ||
                                       crossing.site_after != old_after;
                          if (crossing.site_before != crossing.site_after) kept.push_back(crossing);
                      });
    if (!is_changed) return;
    const LineId line = labels.crossings[row.crossings->begin].line;
    *row.crossings = {size_of(labels.crossings), size_of(kept)};
    labels.crossings.insert(labels.crossings.end(), kept.begin(), kept.end());
    add_faces_of_line(search, line, stale_faces);
}

// An inner point is the position of its site, so only mesh vertices get other labels.
void relabel_points(IslandSearch& search, std::vector<Index>& stale_faces) {
    const Surface& surface = search.in.surface;
    EdgeLabels& labels = search.parts.labels;
    for (const Index face : search.faces) {
        for (const Index v : surface.mesh.triangles[face]) {
            const Index old_site = labels.point_site[v];
            if (!is_island(search, v, old_site)) continue;
            const Index site = new_site_of(search, v, old_site);
            if (site == old_site) continue;
            labels.point_site[v] = site;
            for_each_outgoing(surface, v,
                              [&](Index h) { stale_faces.push_back(Surface::face(h)); });
        }
    }
}

// Changes the labels of islands; returns the mixed faces around them, ascending positions.
std::vector<Index> relabel_islands(const StageInput& input, const CellSet& in_doubt,
                                   DiagramParts& parts) {
    const EdgeLabels& labels = parts.labels;
    const std::vector<Index> faces = faces_of_cells(input.surface, parts, in_doubt);
    UnionFind sets(labels.num_nodes());
    IslandSearch search{input, in_doubt, faces, parts, std::move(sets), {}, {}, {}};
    unite_points(search);
    unite_connected(search);
    find_mainland(search);
    choose_new_sites(search);
    if (search.new_site.empty()) return {};
    std::vector<Index> stale_faces;
    for (const Row& row : search.island_rows) relabel_row(search, row, stale_faces);
    relabel_points(search, stale_faces);
    std::vector<Index> positions;
    for (const Index face : stale_faces) {
        if (labels.mixed_index[face] != no_index) positions.push_back(labels.mixed_index[face]);
    }
    std::sort(positions.begin(), positions.end());
    positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
    return positions;
}

// Whether the relays that tracing these faces may read have been kept.
bool has_relays_around(const StageInput& input, const EdgeLabels& labels,
                       std::span<const Index> positions) {
    const std::vector<RelayRange>& ranges = input.propagation.relay_ranges;
    return std::all_of(positions.begin(), positions.end(), [&](Index position) {
        const Index face = input.propagation.mixed_faces[position];
        bool has_all = ranges[position] != dropped_relays;
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (input.surface.twin[h] == no_index) continue;
            const Index across = labels.mixed_index[Surface::face(input.surface.twin[h])];
            has_all = has_all && (across == no_index || ranges[across] != dropped_relays);
        }
        return has_all;
    });
}

}  // namespace

std::optional<Diagram> absorb_islands(const StageInput& input, DiagramParts& parts) {
    const CellSet displaced = find_displaced(input, parts.num_sites, parts.labels);
    while (true) {
        input.poller.poll();
        Ticker ticker(input.poller);
        Diagram complex = draw_complex(input.surface, parts, ticker);
        const CellSet in_doubt = find_cells_in_doubt(complex, displaced, ticker);
        if (std::find(in_doubt.begin(), in_doubt.end(), 1) == in_doubt.end()) return complex;
        const std::vector<Index> positions = relabel_islands(input, in_doubt, parts);
        if (positions.empty()) return complex;
        if (!has_relays_around(input, parts.labels, positions)) return {};
        trace_faces(input, positions, parts);
        parts.joined = join_arcs(parts.labels, parts.arcs, ticker);
    }
}

}  // namespace agvd
