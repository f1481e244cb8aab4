#include "agvd/diagram/own_places.h"

#include <algorithm>
#include <numeric>

#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/shape_source.h"

namespace agvd {

SitePlaces all_places(const Surface& surface, std::span<const SurfacePoint> points,
                      std::span<const Index> site_of_point, std::span<const SiteShape> shapes) {
    SitePlaces all;
    for (const SiteShape& shape : shapes) {
        const auto add = [&](const SurfacePoint& point) {
            all.points.push_back(point);
            all.sites.push_back(shape.site);
        };
        for (const Index v : shape_source(surface, shape).vertices) add(point_at(surface, v));
        for (const Index face : shape.faces) add({FaceId(face), {1.0 / 3, 1.0 / 3, 1.0 / 3}});
        if (!(shape.start > 0)) continue;
        for (const Index edge : all_edges_of(surface, shape)) {
            add(point_on(surface.edge_half[edge], 0.5));
        }
    }
    all.num_of_shapes = size_of(all.points);
    all.points.insert(all.points.end(), points.begin(), points.end());
    all.own_all = site_of_point.empty() && shapes.empty();
    if (all.own_all) {
        all.sites.resize(points.size());
        std::iota(all.sites.begin(), all.sites.end(), Index{0});
        all.num_sites = size_of(all.sites);
    } else {
        all.sites.insert(all.sites.end(), site_of_point.begin(), site_of_point.end());
        for (const Index site : all.sites) all.num_sites = std::max(all.num_sites, site + 1);
    }
    return all;
}

bool owns_its_place(const Surface& surface, const Propagation& propagation,
                    const EdgeLabels& labels, const SitePlaces& places, Index i) {
    if (places.own_all) return true;
    const SurfacePoint& point = places.points[i];
    const Index site = places.sites[i];
    if (const auto vertex = vertex_of(surface, point)) return labels.point_site[*vertex] == site;
    const Index face = point.face.value();
    if (i < places.num_of_shapes && !half_edge_of(point)) {
        const Triangle& t = surface.mesh.triangles[face];
        const auto is_of_site = [&](Index v) { return labels.point_site[v] == site; };
        if (std::any_of(t.begin(), t.end(), is_of_site)) return false;
    }
    const Index position = labels.mixed_index[face];
    const std::optional<Index> mixed =
        position == no_index ? std::nullopt : std::optional(position);
    const SiteId of_corners(labels.point_site[surface.mesh.triangles[face][0]]);
    return label_in_face(surface, propagation, mixed, of_corners, point).site == SiteId(site);
}

}  // namespace agvd
