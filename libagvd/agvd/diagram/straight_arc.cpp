#include "agvd/diagram/straight_arc.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace agvd {
namespace {

// Distance of p through a relay, all in the frame of its half-edge; as reach() in any frame.
Reach reach_in_frame(const Relay& r, const Vec2& p) {
    const auto root = [](double x, double y) { return std::sqrt(x * x + y * y); };
    const double dx = p.x() - r.x;
    const double dy = p.y() - r.y;
    if (r.y < 0) {
        const double side = r.y * dx;
        const double left = (r.begin - r.x) * dy + side;
        const double right = (r.end - r.x) * dy + side;
        if (left > 0 || right < 0) {
            const double bend = left > 0 ? r.begin : r.end;
            const double rest = root(p.x() - bend, p.y());
            return {r.weight + root(bend - r.x, r.y) + rest, {bend, 0}, rest};
        }
    }
    const double length = root(dx, dy);
    return {r.weight + length, {r.x, r.y}, length};
}

// One of two sites, as the relays know it.
struct Known {
    Index site;
    bool agrees_at_from = false;
    bool agrees_at_to = false;
    Reach at_middle{std::numeric_limits<double>::infinity(), {0, 0}, 0};
    std::size_t frame = 0;  // Of at_middle.
};

}  // namespace

bool is_nearly_straight(const Vec2& chord, const Vec2& middle, const Reach& a, const Reach& b,
                        double tolerance) {
    const double least = std::min(a.last_piece, b.last_piece);
    if (!(least > 0) || !std::isfinite(a.distance + b.distance)) return false;
    // Everything times the chord's length.
    const Vec2 turn = (middle - a.from) / a.last_piece - (middle - b.from) / b.last_piece;
    const double slope = std::abs(cross(chord, turn));
    const double gap = std::abs(a.distance - b.distance);
    const double squared_length = chord.squaredNorm();
    // The slope changes by at most 2 / (least - stray) a unit.
    return 2 * gap <= tolerance * slope && 8 * gap * squared_length <= least * slope * slope;
}

bool joins_straight(std::span<const Relay> relays, const std::array<Vec2, 3>& corners,
                    const Breakpoint& from, const Breakpoint& to, const ChordTest& test) {
    const Vec2 middle = (from.position + to.position) / 2;
    struct Frame {
        Vec2 along;
        Vec2 from, to, middle;
    };
    std::array<Frame, 3> frames;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2& tail = corners[k];
        const Vec2 edge = corners[k == 2 ? 0 : k + 1] - tail;
        const Vec2 along = edge / edge.norm();
        const auto moved = [&](const Vec2& p) {
            const Vec2 d = p - tail;
            return Vec2(along.dot(d), cross(along, d));
        };
        frames[k] = {along, moved(from.position), moved(to.position), moved(middle)};
    }
    Known known[] = {{from.site_after}, {to.site_after}};
    for (const Relay& relay : relays) {
        Known* const site = relay.site.value() == from.site_after ? &known[0]
                            : relay.site.value() == to.site_after ? &known[1]
                                                                  : nullptr;
        if (site == nullptr) continue;
        const std::size_t k = relay.half_edge % 3;
        const Frame& frame = frames[k];
        site->agrees_at_from = site->agrees_at_from || reach_in_frame(relay, frame.from).distance <=
                                                           from.distance + test.slack;
        site->agrees_at_to = site->agrees_at_to ||
                             reach_in_frame(relay, frame.to).distance <= to.distance + test.slack;
        const Reach at_middle = reach_in_frame(relay, frame.middle);
        if (at_middle.distance < site->at_middle.distance) {
            site->at_middle = at_middle;
            site->frame = k;
        }
    }
    for (Known& site : known) {
        if (!site.agrees_at_from || !site.agrees_at_to) return false;
        const Vec2& along = frames[site.frame].along;
        const Vec2 image = site.at_middle.from;
        site.at_middle.from =
            corners[site.frame] + image.x() * along + image.y() * Vec2(-along.y(), along.x());
    }
    return is_nearly_straight(to.position - from.position, middle, known[0].at_middle,
                              known[1].at_middle, test.tolerance);
}

}  // namespace agvd
