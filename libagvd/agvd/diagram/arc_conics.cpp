// In the middle of an arc the nearest paths from both sites give a conic. It goes on in both
// directions until one of its paths comes to the end of what its source sees, or until another path
// becomes the nearest; what is left of the arc is treated likewise. Where nothing ends a conic
// before it has turned far, what is left begins in its middle.
//
// The conics of (a, b) and (c, b) meet where their polar equations about b do, which is linear in
// the direction u: with c_i from b to the other focus, D_i the difference of weights and
// N_i = |c_i|^2 - D_i^2 it is u . (N_1 c_2 - N_2 c_1) = N_1 D_2 - N_2 D_1.
//
// A path that does not meet the conic within h of its point m is told by tangents: f and f' being
// distances, g and g' their gradients at m and rho the length of the last straight piece,
//   f' - f >= f'(m) - f(m) - |g' - g| h - h^2 / (2 rho)   within h of m.
#include "agvd/diagram/arc_conics.h"

#include <cmath>

namespace agvd {
namespace {

// Distances that differ by less are equal: a share of them and of the triangle's size.
constexpr double equal_distances_on_arcs = 2e-13;
// Parts that are shorter (share of the triangle's size) are left to their neighbours.
constexpr double shortest_part = 1e-12;
constexpr int most_parts = 1000;  // Of one arc.
// So near (share of the triangle's size) to the ends of an arc rounding may leave no conic.
constexpr double least_blur = 1e-9;
// A share of the triangle's size and the distance: ends of an arc lie so near to its conic.
constexpr double beside_conic = 1e-10;
// Parts do not turn by more (60 degrees) from their middle.
constexpr double least_cosine = 0.5;

bool turns_little(const Vec2& a, const Vec2& b) {
    const double both = a.dot(b);
    return both > 0 &&
           both * both >= least_cosine * least_cosine * a.squaredNorm() * b.squaredNorm();
}

}  // namespace

double ArcConics::slack(double distance) const {
    return equal_distances_on_arcs * (size_ + distance);
}

bool ArcConics::is_near(const Vec2& a, const Vec2& b, double distance) const {
    const double equal = slack(distance);
    return (a - b).squaredNorm() <= equal * equal;
}

// Windows side by side that show one image are one.
void ArcConics::join_windows(Relays relays) {
    windows_.clear();
    for (PlanarRelay relay : relays) {
        for (std::size_t i = 0; i < windows_.size() && !relay.sees_all; ++i) {
            const PlanarRelay& other = windows_[i];
            if (other.sees_all || !is_near(other.image, relay.image, relay.at_begin) ||
                std::abs(other.weight - relay.weight) > slack(relay.at_begin)) {
                continue;
            }
            if (is_near(other.end, relay.begin, relay.at_begin)) {
                relay.begin = other.begin;
                relay.at_begin = other.at_begin;
            } else if (is_near(other.begin, relay.end, relay.at_end)) {
                relay.end = other.end;
                relay.at_end = other.at_end;
            } else {
                continue;
            }
            windows_[i--] = windows_.back();
            windows_.pop_back();
        }
        windows_.push_back(relay);
    }
}

void ArcConics::collect_sources(std::size_t site, Relays relays) {
    std::vector<Source>& sources = sources_[site];
    sources.clear();
    const Vec2 none(0, 0);
    join_windows(relays);
    for (const PlanarRelay& relay : windows_) {
        if (relay.sees_all) {
            sources.push_back({relay.image, relay.weight, {none, none}, {false, false}, false});
            continue;
        }
        const Vec2 begin = relay.begin - relay.image, end = relay.end - relay.image;
        sources.push_back({relay.image, relay.weight, {begin, end}, {true, true}, false});
        sources.push_back({relay.begin, relay.at_begin, {none, begin}, {false, true}, true});
        sources.push_back({relay.end, relay.at_end, {end, none}, {true, false}, true});
    }
}

std::array<const ArcConics::Source*, 2> ArcConics::nearest(const Vec2& p) const {
    std::array<const Source*, 2> best{nullptr, nullptr};
    for (std::size_t k = 0; k < 2; ++k) {
        double least = infinity;
        for (const Source& source : sources_[k]) {
            if (!source.sees(p)) continue;
            // Of equally near ones a straight path.
            const double distance = source.distance(p);
            const double handicap = source.is_bent ? slack(distance) : 0;
            if (!(distance + handicap < least)) continue;
            least = distance + handicap;
            best[k] = &source;
        }
    }
    return best;
}

// The point of the bisector opposite the middle of a chord. The left site is nearer on its left.
std::optional<ArcConics::Middle> ArcConics::find_middle(const Chord& part) const {
    constexpr int most_steps = 60;
    const Vec2 along = part.to - part.from;
    const double length = along.norm();
    const Vec2 normal(-along.y() / length, along.x() / length);
    const Vec2 centre = (part.from + part.to) / 2;
    double low = -length, high = length, at = 0;
    for (int i = 0; i < most_steps; ++i) {
        Middle middle{centre + at * normal, {}};
        middle.sources = nearest(middle.point);
        if (middle.sources[0] == nullptr || middle.sources[1] == nullptr) return {};
        const Conic conic = middle.conic();
        const double gap = conic.gap(middle.point);
        if (std::abs(gap) <= slack(conic.distance(0, middle.point))) {
            middle.point = conic.moved_onto(middle.point);
            return middle;
        }
        (gap > 0 ? low : high) = at;
        const double newton = at - gap / conic.gradient(middle.point).dot(normal);
        at = newton > low && newton < high ? newton : (low + high) / 2;
    }
    return {};
}

// The ends of the part, where they lie on the conic.
ArcConics::Reached ArcConics::reach_ends(const Conic& conic, const Vec2& from,
                                         const Chord& part) const {
    // The gap grows to the right.
    const Vec2 right = conic.gradient(from);
    Reached reached{conic, from, right, {from, from}, {infinity, infinity}};
    for (const Vec2& end : {part.from, part.to}) {
        const double equal = std::max(blur_, beside_conic * (size_ + conic.distance(0, end)));
        if (std::abs(conic.gap(end)) <= equal) shorten(reached, end);
    }
    return reached;
}

void ArcConics::shorten(Reached& reached, const std::optional<Vec2>& at) {
    if (!at) return;
    const Vec2 step = *at - reached.from;
    const std::size_t side = cross(reached.right, step) > 0 ? 1 : 0;
    if (!(step.squaredNorm() < reached.length_sq[side])) return;
    if (!turns_little(reached.right, reached.conic.gradient(*at))) return;
    reached.ends[side] = *at;
    reached.length_sq[side] = step.squaredNorm();
}

// Where a path from the same site becomes the nearest.
void ArcConics::stop_at_source(const Source& source, std::size_t site, Reached& reached) const {
    const Conic& conic = reached.conic;
    const Vec2& m = reached.from;
    const double least = conic.distance(site, m);
    const double equal = slack(least);
    if (is_near(source.focus, conic.focus[site], least)) {
        // Paths over a corner are the shortest up to the ray on which straight ones pass it.
        for (std::size_t k = 0; k < 2 && source.is_bent; ++k) {
            if (source.has_ray[k]) shorten(reached, conic.on_ray(site, source.rays[k]));
        }
        return;
    }
    const double h =
        std::min(size_, std::sqrt(std::max(reached.length_sq[0], reached.length_sq[1])));
    const double excess = source.distance(m) - least;
    if (excess > 2 * h + equal) return;  // Excesses change by at most 2 a unit.
    const Vec2 turn = (m - source.focus).normalized() - (m - conic.focus[site]).normalized();
    const double bend = h * h / (2 * (m - conic.focus[site]).norm());
    if (excess - turn.norm() * h - bend > equal) return;
    const std::size_t pole = 1 - site;
    const Vec2 c1 = conic.focus[site] - conic.focus[pole];
    const Vec2 c2 = source.focus - conic.focus[pole];
    const double d1 = conic.weight[site] - conic.weight[pole];
    const double d2 = source.weight - conic.weight[pole];
    const double n1 = c1.squaredNorm() - d1 * d1, n2 = c2.squaredNorm() - d2 * d2;
    const Vec2 normal = n1 * c2 - n2 * c1;
    const double norm_sq = normal.squaredNorm(), height = n1 * d2 - n2 * d1;
    const double rest = norm_sq - height * height;
    if (!(rest >= 0 && norm_sq > 0)) return;
    const Vec2 across = std::sqrt(rest) * Vec2(-normal.y(), normal.x());
    for (const double sign : {-1.0, 1.0}) {
        const auto met = conic.on_ray(pole, (height * normal + sign * across) / norm_sq);
        if (!met) continue;
        const Vec2 at = conic.moved_onto(*met);
        if (source.sees(at)) shorten(reached, at);
    }
}

// \return whether the part, or a part beside it, has a conic now.
bool ArcConics::split_part(const Chord& part) {
    const double length = (part.to - part.from).norm();
    if (length <= shortest_part * size_) return false;
    if (--parts_left_ < 0) return false;
    const std::optional<Middle> middle = find_middle(part);
    if (!middle) {
        has_failed_ = has_failed_ || length > blur_;
        return false;
    }
    const Conic conic = middle->conic();
    const Vec2& m = middle->point;
    Reached reached = reach_ends(conic, m, part);
    for (std::size_t site = 0; site < 2; ++site) {
        const Source& here = *middle->sources[site];
        for (std::size_t k = 0; k < 2; ++k) {
            if (here.has_ray[k]) shorten(reached, conic.on_ray(site, here.rays[k]));
        }
        for (const Source& source : sources_[site]) {
            if (&source != &here) stop_at_source(source, site, reached);
        }
    }
    const auto& [begin, end] = reached.ends;
    if (begin == end && length <= blur_) return false;
    if (begin != part.from) static_cast<void>(split_part({part.from, begin}));
    if (begin != end) add({end, conic});
    // Too short a part is its neighbour's.
    if (end != part.to && !split_part({end, part.to}) && !parts_.empty()) {
        parts_.back().end = part.to;
    }
    return true;
}

void ArcConics::add(const Part& part) {
    if (!parts_.empty()) {
        Part& last = parts_.back();
        const double equal = slack(part.conic.distance(0, part.end));
        const auto is_equal = [&](std::size_t k) {
            return (last.conic.focus[k] - part.conic.focus[k]).norm() <= equal &&
                   std::abs(last.conic.weight[k] - part.conic.weight[k]) <= equal;
        };
        if (is_equal(0) && is_equal(1)) {
            last.end = part.end;
            return;
        }
    }
    parts_.push_back(part);
}

std::span<const ArcConics::Part> ArcConics::split(const std::array<Relays, 2>& relays,
                                                  const Chord& ends, double size) {
    size_ = size;
    parts_left_ = most_parts;
    parts_.clear();
    has_failed_ = false;
    for (std::size_t k = 0; k < 2; ++k) collect_sources(k, relays[k]);
    blur_ = least_blur * size_;
    for (const Vec2& end : {ends.from, ends.to}) {
        const auto [left, right] = nearest(end);
        if (left == nullptr || right == nullptr) return {};
        blur_ = std::max(blur_, 4 * std::abs(left->distance(end) - right->distance(end)));
    }
    static_cast<void>(split_part(ends));
    if (has_failed_ || parts_.empty() || parts_left_ < 0) return {};
    parts_.back().end = ends.to;
    return parts_;
}

}  // namespace agvd
