#include "agvd/diagram/apollonius.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "agvd/diagram/straight_arc.h"

namespace agvd {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int max_newton_steps = 25;
// Equalities are met to this share of the triangle's size: below it lies rounding.
constexpr double convergence = 1e-11;
// A Voronoi vertex this far outside (share of the size) still counts as inside.
constexpr double inside_tolerance = 1e-9;
// A step that the distances contradict by more (share of the size) is drawn straight, so that arcs
// do not cross.
constexpr double largest_violation = 1e-3;
// The violation (share of the size) where there is no Voronoi vertex at all.
constexpr double no_voronoi_vertex = 2;
// A search that strays this far (share of the size) from its start does not come back.
constexpr double lost = 2;
// Relays chosen at one point of a bisector stand for their sites this far along (share of the
// chord).
constexpr double near_enough = 0.02;
constexpr int max_arc_depth = 4;  // At most 2^4 pieces an arc and face.

// Interval i lies between breakpoint i and breakpoint i + 1. At a breakpoint, looking inwards, the
// interval before lies on the left.
std::size_t after(std::size_t i, std::size_t n) { return i + 1 == n ? 0 : i + 1; }
std::size_t before(std::size_t i, std::size_t n) { return i == 0 ? n - 1 : i - 1; }

Vec2 direction(const Vec2& p, const Reach& r) {
    return r.last_piece > 0 ? Vec2((p - r.from) / r.last_piece) : Vec2(0, 0);
}

const PlanarRelay* nearest_relay(std::span<const PlanarRelay> relays, const Vec2& p) {
    const PlanarRelay* best = nullptr;
    double least = infinity;
    for (const PlanarRelay& relay : relays) {
        const double distance = reach(relay, p).distance;
        if (distance < least) {
            least = distance;
            best = &relay;
        }
    }
    return best;
}

// Whether the ends of each segment lie on different sides of the other.
bool do_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const Vec2 ab = b - a;
    const double at_c = cross(ab, c - a);
    const double at_d = cross(ab, d - a);
    if (!((at_c < 0 && at_d > 0) || (at_c > 0 && at_d < 0))) return false;
    const Vec2 cd = d - c;
    const double at_a = cross(cd, a - c);
    const double at_b = cross(cd, b - c);
    return (at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0);
}

}  // namespace

double longest_side(const std::array<Vec2, 3>& corners) {
    return std::sqrt(
        std::max({(corners[1] - corners[0]).squaredNorm(), (corners[2] - corners[1]).squaredNorm(),
                  (corners[0] - corners[2]).squaredNorm()}));
}

void TriangleSolver::set_relays(Relays relays, std::span<const Index> sites) {
    groups_.clear();
    for (const Index site : sites) groups_.push_back({site, of_site(relays, site)});
}

void TriangleSolver::begin(Index face, const std::array<Vec2, 3>& corners) {
    face_ = face;
    corners_ = corners;
    start_ = mark();
    is_safe_ = false;
    size_ = longest_side(corners);
}

TriangleSolver::Mark TriangleSolver::mark() const {
    return {out_.points.size(), out_.arcs.size(), out_.voronoi_vertices.size(),
            out_.connections.size()};
}

void TriangleSolver::go_back(const Mark& mark) {
    out_.points.resize(mark.points);
    out_.point_distance.resize(mark.points);
    out_.arcs.resize(mark.arcs);
    out_.voronoi_vertices.resize(mark.voronoi_vertices);
    out_.connections.resize(mark.connections);
}

bool TriangleSolver::try_solve(Index face, const std::array<Vec2, 3>& corners,
                               std::span<const Breakpoint> breakpoints) {
    begin(face, corners);
    for (std::size_t i = 0; i < breakpoints.size(); ++i) {
        if (!agrees(breakpoints[i], breakpoints[before(i, breakpoints.size())].site_after))
            return false;
    }
    draw(breakpoints);
    if (is_sound_ && !straighten_crossing_arcs(start_)) return true;
    go_back(start_);
    return false;
}

void TriangleSolver::solve(Index face, const std::array<Vec2, 3>& corners,
                           std::span<const Breakpoint> breakpoints) {
    begin(face, corners);
    draw(breakpoints);
    if (!straighten_crossing_arcs(start_) || !straighten_crossing_arcs(start_)) return;
    redraw_straight(breakpoints);
}

void TriangleSolver::redraw_straight(std::span<const Breakpoint> breakpoints) {
    go_back(start_);
    is_safe_ = true;
    draw(breakpoints);
}

void TriangleSolver::draw(std::span<const Breakpoint> breakpoints) {
    breakpoints_.assign(breakpoints.begin(), breakpoints.end());
    ends_.clear();
    open_vertices_.clear();
    is_sound_ = true;
    if (breakpoints_.size() > 3) close_ears();
    if (breakpoints_.size() == 3) {
        close_with_vertex(
            0, find_voronoi_vertex(breakpoints_[2], breakpoints_[0], breakpoints_[1], true));
    } else {
        assert(breakpoints_.size() == 2);
        add_arc(breakpoints_[0], breakpoints_[1].position, breakpoints_[1].node,
                breakpoints_[1].site_after, true);
    }
}

// Whether both sites are as near as the edge says.
bool TriangleSolver::agrees(const Breakpoint& at, Index site_before) const {
    const double limit = at.distance + largest_disagreement * size_;
    const auto reaches = [&](const PlanarRelay& relay) {
        return reach(relay, at.position).distance <= limit;
    };
    const Relays a = relays_of_site(site_before);
    const Relays b = relays_of_site(at.site_after);
    return std::any_of(a.begin(), a.end(), reaches) && std::any_of(b.begin(), b.end(), reaches);
}

bool TriangleSolver::is_accepted(double violation) const {
    return !is_safe_ && violation <= largest_violation * size_;
}

TriangleSolver::Ear TriangleSolver::judge_ear(std::size_t i, bool is_thorough) const {
    const Breakpoint& previous = breakpoints_[before(i, breakpoints_.size())];
    const Breakpoint& next = breakpoints_[after(i, breakpoints_.size())];
    Ear ear{};
    ear.state = is_thorough ? Ear::Settled : Ear::Judged;
    ear.is_lens = previous.site_after == next.site_after;
    if (ear.is_lens) {
        judge_lens(breakpoints_[i], next, ear);
        return ear;
    }
    ear.voronoi_vertex = find_voronoi_vertex(previous, breakpoints_[i], next, is_thorough);
    const Vec2& p = ear.voronoi_vertex.position;
    ear.violation = ear.voronoi_vertex.violation;
    if (ear.violation >= no_voronoi_vertex * size_) return ear;
    ear.violation = std::max({ear.violation, arc_undercut(previous.site_after, breakpoints_[i], p),
                              arc_undercut(breakpoints_[i].site_after, next, p)});
    ear.is_certain = ear.violation <= inside_tolerance * size_;
    return ear;
}

// Closes ears until at most three breakpoints are left: the first about which there is no doubt,
// else the best. Most triangles with many breakpoints are crossed by strips; there only the lenses
// at both ends of the row are ears, and told without looking for Voronoi vertices. Closing an ear
// changes the sites around two others at most.
void TriangleSolver::close_ears() {
    ears_.assign(breakpoints_.size(), {});
    while (breakpoints_.size() > 3) {
        const std::size_t i = choose_ear();
        const Ear ear = ears_[i];
        const std::size_t next = after(i, breakpoints_.size());
        close_ear(i, ear);
        if (breakpoints_.size() <= 3) return;
        // The breakpoints at both ends of the interval gave way to one Voronoi vertex, which took
        // the place of the first, or to none.
        if (ear.is_lens) {
            ears_.erase(ears_.begin() + static_cast<std::ptrdiff_t>(std::max(i, next)));
            ears_.erase(ears_.begin() + static_cast<std::ptrdiff_t>(std::min(i, next)));
        } else {
            ears_.erase(ears_.begin() + static_cast<std::ptrdiff_t>(next));
        }
        const std::size_t n = breakpoints_.size();
        const std::size_t here = next < i ? n - 1 : i % n;
        ears_[before(here, n)].state = Ear::Unknown;
        if (ear.is_lens) {
            ears_[here].state = std::min(ears_[here].state, Ear::Judged);
        } else {
            ears_[here].state = Ear::Unknown;
            Ear& last = ears_[after(here, n)];
            last.state = std::min(last.state, Ear::Judged);
        }
    }
}

std::size_t TriangleSolver::choose_ear() {
    const std::size_t n = breakpoints_.size();
    for (const bool of_lenses : {true, false}) {
        for (std::size_t i = 0; i < n; ++i) {
            if (ears_[i].state != Ear::Unknown) continue;
            const bool is_lens =
                breakpoints_[before(i, n)].site_after == breakpoints_[after(i, n)].site_after;
            if (is_lens != of_lenses) continue;
            ears_[i] = judge_ear(i, false);
            if (ears_[i].is_certain) return i;
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (ears_[i].state != Ear::Judged) continue;
        ears_[i] = judge_ear(i, true);
        if (ears_[i].is_certain) return i;
    }
    const auto best = std::min_element(ears_.begin(), ears_.end(), [](const Ear& a, const Ear& b) {
        return a.violation < b.violation;
    });
    return static_cast<std::size_t>(best - ears_.begin());
}

void TriangleSolver::close_ear(std::size_t i, const Ear& ear) {
    if (!ear.is_lens) {
        close_with_vertex(i, ear.voronoi_vertex);
        return;
    }
    // The interval is cut off by one arc; its two neighbours are one piece.
    const bool is_sound = is_accepted(ear.violation);
    is_sound_ = is_sound_ && is_sound;
    const std::size_t next = after(i, breakpoints_.size());
    const Breakpoint from = breakpoints_[i];
    const Breakpoint to = breakpoints_[next];
    add_arc(from, to.position, to.node, to.site_after, is_sound);
    out_.connections.push_back(
        {breakpoints_[before(i, breakpoints_.size())].interval, to.interval, to.site_after});
    // The interval before the ear now reaches to the end of the one after it.
    breakpoints_.erase(breakpoints_.begin() + static_cast<std::ptrdiff_t>(std::max(i, next)));
    breakpoints_.erase(breakpoints_.begin() + static_cast<std::ptrdiff_t>(std::min(i, next)));
}

// Two arcs run from the interval's breakpoints to the Voronoi vertex; with three breakpoints left,
// all three do.
void TriangleSolver::close_with_vertex(std::size_t i, VertexPlace voronoi_vertex) {
    const std::size_t n = breakpoints_.size();
    const std::size_t next = after(i, n);
    const Breakpoint& previous = breakpoints_[before(i, n)];
    const Index site_before = previous.site_after;
    const Index site = breakpoints_[i].site_after;
    const Index site_after = breakpoints_[next].site_after;
    const bool is_sound = is_accepted(voronoi_vertex.violation);
    is_sound_ = is_sound_ && is_sound;
    if (!is_sound) {
        // On the chord that cuts the ear off what is left stays convex.
        const Vec2& p = breakpoints_[i].position;
        const Vec2& q = breakpoints_[next].position;
        const Vec2& r = previous.position;
        const Vec2 places[] = {(p + q) / 2, p, q, (p + q + r) / 3, r, (q + r) / 2, (r + p) / 2};
        const std::size_t count = n == 3 ? 7 : 3;
        voronoi_vertex = least_unequal({places, count}, site_before, site, site_after);
    }
    const auto node = NodeId::of_voronoi_vertex(static_cast<Index>(out_.voronoi_vertices.size()));
    const auto first_arc = static_cast<Index>(out_.arcs.size());
    out_.voronoi_vertices.push_back({face_,
                                     voronoi_vertex.position,
                                     voronoi_vertex.distance,
                                     {first_arc, first_arc + 1, first_arc + 2},
                                     {false, false, false},
                                     {site, site_after, site_before}});
    add_arc(breakpoints_[i], voronoi_vertex.position, node, site_before, is_sound);
    add_arc(breakpoints_[next], voronoi_vertex.position, node, site, is_sound);
    if (n == 3) {
        add_arc(previous, voronoi_vertex.position, node, site_after, is_sound);
        return;
    }
    open_vertices_.push_back(static_cast<Index>(out_.voronoi_vertices.size()) - 1);
    breakpoints_[i] = {voronoi_vertex.position, voronoi_vertex.distance, node, site_after,
                       breakpoints_[next].interval};
    breakpoints_.erase(breakpoints_.begin() + static_cast<std::ptrdiff_t>(next));
}

// An arc inwards from a breakpoint; `left` is the site before the breakpoint.
void TriangleSolver::add_arc(const Breakpoint& from, const Vec2& to, NodeId head, Index left,
                             bool is_curved) {
    const auto arc = static_cast<Index>(out_.arcs.size());
    const auto first_point = static_cast<Index>(out_.points.size());
    if (is_curved && !is_safe_) {
        sample_arc(relays_of_site(left), relays_of_site(from.site_after), from.position, to, 0);
    }
    out_.arcs.push_back({face_, from.node, head, left, from.site_after, first_point,
                         static_cast<Index>(out_.points.size()) - first_point});
    ends_.push_back({from.position, to});
    connect_open_vertex(from.node, arc, true);
    connect_open_vertex(head, arc, false);
}

// A Voronoi vertex that became a breakpoint gets its third arc when that breakpoint is used.
void TriangleSolver::connect_open_vertex(NodeId node, Index arc, bool at_tail) {
    if (!node.is_voronoi_vertex()) return;
    const auto found =
        std::find(open_vertices_.begin(), open_vertices_.end(), node.voronoi_vertex());
    if (found == open_vertices_.end()) return;
    out_.voronoi_vertices[*found].arcs[2] = arc;
    out_.voronoi_vertices[*found].at_tail[2] = at_tail;
    open_vertices_.erase(found);
}

// --- Crossings -------------------------------------------------------------------------------

void TriangleSolver::collect_segments(const Mark& since) {
    segments_.clear();
    for (std::size_t i = since.arcs; i < out_.arcs.size(); ++i) {
        const LocalArc& arc = out_.arcs[i];
        const Ends& ends = ends_[i - since.arcs];
        Vec2 last = ends.tail;
        for (Index j = arc.first_point; j < arc.first_point + arc.num_points; ++j) {
            segments_.push_back({static_cast<Index>(i), last, out_.points[j]});
            last = out_.points[j];
        }
        segments_.push_back({static_cast<Index>(i), last, ends.head});
    }
}

// Arcs that cross others, or themselves, lose their inner points. False: none did.
bool TriangleSolver::straighten_crossing_arcs(const Mark& since) {
    const std::size_t num_arcs = out_.arcs.size() - since.arcs;
    if (num_arcs + out_.points.size() - since.points < 3) return false;
    collect_segments(since);
    crossing_.clear();
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        for (std::size_t j = i + 1; j < segments_.size(); ++j) {
            if (!do_cross(segments_[i].from, segments_[i].to, segments_[j].from, segments_[j].to)) {
                continue;
            }
            crossing_.push_back(segments_[i].arc);
            crossing_.push_back(segments_[j].arc);
        }
    }
    for (const Index arc : crossing_) out_.arcs[arc].num_points = 0;
    return !crossing_.empty();
}

// --- Geometry --------------------------------------------------------------------------------

TriangleSolver::Relays TriangleSolver::relays_of_site(Index site) const {
    for (const Group& group : groups_) {
        if (group.site == site) return group.relays;
    }
    return {};
}

double TriangleSolver::signed_height(const Vec2& p, std::size_t k) const {
    const Vec2& a = corners_[k];
    const Vec2& b = corners_[(k + 1) % 3];
    const double length = (b - a).norm();
    return length > 0 ? cross(b - a, p - a) / length : 0;
}

double TriangleSolver::outside(const Vec2& p) const {
    double least = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2& a = corners_[k];
        if (cross(corners_[(k + 1) % 3] - a, p - a) < 0) {
            least = std::min(least, signed_height(p, k));
        }
    }
    return -least;
}

// Towards the centroid until inside: rounding only.
Vec2 TriangleSolver::inside(const Vec2& p) const {
    const Vec2 centroid = (corners_[0] + corners_[1] + corners_[2]) / 3;
    double keep = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double at_p = signed_height(p, k);
        const double at_centroid = signed_height(centroid, k);
        if (at_p < 0 && at_centroid > 0) {
            keep = std::min(keep, at_centroid / (at_centroid - at_p));
        }
    }
    return centroid + keep * (p - centroid);
}

// By how much some other site than these is nearer at p.
double TriangleSolver::undercut(const Vec2& p, double distance, Index a, Index b, Index c) const {
    double least = distance;
    for (const Group& group : groups_) {
        if (group.site == a || group.site == b || group.site == c) continue;
        least = std::min(least, least_reach(group.relays, p).distance);
    }
    return distance - least;
}

// Newton on equal distances from three sites. Two points may have them: `turn` is positive at the
// one around which the sites lie counter-clockwise.
bool TriangleSolver::find_equal(Relays a, Relays b, Relays c, Vec2& p, double& distance,
                                double& turn) const {
    const Vec2 start = p;
    const PlanarRelay* on_a = nullptr;  // The relays that are nearest at `chosen_at`.
    const PlanarRelay* on_b = nullptr;
    const PlanarRelay* on_c = nullptr;
    Vec2 chosen_at = p;
    for (int i = 0; i < max_newton_steps; ++i) {
        if (on_a == nullptr) {
            on_a = nearest_relay(a, p);
            on_b = nearest_relay(b, p);
            on_c = nearest_relay(c, p);
            chosen_at = p;
            if (on_a == nullptr || on_b == nullptr || on_c == nullptr) return false;
        }
        const Reach ra = reach(*on_a, p);
        const Reach rb = reach(*on_b, p);
        const Reach rc = reach(*on_c, p);
        distance = std::max({ra.distance, rb.distance, rc.distance});
        if (!std::isfinite(distance)) return false;
        const Vec2 residual(ra.distance - rb.distance, rb.distance - rc.distance);
        const Vec2 at_b = direction(p, rb);
        const Vec2 first = direction(p, ra) - at_b;
        const Vec2 second = at_b - direction(p, rc);
        const double determinant = cross(first, second);
        if (std::max(std::abs(residual.x()), std::abs(residual.y())) <=
            convergence * (size_ + distance)) {
            if (p == chosen_at) {
                turn = determinant;
                return true;
            }
            on_a = nullptr;  // Others may be nearer here.
            continue;
        }
        if (!(std::abs(determinant) > convergence)) return false;
        Vec2 step(second.y() * residual.x() - first.y() * residual.y(),
                  first.x() * residual.y() - second.x() * residual.x());
        step /= determinant;
        const double norm = step.norm();
        if (norm > size_ / 2) step *= size_ / (2 * norm);
        p -= step;
        if ((p - start).squaredNorm() > lost * lost * size_ * size_) return false;
    }
    return false;
}

// Where the sites before, at and after an interval meet. Most that are not found at once are
// nowhere; to be thorough takes twice the time.
TriangleSolver::VertexPlace TriangleSolver::find_voronoi_vertex(const Breakpoint& before,
                                                                const Breakpoint& at,
                                                                const Breakpoint& after,
                                                                bool is_thorough) const {
    const Index sites[] = {before.site_after, at.site_after, after.site_after};
    const Relays a = relays_of_site(sites[0]);
    const Relays b = relays_of_site(sites[1]);
    const Relays c = relays_of_site(sites[2]);
    const Vec2 centroid = (at.position + after.position + before.position) / 3;
    const Vec2 starts[] = {centroid, (at.position + after.position) / 2,
                           (after.position + before.position) / 2,
                           (before.position + at.position) / 2};
    for (const Vec2& start : std::span(starts).first(is_thorough ? 4 : 2)) {
        Vec2 p = start;
        double distance;
        double turn = 0;
        if (!find_equal(a, b, c, p, distance, turn)) {
            if (is_thorough) continue;
            break;
        }
        if (!(turn > 0)) continue;  // The other one: from elsewhere.
        const double gap = outside(p);
        if (gap > inside_tolerance * size_) {
            if (is_thorough) continue;
            break;
        }
        return {gap > 0 ? inside(p) : p, distance,
                undercut(p, distance, sites[0], sites[1], sites[2])};
    }
    // Cells may meet at the very end of an interval, where distances have no derivative.
    const Vec2 places[] = {at.position, after.position, before.position};
    const VertexPlace at_breakpoint = least_unequal(places, sites[0], sites[1], sites[2]);
    if (at_breakpoint.violation <= inside_tolerance * size_) return at_breakpoint;
    return {centroid, least_reach(b, centroid).distance, no_voronoi_vertex * size_};
}

// Where three distances differ least; by how much is the violation.
TriangleSolver::VertexPlace TriangleSolver::least_unequal(std::span<const Vec2> places, Index a,
                                                          Index b, Index c) const {
    VertexPlace best{places[0], 0, infinity};
    for (const Vec2& p : places) {
        const double da = least_reach(relays_of_site(a), p).distance;
        const double db = least_reach(relays_of_site(b), p).distance;
        const double dc = least_reach(relays_of_site(c), p).distance;
        const double most = std::max({da, db, dc});
        const double violation = most - std::min({da, db, dc});
        if (violation < best.violation || (&p == places.data())) {
            best = {p, most, std::isfinite(most) ? violation : infinity};
        }
    }
    return best;
}

// By how much some other site is nearer in the middle of an arc.
double TriangleSolver::arc_undercut(Index site_before, const Breakpoint& from,
                                    const Vec2& to) const {
    Vec2 p;
    double distance;
    return project(relays_of_site(site_before), relays_of_site(from.site_after), from.position, to,
                   p, distance)
               ? undercut(p, distance, site_before, from.site_after, no_index)
               : 0;
}

// Closing off an interval by one arc from its breakpoint to the next: wrong where a third site is
// nearer on the arc, and the less likely the farther the arc strays from its chord. Certain where
// the site has no other interval that this one could hang together with.
void TriangleSolver::judge_lens(const Breakpoint& from, const Breakpoint& to, Ear& ear) const {
    Vec2 p;
    double distance;
    if (!project(relays_of_site(from.site_after), relays_of_site(to.site_after), from.position,
                 to.position, p, distance)) {
        ear.violation = no_voronoi_vertex * size_;
        return;
    }
    constexpr double stray_weight = 1e-3;
    const double below = undercut(p, distance, from.site_after, to.site_after, no_index);
    ear.violation = below + stray_weight * (p - (from.position + to.position) / 2).norm();
    ear.is_certain =
        below <= inside_tolerance * size_ &&
        std::count_if(breakpoints_.begin(), breakpoints_.end(), [&](const Breakpoint& breakpoint) {
            return breakpoint.site_after == from.site_after;
        }) == 1;
}

// The point of the bisector of a and b opposite the middle of a chord; false where there is
// none near. 1D Newton across the chord.
bool TriangleSolver::project(Relays a, Relays b, const Vec2& from, const Vec2& to, Vec2& p,
                             double& distance) const {
    const Vec2 chord = to - from;
    const double length = chord.norm();
    if (!(length > inside_tolerance * size_)) return false;
    const Vec2 normal(-chord.y() / length, chord.x() / length);
    const Vec2 middle = (from + to) / 2;
    const PlanarRelay* on_a = nullptr;  // The relays that are nearest at `chosen_at`.
    const PlanarRelay* on_b = nullptr;
    double chosen_at = 0;
    double s = 0;
    for (int i = 0; i < max_newton_steps; ++i) {
        p = middle + s * normal;
        if (on_a == nullptr) {
            on_a = nearest_relay(a, p);
            on_b = nearest_relay(b, p);
            chosen_at = s;
            if (on_a == nullptr || on_b == nullptr) return false;
        }
        const Reach ra = reach(*on_a, p);
        const Reach rb = reach(*on_b, p);
        const double gap = ra.distance - rb.distance;
        distance = std::max(ra.distance, rb.distance);
        if (std::abs(gap) <= convergence * (size_ + distance)) {
            if (std::abs(s - chosen_at) <= near_enough * length) {
                return outside(p) <= inside_tolerance * size_;
            }
            on_a = nullptr;  // Others may be nearer here.
            continue;
        }
        const double slope = (direction(p, ra) - direction(p, rb)).dot(normal);
        if (!(std::abs(slope) > convergence)) return false;
        s = std::clamp(s - gap / slope, -length / 2, length / 2);
    }
    return false;
}

bool TriangleSolver::is_straight(Relays a, Relays b, const Vec2& from, const Vec2& to) const {
    const Vec2 middle = (from + to) / 2;
    return is_nearly_straight(to - from, middle, least_reach(a, middle), least_reach(b, middle),
                              chord_tolerance_);
}

void TriangleSolver::sample_arc(Relays a, Relays b, const Vec2& from, const Vec2& to, int depth) {
    Vec2 p;
    double distance;
    if (depth == max_arc_depth || is_straight(a, b, from, to)) return;
    if (!project(a, b, from, to, p, distance)) return;
    if ((p - (from + to) / 2).norm() <= chord_tolerance_ * (to - from).norm()) return;
    sample_arc(a, b, from, p, depth + 1);
    out_.points.push_back(p);
    out_.point_distance.push_back(distance);
    sample_arc(a, b, p, to, depth + 1);
}

}  // namespace agvd
