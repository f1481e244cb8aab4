#include "agvd/diagram/islands.h"

#include <algorithm>
#include <map>
#include <utility>

#include "agvd/core/union_find.h"
#include "agvd/mesh/one_ring.h"
#include "agvd/propagation/site_placement.h"

namespace agvd {
namespace {

// Calls back for each crossing of a row with the intervals before and after it, by node: points,
// then the intervals after crossings that end at no point.
template <typename Callback>
void for_each_crossing(const EdgeLabels& labels, const Block& row, Index from, Index to,
                       const Callback& callback) {
    const auto num_points = static_cast<Index>(labels.point_site.size());
    Index before = from;
    for (Index c = row.begin; c < row.end(); ++c) {
        const Index after = c + 1 == row.end() ? to : num_points + c;
        const Crossing& crossing = labels.crossings[c];
        callback(c, before, crossing.site_before, after, crossing.site_after);
        before = after;
    }
}

// The interval of an edge that holds the site.
Index interval_of(const Surface& surface, const SurfacePoint& place, const EdgeLabels& labels,
                  Index s, Index half_edge) {
    const Index e = surface.edge[half_edge];
    const bool forward = surface.edge_half[e] == half_edge;
    const double at = place.barycentric[(half_edge + (forward ? 1 : 0)) % 3];
    const Index tail = surface.tail(surface.edge_half[e]);
    const Index head = surface.head(surface.edge_half[e]);
    Index holder = tail;
    Index site = labels.point_site[tail];
    for_each_crossing(labels, labels.edge_rows[e], tail, head,
                      [&](Index c, Index, Index, Index after, Index site_after) {
                          if (labels.crossings[c].at > at) return;
                          holder = after;
                          site = site_after;
                      });
    return site == s ? holder : no_index;
}

// The node that holds a site; no_index: its place belongs to another cell, or is an inner point.
Index holder_of(const Surface& surface, const SurfacePoint& place, const EdgeLabels& labels,
                Index s) {
    if (const auto vertex = vertex_of(surface, place)) {
        return labels.point_site[*vertex] == s ? *vertex : no_index;
    }
    const auto half_edge = half_edge_of(place);
    if (half_edge) return interval_of(surface, place, labels, s, *half_edge);
    // A site inside an unlisted face owns the face.
    const Index face = place.face.value();
    const Index v = surface.mesh.triangles[face][0];
    return labels.mixed_index[face] == no_index && labels.point_site[v] == s ? v : no_index;
}

class IslandFinder {
public:
    IslandFinder(const Surface& surface, std::span<const SurfacePoint> sites,
                 const CellSet& in_doubt, std::span<const Index> faces, EdgeLabels& labels)
        : surface_(surface),
          sites_(sites),
          in_doubt_(in_doubt),
          faces_(faces),
          labels_(labels),
          num_points_(static_cast<Index>(labels.point_site.size())),
          sets_(labels.point_site.size() + labels.crossings.size()) {}

    void connect(const ArcStore& arcs) {
        join_points();
        const auto node_of = [&](Index interval) {
            return interval < FaceArcs::first_interval
                       ? interval
                       : interval - FaceArcs::first_interval + num_points_;
        };
        for (const Index face : faces_) {
            for (const Connection& c : arcs.connections()[arcs.of_face(face).connections]) {
                if (in_doubt_.has(c.site)) unite(node_of(c.a), node_of(c.b));
            }
        }
        mainland_.assign(sites_.size(), no_index);
        for (Index i = 0; i < labels_.inner_points.size(); ++i) {
            const Index site = labels_.inner_points[i].site;
            if (in_doubt_.has(site)) mainland_[site] = root(surface_.num_vertices() + i);
        }
        for (Index s = 0; s < sites_.size(); ++s) {
            if (!in_doubt_.has(s)) continue;
            const Index node = holder_of(surface_, sites_[s], labels_, s);
            if (node != no_index) mainland_[s] = root(node);
        }
    }

    // Islands border on other cells at crossings. Each goes to the lowest-numbered cell that it
    // borders on and that hangs together with its site there.
    void choose_new_sites() {
        for_each_row([&](Block& row, Index from, Index to) {
            bool has_island = false;
            for_each_crossing(labels_, row, from, to,
                              [&](Index, Index a, Index site_a, Index b, Index site_b) {
                                  const bool is_a = is_island(a, site_a);
                                  const bool is_b = is_island(b, site_b);
                                  has_island = has_island || is_a || is_b;
                                  if (is_a && !is_b) give(a, site_b);
                                  if (is_b && !is_a) give(b, site_a);
                              });
            if (has_island) island_rows_.push_back({&row, from, to});
        });
    }

    // Inner points hang together with their sites.
    Index relabel(CellTally& tally, std::vector<OldLabel>& old_labels,
                  std::vector<Index>& stale_faces) {
        if (new_site_.empty()) return 0;
        for (const auto& [row, from, to] : island_rows_) {
            relabel_row(*row, from, to, tally, stale_faces);
        }
        for (const Index face : faces_) {
            for (const Index v : surface_.mesh.triangles[face]) {
                const Index old_site = labels_.point_site[v];
                if (!is_island(v, old_site)) continue;
                const Index site = site_of(v, old_site);
                if (site == old_site) continue;
                old_labels.push_back({v, old_site});
                labels_.point_site[v] = site;
                for_each_outgoing(surface_, v,
                                  [&](Index h) { stale_faces.push_back(Surface::face(h)); });
            }
        }
        return static_cast<Index>(new_site_.size());
    }

private:
    [[nodiscard]] Index root(Index i) { return sets_.root(i); }
    void unite(Index a, Index b) { sets_.unite(a, b); }

    // Those that hang together along edges and cuts of one label.
    void join_points() {
        for (const Index f : faces_) {
            const Triangle& t = surface_.mesh.triangles[f];
            if (labels_.mixed_index[f] == no_index) {
                if (!in_doubt_.has(labels_.point_site[t[0]])) continue;
                unite(t[0], t[1]);
                unite(t[1], t[2]);
                continue;
            }
            for (Index k = 0; k < 3; ++k) {
                const Index twin = surface_.twin[3 * f + k];
                if (twin < 3 * f + k || !in_doubt_.has(labels_.point_site[t[k]])) continue;
                if (labels_.edge_rows[surface_.edge[3 * f + k]].count > 0) continue;
                unite(t[k], t[k == 2 ? 0 : k + 1]);
            }
        }
        for (const CutFace& face : labels_.cut_faces) {
            for (const Cut& cut : labels_.cuts[face.cuts]) {
                if (cut.row.count == 0) unite(cut.from.point, cut.to.point);
            }
        }
    }

    // Calls back for each row of these faces that has crossings, with the points at its ends.
    template <typename Callback>
    void for_each_row(const Callback& callback) {
        for (const Index f : faces_) {
            if (labels_.mixed_index[f] == no_index) continue;
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                const Index e = surface_.edge[h];
                if (surface_.edge_half[e] != h || labels_.edge_rows[e].count == 0) continue;
                callback(labels_.edge_rows[e], surface_.tail(h), surface_.head(h));
            }
        }
        for (const CutFace& face : labels_.cut_faces) {
            for (Cut& cut : labels_.cuts[face.cuts]) {
                if (cut.row.count > 0) callback(cut.row, cut.from.point, cut.to.point);
            }
        }
    }

    [[nodiscard]] bool is_island(Index node, Index site) {
        return in_doubt_.has(site) && root(node) != mainland_[site];
    }

    void give(Index island, Index site) {
        const auto [found, is_new] = new_site_.try_emplace(root(island), site);
        if (!is_new) found->second = std::min(found->second, site);
    }

    [[nodiscard]] Index site_of(Index node, Index site) {
        const auto found = new_site_.find(root(node));
        return found == new_site_.end() ? site : found->second;
    }

    // Keeps the crossings between different sites.
    void relabel_row(Block& row, Index from, Index to, CellTally& tally,
                     std::vector<Index>& stale_faces) {
        kept_.clear();
        bool is_changed = false;
        for_each_crossing(
            labels_, row, from, to,
            [&](Index c, Index before, Index old_before, Index after, Index old_after) {
                Crossing crossing = labels_.crossings[c];
                crossing.site_before = site_of(before, old_before);
                crossing.site_after = site_of(after, old_after);
                is_changed = is_changed || crossing.site_before != old_before ||
                             crossing.site_after != old_after;
                if (crossing.site_before != crossing.site_after) {
                    kept_.push_back(crossing);
                }
            });
        if (!is_changed) return;
        const Index line = labels_.crossings[row.begin].line;
        const bool is_cut = line >= Crossing::first_cut;
        const auto tell = [&](int sign) {
            const auto crossings = std::as_const(labels_.crossings)[row];
            if (is_cut) {
                tally.count_cut(crossings, labels_.point_site[to], sign);
            } else {
                tally.count_row(crossings, sign);
            }
        };
        tell(-1);
        labels_.crossings.release(row);
        row = labels_.crossings.add(kept_);
        tell(1);
        if (is_cut) {
            stale_faces.push_back(labels_.cuts[line - Crossing::first_cut].face);
            return;
        }
        stale_faces.push_back(Surface::face(line));
        const Index twin = surface_.twin[line];
        if (twin != no_index) stale_faces.push_back(Surface::face(twin));
    }

    const Surface& surface_;
    std::span<const SurfacePoint> sites_;
    const CellSet& in_doubt_;
    std::span<const Index> faces_;
    EdgeLabels& labels_;
    Index num_points_;
    UnionFind sets_;                   // Points and intervals.
    std::vector<Index> mainland_;      // By site: the root of what hangs together with it.
    std::map<Index, Index> new_site_;  // By root of an island.
    struct Row {
        Block* crossings;
        Index from, to;
    };
    std::vector<Row> island_rows_;  // With an interval on an island.
    std::vector<Crossing> kept_;    // Of the row at hand.
};

}  // namespace

void find_displaced(const Surface& surface, std::span<const SurfacePoint> sites,
                    const EdgeLabels& labels, const TouchedParts& touched, CellSet& displaced) {
    const auto num_sites = static_cast<Index>(sites.size());
    CellSet has_inner_point(num_sites);
    for (Index i = 0; i < labels.inner_points.size(); ++i) {
        has_inner_point.insert(labels.inner_points[i].site);
    }
    displaced.resize(num_sites);
    for (Index s = 0; s < num_sites; ++s) {
        if (!touched.is_near(sites[s].face.value())) continue;
        displaced.set(
            s, !has_inner_point.has(s) && holder_of(surface, sites[s], labels, s) == no_index);
    }
}

CellSet cells_in_doubt(const CellSet& displaced, std::span<const Index> num_loops) {
    CellSet result(static_cast<Index>(num_loops.size()));
    for (Index s = 0; s < num_loops.size(); ++s) {
        if (num_loops[s] > 1 || (num_loops[s] == 1 && displaced.has(s))) result.insert(s);
    }
    return result;
}

Index absorb_islands(const Surface& surface, std::span<const SurfacePoint> sites,
                     const ArcStore& arcs, const CellSet& in_doubt, std::span<const Index> faces,
                     EdgeLabels& labels, CellTally& tally, std::vector<OldLabel>& old_labels,
                     std::vector<Index>& stale_faces) {
    IslandFinder finder(surface, sites, in_doubt, faces, labels);
    finder.connect(arcs);
    finder.choose_new_sites();
    return finder.relabel(tally, old_labels, stale_faces);
}

}  // namespace agvd
