// Makes the relays of a face from the views of its corners and of the far corners of its
// neighbours. A view is the image of a site that a vertex sees through an edge of a face. A corner
// is a relay itself only if no image, site or neighbour's corner represents its path in the face.
#include "agvd/propagation/vertex_relays.h"

#include <algorithm>
#include <cstdint>

namespace agvd {

std::vector<Index> VertexRelays::mixed_faces() const {
    std::vector<std::uint8_t> is_mixed;
    is_mixed.reserve(surface_.num_faces());
    for (const auto& [a, b, c] : surface_.mesh.triangles) {
        const Index site = reach_[a].site;
        is_mixed.push_back(((reach_[b].site != site) | (reach_[c].site != site)) ? 1 : 0);
    }
    const auto mark_if_foreign = [&](Index face, Index site) {
        if (reach_[surface_.tail(3 * face)].site != site) is_mixed[face] = 1;
    };
    const auto mark_around = [&](Index face, Index site) {
        mark_if_foreign(face, site);
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Index twin = surface_.twin[h];
            if (twin != no_index) mark_if_foreign(Surface::face(twin), site);
        }
    };
    for (Index s = 0; s < sites_.size(); ++s) {
        if (vertex_of(surface_, sites_[s])) continue;
        mark_around(sites_[s].face.value(), s);
        const auto half_edge = half_edge_of(sites_[s]);
        if (half_edge && surface_.twin[*half_edge] != no_index) {
            mark_around(Surface::face(surface_.twin[*half_edge]), s);
        }
    }
    std::vector<Index> mixed;
    for (Index f = 0; f < is_mixed.size(); ++f) {
        if (is_mixed[f] != 0) mixed.push_back(f);
    }
    return mixed;
}

void VertexRelays::collect(Index face, std::vector<Relay>& out) const {
    if (!placement_.is_empty()) collect_sites(face, out);
    std::array<Index, 3> source{};
    for (Index k = 0; k < 3; ++k) source[k] = source_of(views_[corners_.tail(3 * face + k)]);
    for (Index k = 0; k < 3; ++k) {
        const Index h = 3 * face + k;
        if (!is_served(h, out)) {
            const VertexReach& reach = reach_[corners_.tail(h)];
            add_point(h, {0, 0}, reach.distance, reach.site, out);
        }
        // The neighbour's far corner is a relay if an end of h was reached from it.
        const Index other = source[(k + 1) % 3];
        const Index twin = corners_.twin(h);
        if (twin == no_index || (source[k] == no_index && other == no_index)) continue;
        const Index far = corners_.apex_vertex(twin);
        if (far != source[k] && far != other) continue;
        const Vec2 apex = corners_.apex(twin);
        add_point(h, {corners_.length(h) - apex.x(), -apex.y()}, reach_[far].distance,
                  reach_[far].site, out);
    }
}

// Adds the sites in a face and in its neighbours.
void VertexRelays::collect_sites(Index face, std::vector<Relay>& out) const {
    for (const PlacedSite& placed : placement_.in_face(face)) {
        const Vec2 p = position_in_frame(surface_, placed.point, 3 * face);
        add_point(3 * face, p, 0, placed.site, out);
    }
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const Index twin = corners_.twin(h);
        if (twin == no_index) continue;
        for (const PlacedSite& placed : placement_.in_face(Surface::face(twin))) {
            const Vec2 p = position_in_frame(surface_, placed.point, twin);
            if (!(p.y() > 0)) continue;  // It lies on the edge, and so in this face, too.
            add_point(h, {corners_.length(h) - p.x(), -p.y()}, 0, placed.site, out);
        }
    }
}

// Adds a point that sees the whole face, or all of it that lies behind h.
void VertexRelays::add_point(Index h, const Vec2& p, double weight, Index site,
                             std::vector<Relay>& out) const {
    out.push_back({p.x(), p.y(), weight, 0, corners_.length(h), SiteId(site), h});
}

// The vertex from which another was reached along an edge; no_index: it was not.
Index VertexRelays::source_of(const VertexView& view) const {
    if (view.kind == ViewKind::FromTail) return corners_.tail(view.half_edge);
    if (view.kind == ViewKind::FromHead) return corners_.head(view.half_edge);
    return no_index;
}

// Whether another relay of the face replaces the corner at the tail of h. Adds the image that the
// corner sees through an edge. Corners are compared by half-edges, since the face may have the
// vertex at another corner, too.
bool VertexRelays::is_served(Index h, std::vector<Relay>& out) const {
    const Index vertex = corners_.tail(h);
    const VertexView& view = views_[vertex];
    if (view.kind == ViewKind::Site) return false;
    const Index previous = Surface::previous(h);
    const Index across[2] = {corners_.twin(h), corners_.twin(previous)};
    if (view.kind == ViewKind::Window) {
        const Index site = reach_[vertex].site;
        if (view.half_edge == Surface::next(h)) {
            add_image(view.half_edge, view.image, view.weight, site, direction(view.left),
                      direction(view.right), out);
            return true;
        }
        if (across[0] != no_index && view.half_edge == Surface::previous(across[0])) {
            return add_across(h, view, site, out);
        }
        if (across[1] != no_index && view.half_edge == Surface::next(across[1])) {
            return add_across(previous, view, site, out);
        }
        return false;
    }
    // Edges of the neighbours: the one opposite to the corner, and the one from it to the far
    // corner.
    const bool has_neighbour[2] = {across[0] != no_index, across[1] != no_index};
    if (view.kind == ViewKind::Face) {  // The site is a relay of its face and of the neighbours.
        return view.half_edge == Surface::next(h) ||
               (has_neighbour[0] && view.half_edge == Surface::previous(across[0])) ||
               (has_neighbour[1] && view.half_edge == Surface::next(across[1]));
    }
    const Index along = surface_.edge[view.half_edge];
    return along == surface_.edge[h] || along == surface_.edge[previous] ||
           (has_neighbour[0] && along == surface_.edge[Surface::next(across[0])]) ||
           (has_neighbour[1] && along == surface_.edge[Surface::previous(across[1])]);
}

// Adds what passes h of the view of one end of h, which lies in the face across h.
bool VertexRelays::add_across(Index h, const VertexView& view, Index site,
                              std::vector<Relay>& out) const {
    const Vec2 apex = corners_.apex(view.half_edge);
    const bool at_tail = Surface::next(view.half_edge) == corners_.twin(h);
    const double length = corners_.length(h);
    const Vec2 tail = at_tail ? apex : Vec2(0, 0);
    const Vec2 head = at_tail ? Vec2(corners_.length(view.half_edge), 0) : apex;
    const Vec2 axis = (head - tail) / length;
    const Vec2 image = turned_back(view.image - tail, axis);
    if (!(image.y() < 0)) return false;
    if (at_tail) {
        add_image(h, image, view.weight, site, -image, turned_back(direction(view.right), axis),
                  out);
    } else {
        add_image(h, image, view.weight, site, turned_back(direction(view.left), axis),
                  Vec2(length, 0) - image, out);
    }
    return true;
}

// Adds an image below half-edge h that sees what lies between two directions.
void VertexRelays::add_image(Index h, const Vec2& image, double weight, Index site,
                             const Vec2& left, const Vec2& right, std::vector<Relay>& out) const {
    const double length = corners_.length(h);
    const auto hit = [&](const Vec2& d, double otherwise) {
        if (!(d.y() > 0)) return otherwise;
        return std::clamp(image.x() - image.y() * d.x() / d.y(), 0.0, length);
    };
    const double begin = hit(left, 0);
    const double end = std::max(begin, hit(right, length));
    out.push_back({image.x(), image.y(), weight, begin, end, SiteId(site), h});
}

}  // namespace agvd
