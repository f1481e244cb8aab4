// Windows and vertices wait in one queue, nearest first. A window is given in the frame of the
// half-edge through which it enters a face. It is slow and safe on purpose: long double, only the
// safest filter of [xin2009], no trimming and no merging.
#include "support/arbiter.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

namespace arbiter {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::SiteId;
using agvd::Surface;
using agvd::SurfacePoint;

using Real = long double;
using Point = Eigen::Matrix<Real, 2, 1>;

constexpr Real infinity = std::numeric_limits<Real>::infinity();
constexpr Real pi = std::numbers::pi_v<Real>;

Real cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

// In the frame of a half-edge, into whose face it propagates: the image lies below, at y < 0.
struct Window {
    Index half_edge;
    Point image;
    Real begin, end;  // On the edge.
    Real weight;      // From the site to the image.
    SiteId site;

    // Straight through the interval, otherwise around its nearer end.
    [[nodiscard]] Real distance_to(const Point& p) const {
        const Point left(begin, 0), right(end, 0);
        const Point chord = p - image;
        if (cross(left - image, chord) > 0) {
            return weight + (left - image).norm() + (p - left).norm();
        }
        if (cross(right - image, chord) < 0) {
            return weight + (right - image).norm() + (p - right).norm();
        }
        return weight + chord.norm();
    }
    [[nodiscard]] Real nearest() const {
        return distance_to({std::min(std::max(image.x(), begin), end), 0});
    }
};

// A window, or a vertex that sends out windows (of `window` only the site counts).
struct Event {
    Real key;
    Window window;
    Index vertex;

    bool operator<(const Event& other) const { return key > other.key; }
};

class Search {
public:
    Search(const Surface& surface, std::span<const SurfacePoint> targets)
        : surface_(surface),
          targets_(targets),
          targets_of_(surface.num_faces()),
          angle_(surface.num_vertices(), 0),
          vertex_distance_(surface.num_vertices(), infinity),
          vertex_site_(surface.num_vertices()),
          result_{std::vector<Real>(targets.size(), infinity),
                  std::vector<SiteId>(targets.size())} {
        for (Index i = 0; i < targets.size(); ++i) {
            targets_of_[targets[i].face.value()].push_back(i);
        }
        for (Index h = 0; h < surface.twin.size(); ++h) {
            length_.push_back((corner(Surface::next(h)) - corner(h)).norm());
        }
        for (Index h = 0; h < surface.twin.size(); ++h) {
            const Vec u = corner(Surface::next(h)) - corner(h);
            const Vec v = corner(Surface::previous(h)) - corner(h);
            apex_.emplace_back(u.dot(v) / length_[h], u.cross(v).norm() / length_[h]);
            angle_[surface.tail(h)] += std::atan2(apex_[h].y(), apex_[h].x());
        }
    }

    Distances run(std::span<const SurfacePoint> sites, Real longest) {
        for (Index s = 0; s < sites.size(); ++s) start(sites[s], SiteId(s));
        while (!queue_.empty() && queue_.top().key <= longest) {
            const Event event = queue_.top();
            queue_.pop();
            if (event.vertex == no_index) {
                cross_face(event.window);
            } else if (event.key == vertex_distance_[event.vertex]) {
                send_out(event.vertex, event.window.site);
            }
        }
        // A target at a corner of its face may have been reached from other faces only.
        for (Index i = 0; i < targets_.size(); ++i) {
            const Index first = 3 * targets_[i].face.value();
            for (Index h = first; h < first + 3; ++h) {
                const Index v = surface_.tail(h);
                reach_target(i, vertex_distance_[v] + place(targets_[i], h).norm(),
                             vertex_site_[v]);
            }
        }
        return std::move(result_);
    }

private:
    using Vec = Eigen::Matrix<Real, 3, 1>;

    [[nodiscard]] Vec corner(Index h) const {
        return surface_.mesh.positions[surface_.tail(h)].cast<Real>();
    }
    // In the frame of one of its face's half-edges.
    [[nodiscard]] Point place(const SurfacePoint& point, Index h) const {
        const auto& b = point.barycentric;
        return b[Surface::next(h) % 3] * Point(length_[h], 0) +
               b[Surface::previous(h) % 3] * apex_[h];
    }

    void start(const SurfacePoint& site, SiteId label) {
        Index zeros = 0;
        for (const double b : site.barycentric) zeros += b == 0;
        const Index first = 3 * site.face.value();
        for (Index h = first; h < first + 3; ++h) {
            if (zeros == 2 && site.barycentric[h % 3] != 0) {
                reach_vertex(surface_.tail(h), 0, label);
                send_out(surface_.tail(h), label);
                return;
            }
        }
        start_in_face(site, label);
        for (Index h = first; h < first + 3; ++h) {
            // This near to a vertex, rounding hides the faces beyond it: the vertex sends out
            // windows instead of the site.
            constexpr Real at_vertex = 1e-12L;
            const Index v = surface_.tail(h);
            if (place(site, h).norm() <= at_vertex * length_[h] && vertex_site_[v] == label) {
                send_out(v, label);
            }
            const Index twin = surface_.twin[h];
            if (zeros != 1 || site.barycentric[Surface::previous(h) % 3] != 0 || twin == no_index) {
                continue;
            }
            SurfacePoint across{agvd::FaceId(Surface::face(twin)), {0, 0, 0}};
            across.barycentric[twin % 3] = site.barycentric[Surface::next(h) % 3];
            across.barycentric[Surface::next(twin) % 3] = site.barycentric[h % 3];
            start_in_face(across, label);
        }
    }

    void start_in_face(const SurfacePoint& site, SiteId label) {
        const Index first = 3 * site.face.value();
        for (const Index i : targets_of_[site.face.value()]) {
            reach_target(i, (place(targets_[i], first) - place(site, first)).norm(), label);
        }
        for (Index h = first; h < first + 3; ++h) {
            const Point p = place(site, h);
            reach_vertex(surface_.tail(h), p.norm(), label);
            leave({h, p, 0, length_[h], 0, label});
        }
    }

    // Sends windows over all edges around a vertex, and paths to the vertices and targets of its
    // faces.
    void send_out(Index vertex, SiteId label) {
        const Real distance = vertex_distance_[vertex];
        Index h = surface_.outgoing[vertex];
        do {
            reach_vertex(surface_.head(h), distance + length_[h], label);
            reach_vertex(surface_.tail(Surface::previous(h)),
                         distance + length_[Surface::previous(h)], label);
            for (const Index i : targets_of_[Surface::face(h)]) {
                reach_target(i, distance + place(targets_[i], h).norm(), label);
            }
            const Index opposite = Surface::next(h);
            leave({opposite, apex_[opposite], 0, length_[opposite], distance, label});
            h = surface_.twin[Surface::previous(h)];
        } while (h != no_index && h != surface_.outgoing[vertex]);
    }

    // Queues a window given in the frame of the half-edge by which it leaves a face.
    void leave(Window window) {
        const Index h = window.half_edge;
        const Index twin = surface_.twin[h];
        if (twin == no_index) return;
        window.half_edge = twin;
        window.image = {length_[h] - window.image.x(), -window.image.y()};
        window.begin = length_[h] - window.begin;
        window.end = length_[h] - window.end;
        std::swap(window.begin, window.end);
        if (window.image.y() < 0 && window.begin < window.end && !is_beaten(window)) {
            queue_.push({window.nearest(), window, no_index});
        }
    }

    [[nodiscard]] bool is_beaten(const Window& w) const {
        const Index h = w.half_edge;
        return vertex_distance_[surface_.tail(h)] + w.end <= w.distance_to({w.end, 0}) ||
               vertex_distance_[surface_.head(h)] + length_[h] - w.begin <=
                   w.distance_to({w.begin, 0});
    }

    void cross_face(const Window& w) {
        if (is_beaten(w)) return;
        const Index h = w.half_edge;
        for (const Index i : targets_of_[Surface::face(h)]) {
            reach_target(i, w.distance_to(place(targets_[i], h)), w.site);
        }
        const Point apex = apex_[h];
        reach_vertex(surface_.tail(Surface::previous(h)), w.distance_to(apex), w.site);
        const Point left = Point(w.begin, 0) - w.image, right = Point(w.end, 0) - w.image;
        const bool left_ray_hits_right_edge = cross(left, apex - w.image) > 0;
        const bool right_ray_hits_right_edge = cross(right, apex - w.image) > 0;
        const Index right_edge = Surface::next(h), left_edge = Surface::previous(h);
        const Point head(length_[h], 0), tail(0, 0);
        if (right_ray_hits_right_edge) {
            carry(w, right_edge, head, apex, hit(w, right, head, apex),
                  left_ray_hits_right_edge ? hit(w, left, head, apex) : 1);
        }
        if (!left_ray_hits_right_edge) {
            carry(w, left_edge, apex, tail,
                  right_ray_hits_right_edge ? 0 : hit(w, right, apex, tail),
                  hit(w, left, apex, tail));
        }
    }

    // Where a ray from the image meets the segment: from 0 to 1.
    static Real hit(const Window& w, const Point& ray, const Point& from, const Point& to) {
        const Real along = -cross(ray, from - w.image) / cross(ray, to - from);
        return std::isfinite(along) ? std::min<Real>(std::max<Real>(along, 0), 1) : 0;
    }

    void carry(const Window& w, Index edge, const Point& from, const Point& to, Real begin,
               Real end) {
        const Point direction = (to - from) / (to - from).norm();
        const Point image = w.image - from;
        leave({edge,
               {image.dot(direction), cross(direction, image)},
               begin * length_[edge],
               end * length_[edge],
               w.weight,
               w.site});
    }

    void reach_vertex(Index vertex, Real distance, SiteId site) {
        // Below the slack a corner counts as straight: bending there costs its square.
        constexpr Real slack = 1e-9L;
        if (!(distance < vertex_distance_[vertex])) return;
        vertex_distance_[vertex] = distance;
        vertex_site_[vertex] = site;
        const Real straight = surface_.is_boundary_vertex(vertex) ? pi : 2 * pi;
        if (angle_[vertex] <= straight + slack) return;
        queue_.push({distance, {no_index, {0, 0}, 0, 0, distance, site}, vertex});
    }

    void reach_target(Index target, Real distance, SiteId site) {
        if (!(distance < result_.distance[target])) return;
        result_.distance[target] = distance;
        result_.site[target] = site;
    }

    const Surface& surface_;
    std::span<const SurfacePoint> targets_;
    std::vector<std::vector<Index>> targets_of_;  // #F.
    std::vector<Real> length_;                    // #H.
    std::vector<Point> apex_;                     // #H.
    std::vector<Real> angle_;                     // #V.
    std::vector<Real> vertex_distance_;           // #V.
    std::vector<SiteId> vertex_site_;             // #V.
    std::priority_queue<Event> queue_;
    Distances result_;
};

}  // namespace

Distances nearest_sites(const Surface& surface, std::span<const SurfacePoint> sites,
                        std::span<const SurfacePoint> targets, long double longest) {
    return Search(surface, targets).run(sites, longest);
}

}  // namespace arbiter
