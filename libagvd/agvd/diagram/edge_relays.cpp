#include "agvd/diagram/edge_relays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "agvd/core/parallel.h"

namespace agvd {
namespace {

constexpr Index grain = 1024;
// A relay stands for the end of an edge itself if it is no worse there by more than this share of
// the edge.
constexpr double same_distance = 1e-4;
constexpr double infinity = std::numeric_limits<double>::infinity();

// Tail, head and apex of the relay's half-edge, straight or bent at an end of its interval.
std::array<double, 3> distances_of_corners(const Relay& r, double length, const Vec2& apex) {
    const auto root = [](double x, double y) { return std::sqrt(x * x + y * y); };
    const double cx = apex.x();
    const double cy = apex.y();
    if (r.y >= 0) {
        return {r.weight + root(r.x, r.y), r.weight + root(length - r.x, r.y),
                r.weight + root(cx - r.x, cy - r.y)};
    }
    const double to_begin = r.weight + root(r.begin - r.x, r.y);
    const double to_end = r.weight + root(r.end - r.x, r.y);
    // The chord to the apex meets the edge at x + (cx - x) (-y) / (cy - y).
    const double height = cy - r.y;
    const double hit = (cx - r.x) * -r.y;
    double at_apex;
    if (hit < (r.begin - r.x) * height) {
        at_apex = to_begin + root(cx - r.begin, cy);
    } else if (hit > (r.end - r.x) * height) {
        at_apex = to_end + root(cx - r.end, cy);
    } else {
        at_apex = r.weight + root(cx - r.x, height);
    }
    return {to_begin + r.begin, to_end + (length - r.end), at_apex};
}

// From the frame of another half-edge of the same face into that of `h`.
Motion between_half_edges(const Surface& surface, Index from, Index h) {
    const Vec2& apex = surface.apex[h];
    const Vec2 head(surface.length_of(h), 0);
    const double length = surface.length_of(from);
    if (from == Surface::next(h)) return {(apex - head) / length, head};
    return {-apex / length, apex};
}

}  // namespace

CornerDistances find_corner_distances(const Surface& surface, const Propagation& propagation,
                                      int num_threads) {
    CornerDistances result(propagation.relays.size());
    parallel_chunks(static_cast<Index>(result.size()), grain, num_threads,
                    [&](Index, Index begin, Index end) {
                        for (Index i = begin; i < end; ++i) {
                            const Relay& relay = propagation.relays[i];
                            const Index h = relay.half_edge;
                            const auto found = distances_of_corners(relay, surface.length_of(h),
                                                                    surface.apex[h]);
                            for (Index k = 0; k < 3; ++k) result[i][(h + k) % 3] = found[k];
                        }
                    });
    return result;
}

void EdgeRelays::scan_side(Index half_edge, std::size_t tail, std::size_t head) {
    const Index mixed = labels_.mixed_index[Surface::face(half_edge)];
    for (Index r = propagation_.relay_offsets[mixed]; r < propagation_.relay_offsets[mixed + 1];
         ++r) {
        const auto& at = corner_distances_[r];
        candidates_.push_back({at[tail], at[head], r, propagation_.relays[r].site.value()});
    }
}

// Leaves the candidates that could win somewhere.
void EdgeRelays::scan(Index edge) {
    const Index h = surface_.edge_half[edge];
    const Index twin = surface_.twin[h];
    const double length = surface_.length[edge];
    candidates_.clear();
    scan_side(h, h % 3, (h + 1) % 3);
    if (twin != no_index) scan_side(twin, (twin + 1) % 3, twin % 3);

    const double at_tail = labels_.vertex_distance[surface_.tail(h)];
    const double at_head = labels_.vertex_distance[surface_.head(h)];
    Candidate first{infinity, infinity, 0, no_index};
    Candidate last = first;
    for (const Candidate& c : candidates_) {
        if (c.lo < first.lo) first = c;
        if (c.hi < last.hi) last = c;
    }
    const double slack = tie_tolerance * (at_tail + at_head + length);
    const double enough = same_distance * length;
    needs_tail_ = first.site != labels_.point_site[surface_.tail(h)] || first.lo > at_tail + enough;
    needs_head_ = last.site != labels_.point_site[surface_.head(h)] || last.hi > at_head + enough;
    if (candidates_.empty()) {
        first = {at_tail, at_tail + length, 0, 0};
        last = {at_head + length, at_head, 0, 0};
    }

    // c is at least max(lo - x, hi - (length - x)), with its least value where these meet; the
    // others lie below their chords.
    const double rise_first = (first.hi - first.lo) / length;
    const double rise_last = (last.hi - last.lo) / length;
    const auto loses = [&](const Candidate& c) {
        const double least = (c.lo + c.hi - length) / 2;
        const double where = (c.lo - c.hi + length) / 2;
        return least - slack > first.lo + rise_first * where ||
               least - slack > last.lo + rise_last * where;
    };
    std::erase_if(candidates_, loses);
}

bool EdgeRelays::may_change(Index edge, std::vector<PlanarRelay>& relays) {
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

void EdgeRelays::gather(Index edge, std::vector<PlanarRelay>& relays) {
    scan(edge);
    append_all(edge, relays);
}

void EdgeRelays::append_all(Index edge, std::vector<PlanarRelay>& relays) const {
    relays.clear();
    const Index h = surface_.edge_half[edge];
    const double length = surface_.length[edge];
    const Motion turn{{-1, 0}, {length, 0}};
    Index half_edge = no_index;
    Motion motion;
    for (const Candidate& c : candidates_) {
        const Relay& relay = propagation_.relays[c.relay];
        if (relay.half_edge != half_edge) {
            half_edge = relay.half_edge;
            const bool is_here = Surface::face(half_edge) == Surface::face(h);
            const Index base = is_here ? h : surface_.twin[h];
            motion = half_edge == base ? Motion{} : between_half_edges(surface_, half_edge, base);
            if (!is_here) motion = compose(turn, motion);
        }
        relays.push_back(to_planar(relay, motion));
    }
    const Index a = surface_.tail(h);
    const Index b = surface_.head(h);
    if (needs_tail_) {
        relays.push_back(point_relay({0, 0}, labels_.vertex_distance[a], labels_.point_site[a]));
    }
    if (needs_head_) {
        relays.push_back(
            point_relay({length, 0}, labels_.vertex_distance[b], labels_.point_site[b]));
    }
}

}  // namespace agvd
