#include "remesh/dual/site_mesh.h"

#include <algorithm>
#include <functional>

#include "agvd/mesh/any_mesh.h"

namespace remesh::detail {

SiteMesh build_site_mesh(std::vector<Triangle> triangles, Index num_sites, Ticker ticker) {
    SiteMesh mesh{std::move(triangles), {}, {}};
    const auto num_half_edges = static_cast<Index>(3 * mesh.triangles.size());
    std::vector<std::pair<std::uint64_t, Index>> keys(num_half_edges);
    for (Index h = 0; h < num_half_edges; ++h) {
        keys[h] = {edge_key(mesh.tail(h), mesh.head(h)), h};
    }
    sort_ticked(keys, ticker, std::less<>());
    mesh.twin.assign(num_half_edges, no_index);
    mesh.is_rim.assign(num_sites, 0);
    for (std::size_t i = 0, end = 0; i < keys.size(); i = end) {
        while (end < keys.size() && keys[end].first == keys[i].first) ++end;
        const Index h = keys[i].second;
        if (end - i == 2 && mesh.tail(h) != mesh.tail(keys[i + 1].second)) {
            mesh.twin[h] = keys[i + 1].second;
            mesh.twin[keys[i + 1].second] = h;
        } else {
            mesh.is_rim[mesh.tail(h)] = mesh.is_rim[mesh.head(h)] = 1;
        }
    }
    return mesh;
}

std::vector<Fan> find_fans(const SiteMesh& mesh) {
    std::vector<Index> count(mesh.is_rim.size(), 0), first(mesh.is_rim.size(), no_index);
    for (Index h = 0; h < mesh.twin.size(); ++h) {
        const Index site = mesh.tail(h);
        ++count[site];
        if (first[site] == no_index || mesh.twin[h] == no_index) first[site] = h;
    }
    std::vector<Fan> fans(count.size(), Fan::Broken);
    for (Index site = 0; site < fans.size(); ++site) {
        if (count[site] == 0) continue;
        Index length = 0, h = first[site];
        do {
            ++length;
            h = mesh.twin[SiteMesh::previous(h)];
        } while (h != no_index && h != first[site]);
        if (length != count[site]) continue;
        if (h == no_index) {
            fans[site] = Fan::Open;
        } else if (length >= 3) {
            fans[site] = Fan::Closed;
        }
    }
    return fans;
}

}  // namespace remesh::detail
