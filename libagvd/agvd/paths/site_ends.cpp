#include "agvd/paths/site_ends.h"

#include <algorithm>
#include <cmath>

#include "agvd/mesh/surface_points.h"
#include "agvd/paths/face_strip.h"

namespace agvd {
namespace {

// Points, then shapes behind them.
Groups parts_by_site(Index num_points, const Propagation& propagation) {
    const bool are_sites = propagation.site_of_point.empty();
    const Index num_parts = num_points + static_cast<Index>(propagation.shapes.size());
    const auto site_of = [&](Index part) {
        if (part >= num_points) return propagation.shapes[part - num_points].site;
        return are_sites ? part : propagation.site_of_point[part];
    };
    std::size_t num_sites = 0;
    for (Index part = 0; part < num_parts; ++part) {
        num_sites = std::max(num_sites, std::size_t{site_of(part)} + 1);
    }
    return Groups(num_sites, [&](const auto& add) {
        for (Index part = 0; part < num_parts; ++part) add(site_of(part), part);
    });
}

}  // namespace

SiteEnds::SiteEnds(const Surface& surface, std::span<const SurfacePoint> points,
                   const Propagation& propagation)
    : surface_(surface),
      points_(points),
      propagation_(propagation),
      parts_(parts_by_site(static_cast<Index>(points.size()), propagation)),
      shapes_(sources_of(surface, propagation.shapes)) {}

double SiteEnds::start_of_point(Index point) const {
    return start_of(propagation_.start_of_point, point);
}

std::optional<SiteEnd> SiteEnds::of_relay(const Relay& relay, const SurfacePoint& view,
                                          double slack) const {
    if (relay.y == infinity) return SiteEnd{view, relay.weight};
    if (!(relay.y >= 0)) return std::nullopt;
    const Vec2 image(relay.x, relay.y);
    std::optional<SiteEnd> best;
    double least = infinity;
    const auto take = [&](const SurfacePoint& place, double start) {
        if (relay.weight - start > slack || start - relay.weight > slack) return;
        const double away = (position_in_frame(surface_, place, relay.half_edge) - image).norm();
        if (!(away < least)) return;
        least = away;
        best = {place, start};
    };
    for (const Index part : parts_.of(relay.site.value())) {
        if (part < points_.size()) {
            const SurfacePoint point = snapped(surface_, points_[part]);
            const auto place = seen_from(surface_, point, Surface::face(relay.half_edge));
            if (place) take(*place, start_of_point(part));
        } else if (relay.x == 0 && relay.y == 0) {
            const ShapeSource& shape = shapes_[part - points_.size()];
            if (is_among(shape.vertices, surface_.tail(relay.half_edge))) {
                take(point_on(relay.half_edge, 0), shape.start);
            }
        }
    }
    return best;
}

std::optional<double> SiteEnds::at_side(Index half_edge, SiteId site) const {
    std::optional<double> least;
    for (const Index part : parts_.of(site.value())) {
        if (part < points_.size()) continue;
        const ShapeSource& shape = shapes_[part - points_.size()];
        if (!is_among(shape.sides, half_edge)) continue;
        least = std::min(shape.start, least.value_or(infinity));
    }
    return least;
}

SiteEnd SiteEnds::nearest_in_space(SiteId site, const SurfacePoint& point) const {
    const MeshView mesh = surface_.mesh.view();
    const Vec3 from = position(mesh, point);
    SiteEnd best;
    double least = infinity;
    const auto take = [&](const SurfacePoint& place, double start) {
        const double distance = start + (position(mesh, place) - from).norm();
        if (!(distance < least)) return;
        least = distance;
        best = {place, start};
    };
    for (const Index part : parts_.of(site.value())) {
        if (part < points_.size()) {
            take(points_[part], start_of_point(part));
            continue;
        }
        const ShapeSource& shape = shapes_[part - points_.size()];
        for (const Index v : shape.vertices) take(point_at(surface_, v), shape.start);
    }
    return best;
}

}  // namespace agvd
