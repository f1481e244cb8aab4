// An arc is followed from its tail. The nearest paths from both sites give a conic, which goes on
// until one of the paths comes to the end of what its source sees, or until another path becomes
// the nearest.
//
// The conics of (a, b) and (c, b) meet where their polar equations about b do, which is linear in
// the direction u: with c_i from b to the other focus, D_i the difference of weights and
// N_i = |c_i|^2 - D_i^2 it is u . (N_1 c_2 - N_2 c_1) = N_1 D_2 - N_2 D_1.
//
// A path that does not meet the conic between p and q is told by what its source sees, or by
// tangents: f and f' being distances, g and g' their gradients at p and rho the length of the last
// straight piece of f,
//   f'(x) - f(x) >= f'(p) - f(p) + (g' - g) . (x - p) - |x - p|^2 / (2 rho),
// and the conic lies in the triangle of its chord and its tangents.
#include "agvd/diagram/arc_conics.h"

#include <algorithm>
#include <cmath>

namespace agvd {
namespace {

// Distances that differ by less are equal: a share of them and of the triangle's size.
constexpr double equal_distances_on_arcs = 2e-13;
// Parts that are shorter (share of the triangle's size) are left to their neighbours.
constexpr double shortest_part = 1e-12;
constexpr int most_steps = 1000;  // Along one arc.
// So near (share of the triangle's size) to the ends of an arc rounding may leave no conic.
constexpr double least_blur = 1e-9;
// A share of the triangle's size and the distance: ends of an arc lie so near to its conic.
constexpr double beside_conic = 1e-10;
// Squared sine of half the angle between two points where conics meet: below it they touch.
constexpr double touching = 1e-15;

// Away from what lies right of a ray, and away from what lies left of it.
Vec2 left_of(const Vec2& ray) { return {-ray.y(), ray.x()}; }
Vec2 right_of(const Vec2& ray) { return {ray.y(), -ray.x()}; }

// Distances with errors: one focus is farther off than the other everywhere.
bool has_no_points(const Conic& conic) {
    constexpr double rounding = 1e-13;
    const double difference = std::abs(conic.weight[0] - conic.weight[1]);
    return difference * (1 - rounding) > (conic.focus[0] - conic.focus[1]).norm();
}

}  // namespace

Vec2 ArcConics::Source::ray(std::size_t side) const {
    return side == 0 ? right_of(normals[0]) : left_of(normals[1]);
}

// Seen from the focus that it does not bend around the conic turns by less than half a circle.
bool ArcConics::Piece::is_before(const Vec2& p, const Vec2& q) const {
    const std::size_t eye = conic.weight[0] < conic.weight[1] ? 0 : 1;
    const double turn = cross(p - conic.focus[eye], q - conic.focus[eye]);
    return eye == 0 ? turn > 0 : turn < 0;
}

bool ArcConics::is_on(const Conic& conic, const Vec2& p) const {
    return std::abs(conic.gap(p)) <= std::max(blur_, beside_conic * (size_ + conic.distance(0, p)));
}

bool ArcConics::is_near(const Vec2& a, const Vec2& b) const {
    return (a - b).squaredNorm() <= tolerance() * tolerance();
}

// Sources there say no more than the end itself.
bool ArcConics::is_end(const Vec2& p) const {
    return is_near(p, ends_.from) || is_near(p, ends_.to);
}

// Relays give the first ones, in their order. Where intervals end, paths bend.
void ArcConics::collect_sources(std::size_t site, Relays relays) {
    std::vector<Source>& sources = sources_[site];
    sources.clear();
    relays_.clear();
    const Vec2 none(0, 0);
    for (const PlanarRelay& relay : relays) {
        if (relay.sees_all) {
            if (is_end(relay.image)) continue;
            sources.push_back({relay.image, relay.weight, {none, none}, false});
        } else {
            if (is_near(relay.begin, relay.end)) continue;  // Its neighbours say as much.
            sources.push_back({relay.image,
                               relay.weight,
                               {left_of((relay.begin - relay.image).normalized()),
                                right_of((relay.end - relay.image).normalized())},
                               false});
        }
        relays_.push_back({&relay, relay.sees_all});
    }
    for (std::size_t i = 0; i < relays_.size(); ++i) {
        if (relays_[i].relay->sees_all) continue;
        if (const auto next = window_beside(i)) {
            relays_[*next].is_joined = true;
            join(site, i, *next);
        } else {
            bend(site, i, 1);
        }
    }
    for (std::size_t i = 0; i < relays_.size(); ++i) {
        if (!relays_[i].is_joined) bend(site, i, 0);
    }
}

// The window whose interval begins where that of `window` ends; mostly the next one.
std::optional<std::size_t> ArcConics::window_beside(std::size_t window) const {
    const Vec2& end = relays_[window].relay->end;
    for (std::size_t step = 1; step < relays_.size(); ++step) {
        const std::size_t i =
            window + step < relays_.size() ? window + step : window + step - relays_.size();
        if (!relays_[i].is_joined && is_near(relays_[i].relay->begin, end)) return i;
    }
    return {};
}

// Paths that bend where two windows touch matter if one is shorter there, or between the windows if
// neither sees what lies there.
void ArcConics::join(std::size_t site, std::size_t left, std::size_t right) {
    std::vector<Source>& sources = sources_[site];
    const PlanarRelay &a = *relays_[left].relay, &b = *relays_[right].relay;
    const Vec2 beyond_a = -sources[left].normals[1], beyond_b = -sources[right].normals[0];
    const Vec2 none(0, 0);
    if (std::abs(a.at_end - b.at_begin) > equal_) {
        if (a.at_end < b.at_begin) {
            sources.push_back({a.end, a.at_end, {beyond_a, none}, true});
        } else {
            sources.push_back({b.begin, b.at_begin, {none, beyond_b}, true});
        }
    } else if (cross(beyond_a, beyond_b) * size_ > equal_) {
        sources.push_back({a.end, std::min(a.at_end, b.at_begin), {beyond_a, beyond_b}, true});
    }
}

// Paths that bend at an end of an interval, unless they come from a corner of the face.
void ArcConics::bend(std::size_t site, std::size_t window, std::size_t side) {
    const PlanarRelay& relay = *relays_[window].relay;
    const Vec2& at = side == 0 ? relay.begin : relay.end;
    const double distance = side == 0 ? relay.at_begin : relay.at_end;
    if (is_end(at)) return;
    for (const Entry& entry : relays_) {
        const PlanarRelay& other = *entry.relay;
        if (other.sees_all && is_near(other.image, at) && other.weight <= distance + equal_) return;
    }
    std::array<Vec2, 2> normals{Vec2(0, 0), Vec2(0, 0)};
    normals[1 - side] = -sources_[site][window].normals[side];
    sources_[site].push_back({at, distance, normals, true});
}

// Whether a source sees a point, and the arc behind it.
bool ArcConics::goes_on(const Source& source, std::size_t site, const Vec2& p) const {
    return source.outside(1 - site, p) <= tolerance() &&
           (!source.has_ray(site) || source.outside(site, p) < -tolerance());
}

// The nearest source; null if none sees the point.
const ArcConics::Source* ArcConics::nearest(std::size_t site, const Vec2& p, bool behind) const {
    const Source* best = nullptr;
    double least = infinity;
    for (const Source& source : sources_[site]) {
        if (behind ? !goes_on(source, site, p)
                   : source.outside(0, p) > tolerance() || source.outside(1, p) > tolerance()) {
            continue;
        }
        // Of equally near ones a straight path.
        const double distance = source.distance(p) + (source.is_bent ? equal_ : 0);
        if (!(distance < least)) continue;
        least = distance;
        best = &source;
    }
    return best;
}

// Up to the arc's end if that lies on the conic, or to where one of the paths comes to the end of
// what its source sees.
ArcConics::Piece ArcConics::begin_piece(const Sources& sources, const Vec2& from,
                                        const Vec2& end) const {
    const auto& [a, b] = sources;
    Piece piece{sources, {{a->focus, b->focus}, {a->weight, b->weight}}, from, {}, {}, {}, {}, {}};
    for (std::size_t k = 0; k < 2; ++k) {
        const Vec2 path = from - piece.conic.focus[k];
        piece.lengths[k] = path.norm();
        piece.directions[k] = piece.lengths[k] > 0 ? Vec2(path / piece.lengths[k]) : Vec2(0, 0);
    }
    if (is_on(piece.conic, end)) piece.to = end;
    for (std::size_t k = 0; k < 2; ++k) {
        const Source& source = *sources[k];
        if (!source.has_ray(k)) continue;
        if (piece.to && source.outside(k, *piece.to) <= equal_) continue;
        piece.stop(piece.conic.on_ray(k, source.ray(k)), {});
    }
    if (!piece.to) return piece;
    const Vec2 first = piece.directions[0] - piece.directions[1];
    const Vec2 last = piece.conic.gradient(*piece.to);
    if (!(first.dot(last) > 0)) return piece;
    const Vec2 chord = *piece.to - from;
    const Vec2 to_apex = chord.dot(last) / cross(first, last) * left_of(first);
    const bool is_apex = chord.dot(to_apex) > 0 && to_apex.squaredNorm() <= chord.squaredNorm();
    piece.apex = is_apex ? Vec2(from + to_apex) : *piece.to;
    return piece;
}

void ArcConics::Piece::stop(const std::optional<Vec2>& at, const Event& event) {
    if (!at || !is_before(from, *at) || (to && !is_before(*at, *to))) return;
    to = *at;
    next = event;
}

// Where another path from the same site becomes the nearest.
void ArcConics::stop_at_source(const Source& source, std::size_t site, Piece& piece) const {
    const Conic& conic = piece.conic;
    const Vec2 path = piece.from - source.focus;
    const double length = path.norm();
    const double excess = source.weight - conic.weight[site] + (length - piece.lengths[site]);
    if (piece.apex) {
        const Vec2 turn = path / length - piece.directions[site];
        const auto rise = [&](const Vec2& to) {
            const Vec2 way = to - piece.from;
            return turn.dot(way) - way.squaredNorm() / (2 * piece.lengths[site]);
        };
        if (excess + std::min({0.0, rise(*piece.to), rise(*piece.apex)}) >= -equal_) return;
    }
    const std::size_t pole = 1 - site;
    // How fast it becomes nearer behind a point of the conic where both are as near; in units of
    // what rounding makes of that.
    const auto gain = [&](const Vec2& p) {
        const Vec2 from_here = p - conic.focus[site], from_there = p - source.focus;
        const Vec2 other = (p - conic.focus[pole]).normalized();
        const double near = from_here.norm(), far = from_there.norm();
        const Vec2 right = from_here / near - other, then = from_there / far - other;
        const double turn = cross(right, then) * std::min(near, far) / (2 * tolerance());
        return site == 0 ? -turn : turn;
    };
    const Event event{&source, site};
    const bool has_same_focus = is_near(source.focus, conic.focus[site]);
    // On a ray from the source so far both are as near, and touch; behind it this one is nearer.
    const bool begins_there = !source.is_bent && !has_same_focus && source.has_ray(pole) &&
                              std::abs(source.outside(pole, conic.focus[site])) <= tolerance();
    if (goes_on(source, site, piece.from)) {
        const bool begins_here = begins_there && source.outside(pole, piece.from) >= -tolerance();
        if (excess <= equal_ && gain(piece.from) > (begins_here ? -1 : 1)) {
            piece.to = piece.from;
            piece.next = event;
            return;
        }
    } else if (begins_there && source.outside(pole, piece.from) > 0) {
        const auto at = conic.on_ray(site, source.ray(pole));
        if (at && source.distance(*at) <= conic.distance(site, *at) + equal_) piece.stop(at, event);
    }
    if (has_same_focus) return;
    const Vec2 c1 = conic.focus[site] - conic.focus[pole];
    const Vec2 c2 = source.focus - conic.focus[pole];
    const double d1 = conic.weight[site] - conic.weight[pole];
    const double d2 = source.weight - conic.weight[pole];
    const double n1 = c1.squaredNorm() - d1 * d1, n2 = c2.squaredNorm() - d2 * d2;
    const Vec2 normal = n1 * c2 - n2 * c1;
    const double norm_sq = normal.squaredNorm(), height = n1 * d2 - n2 * d1;
    const double rest = norm_sq - height * height;
    if (!(rest > touching * norm_sq)) return;
    const Vec2 across = std::sqrt(rest) * left_of(normal);
    for (const double sign : {-1.0, 1.0}) {
        const auto met = conic.on_ray(pole, (height * normal + sign * across) / norm_sq);
        if (!met || (piece.to && !piece.is_before(*met, *piece.to))) continue;
        const Vec2 at = conic.moved_onto(*met);
        if (goes_on(source, site, at) && gain(at) > 1) piece.stop(at, event);
    }
}

bool ArcConics::begin(const std::array<Relays, 2>& relays, const Chord& ends,
                      const std::array<double, 2>& distances, double size) {
    size_ = size;
    ends_ = ends;
    equal_ = equal_distances_on_arcs * (size + distances[0]);
    for (std::size_t k = 0; k < 2; ++k) collect_sources(k, relays[k]);
    blur_ = least_blur * size_;
    for (std::size_t i = 0; i < 2; ++i) {
        const Vec2& end = i == 0 ? ends.from : ends.to;
        const double most = distances[i] + largest_disagreement * size_;
        std::array<double, 2> least{infinity, infinity};
        for (std::size_t k = 0; k < 2; ++k) {
            const Source* source = nearest(k, end, false);
            if (source != nullptr) least[k] = source->distance(end);
            if (i == 0) first_[k] = source;
            if (!(least[k] <= most)) return false;
        }
        blur_ = std::max(blur_, 4 * std::abs(least[0] - least[1]));
    }
    return true;
}

std::span<const ArcConics::Part> ArcConics::follow() {
    parts_.clear();
    if (!find_parts() || parts_.empty()) return {};
    parts_.back().end = ends_.to;
    return parts_;
}

// False: distances contradict each other.
bool ArcConics::find_parts() {
    Sources sources = first_;
    for (std::size_t k = 0; k < 2; ++k) {
        if (goes_on(*sources[k], k, ends_.from)) continue;
        if (const Source* next = nearest(k, ends_.from, true)) sources[k] = next;
    }
    Vec2 from = ends_.from;
    for (int step = 0; step < most_steps; ++step) {
        if (sources[0] == nullptr || sources[1] == nullptr) return false;
        Piece piece = begin_piece(sources, from, ends_.to);
        for (std::size_t k = 0; k < 2; ++k) {
            for (const Source& source : sources_[k]) {
                if (&source == sources[k] || is_out_of_sight(source, piece)) continue;
                stop_at_source(source, k, piece);
            }
        }
        if (!piece.to || has_no_points(piece.conic)) return false;
        // Too short a part is its neighbour's.
        const double shortest = shortest_part * size_;
        if ((*piece.to - from).squaredNorm() > shortest * shortest) add({*piece.to, piece.conic});
        from = *piece.to;
        if (from == ends_.to) return true;
        if (piece.next.source != nullptr) {
            sources[piece.next.site] = piece.next.source;
            continue;
        }
        for (std::size_t k = 0; k < 2; ++k) {
            if (sources[k]->has_ray(k) && sources[k]->outside(k, from) >= -equal_) {
                sources[k] = nearest(k, from, true);
            }
        }
    }
    return false;
}

void ArcConics::add(const Part& part) {
    if (!parts_.empty()) {
        Part& last = parts_.back();
        const auto is_equal = [&](std::size_t k) {
            return is_near(last.conic.focus[k], part.conic.focus[k]) &&
                   std::abs(last.conic.weight[k] - part.conic.weight[k]) <= equal_;
        };
        if (is_equal(0) && is_equal(1)) {
            last.end = part.end;
            return;
        }
    }
    parts_.push_back(part);
}

}  // namespace agvd
