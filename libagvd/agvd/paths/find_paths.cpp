// trace_to_site() follows relays where there are any. trace() follows the straight line to a site,
// descend() goes down the distances from vertex to vertex, search() is an A* search along edges;
// then paths are straightened.
#include "agvd/paths/geodesic_path.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <unordered_map>
#include <utility>

#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/paths/face_strip.h"
#include "agvd/paths/relay_trace.h"

namespace agvd {

namespace {

using Way = std::vector<Index>;  // Vertices.

// A path that is longer than the distance by no more than this share is a shortest one.
constexpr double length_tolerance = 1e-9;
// A share of a side of a face: shorter paths are rounding.
constexpr double no_length = 1e-12;

// A vertex near a point, and the length of a path over it.
struct Start {
    double length;
    Index vertex;
    bool operator<(const Start& other) const {
        return length != other.length ? length < other.length : vertex < other.vertex;
    }
    bool operator>(const Start& other) const { return other < *this; }
};

// The corners of the faces that hold a point, the nearest first, each once.
std::vector<Start> corners_around(const Surface& surface, const SurfacePoint& point) {
    std::vector<Start> corners;
    for_each_view(surface, point, [&](const SurfacePoint& view) {
        for (Index k = 0; k < 3; ++k) {
            const Index h = 3 * view.face.value() + k;
            corners.push_back({face_distance(surface, view, point_on(h, 0)), surface.tail(h)});
        }
    });
    std::sort(corners.begin(), corners.end());
    std::vector<Start> unique;
    for (const Start& corner : corners) {
        const auto is_same = [&](const Start& other) { return other.vertex == corner.vertex; };
        if (std::none_of(unique.begin(), unique.end(), is_same)) unique.push_back(corner);
    }
    return unique;
}

bool share_face(const Surface& surface, const SurfacePoint& a, const SurfacePoint& b) {
    return common_faces(surface, a, b).first != no_index;
}

// Goes from a vertex of the cell each time to the neighbour in it over which the site is nearest,
// until one shares a face with the site. Empty if that ends before.
Way descend(const Surface& surface, const SiteDistances& distances, const SiteGoal& goal,
            Index start, Ticker& ticker) {
    const auto& distance = distances.distance;
    Way way{start};
    for (bool is_there = false;;) {
        const Index here = way.back();
        Start next{infinity, no_index};
        for_each_edge_at(surface, here, [&](Index h, Index v) {
            is_there = is_there || seen_from(surface, goal.point, Surface::face(h));
            if (distances.site[v] == goal.site && distance[v] < distance[here]) {
                next = std::min(next, {distance[v] + surface.length_of(h), v});
            }
        });
        ticker.tick();
        if (is_there) return way;
        if (next.vertex == no_index) return {};
        way.push_back(next.vertex);
    }
}

// From the left of a half-edge to a site's image on its right, in the frame of the half-edge.
struct Ray {
    Index half_edge;
    Vec2 from, image;
};

// The strip that the ray crosses from a point to a face that holds the site.
std::optional<FaceStrip> trace(const Surface& surface, const SiteGoal& goal,
                               const SurfacePoint& point, Ray ray, Ticker& ticker) {
    FaceStrip strip{point, point, {}};
    while (strip.crossed.size() <= surface.num_faces()) {
        ticker.tick();
        strip.crossed.push_back(ray.half_edge);
        const Index inside = surface.twin[ray.half_edge];
        if (inside == no_index) break;
        if (const auto target = seen_from(surface, goal.point, Surface::face(inside))) {
            strip.target = *target;
            return strip;
        }
        const Vec2 end(surface.length_of(inside), 0), apex = surface.apex[inside];
        ray.from = end - ray.from;
        ray.image = end - ray.image;
        const Vec2 way = ray.image - ray.from, to_apex = apex - ray.from;
        const bool is_left = cross(way, to_apex) > 0;  // The apex.
        ray.half_edge = is_left ? Surface::next(inside) : Surface::previous(inside);
        const Vec2 tail = is_left ? end : apex, head = is_left ? apex : Vec2(0, 0);
        const Vec2 along = (head - tail).normalized();
        for (Vec2* moved : {&ray.from, &ray.image}) {
            const Vec2 step = *moved - tail;
            *moved = {step.dot(along), cross(along, step)};
        }
    }
    return std::nullopt;
}

// The ray across a half-edge to the image of the site that the distances of both its ends give.
std::optional<Ray> ray_across(const Surface& surface, const SiteDistances& distances,
                              const SiteGoal& goal, const SurfacePoint& point, Index half_edge) {
    const Index a = surface.tail(half_edge), b = surface.head(half_edge);
    if (distances.site[a] != goal.site || distances.site[b] != goal.site) return std::nullopt;
    const Vec2 from = position_in_frame(surface, point, half_edge);
    const double length = surface.length_of(half_edge);
    const double to_a = distances.distance[a], to_b = distances.distance[b];
    const double x = ((to_a - to_b) * (to_a + to_b) + length * length) / (2 * length);
    const double y = std::sqrt(std::max(to_a * to_a - x * x, 0.0));
    if (!(from.y() > 0 && y > 0)) return std::nullopt;
    const double at = from.x() + (x - from.x()) * from.y() / (from.y() + y);
    if (!(at >= 0 && at <= length)) return std::nullopt;
    return Ray{half_edge, from, {x, -y}};
}

// Between the faces of two points. Empty if none arrives. Ties go to the lower vertex.
Way search(const Surface& surface, const SurfacePoint& from, const SurfacePoint& to,
           Ticker& ticker) {
    struct Reached {
        double length = infinity;
        Index from = no_index;
        bool is_done = false;
    };
    std::unordered_map<Index, Reached> reached;
    std::priority_queue<Start, std::vector<Start>, std::greater<>> queue;
    const Vec3 target = position(surface.mesh.view(), to);
    const auto reach = [&](Index v, double length, Index before) {
        Reached& state = reached[v];
        if (state.is_done || !(length < state.length)) return;
        state = {length, before, false};
        queue.push({length + (surface.mesh.positions[v] - target).norm(), v});
    };
    for (const Start& corner : corners_around(surface, from)) {
        reach(corner.vertex, corner.length, no_index);
    }
    Way way;
    while (!queue.empty() && way.empty()) {
        ticker.tick(4);
        const Index here = queue.top().vertex;
        queue.pop();
        Reached& state = reached[here];
        if (std::exchange(state.is_done, true)) continue;
        const double length = state.length;
        bool is_there = false;
        for_each_edge_at(surface, here, [&](Index h, Index v) {
            is_there = is_there || seen_from(surface, to, Surface::face(h));
            reach(v, length + surface.length_of(h), here);
        });
        if (!is_there) continue;
        for (Index v = here; v != no_index; v = reached[v].from) way.push_back(v);
    }
    std::reverse(way.begin(), way.end());
    return way;
}

GeodesicPath straighten_way(const Surface& surface, const SurfacePoint& from, const Way& way,
                            const SurfacePoint& to, Ticker ticker) {
    std::vector<SurfacePoint> points{from};
    for (const Index v : way) points.push_back(point_at(surface, v));
    points.push_back(to);
    return straighten(surface, strip_along(surface, points, {}), ticker);
}

}  // namespace

GeodesicPath straighten_path(const Surface& surface, std::span<const SurfacePoint> points,
                             std::span<const FaceId> faces, const Progress& progress) {
    Poller poller(progress);
    return straighten(surface, strip_along(surface, points, faces), Ticker(poller));
}

GeodesicPath path_between(const Surface& surface, const SurfacePoint& from, const SurfacePoint& to,
                          const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    const SurfacePoint first = snapped(surface, from), last = snapped(surface, to);
    if (share_face(surface, first, last)) return straighten_way(surface, first, {}, last, ticker);
    const Way way = search(surface, first, last, ticker);
    if (way.empty()) throw InvalidInput("no path: the points lie on different components");
    return straighten_way(surface, first, way, last, ticker);
}

GeodesicPath path_to_site(const Surface& surface, const SiteDistances& distances,
                          const SiteGoal& to, const SurfacePoint& from, const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    const SurfacePoint point = snapped(surface, from);
    const SiteGoal goal{to.site, snapped(surface, to.point), to.distance};
    if (share_face(surface, point, goal.point)) {
        return straighten_way(surface, point, {}, goal.point, ticker);
    }
    std::vector<Start> starts;
    for (const auto& [length, v] : corners_around(surface, point)) {
        if (distances.site[v] == goal.site) starts.push_back({length + distances.distance[v], v});
    }
    std::sort(starts.begin(), starts.end());
    GeodesicPath shortest;
    shortest.length = infinity;
    const auto is_found = [&] { return shortest.length <= goal.distance * (1 + length_tolerance); };
    const auto take = [&](GeodesicPath path) {
        if (path.length < shortest.length) shortest = std::move(path);
    };
    for_each_view(surface, point, [&](const SurfacePoint& view) {
        for (Index k = 0; k < 3 && !is_found(); ++k) {
            const auto ray = ray_across(surface, distances, goal, view, 3 * view.face.value() + k);
            if (!ray) continue;
            const auto strip = trace(surface, goal, view, *ray, ticker);
            if (strip) take(straighten(surface, *strip, ticker));
        }
    });
    for (const Start& start : starts) {
        if (is_found()) break;
        const Way way = descend(surface, distances, goal, start.vertex, ticker);
        if (!way.empty()) take(straighten_way(surface, point, way, goal.point, ticker));
    }
    if (shortest.points.empty()) return path_between(surface, point, goal.point, progress);
    return shortest;
}

SitePath path_to_ends(const TracedField& field, const SurfacePoint& point,
                      const Progress& progress) {
    const Surface& surface = field.surface;
    const Propagation& propagation = field.propagation;
    const PointLabel label = label_at(surface, propagation, point);
    if (!label.site.is_valid()) return {};
    Poller poller(progress);
    Ticker ticker(poller);
    if (const auto traced = trace_to_site(field, snapped(surface, point), ticker)) {
        const FaceStrip strip = strip_along(surface, traced->points, traced->faces);
        GeodesicPath path = straighten(surface, strip, ticker);
        const double allowed = std::max(length_tolerance, propagation.certified_error);
        const double rounding = no_length * surface.length_of(3 * point.face.value());
        if (path.length + traced->start <=
            label.distance.value_or(infinity) * (1 + allowed) + rounding) {
            return {traced->site, std::move(path), traced->start};
        }
    }
    const SiteEnd end = field.ends.nearest_in_space(label.site, point);
    const double distance = std::max(label.distance.value_or(0) - end.start, 0.0);
    return {label.site,
            path_to_site(surface, {propagation.vertex_site, propagation.vertex_distance},
                         {label.site, end.place, distance}, point, progress),
            end.start};
}

GeodesicPath path_to_site(const Surface& surface, std::span<const SurfacePoint> sites,
                          const Propagation& propagation, const SurfacePoint& point,
                          const Progress& progress) {
    const SiteEnds ends(surface, sites, propagation);
    SitePath found = path_to_ends({surface, propagation, ends}, point, progress);
    if (!found.site.is_valid()) throw InvalidInput("no path: no site reaches the point");
    return std::move(found.path);
}

}  // namespace agvd
