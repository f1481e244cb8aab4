#include "paper/vertex_labels.h"

#include <algorithm>

#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

struct Place {
    SurfacePoint point;
    double distance = 0;  // From the sites between which it lies.
    Index vertex = no_index;
};

class Drawing {
public:
    Drawing(const Surface& surface, std::size_t num_sites, const Propagation& p)
        : surface_(surface), p_(p), crossings_(surface.num_edges()), at_(surface.num_vertices()) {
        diagram_.num_sites = static_cast<Index>(num_sites);
        diagram_.nearest_site = p.vertex_site;
        diagram_.nearest_distance = p.vertex_distance;
        diagram_.edge_points = diagram_.vertex_offsets = {0};
    }
    Diagram run() {
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            if (label(3 * f).is_valid()) draw_face(f);
        }
        for (const std::vector<EdgeEnd>& ends : ends_) {
            for (const EdgeEnd& end : ends) {
                const VoronoiEdge& edge = diagram_.edges[end.edge];
                diagram_.vertex_ends.push_back(end);
                diagram_.vertex_sites.push_back(end.is_tail ? edge.left : edge.right);
            }
            diagram_.vertex_offsets.push_back(static_cast<Index>(diagram_.vertex_ends.size()));
        }
        return std::move(diagram_);
    }

private:
    // Of its tail.
    [[nodiscard]] SiteId label(Index h) const { return p_.vertex_site[surface_.tail(h)]; }

    // The place on half-edge h, at a share of its length, as one of its face.
    static SurfacePoint point_on(Index h, double at) {
        SurfacePoint point{FaceId(Surface::face(h)), {0, 0, 0}};
        point.barycentric[h % 3] = 1 - at;
        point.barycentric[Surface::next(h) % 3] = at;
        return point;
    }
    // The place as seen from the face of `point`. It is made if it is not known.
    Place place(Place& known, const SurfacePoint& point, double distance) {
        if (known.vertex == no_index) {
            known = {point, distance, static_cast<Index>(ends_.size())};
            diagram_.vertices.push_back(point);
            diagram_.vertex_distance.push_back(distance);
            ends_.emplace_back();
        }
        return {point, known.distance, known.vertex};
    }
    Place corner(Index h) { return place(at_[surface_.tail(h)], point_on(h, 0), 0); }

    // Where paths along half-edge h, from both of its ends, are equally long.
    Place crossing(Index h) {
        Place& known = crossings_[surface_.edge[h]];
        const auto face = FaceId(Surface::face(h));
        if (known.vertex != no_index) {
            return place(known, *seen_from(surface_, known.point, face.value()), 0);
        }
        const double length = surface_.length_of(h);
        const double tail = p_.vertex_distance[surface_.tail(h)];
        const double head = p_.vertex_distance[surface_.head(h)];
        const double at = std::clamp((1 + (head - tail) / length) / 2, 0.0, 1.0);
        return place(known, point_on(h, at), tail + at * length);
    }

    // Edges are added so that their ends are counter-clockwise at each vertex.
    void add_edge(const Place& from, const Place& to, SiteId left, SiteId right) {
        const auto edge = static_cast<Index>(diagram_.edges.size());
        diagram_.edges.push_back({left, right, from.vertex, to.vertex});
        for (const Place* end : {&from, &to}) {
            diagram_.points.push_back(end->point);
            diagram_.point_distance.push_back(end->distance);
            diagram_.passages.emplace_back();
            ends_[end->vertex].push_back({edge, end == &from});
        }
        diagram_.edge_points.push_back(static_cast<Index>(diagram_.points.size()));
    }
    void draw_face(Index face) {
        std::vector<std::pair<Index, Place>> changes;  // Half-edges, and the places on them.
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (label(h) != label(Surface::next(h))) changes.emplace_back(h, crossing(h));
        }
        if (changes.size() == 2) {
            const auto& [first, a] = changes[0];
            add_edge(a, changes[1].second, label(first), label(Surface::next(first)));
        } else if (changes.size() == 3) {
            Place middle{{FaceId(face), {0, 0, 0}}};
            for (const auto& [h, change] : changes) {
                middle.distance += change.distance / 3;
                for (std::size_t k = 0; k < 3; ++k) {
                    middle.point.barycentric[k] += change.point.barycentric[k] / 3;
                }
            }
            Place unknown;
            middle = place(unknown, middle.point, middle.distance);
            for (const auto& [h, change] : changes) {
                add_edge(middle, change, label(Surface::next(h)), label(h));
            }
        }
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (surface_.twin[h] != no_index) continue;
            Place from = corner(h);
            if (label(h) != label(Surface::next(h))) {
                add_edge(from, crossing(h), label(h), {});
                from = crossing(h);
            }
            add_edge(from, corner(Surface::next(h)), label(Surface::next(h)), {});
        }
    }

    const Surface& surface_;
    const Propagation& p_;
    std::vector<Place> crossings_;            // #E
    std::vector<Place> at_;                   // #V: on the boundary.
    std::vector<std::vector<EdgeEnd>> ends_;  // By Voronoi vertex.
    Diagram diagram_;
};

}  // namespace

Diagram vertex_label_diagram(const Surface& surface, std::size_t num_sites,
                             const Propagation& exact) {
    return Drawing(surface, num_sites, exact).run();
}

}  // namespace agvd
