// Retirement of faces behind the front: their relays are made, and their Steiner points are given
// back ([meng2023] Sec. 5.2). Faces retire in an order that depends on lambda; the result does not.
//
// Inside a face, a node whose parent lies on the same face is dominated by that parent (triangle
// inequality), and one that came through a neighbour is dominated by its parent's image, unfolded
// across the shared edge. So the relays of a face are the parents' images: the joint diagram with
// the neighbours' Steiner points ([meng2023] Sec. 5.3), without the points that cannot win.
#include "agvd/propagation/steiner/steiner_front.h"

#include <algorithm>
#include <numeric>

#include "agvd/mesh/point_faces.h"

namespace agvd {

bool SteinerFront::is_behind(Index face, double front) const {
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const double bound = (vertices_[surface_.tail(h)].distance +
                              vertices_[surface_.head(h)].distance + surface_.length_of(h)) /
                             2;
        if (!(bound < front)) return false;
    }
    return true;
}

void SteinerFront::retire(Index face) {
    face_state_[face] = FaceState::Retired;
    if (is_mixed(face)) {
        mixed_faces_.push_back(face);
        relay_offsets_.push_back(static_cast<Index>(relays_.size()));
        collect(face);
    }
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const Index twin = surface_.twin[h];
        if (twin == no_index || face_state_[Surface::face(twin)] == FaceState::Retired) {
            pool_.retire(surface_.edge[h]);
        }
    }
}

bool SteinerFront::are_all_from(Index half_edge, Index site) {
    if (vertices_[surface_.tail(half_edge)].site != site) return false;
    const Index edge = surface_.edge[half_edge];
    const Index m = counts_[edge];
    if (m == 0) return true;
    const SteinerNode* const nodes = pool_.nodes(edge);
    return std::all_of(nodes, nodes + m,
                       [site](const SteinerNode& node) { return node.site == site; });
}

bool SteinerFront::is_mixed(Index face) {
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

void SteinerFront::add_relay(Index half_edge, const Vec2& image, double weight, Index site) {
    relays_.push_back({image.x(), image.y(), std::max(weight, 0.0), 0,
                       surface_.length_of(half_edge), SiteId(site), half_edge});
}

void SteinerFront::collect(Index face) {
    for (const PlacedSite& placed : placement_.in_face(face)) {
        add_relay(3 * face, position_in_frame(surface_, placed.point, 3 * face), 0, placed.site);
    }
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const SteinerNode& corner = vertices_[surface_.tail(h)];
        if (corner.from != h) {  // Else its parent in this face replaces it.
            add_relay(h, {0, 0}, corner.distance, corner.site);
        }
        const Index twin = surface_.twin[h];
        if (twin != no_index) collect_across(h, twin);
    }
}

// Adds the images, in the frame of h, of the parents in the neighbour from which nodes on h
// were reached.
void SteinerFront::collect_across(Index h, Index twin) {
    const double length = surface_.length_of(h);
    const auto mirrored = [length](const Vec2& p) { return Vec2(length - p.x(), -p.y()); };
    const Index neighbour = Surface::face(twin);
    for (const PlacedSite& placed : placement_.in_face(neighbour)) {
        const Vec2 image = mirrored(position_in_frame(surface_, placed.point, twin));
        // Sites on the edge are in in_face(face), too.
        if (image.y() < 0) add_relay(h, image, 0, placed.site);
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
        add_relay(h, mirrored(p), node.distance - chord, node.site);
    }
}

void SteinerFront::retire_behind(double front) {
    std::size_t kept = 0;
    for (const Index face : open_) {
        if (is_behind(face, front)) {
            retire(face);
        } else {
            open_[kept++] = face;
        }
    }
    open_.resize(kept);
}

void SteinerFront::hand_over(Propagation& result) const {
    const auto count = static_cast<Index>(mixed_faces_.size());
    std::vector<Index> order(count);
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return mixed_faces_[a] < mixed_faces_[b]; });
    result.relays.reserve(relays_.size());
    result.mixed_faces.reserve(count);
    result.relay_ranges.reserve(count);
    for (const Index i : order) {
        result.mixed_faces.push_back(mixed_faces_[i]);
        const auto begin = static_cast<Index>(result.relays.size());
        const std::size_t end = i + 1 < count ? relay_offsets_[i + 1] : relays_.size();
        result.relays.insert(result.relays.end(), relays_.begin() + relay_offsets_[i],
                             relays_.begin() + static_cast<std::ptrdiff_t>(end));
        result.relay_ranges.push_back({begin, static_cast<Index>(result.relays.size())});
    }
}

}  // namespace agvd
