#include "agvd/diagram/islands.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace agvd {
namespace {

class IslandFinder {
public:
    IslandFinder(const Surface& surface, std::span<const SurfacePoint> sites,
                 std::span<const FaceArcs> chunks, EdgeLabels& labels)
        : surface_(surface), sites_(sites), chunks_(chunks), labels_(labels) {
        Index next = surface.num_vertices() + static_cast<Index>(labels.crossings.size());
        for (const FaceArcs& chunk : chunks) {
            inner_offset_.push_back(next);
            next += static_cast<Index>(chunk.inner.size());
        }
        first_site_ = next;
        parent_.resize(next + sites.size());
        std::iota(parent_.begin(), parent_.end(), Index{0});
    }

    void connect() {
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            const Index h = surface_.edge_half[e];
            if (labels_.on_edge(e).empty()) unite(surface_.tail(h), surface_.head(h));
        }
        for (Index chunk = 0; chunk < chunks_.size(); ++chunk) {
            for (const auto& [a, b] : chunks_[chunk].local.connected) {
                unite(node(chunk, a), node(chunk, b));
            }
        }
        for (Index s = 0; s < sites_.size(); ++s) connect_site(s);
    }

    // Islands border on other cells at crossings. Each goes to the lowest-numbered cell that it
    // borders on and that hangs together with its site there.
    void choose_new_sites() {
        for (const Index e : labels_.edges) {
            for_each_interval(e, [&](Index, Index a, Index site_a, Index b, Index site_b) {
                consider(a, site_a, b, site_b);
                consider(b, site_b, a, site_a);
            });
        }
    }

    Index bar(std::vector<BarredSite>& barred, std::vector<bool>& is_stale) {
        const std::size_t before = barred.size();
        for (Index chunk = 0; chunk < chunks_.size(); ++chunk) {
            for (Index i = 0; i < chunks_[chunk].inner.size(); ++i) {
                const Index site = chunks_[chunk].inner[i].site_after;
                const Index interval = inner_offset_[chunk] + i;
                if (!is_island(interval, site) || new_site_.contains(root(interval))) continue;
                const Index mixed = labels_.mixed_index[chunks_[chunk].inner_face[i]];
                barred.push_back({mixed, site});
                is_stale[mixed] = true;
            }
        }
        const auto count = static_cast<Index>(barred.size() - before);
        std::sort(barred.begin(), barred.end());
        return count;
    }

    Index relabel(std::vector<bool>& is_stale) {
        if (new_site_.empty()) return 0;
        for (Index i = 0; i < labels_.edges.size(); ++i) {
            bool is_changed = false;
            std::vector<Crossing> kept;
            for_each_interval(labels_.edges[i],
                              [&](Index c, Index a, Index site_a, Index b, Index site_b) {
                                  Crossing crossing = labels_.crossings[c];
                                  crossing.site_before = site_of(a, site_a);
                                  crossing.site_after = site_of(b, site_b);
                                  is_changed = is_changed || crossing.site_before != site_a ||
                                               crossing.site_after != site_b;
                                  if (crossing.site_before != crossing.site_after)
                                      kept.push_back(crossing);
                              });
            if (!is_changed) continue;
            std::copy(kept.begin(), kept.end(),
                      labels_.crossings.begin() + labels_.crossing_offsets[i]);
            labels_.crossing_counts[i] = static_cast<Index>(kept.size());
            mark_faces(surface_.edge_half[labels_.edges[i]], is_stale);
        }
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            const Index site = site_of(v, labels_.vertex_site[v]);
            if (site == labels_.vertex_site[v]) continue;
            labels_.vertex_site[v] = site;
            mark_one_ring(v, is_stale);
        }
        return static_cast<Index>(new_site_.size());
    }

private:
    [[nodiscard]] Index node(Index chunk, Index name) const {
        const Index index = IntervalName::index(name);
        switch (IntervalName::kind(name)) {
            case IntervalName::Vertex:
                return index;
            case IntervalName::Crossing:
                return surface_.num_vertices() + index;
            case IntervalName::Inner:
                return inner_offset_[chunk] + index;
            default:
                return first_site_ + index;
        }
    }

    [[nodiscard]] Index root(Index i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void unite(Index a, Index b) {
        a = root(a);
        b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

    // Calls back for each crossing of an edge with the intervals before and after it.
    template <typename Callback>
    void for_each_interval(Index edge, const Callback& callback) {
        const auto crossings = labels_.on_edge(edge);
        if (crossings.empty()) return;
        const auto first = static_cast<Index>(&crossings[0] - labels_.crossings.data());
        Index before = surface_.tail(surface_.edge_half[edge]);
        for (Index i = 0; i < crossings.size(); ++i) {
            const Index after = i + 1 < crossings.size() ? surface_.num_vertices() + first + i
                                                         : surface_.head(surface_.edge_half[edge]);
            callback(first + i, before, crossings[i].site_before, after, crossings[i].site_after);
            before = after;
        }
    }

    void connect_site(Index s) {
        if (const auto vertex = vertex_of(surface_, sites_[s])) {
            if (labels_.vertex_site[*vertex] == s) unite(*vertex, first_site_ + s);
            return;
        }
        const auto half_edge = half_edge_of(sites_[s]);
        if (!half_edge) {
            connect_inner_site(s);
            return;
        }
        // The interval of the edge that holds the site.
        const Index e = surface_.edge[*half_edge];
        const bool forward = surface_.edge_half[e] == *half_edge;
        const double at = sites_[s].barycentric[(*half_edge + (forward ? 1 : 0)) % 3];
        Index holder = surface_.tail(surface_.edge_half[e]);
        Index site = labels_.vertex_site[holder];
        for_each_interval(e, [&](Index c, Index, Index, Index after, Index site_after) {
            if (labels_.crossings[c].at > at) return;
            holder = after;
            site = site_after;
        });
        if (site == s) unite(holder, first_site_ + s);
    }

    // A site inside an unlisted face owns the face; in a listed one the cuts know it.
    void connect_inner_site(Index s) {
        const Index face = sites_[s].face.value();
        const Index v = surface_.mesh.triangles[face][0];
        if (labels_.mixed_index[face] == no_index && labels_.vertex_site[v] == s) {
            unite(v, first_site_ + s);
        }
    }

    [[nodiscard]] bool is_island(Index interval, Index site) {
        return site != no_index && root(interval) != root(first_site_ + site);
    }

    void consider(Index island, Index site, Index neighbour, Index neighbour_site) {
        if (!is_island(island, site) || is_island(neighbour, neighbour_site)) return;
        const auto [found, is_new] = new_site_.try_emplace(root(island), neighbour_site);
        if (!is_new) found->second = std::min(found->second, neighbour_site);
    }

    void mark_faces(Index half_edge, std::vector<bool>& is_stale) const {
        for (const Index h : {half_edge, surface_.twin[half_edge]}) {
            if (h == no_index) continue;
            const Index mixed = labels_.mixed_index[Surface::face(h)];
            if (mixed != no_index) is_stale[mixed] = true;
        }
    }

    void mark_one_ring(Index vertex, std::vector<bool>& is_stale) const {
        Index h = surface_.outgoing[vertex];
        while (h != no_index) {
            mark_faces(h, is_stale);
            h = surface_.twin[Surface::previous(h)];
            if (h == surface_.outgoing[vertex]) break;
        }
    }

    [[nodiscard]] Index site_of(Index interval, Index site) {
        const auto found = new_site_.find(root(interval));
        return found == new_site_.end() ? site : found->second;
    }

    const Surface& surface_;
    std::span<const SurfacePoint> sites_;
    std::span<const FaceArcs> chunks_;
    EdgeLabels& labels_;
    std::vector<Index> inner_offset_;
    Index first_site_ = 0;
    std::vector<Index> parent_;
    std::map<Index, Index> new_site_;  // By root of an island.
};

}  // namespace

Index absorb_islands(const Surface& surface, std::span<const SurfacePoint> sites,
                     std::span<const FaceArcs> chunks, EdgeLabels& labels,
                     std::vector<BarredSite>& barred, std::vector<bool>& is_stale) {
    IslandFinder finder(surface, sites, chunks, labels);
    finder.connect();
    finder.choose_new_sites();
    return finder.bar(barred, is_stale) + finder.relabel(is_stale);
}

}  // namespace agvd
