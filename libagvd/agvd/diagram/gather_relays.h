//! \file
//! The relays that matter on one mesh edge and inside one face.
#pragma once

#include <algorithm>
#include <cmath>

#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/face_relays.h"

namespace agvd {

//! Keeps references; one for each thread.
class RelayGatherer {
public:
    RelayGatherer(const Surface& surface, const Propagation& propagation, const EdgeLabels& labels)
        : surface_(surface), propagation_(propagation), labels_(labels) {}

    //! Whether labels may change on an edge, all of whose faces are listed. Then `relays` holds
    //! those that could be the nearest somewhere on it, in the frame of the edge_half. Most lose by
    //! what they say at its ends, since distances are convex.
    //! \param changes_once  not null: may be set, if the label certainly changes once; the relays
    //!                      are not written then.
    [[nodiscard]] bool may_change(Index edge, std::vector<LineRelay>& relays,
                                  bool* changes_once = nullptr) {
        const Index h = surface_.edge_half[edge];
        const Index site = labels_.point_site[surface_.tail(h)];
        scan(edge);
        if (labels_.point_site[surface_.head(h)] == site &&
            std::all_of(candidates_.begin(), candidates_.end(),
                        [site](const Candidate& c) { return c.site == site; })) {
            return false;
        }
        if (changes_once != nullptr && (*changes_once = is_single_change(edge))) return true;
        put_candidates(edge, relays);
        return true;
    }

    //! The face's own relays, in its own frame, by ascending site.
    void gather_own(Index mixed_index, std::vector<PlanarRelay>& out) {
        out.clear();
        const Index face = propagation_.mixed_faces[mixed_index];
        std::array<Motion, 3> motions;
        for (Index k = 0; k < 3; ++k) motions[k] = to_face_frame(surface_, 3 * face + k);
        const auto own = relays_of(propagation_, mixed_index);
        order_.clear();
        for (Index i = 0; i < own.size(); ++i) order_.emplace_back(own[i].site.value(), i);
        std::sort(order_.begin(), order_.end());
        for (const auto& [site, i] : order_) {
            out.push_back(to_planar(own[i], motions[own[i].half_edge - 3 * face]));
        }
    }

    //! What lies in the face, its corners, the label changes on its edges, which pin the arcs, and
    //! what won on its edges, through the interval on which it won: in the face every label is
    //! star-shaped with respect to an interval of its own on the boundary, or its site.
    void gather_all(Index mixed_index, std::vector<PlanarRelay>& out) {
        out.clear();
        const Index face = propagation_.mixed_faces[mixed_index];
        for (const Relay& relay : relays_of(propagation_, mixed_index)) {
            if (relay.y >= 0 || !is_listed(relay.half_edge)) {
                out.push_back(to_planar(relay, to_face_frame(surface_, relay.half_edge)));
            }
        }
        const auto corners = face_corners(surface_, face);
        for (Index k = 0; k < 3; ++k) {
            const Index v = surface_.mesh.triangles[face][k];
            out.push_back(
                point_relay(corners[k], labels_.vertex_distance[v], labels_.point_site[v]));
            if (is_listed(3 * face + k)) append_winners(3 * face + k, out);
            append_crossings(3 * face + k, out);
        }
        std::stable_sort(out.begin(), out.end(), [](const PlanarRelay& a, const PlanarRelay& b) {
            return a.site < b.site;
        });
    }

private:
    // A relay no worse than this share of the edge stands for its end.
    static constexpr double same_distance = 1e-4;
    // The relays across an edge suffice if they give the distances of its ends up to this share of
    // the edge. Errors below it are accepted for a shorter list of candidates.
    static constexpr double enough_at_ends = 1e-2;
    static constexpr double slope_rounding = 1e-6;
    // Images nearer to an edge (share of its length) lie on it.
    static constexpr double on_edge = 1e-12;
    // A relay whose image lies across the edge, in the frame of one half-edge or the other.
    // \param at_tail, at_head  distances of the half-edge's ends.
    static LineRelay through_edge(const Relay& r, double at_tail, double at_head, bool forward,
                                  double length) {
        const double at_begin = at_tail - r.begin;
        const double at_end = at_head - (length - r.end);
        if (is_parallel(r) && !forward) {
            return {{length - r.end, -r.x, length - r.begin},
                    {0, infinity, 0},
                    {at_end, r.weight - length * r.x, at_begin},
                    length - r.end,
                    length - r.begin,
                    r.site.value()};
        }
        if (forward) {
            return {
                {r.begin, r.x, r.end}, {0, r.y, 0}, {at_begin, r.weight, at_end}, r.begin, r.end,
                r.site.value()};
        }
        return {{length - r.end, length - r.x, length - r.begin},
                {0, -r.y, 0},
                {at_end, r.weight, at_begin},
                length - r.end,
                length - r.begin,
                r.site.value()};
    }

    // From the frame of another half-edge of the same face into that of `h`.
    static Motion between_half_edges(const Surface& surface, Index from, Index h) {
        const Vec2& apex = surface.apex[h];
        const Vec2 head(surface.length_of(h), 0);
        const double length = surface.length_of(from);
        if (from == Surface::next(h)) return {(apex - head) / length, head};
        return {-apex / length, apex};
    }

    // The three positions of an image.
    static bool is_across(const Relay& r, Index half_edge) {
        return r.y < 0 && r.half_edge == half_edge;
    }
    // At the tail of its half-edge.
    static bool is_corner(const Relay& r) { return r.x == 0 && r.y == 0; }
    static bool is_inside(const Relay& r) { return r.y >= 0 && !is_corner(r); }
    struct Candidate {
        double lo, hi;              // Distances of the two ends,
        double slope_lo, slope_hi;  // and bounds of their derivatives along the edge.
        const Relay* relay;
        Index site;
        Index base;  // The half-edge of the edge in whose face the relay is seen.
    };

    // Of the face.
    [[nodiscard]] std::span<const Relay> relays_at(Index half_edge) const {
        return relays_of(propagation_, labels_.mixed_index[Surface::face(half_edge)]);
    }
    // Leaves the candidates that could be the nearest somewhere on the edge.
    void scan(Index edge) {
        const Index h = surface_.edge_half[edge];
        const Index twin = surface_.twin[h];
        const double length = surface_.length[edge];
        candidates_.clear();
        scan_across(edge, h);
        if (twin != no_index) scan_across(edge, twin);
        const double at_tail = labels_.vertex_distance[surface_.tail(h)];
        const double at_head = labels_.vertex_distance[surface_.head(h)];
        Candidate first, last;  // The nearest at the ends.
        const auto find_nearest = [&] {
            first = last = {infinity, infinity, 0, 0, nullptr, no_index, no_index};
            for (const Candidate& c : candidates_) {
                if (c.lo < first.lo) first = c;
                if (c.hi < last.hi) last = c;
            }
        };
        find_nearest();
        // A path that reaches the edge through one face passes a relay of the other face. Where an
        // engine leaves some of these out, the relays found do not give the distances of the ends.
        if (twin == no_index || first.lo > at_tail + enough_at_ends * length ||
            last.hi > at_head + enough_at_ends * length) {
            scan_others(edge, h);
            if (twin != no_index) scan_others(edge, twin);
            find_nearest();
        }

        const double slack = tie_tolerance * (at_tail + at_head + length);
        const double enough = same_distance * length;
        needs_tail_ =
            first.site != labels_.point_site[surface_.tail(h)] || first.lo > at_tail + enough;
        needs_head_ =
            last.site != labels_.point_site[surface_.head(h)] || last.hi > at_head + enough;
        if (candidates_.empty()) {
            first.lo = at_tail;
            first.hi = at_tail + length;
            last.lo = at_head + length;
            last.hi = at_head;
        }

        // c lies above its tangents at the ends, the others below their chords.
        const double rise_first = (first.hi - first.lo) / length;
        const double rise_last = (last.hi - last.lo) / length;
        const auto loses = [&](const Candidate& c) {
            const double bend = c.slope_hi - c.slope_lo;
            double where = bend > 0 ? (c.lo - c.hi + c.slope_hi * length) / bend : 0;
            where = std::clamp(where, 0.0, length);
            const double least =
                std::max(c.lo + c.slope_lo * where, c.hi - c.slope_hi * (length - where)) - slack;
            return (least > first.lo + rise_first * where && c.lo > first.lo && c.hi > first.hi) ||
                   (least > last.lo + rise_last * where && c.lo > last.lo && c.hi > last.hi);
        };
        std::erase_if(candidates_, loses);
    }

    // Whether the candidates are of the sites a and b of the ends alone, and a - b certainly has
    // one change of sign: because it rises all along; or because it rises where one of two relays
    // is bent, and its signs where the image of each is first and last seen are different. There it
    // has two zeros at most, as a quadratic equation has.
    [[nodiscard]] bool is_single_change(Index edge) const {
        const Index h = surface_.edge_half[edge];
        const Index a = labels_.point_site[surface_.tail(h)];
        const Index b = labels_.point_site[surface_.head(h)];
        if (a == b || needs_tail_ || needs_head_) return false;
        const Candidate *on_a = nullptr, *on_b = nullptr;
        double least_rise = 1, most_rise = -1;  // Of a, and of b.
        for (const Candidate& c : candidates_) {
            if (c.site == a) {
                on_a = &c;
                least_rise = std::min(least_rise, c.slope_lo);
            } else if (c.site == b) {
                on_b = &c;
                most_rise = std::max(most_rise, c.slope_hi);
            } else {
                return false;
            }
        }
        if (least_rise > most_rise + 2 * slope_rounding) return true;
        if (candidates_.size() != 2 || on_a == nullptr || on_b == nullptr) return false;
        const double length = surface_.length[edge];
        const auto from_a = straight_part(*on_a, length), from_b = straight_part(*on_b, length);
        if (!from_a || !from_b || from_a->begin > 0 || from_b->end < length) return false;
        const double clear = shortest_interval * (length + on_a->hi);
        const auto is_nearer_at = [&](const StraightPiece& here, double bent, double x) {
            return here.weight + root(x - here.from.x(), here.from.y()) + clear < bent;
        };
        return from_a->end <= from_b->begin ||
               ((from_b->begin <= 0 ||
                 is_nearer_at(*from_a, on_b->lo - from_b->begin, from_b->begin)) &&
                (from_a->end >= length ||
                 is_nearer_at(*from_b, on_a->hi - (length - from_a->end), from_a->end)));
    }

    // Where a candidate's image is seen from the edge, if it bends at the edge or not at all.
    [[nodiscard]] std::optional<StraightPiece> straight_part(const Candidate& c,
                                                             double length) const {
        const Relay& r = *c.relay;
        if (r.y >= 0 || r.half_edge != c.base || is_parallel(r)) return {};
        const StraightPiece piece{{r.x, r.y}, r.weight, r.begin, r.end, c.site};
        if (surface_.edge_half[surface_.edge[c.base]] == c.base) return piece;
        return StraightPiece{
            {length - r.x, -r.y}, r.weight, length - r.end, length - r.begin, c.site};
    }

    // The relays of one face whose image lies across the edge, with their slopes, and those in the
    // face. Faces have too few relays to sort them first.
    void scan_across(Index edge, Index half_edge) {
        const bool forward = surface_.edge_half[edge] == half_edge;
        const double length = surface_.length[edge];
        const auto relays = relays_at(half_edge);
        for (const Relay& r : relays) {
            if (!is_across(r, half_edge)) continue;
            if (is_parallel(r)) {
                add_parallel(edge, half_edge, r);
                continue;
            }
            const double begin = root(r.begin - r.x, r.y);
            const double end = root(r.end - r.x, r.y);
            const double tail = r.weight + begin + r.begin;
            const double head = r.weight + end + (length - r.end);
            // Bent paths run along the edge.
            double slope_tail = -1;
            double slope_head = 1;
            if (r.begin <= 0 && begin > 0)
                slope_tail = std::max(-1.0, -r.x / begin - slope_rounding);
            if (r.end >= length && end > 0)
                slope_head = std::min(1.0, (length - r.x) / end + slope_rounding);
            add_across(forward,
                       {tail, head, slope_tail, slope_head, &r, r.site.value(), half_edge});
        }
        for (const Relay& r : relays) {
            if (is_inside(r)) add_distances(edge, half_edge, r);
        }
    }

    // Parallel paths across the edge.
    void add_parallel(Index edge, Index half_edge, const Relay& r) {
        const double length = surface_.length[edge];
        const double tail = r.weight - r.begin * r.x + r.begin;
        const double head = r.weight - r.end * r.x + (length - r.end);
        const double slope_tail = r.begin <= 0 ? std::max(-1.0, -r.x - slope_rounding) : -1;
        const double slope_head = r.end >= length ? std::min(1.0, -r.x + slope_rounding) : 1;
        add_across(surface_.edge_half[edge] == half_edge,
                   {tail, head, slope_tail, slope_head, &r, r.site.value(), half_edge});
    }

    // A candidate in the direction of a half-edge or, if it is not the edge_half, of the twin.
    void add_across(bool forward, const Candidate& c) {
        if (forward) {
            candidates_.push_back(c);
        } else {
            candidates_.push_back({c.hi, c.lo, -c.slope_hi, -c.slope_lo, c.relay, c.site, c.base});
        }
    }

    // The others, and the corner opposite.
    void scan_others(Index edge, Index half_edge) {
        const Index previous = Surface::previous(half_edge);
        const auto relays = relays_at(half_edge);
        for (const Index other : {Surface::next(half_edge), previous}) {
            for (const Relay& r : relays) {
                if (is_across(r, other)) add_distances(edge, half_edge, r);
            }
        }
        for (const Relay& r : relays) {
            if (is_corner(r) && r.half_edge == previous) add_distances(edge, half_edge, r);
        }
    }

    // Of a relay of the face that may belong to another half-edge.
    void add_distances(Index edge, Index half_edge, const Relay& relay) {
        const CornerDistances to = corner_distances(relay, surface_.length_of(relay.half_edge),
                                                    surface_.apex[relay.half_edge]);
        double tail = to.tail;
        double head = to.head;
        if (relay.half_edge == Surface::next(half_edge)) {
            tail = to.apex;
            head = to.tail;
        } else if (relay.half_edge != half_edge) {
            tail = to.head;
            head = to.apex;
        }
        if (surface_.edge_half[edge] != half_edge) std::swap(tail, head);
        candidates_.push_back({tail, head, -1, 1, &relay, relay.site.value(), half_edge});
    }

    [[nodiscard]] LineRelay through_face(Index base, const Relay& relay) const {
        const Index edge = surface_.edge[base];
        const double length = surface_.length[edge];
        const bool is_here = surface_.edge_half[edge] == base;
        const Motion motion = relay.half_edge == base
                                  ? Motion{}
                                  : between_half_edges(surface_, relay.half_edge, base);
        if (is_here) return on_line(to_planar(relay, motion), {0, 0}, {1, 0}, length);
        const Motion turn{{-1, 0}, {length, 0}};
        const Motion turned{turn(motion.axis) - turn.origin, turn(motion.origin)};
        return on_line(to_planar(relay, turned), {0, 0}, {1, 0}, length);
    }

    void put_candidates(Index edge, std::vector<LineRelay>& relays) const {
        relays.clear();
        const Index h = surface_.edge_half[edge];
        const double length = surface_.length[edge];
        for (const Candidate& c : candidates_) {
            const Relay& relay = *c.relay;
            if (relay.y >= 0 || relay.half_edge != c.base) {
                relays.push_back(through_face(c.base, relay));
            } else if (c.base == h) {
                relays.push_back(through_edge(relay, c.lo, c.hi, true, length));
            } else {
                relays.push_back(through_edge(relay, c.hi, c.lo, false, length));
            }
        }
        const Index a = surface_.tail(h);
        const Index b = surface_.head(h);
        if (needs_tail_) {
            relays.push_back(point_on_line(0, labels_.vertex_distance[a], labels_.point_site[a]));
        }
        if (needs_head_) {
            relays.push_back(
                point_on_line(length, labels_.vertex_distance[b], labels_.point_site[b]));
        }
    }

    [[nodiscard]] bool is_listed(Index half_edge) const {
        const Index twin = surface_.twin[half_edge];
        return twin == no_index || labels_.mixed_index[Surface::face(twin)] != no_index;
    }

    void append_winners(Index half_edge, std::vector<PlanarRelay>& out) {
        const Index edge = surface_.edge[half_edge];
        const Index along = surface_.edge_half[edge];
        const double length = surface_.length[edge];
        scan(edge);
        put_candidates(edge, on_edge_);
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
            if (std::isinf(won.from.y())) {
                if ((won.from.y() < 0) == forward) out.push_back(parallel_winner(won, half_edge));
                continue;
            }
            const Vec2 image = forward ? won.from : Vec2(length - won.from.x(), -won.from.y());
            if (image.y() > on_edge * length) continue;  // Comes from this face.
            const Vec2 begin(forward ? won.begin : length - won.end, 0);
            const Vec2 end(forward ? won.end : length - won.begin, 0);
            if (image.y() >= -on_edge * length) {
                // Paths leave the edge where it is the nearest to the image.
                const Vec2 leaves(std::clamp(image.x(), begin.x(), end.x()), 0);
                out.push_back(
                    point_relay(to(leaves), won.weight + (leaves - image).norm(), won.site));
                continue;
            }
            out.push_back({to(image), to(begin), to(end), won.weight,
                           won.weight + (begin - image).norm(), won.weight + (end - image).norm(),
                           won.site, false});
        }
    }

    // Parallel paths that come across the half-edge of a face, in the frame of the face.
    [[nodiscard]] PlanarRelay parallel_winner(const StraightPiece& won, Index half_edge) const {
        const Index edge = surface_.edge[half_edge];
        const double length = surface_.length[edge];
        const double x = won.from.x();
        const Relay relay =
            surface_.edge_half[edge] == half_edge
                ? Relay{x, -infinity, won.weight, won.begin, won.end, SiteId(won.site), half_edge}
                : Relay{-x,
                        -infinity,
                        won.weight - length * x,
                        length - won.end,
                        length - won.begin,
                        SiteId(won.site),
                        half_edge};
        return to_planar_parallel(relay, to_face_frame(surface_, half_edge));
    }

    void append_crossings(Index half_edge, std::vector<PlanarRelay>& out) const {
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

    const Surface& surface_;
    const Propagation& propagation_;
    const EdgeLabels& labels_;
    std::vector<Candidate> candidates_;  // Of the edge at hand.
    // The end itself is nearer to its site than any relay says.
    bool needs_tail_ = false, needs_head_ = false;
    std::vector<std::pair<Index, Index>> order_;  // Site and relay.
    std::vector<LineRelay> on_edge_;
    std::vector<StraightPiece> pieces_;
};

}  // namespace agvd
