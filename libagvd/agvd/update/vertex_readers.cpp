#include "agvd/update/vertex_readers.h"

#include <algorithm>
#include <utility>

namespace agvd {
namespace {

bool is_reached(const Reader& reader) { return reader.distance < infinity; }

void take_change(Index site, const RunChanges::Vertex& change, std::vector<Reader>& readers) {
    const auto reader = std::find_if(readers.begin(), readers.end(),
                                     [&](const Reader& r) { return r.site == site; });
    if (reader == readers.end()) {
        readers.push_back({site, change.distance});
    } else if (change.is_read) {
        reader->distance = change.distance;
    } else {
        readers.erase(reader);
    }
}

// Keeps the list ascending.
void set_off_windows(Index v, bool is_off, std::vector<Index>& list) {
    const auto place = std::lower_bound(list.begin(), list.end(), v);
    const bool was_off = place != list.end() && *place == v;
    if (was_off && !is_off) list.erase(place);
    if (is_off && !was_off) list.insert(place, v);
}

}  // namespace

std::vector<Index> find_dirty(const NumberedSites& sites, const VertexReaders& readers) {
    std::vector<std::uint8_t> is_dirty = sites.is_changed();
    std::vector<Index> dirty;
    for (Index site = 0; site < is_dirty.size(); ++site) {
        if (is_dirty[site] != 0) dirty.push_back(site);
    }
    for (const Index v : sites.changed_bounds()) {
        for (const Reader& reader : readers.at[v]) {
            if (std::exchange(is_dirty[reader.site], 1) == 0) dirty.push_back(reader.site);
        }
    }
    std::sort(dirty.begin(), dirty.end(),
              [&](Index a, Index b) { return sites.comes_before(a, b); });
    return dirty;
}

std::vector<Index> take_changes(const SiteRuns& runs, std::span<const Index> sites,
                                const NumberedSites& numbered, VertexReaders& readers) {
    std::vector<Index> vertices;
    const auto list = [&](Index v) {
        if (std::exchange(readers.is_listed[v], 1) == 0) vertices.push_back(v);
    };
    for (Index i = 0; i < sites.size(); ++i) {
        for (const RunChanges::Vertex& change : changes_of(runs, i).vertices) {
            take_change(sites[i], change, readers.at[change.vertex]);
            list(change.vertex);
        }
    }
    for (const Index v : numbered.changed_bounds()) {
        if (std::none_of(readers.at[v].begin(), readers.at[v].end(), is_reached)) list(v);
    }
    for (const Index v : vertices) readers.is_listed[v] = 0;
    return vertices;
}

bool settle_vertex(const NumberedSites& sites, Index vertex, VertexReaders& readers,
                   Propagation& result) {
    std::vector<Reader>& here = readers.at[vertex];
    std::sort(here.begin(), here.end(),
              [&](const Reader& a, const Reader& b) { return sites.comes_before(a.site, b.site); });
    double best = infinity;
    Index best_site = no_index;
    for (const Reader& reader : here) {
        if (!is_reached(reader)) continue;
        const Index rank = sites.rank(reader.site);
        if (!is_nearer(reader.distance, rank, best, best_site)) continue;
        best = reader.distance;
        best_site = rank;
    }
    const Index bounding = sites.site_of_bound(vertex);
    const bool is_off = best_site == no_index && bounding != no_index;
    if (is_off) {
        best = sites.bounds()[vertex];
        best_site = sites.rank(bounding);
    }
    set_off_windows(vertex, is_off, result.vertices_off_windows);
    const SiteId site(best_site);
    if (result.vertex_distance[vertex] == best && result.vertex_site[vertex] == site) return false;
    result.vertex_distance[vertex] = best;
    result.vertex_site[vertex] = site;
    return true;
}

}  // namespace agvd
