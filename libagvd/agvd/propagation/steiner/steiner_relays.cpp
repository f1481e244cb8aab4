#include "agvd/propagation/steiner/steiner_relays.h"

#include <algorithm>

namespace agvd {

bool SteinerRelays::are_all_from(Index half_edge, Index site) {
    if (vertices_[surface_.tail(half_edge)].site != site) return false;
    const Index edge = surface_.edge[half_edge];
    const Index m = counts_[edge];
    if (m == 0) return true;
    const SteinerNode* const nodes = pool_.nodes(edge);
    return std::all_of(nodes, nodes + m,
                       [site](const SteinerNode& node) { return node.site == site; });
}

bool SteinerRelays::is_mixed(Index face) {
    const Index site = vertices_[surface_.tail(3 * face)].site;
    const auto may_hold_another = [&](Index f) {
        const auto placed = placement_.in_face(f);
        return std::any_of(placed.begin(), placed.end(),
                           [site](const PlacedSite& p) { return p.site != site; });
    };
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        if (!are_all_from(h, site)) return true;
        const Index twin = surface_.twin[h];
        if (twin != no_index && may_hold_another(Surface::face(twin))) return true;
    }
    return may_hold_another(face);
}

void SteinerRelays::add_relay(Index half_edge, const Vec2& image, double weight, Index site,
                              std::vector<Relay>& out) const {
    out.push_back({image.x(), image.y(), std::max(weight, 0.0), 0, surface_.length_of(half_edge),
                   SiteId(site), half_edge});
}

void SteinerRelays::collect(Index face, std::vector<Relay>& out) {
    for (const PlacedSite& placed : placement_.in_face(face)) {
        add_relay(3 * face, position_in_frame(surface_, placed.point, 3 * face), 0, placed.site,
                  out);
    }
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const SteinerNode& corner = vertices_[surface_.tail(h)];
        if (corner.from != h) {  // Else its parent in this face replaces it.
            add_relay(h, {0, 0}, corner.distance, corner.site, out);
        }
        const Index twin = surface_.twin[h];
        if (twin != no_index) collect_across(h, twin, out);
    }
}

// Adds the images, in the frame of h, of the parents in the neighbour from which nodes on h were
// reached.
void SteinerRelays::collect_across(Index h, Index twin, std::vector<Relay>& out) {
    const double length = surface_.length_of(h);
    const auto mirrored = [length](const Vec2& p) { return Vec2(length - p.x(), -p.y()); };
    const Index neighbour = Surface::face(twin);
    for (const PlacedSite& placed : placement_.in_face(neighbour)) {
        const Vec2 image = mirrored(position_in_frame(surface_, placed.point, twin));
        // Sites on the edge are in in_face(face), too.
        if (image.y() < 0) add_relay(h, image, 0, placed.site, out);
    }
    const Index edge = surface_.edge[h];
    const Index m = counts_[edge];
    if (m == 0) return;
    const double step = counts_.step(edge);
    const SteinerNode* const nodes = pool_.nodes(edge);
    seen_slots_.clear();
    for (Index k = 0; k < m; ++k) {
        const SteinerNode& node = nodes[k];
        if (node.from != twin || node.parent_slot == FaceRing::site_slot ||
            FaceRing::is_on_base(node.parent_slot)) {
            continue;
        }
        const std::pair<Index, Index> key(node.parent_slot, node.site);
        if (std::find(seen_slots_.begin(), seen_slots_.end(), key) != seen_slots_.end()) {
            continue;
        }
        seen_slots_.push_back(key);
        const Vec2 p = FaceRing::position(surface_, counts_, twin, node.parent_slot);
        const Index j = surface_.edge_half[edge] == twin ? k + 1 : m - k;
        const double chord = (p - Vec2(length * j * step, 0)).norm();
        add_relay(h, mirrored(p), node.distance - chord, node.site, out);
    }
}

}  // namespace agvd
