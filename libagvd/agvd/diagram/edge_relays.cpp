// Candidates for the lower envelope along an edge. A relay's distance f(x) along the edge is
// convex, with |f'| <= 1. So it lies below the chord between its ends and above its tangents there:
// a relay whose tangents lie above the chord of the relay that is nearest at an end is dropped.
//
// Notation: lo and hi are the tail and head of the edge's edge_half.
#include "agvd/diagram/edge_relays.h"

#include <algorithm>
#include <cmath>

namespace agvd {
namespace {

// A relay stands for the end of an edge itself if it is no worse there by more than this share of
// the edge.
constexpr double same_distance = 1e-4;
// The relays across an edge suffice if they give the distances of its ends up to this share of the
// edge. Errors below it are accepted for a shorter list of candidates.
constexpr double enough_at_ends = 1e-2;

double root(double x, double y) { return std::sqrt(x * x + y * y); }

// A relay whose image lies across the edge, in the frame of one half-edge or the other.
// \param at_tail, at_head  distances of the half-edge's ends.
LineRelay through_edge(const Relay& r, double at_tail, double at_head, bool forward,
                       double length) {
    const double at_begin = at_tail - r.begin;
    const double at_end = at_head - (length - r.end);
    if (forward) {
        return {{r.begin, r.x, r.end}, {0, r.y, 0}, {at_begin, r.weight, at_end}, r.begin, r.end,
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
Motion between_half_edges(const Surface& surface, Index from, Index h) {
    const Vec2& apex = surface.apex[h];
    const Vec2 head(surface.length_of(h), 0);
    const double length = surface.length_of(from);
    if (from == Surface::next(h)) return {(apex - head) / length, head};
    return {-apex / length, apex};
}

// The three places of an image.
bool is_across(const Relay& r, Index half_edge) { return r.y < 0 && r.half_edge == half_edge; }
bool is_corner(const Relay& r) { return r.x == 0 && r.y == 0; }  // The tail of its half-edge.
bool is_inside(const Relay& r) { return r.y >= 0 && !is_corner(r); }

}  // namespace

// Most faces have three or four relays, so that sorting them first would not pay.
template <typename IsInQuestion, typename Each>
void EdgeRelays::for_each_relay(Index half_edge, const IsInQuestion& is_in_question,
                                const Each& each) const {
    const auto [begin, end] =
        propagation_.relay_ranges[labels_.mixed_index[Surface::face(half_edge)]];
    for (Index i = begin; i < end; ++i) {
        if (is_in_question(propagation_.relays[i])) each(i);
    }
}

// The relays of one face whose image lies across the edge, with their slopes, and those in the
// face. The ends of the edge stand for themselves.
void EdgeRelays::scan_across(Index edge, Index half_edge) {
    const bool forward = surface_.edge_half[edge] == half_edge;
    const double length = surface_.length[edge];
    const auto add_across = [&](Index i) {
        const Relay& r = propagation_.relays[i];
        const double begin = root(r.begin - r.x, r.y);
        const double end = root(r.end - r.x, r.y);
        const double tail = r.weight + begin + r.begin;
        const double head = r.weight + end + (length - r.end);
        // Bent paths run along the edge.
        constexpr double rounding = 1e-6;
        double slope_tail = -1;
        double slope_head = 1;
        if (r.begin <= 0 && begin > 0) slope_tail = std::max(-1.0, -r.x / begin - rounding);
        if (r.end >= length && end > 0) slope_head = std::min(1.0, (length - r.x) / end + rounding);
        if (forward) {
            candidates_.push_back(
                {tail, head, slope_tail, slope_head, i, r.site.value(), half_edge});
        } else {
            candidates_.push_back(
                {head, tail, -slope_head, -slope_tail, i, r.site.value(), half_edge});
        }
    };
    for_each_relay(
        half_edge, [&](const Relay& r) { return is_across(r, half_edge); }, add_across);
    for_each_relay(half_edge, is_inside, [&](Index i) { add_distances(edge, half_edge, i); });
}

// The others, and the corner opposite.
void EdgeRelays::scan_others(Index edge, Index half_edge) {
    const Index next = Surface::next(half_edge);
    const Index previous = Surface::previous(half_edge);
    const auto add = [&](Index i) { add_distances(edge, half_edge, i); };
    for (const Index other : {next, previous}) {
        for_each_relay(
            half_edge, [&](const Relay& r) { return is_across(r, other); }, add);
    }
    for_each_relay(
        half_edge, [&](const Relay& r) { return is_corner(r) && r.half_edge == previous; }, add);
}

// Of a relay of the face that may belong to another half-edge.
void EdgeRelays::add_distances(Index edge, Index half_edge, Index i) {
    const Relay& relay = propagation_.relays[i];
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
    candidates_.push_back({tail, head, -1, 1, i, relay.site.value(), half_edge});
}

// Leaves the candidates that could be the nearest somewhere on the edge.
void EdgeRelays::scan(Index edge) {
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
        first = last = {infinity, infinity, 0, 0, 0, no_index, no_index};
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
    needs_tail_ = first.site != labels_.point_site[surface_.tail(h)] || first.lo > at_tail + enough;
    needs_head_ = last.site != labels_.point_site[surface_.head(h)] || last.hi > at_head + enough;
    if (candidates_.empty()) {
        first.lo = at_tail;
        first.hi = at_tail + length;
        last.lo = at_head + length;
        last.hi = at_head;
    }

    // c lies above its tangents at the ends, which come closest to a chord where they meet; the
    // others lie below their chords.
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

bool EdgeRelays::may_change(Index edge, std::vector<LineRelay>& relays) {
    const Index h = surface_.edge_half[edge];
    const Index site = labels_.point_site[surface_.tail(h)];
    scan(edge);
    if (labels_.point_site[surface_.head(h)] == site &&
        std::all_of(candidates_.begin(), candidates_.end(),
                    [site](const Candidate& c) { return c.site == site; })) {
        return false;
    }
    append_all(edge, relays);
    return true;
}

void EdgeRelays::gather(Index edge, std::vector<LineRelay>& relays) {
    scan(edge);
    append_all(edge, relays);
}

void EdgeRelays::append_all(Index edge, std::vector<LineRelay>& relays) const {
    relays.clear();
    const Index h = surface_.edge_half[edge];
    const double length = surface_.length[edge];
    for (const Candidate& c : candidates_) {
        const Relay& relay = propagation_.relays[c.relay];
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
        relays.push_back(point_on_line(length, labels_.vertex_distance[b], labels_.point_site[b]));
    }
}

LineRelay EdgeRelays::through_face(Index base, const Relay& relay) const {
    const Index edge = surface_.edge[base];
    const double length = surface_.length[edge];
    const bool is_here = surface_.edge_half[edge] == base;
    const Motion motion =
        relay.half_edge == base ? Motion{} : between_half_edges(surface_, relay.half_edge, base);
    const Motion turn{{-1, 0}, {length, 0}};
    return on_line(to_planar(relay, is_here ? motion : compose(turn, motion)), {0, 0}, {1, 0},
                   length);
}

}  // namespace agvd
