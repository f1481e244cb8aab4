#include "agvd/diagram/site_holders.h"

#include "agvd/diagram/intervals.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// The interval of an edge that holds a site on it.
Index interval_of(const StageInput& in, const EdgeLabels& labels, Index site, Index half_edge) {
    const Surface& surface = in.surface;
    const Index e = surface.edge[half_edge];
    const bool forward = surface.edge_half[e] == half_edge;
    const double at = in.sites[site].barycentric[(half_edge + (forward ? 1 : 0)) % 3];
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
    return label == site ? holder : no_index;
}

}  // namespace

Index holder_of(const StageInput& input, const EdgeLabels& labels, Index site) {
    const SurfacePoint& place = input.sites[site];
    if (const auto vertex = vertex_of(input.surface, place)) {
        return labels.point_site[*vertex] == site ? *vertex : no_index;
    }
    const auto half_edge = half_edge_of(place);
    if (half_edge) return interval_of(input, labels, site, *half_edge);
    // A site inside an unlisted face owns the face.
    const Index face = place.face.value();
    const Index v = input.surface.mesh.triangles[face][0];
    return labels.mixed_index[face] == no_index && labels.point_site[v] == site ? v : no_index;
}

CellSet inner_sites(const EdgeLabels& labels, Index num_sites) {
    CellSet sites(num_sites);
    for (Index i = 0; i < labels.inner_points.size(); ++i) {
        sites.insert(labels.inner_points[i].site);
    }
    return sites;
}

bool is_displaced(const StageInput& input, const EdgeLabels& labels, const CellSet& inner_sites,
                  Index site) {
    return !inner_sites.has(site) && holder_of(input, labels, site) == no_index;
}

CellSet find_displaced(const StageInput& input, const EdgeLabels& labels) {
    const auto num_sites = static_cast<Index>(input.sites.size());
    const CellSet inner = inner_sites(labels, num_sites);
    CellSet displaced(num_sites);
    for (Index s = 0; s < num_sites; ++s) displaced.set(s, is_displaced(input, labels, inner, s));
    return displaced;
}

}  // namespace agvd
