#include "agvd/diagram/islands.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "agvd/propagation/site_placement.h"

namespace agvd {
namespace {

Index find_root(std::vector<Index>& parent, Index i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

void unite_nodes(std::vector<Index>& parent, Index a, Index b) {
    if (parent[a] == parent[b]) return;
    a = find_root(parent, a);
    b = find_root(parent, b);
    parent[std::max(a, b)] = std::min(a, b);
}

// Nodes are points, then the intervals after crossings that end at no point.
class IslandFinder {
public:
    IslandFinder(const Surface& surface, std::span<const SurfacePoint> sites,
                 const std::vector<Index>& joined_points, EdgeLabels& labels)
        : surface_(surface),
          sites_(sites),
          labels_(labels),
          num_points_(static_cast<Index>(labels.point_site.size())) {
        parent_.reserve(labels.point_site.size() + labels.crossings.size());
        parent_ = joined_points;
        for (Index i = 0; i < labels.crossings.size(); ++i) parent_.push_back(num_points_ + i);
    }

    void connect(std::span<const FaceArcs> chunks) {
        for (const CrossingRow& row : labels_.rows) {
            if (row.count > 0) continue;  // Its crossings have vanished.
            const auto [from, to] = ends_of(row);
            unite(from, to);
        }
        for (const FaceArcs& chunk : chunks) {
            for (const Connection& c : chunk.local.connections) unite(c.a, c.b);
        }
        mainland_.assign(sites_.size(), no_index);
        for (Index i = 0; i < labels_.inner_points.size(); ++i) {
            mainland_[labels_.inner_points[i].site] = root(surface_.num_vertices() + i);
        }
        for (Index s = 0; s < sites_.size(); ++s) {
            const Index node = holder_of(s);
            if (node != no_index) mainland_[s] = root(node);
        }
    }

    // Islands border on other cells at crossings. Each goes to the lowest-numbered cell that it
    // borders on and that hangs together with its site there.
    void choose_new_sites() {
        for (Index row = 0; row < labels_.rows.size(); ++row) {
            for_each_crossing(row, [&](Index, Index a, Index site_a, Index b, Index site_b) {
                const bool is_a = is_island(a, site_a);
                const bool is_b = is_island(b, site_b);
                if (is_a && !is_b) give(a, site_b);
                if (is_b && !is_a) give(b, site_a);
            });
        }
    }

    Index relabel(std::vector<std::uint8_t>& is_stale) {
        if (new_site_.empty()) return 0;
        for (CrossingRow& row : labels_.rows) relabel_row(row, is_stale);
        for (Index v = 0; v < num_points_; ++v) {
            const Index site = site_of(v, labels_.point_site[v]);
            if (site == labels_.point_site[v]) continue;
            labels_.point_site[v] = site;
            if (v < surface_.num_vertices()) mark_one_ring(v, is_stale);
        }
        return static_cast<Index>(new_site_.size());
    }

private:
    [[nodiscard]] Index root(Index i) { return find_root(parent_, i); }
    void unite(Index a, Index b) { unite_nodes(parent_, a, b); }

    // The points at both ends of a row.
    [[nodiscard]] std::pair<Index, Index> ends_of(const CrossingRow& row) const {
        if (row.edge >= CrossingRow::first_cut) {
            const Cut& cut = labels_.cuts[row.edge - CrossingRow::first_cut];
            return {cut.from, cut.to};
        }
        const Index h = surface_.edge_half[row.edge];
        return {surface_.tail(h), surface_.head(h)};
    }

    // Calls back for each crossing of a row with the intervals before and after it.
    template <typename Callback>
    void for_each_crossing(Index row_index, const Callback& callback) const {
        const CrossingRow& row = labels_.rows[row_index];
        const auto [from, to] = ends_of(row);
        Index before = from;
        for (Index c = row.begin; c < row.begin + row.count; ++c) {
            const Index after = c + 1 == row.begin + row.count ? to : num_points_ + c;
            const Crossing& crossing = labels_.crossings[c];
            callback(c, before, crossing.site_before, after, crossing.site_after);
            before = after;
        }
    }

    // The node that holds a site; no_index: its place belongs to another cell, or is an inner
    // point.
    [[nodiscard]] Index holder_of(Index s) const {
        if (const auto vertex = vertex_of(surface_, sites_[s])) {
            return labels_.point_site[*vertex] == s ? *vertex : no_index;
        }
        const auto half_edge = half_edge_of(sites_[s]);
        if (half_edge) return interval_of(s, *half_edge);
        // A site inside an unlisted face owns the face.
        const Index face = sites_[s].face.value();
        const Index v = surface_.mesh.triangles[face][0];
        return labels_.mixed_index[face] == no_index && labels_.point_site[v] == s ? v : no_index;
    }

    // The interval of an edge that holds the site.
    [[nodiscard]] Index interval_of(Index s, Index half_edge) const {
        const Index e = surface_.edge[half_edge];
        const bool forward = surface_.edge_half[e] == half_edge;
        const double at = sites_[s].barycentric[(half_edge + (forward ? 1 : 0)) % 3];
        Index holder = surface_.tail(surface_.edge_half[e]);
        Index site = labels_.point_site[holder];
        if (labels_.edge_row[e] != no_index) {
            for_each_crossing(labels_.edge_row[e],
                              [&](Index c, Index, Index, Index after, Index site_after) {
                                  if (labels_.crossings[c].at > at) return;
                                  holder = after;
                                  site = site_after;
                              });
        }
        return site == s ? holder : no_index;
    }

    [[nodiscard]] bool is_island(Index node, Index site) {
        return site != no_index && root(node) != mainland_[site];
    }

    void give(Index island, Index site) {
        const auto [found, is_new] = new_site_.try_emplace(root(island), site);
        if (!is_new) found->second = std::min(found->second, site);
    }

    [[nodiscard]] Index site_of(Index node, Index site) {
        const auto found = new_site_.find(root(node));
        return found == new_site_.end() ? site : found->second;
    }

    void relabel_row(CrossingRow& row, std::vector<std::uint8_t>& is_stale) {
        const auto [from, to] = ends_of(row);
        const Index end = row.begin + row.count;
        Index kept = row.begin;
        Index before = from;
        bool is_changed = false;
        for (Index c = row.begin; c < end; ++c) {
            const Index after = c + 1 == end ? to : num_points_ + c;
            Crossing crossing = labels_.crossings[c];
            const Index site_before = site_of(before, crossing.site_before);
            const Index site_after = site_of(after, crossing.site_after);
            is_changed = is_changed || site_before != crossing.site_before ||
                         site_after != crossing.site_after;
            crossing.site_before = site_before;
            crossing.site_after = site_after;
            if (site_before != site_after) labels_.crossings[kept++] = crossing;
            before = after;
        }
        row.count = kept - row.begin;
        if (!is_changed) return;
        if (row.edge < CrossingRow::first_cut) {
            mark_faces(surface_.edge_half[row.edge], is_stale);
        } else {
            mark_face(labels_.cuts[row.edge - CrossingRow::first_cut].face, is_stale);
        }
    }

    void mark_face(Index face, std::vector<std::uint8_t>& is_stale) const {
        const Index mixed = labels_.mixed_index[face];
        if (mixed != no_index) is_stale[mixed] = 1;
    }

    void mark_faces(Index half_edge, std::vector<std::uint8_t>& is_stale) const {
        mark_face(Surface::face(half_edge), is_stale);
        const Index twin = surface_.twin[half_edge];
        if (twin != no_index) mark_face(Surface::face(twin), is_stale);
    }

    void mark_one_ring(Index vertex, std::vector<std::uint8_t>& is_stale) const {
        const Index first = surface_.outgoing[vertex];
        Index h = first;
        do {
            mark_face(Surface::face(h), is_stale);
            h = surface_.twin[Surface::previous(h)];
        } while (h != no_index && h != first);
    }

    const Surface& surface_;
    std::span<const SurfacePoint> sites_;
    EdgeLabels& labels_;
    Index num_points_;
    std::vector<Index> parent_;
    std::vector<Index> mainland_;      // By site: the root of what hangs together with it.
    std::map<Index, Index> new_site_;  // By root of an island.
};

}  // namespace

std::vector<Index> join_points(const Surface& surface, const EdgeLabels& labels) {
    std::vector<Index> parent(labels.point_site.size());
    std::iota(parent.begin(), parent.end(), Index{0});
    for (Index f = 0; f < surface.num_faces(); ++f) {
        const Triangle& t = surface.mesh.triangles[f];
        if (labels.mixed_index[f] == no_index) {
            unite_nodes(parent, t[0], t[1]);
            unite_nodes(parent, t[1], t[2]);
            continue;
        }
        for (Index k = 0; k < 3; ++k) {
            const Index twin = surface.twin[3 * f + k];
            if (twin < 3 * f + k) continue;  // Each edge once.
            if (labels.edge_row[surface.edge[3 * f + k]] != no_index) continue;
            unite_nodes(parent, t[k], t[k == 2 ? 0 : k + 1]);
        }
    }
    for (const Cut& cut : labels.cuts) {
        if (cut.row == no_index) unite_nodes(parent, cut.from, cut.to);
    }
    return parent;
}

Index absorb_islands(const Surface& surface, std::span<const SurfacePoint> sites,
                     std::span<const FaceArcs> chunks, const std::vector<Index>& joined_points,
                     EdgeLabels& labels, std::vector<std::uint8_t>& is_stale) {
    IslandFinder finder(surface, sites, joined_points, labels);
    finder.connect(chunks);
    finder.choose_new_sites();
    return finder.relabel(is_stale);
}

}  // namespace agvd
