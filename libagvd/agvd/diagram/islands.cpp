// Points and intervals of one label that touch are united by union-find. What is not united with
// its cell's site is an island. Nodes are numbered as in intervals.h. It gets the label of a
// neighbouring cell that is connected to its own site, on edges and cuts alike, and the faces
// around it lose their arcs, which are traced again.
#include "agvd/diagram/islands.h"

#include <algorithm>
#include <map>
#include <utility>

#include "agvd/core/union_find.h"
#include "agvd/diagram/intervals.h"
#include "agvd/diagram/loops.h"
#include "agvd/diagram/site_holders.h"
#include "agvd/mesh/surface.h"

namespace agvd {
namespace {

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
    std::vector<Index> mainland;      // By site: the root of the set that holds it.
    std::map<Index, Index> new_site;  // By root of an island.
    std::vector<Row> island_rows;     // With an interval on an island.
};

// Ascending: the faces that any of these cells reaches into, as far as they are connected to an
// edge between cells.
std::vector<Index> faces_of_cells(const Surface& surface, const DiagramParts& parts,
                                  const CellSet& cells) {
    const auto is_reached = [&](Index face) {
        if (parts.labels.mixed_index[face] == no_index) {
            return cells.has(parts.labels.point_site[surface.mesh.triangles[face][0]]);
        }
        const auto in_face = parts.arcs.parts()[parts.arcs.of_face(face).parts];
        return std::any_of(in_face.begin(), in_face.end(),
                           [&](const FaceArcs::CellPart& part) { return cells.has(part.site); });
    };
    std::vector<Index> faces;
    std::vector<std::uint8_t> is_seen(surface.num_faces(), 0);
    const auto visit = [&](Index face) {
        if (std::exchange(is_seen[face], 1) == 0 && is_reached(face)) faces.push_back(face);
    };
    for (const Index face : faces_on_borders(parts, cells)) visit(face);
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
            if (!search.in_doubt.has(labels.point_site[t[0]])) continue;
            search.sets.unite(t[0], t[1]);
            search.sets.unite(t[1], t[2]);
            continue;
        }
        for (Index k = 0; k < 3; ++k) {
            const Index twin = surface.twin[3 * f + k];
            if (twin < 3 * f + k || !search.in_doubt.has(labels.point_site[t[k]])) continue;
            if (labels.edge_rows[surface.edge[3 * f + k]].count > 0) continue;
            search.sets.unite(t[k], t[k == 2 ? 0 : k + 1]);
        }
    }
    for (const CutFace& face : labels.cut_faces) {
        for (const Cut& cut : labels.cuts[face.cuts]) {
            if (cut.row.count == 0) search.sets.unite(cut.from.point, cut.to.point);
        }
    }
}

// Through faces.
void unite_connected(IslandSearch& search) {
    const auto num_points = static_cast<Index>(search.parts.labels.point_site.size());
    const auto node_of = [&](IntervalId interval) {
        return interval.follows_crossing() ? num_points + interval.crossing() : interval.point();
    };
    const ArcStore& arcs = search.parts.arcs;
    for (const Index face : search.faces) {
        for (const Connection& c : arcs.connections()[arcs.of_face(face).connections]) {
            if (search.in_doubt.has(c.site)) search.sets.unite(node_of(c.a), node_of(c.b));
        }
    }
}

void find_mainland(IslandSearch& search) {
    const EdgeLabels& labels = search.parts.labels;
    const auto num_sites = static_cast<Index>(search.in.sites.size());
    search.mainland.assign(num_sites, no_index);
    for (Index i = 0; i < labels.inner_points.size(); ++i) {
        const Index site = labels.inner_points[i].site;
        if (!search.in_doubt.has(site)) continue;
        search.mainland[site] = search.sets.root(search.in.surface.num_vertices() + i);
    }
    for (Index s = 0; s < num_sites; ++s) {
        if (!search.in_doubt.has(s)) continue;
        const Index node = holder_of(search.in, labels, s);
        if (node != no_index) search.mainland[s] = search.sets.root(node);
    }
}

bool is_island(IslandSearch& search, Index node, Index site) {
    return search.in_doubt.has(site) && search.sets.root(node) != search.mainland[site];
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
    for (const CutFace& face : labels.cut_faces) {
        for (Cut& cut : labels.cuts[face.cuts]) {
            if (cut.row.count > 0) callback(Row{&cut.row, cut.from.point, cut.to.point});
        }
    }
}

// Islands border on other cells at crossings. Each goes to the lowest-numbered cell that it borders
// on and that is connected to its site there.
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

void count_row(const IslandSearch& search, const Row& row, LineId line, int sign) {
    const EdgeLabels& labels = search.parts.labels;
    const std::span<const Crossing> crossings = labels.crossings[*row.crossings];
    if (line.is_cut()) {
        search.parts.tally.count_cut(crossings, labels.point_site[row.to], sign);
    } else {
        search.parts.tally.count_row(crossings, sign);
    }
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
    count_row(search, row, line, -1);
    labels.crossings.release(*row.crossings);
    *row.crossings = labels.crossings.add(kept);
    count_row(search, row, line, 1);
    add_faces_of_line(search, line, stale_faces);
}

// An inner point is the place of its site, so only mesh vertices get other labels.
void relabel_points(IslandSearch& search, RelabelledIslands& out) {
    const Surface& surface = search.in.surface;
    EdgeLabels& labels = search.parts.labels;
    for (const Index face : search.faces) {
        for (const Index v : surface.mesh.triangles[face]) {
            const Index old_site = labels.point_site[v];
            if (!is_island(search, v, old_site)) continue;
            const Index site = new_site_of(search, v, old_site);
            if (site == old_site) continue;
            out.points.push_back({v, old_site});
            labels.point_site[v] = site;
            for_each_outgoing(surface, v, [&](Index h) { out.faces.push_back(Surface::face(h)); });
        }
    }
}

}  // namespace

CellSet cells_in_doubt(const CellSet& displaced, std::span<const Index> num_loops) {
    CellSet result(static_cast<Index>(num_loops.size()));
    for (Index s = 0; s < num_loops.size(); ++s) {
        if (num_loops[s] > 1 || (num_loops[s] == 1 && displaced.has(s))) result.insert(s);
    }
    return result;
}

RelabelledIslands relabel_islands(const StageInput& input, const CellSet& in_doubt,
                                  DiagramParts& parts) {
    const EdgeLabels& labels = parts.labels;
    const std::vector<Index> faces = faces_of_cells(input.surface, parts, in_doubt);
    IslandSearch search{input,
                        in_doubt,
                        faces,
                        parts,
                        UnionFind(labels.point_site.size() + labels.crossings.size()),
                        {},
                        {},
                        {}};
    unite_points(search);
    unite_connected(search);
    find_mainland(search);
    choose_new_sites(search);
    RelabelledIslands out;
    if (search.new_site.empty()) return out;
    for (const Row& row : search.island_rows) relabel_row(search, row, out.faces);
    relabel_points(search, out);
    std::sort(out.faces.begin(), out.faces.end());
    out.faces.erase(std::unique(out.faces.begin(), out.faces.end()), out.faces.end());
    std::erase_if(out.faces, [&](Index face) { return labels.mixed_index[face] == no_index; });
    return out;
}

}  // namespace agvd
