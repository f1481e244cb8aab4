#include "agvd/diagram/inside_relays.h"

#include <algorithm>
#include <cmath>

namespace agvd {
namespace {

// Images nearer to an edge (share of its length) lie on it.
constexpr double on_edge = 1e-12;

bool is_listed(const Surface& surface, const EdgeLabels& labels, Index half_edge) {
    const Index twin = surface.twin[half_edge];
    return twin == no_index || labels.mixed_index[Surface::face(twin)] != no_index;
}

}  // namespace

void InsideRelays::gather_own(Index mixed_index, std::vector<PlanarRelay>& out) {
    out.clear();
    const Index face = propagation_.mixed_faces[mixed_index];
    const auto corners = face_corners(surface_, face);
    std::array<double, 3> lengths;
    for (Index k = 0; k < 3; ++k) lengths[k] = surface_.length_of(3 * face + k);
    const std::array<Motion, 3> motions{Motion{},
                                        Motion{(corners[2] - corners[1]) / lengths[1], corners[1]},
                                        Motion{-corners[2] / lengths[2], corners[2]}};
    const auto own = relays_of(propagation_, mixed_index);
    order_.clear();
    for (Index i = 0; i < own.size(); ++i) order_.emplace_back(own[i].site.value(), i);
    std::sort(order_.begin(), order_.end());
    for (const auto& [site, i] : order_) {
        out.push_back(to_planar(own[i], motions[own[i].half_edge - 3 * face]));
    }
}

void InsideRelays::gather_all(Index mixed_index, std::vector<PlanarRelay>& out) {
    out.clear();
    const Index face = propagation_.mixed_faces[mixed_index];
    for (const Relay& relay : relays_of(propagation_, mixed_index)) {
        if (relay.y >= 0 || !is_listed(surface_, labels_, relay.half_edge)) {
            out.push_back(to_planar(relay, to_face_frame(surface_, relay.half_edge)));
        }
    }
    const auto corners = face_corners(surface_, face);
    for (Index k = 0; k < 3; ++k) {
        const Index v = surface_.mesh.triangles[face][k];
        out.push_back(point_relay(corners[k], labels_.vertex_distance[v], labels_.point_site[v]));
        if (is_listed(surface_, labels_, 3 * face + k)) append_winners(3 * face + k, out);
        append_crossings(3 * face + k, out);
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const PlanarRelay& a, const PlanarRelay& b) { return a.site < b.site; });
}

void InsideRelays::append_winners(Index half_edge, std::vector<PlanarRelay>& out) {
    const Index edge = surface_.edge[half_edge];
    const Index along = surface_.edge_half[edge];
    const double length = surface_.length[edge];
    edge_relays_.gather(edge, on_edge_);
    pieces_.clear();
    double from = 0;
    Index site = labels_.point_site[surface_.tail(along)];
    for (const Crossing& crossing : labels_.on_edge(edge)) {
        append_pieces(on_edge_, site, from, crossing.at * length, pieces_);
        from = crossing.at * length;
        site = crossing.site_after;
    }
    append_pieces(on_edge_, site, from, length, pieces_);
    const bool forward = along == half_edge;
    const Motion to = to_face_frame(surface_, half_edge);
    for (const StraightPiece& won : pieces_) {
        const Vec2 image = forward ? won.from : Vec2(length - won.from.x(), -won.from.y());
        const bool is_on_edge = std::abs(image.y()) <= on_edge * length;
        if (image.y() > 0 && !is_on_edge) continue;  // Comes from this face.
        const Vec2 begin(forward ? won.begin : length - won.end, 0);
        const Vec2 end(forward ? won.end : length - won.begin, 0);
        out.push_back({to(image), to(begin), to(end), won.weight,
                       won.weight + (begin - image).norm(), won.weight + (end - image).norm(),
                       won.site, is_on_edge});
    }
}

void InsideRelays::append_crossings(Index half_edge, std::vector<PlanarRelay>& out) const {
    const Index edge = surface_.edge[half_edge];
    const double length = surface_.length[edge];
    const bool forward = surface_.edge_half[edge] == half_edge;
    const Motion to = to_face_frame(surface_, half_edge);
    for (const Crossing& c : labels_.on_edge(edge)) {
        const Vec2 p = to({length * (forward ? c.at : 1 - c.at), 0});
        out.push_back(point_relay(p, c.distance, c.site_before));
        out.push_back(point_relay(p, c.distance, c.site_after));
    }
}

}  // namespace agvd
