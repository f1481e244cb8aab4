#include "agvd/diagram/line_relay.h"

#include <algorithm>

namespace agvd {
namespace {}  // namespace

LineRelay on_line(const PlanarRelay& relay, const Vec2& start, const Vec2& along, double length) {
    LineRelay line{};
    line.first = -infinity;
    line.last = infinity;
    line.site = relay.site;
    const auto set = [&](std::size_t source, const Vec2& p, double weight) {
        const Vec2 d = p - start;
        line.x[source] = d.dot(along);
        line.y[source] = cross(along, d);
        line.weight[source] = weight;
    };
    set(1, relay.image, relay.weight);
    if (relay.sees_all) return line;
    // Out of sight beyond `begin` where behind(x) = at_start + rise * x > 0, and beyond `end` where
    // the same with the sign turned. Only one of them can apply on one side of the segment.
    const auto hide = [&](const Vec2& end, double weight, double sign) {
        const Vec2 ray = end - relay.image;
        const double at_start = sign * cross(ray, start - relay.image);
        const double rise = sign * cross(ray, along);
        if (rise < 0 ? at_start > 0 : rise == 0 && at_start > 0) {
            line.first = rise < 0 ? -at_start / rise : infinity;
            set(0, end, weight);
        } else if (rise > 0 && at_start + rise * length > 0) {
            line.last = -at_start / rise;
            set(2, end, weight);
        }
    };
    hide(relay.begin, relay.at_begin, 1);
    hide(relay.end, relay.at_end, -1);
    return line;
}

double distance_on_line(std::span<const LineRelay> relays, Index site, double x) {
    double least = infinity;
    for (const LineRelay& relay : relays) {
        if (relay.site == site) least = std::min(least, sample(relay, x).value);
    }
    return least;
}

void append_pieces(std::span<const LineRelay> relays, Index site, double begin, double end,
                   std::vector<StraightPiece>& out) {
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    const auto append = [&](const LineRelay& relay, std::size_t source, double lo, double hi) {
        if (!(hi > lo)) return;
        const Vec2 from(relay.x[source], relay.y[source]);
        // Paths that bend at one point are one.
        const auto same = std::find_if(out.begin() + first, out.end(), [&](const auto& piece) {
            return piece.from == from && piece.weight == relay.weight[source];
        });
        if (same == out.end()) {
            out.push_back({from, relay.weight[source], lo, hi, site});
        } else {
            same->begin = std::min(same->begin, lo);
            same->end = std::max(same->end, hi);
        }
    };
    for (const LineRelay& relay : relays) {
        if (relay.site != site) continue;
        const double straight = std::clamp(relay.first, begin, end);
        const double bent = std::clamp(relay.last, straight, end);
        append(relay, 0, begin, straight);
        append(relay, 1, straight, bent);
        append(relay, 2, bent, end);
    }
}

}  // namespace agvd
