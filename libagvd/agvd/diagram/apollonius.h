//! \file
//! The local Apollonius diagram of a triangle whose boundary is already labelled ([meng2023]
//! Sec. 4.2): which arcs join the label changes on the boundary, and where three arcs meet.
//!
//! Notation: breakpoint i is the label change between interval i - 1 and interval i, all cyclic. An
//! ear is an interval with a way to close it off: by a Voronoi vertex with both neighbours, or,
//! where both have one label, by one arc: then it is a lens.
#pragma once

#include <algorithm>
#include <cassert>

#include "agvd/diagram/bisectors.h"

namespace agvd {

//! Draws diagrams into `out`. Scratch memory is kept from triangle to triangle.
class TriangleSolver {
public:
    //! \param chord_tolerance  arcs are sampled until they stray less than this share of a chord.
    TriangleSolver(double chord_tolerance, Arcs& out)
        : chord_tolerance_(chord_tolerance), out_(out) {}

    //! \param relays  by ascending site; kept by reference until the next call.
    //! \param sites   those on the next triangle's boundary; others are not used.
    void set_relays(std::span<const PlanarRelay> relays, std::span<const Index> sites) {
        triangle_.groups.clear();
        for (const Index site : sites) triangle_.groups.push_back({site, of_site(relays, site)});
    }

    //! Appends the diagram if the relays agree with the breakpoints and with each other, and no
    //! arcs cross.
    //! \param breakpoints  at least 2, neighbours differ in site_after.
    //! \return false: nothing was appended.
    [[nodiscard]] bool try_solve(Index face, const std::array<Vec2, 3>& corners,
                                 std::span<const Breakpoint> breakpoints) {
        begin(face, corners);
        for (std::size_t i = 0; i < breakpoints.size(); ++i) {
            const Index site_before = breakpoints[before(i, breakpoints.size())].site_after;
            if (!agrees(breakpoints[i], site_before)) return false;
        }
        draw(breakpoints);
        if (is_sound_ && !straighten()) return true;
        out_.go_back(start_);
        return false;
    }

    //! The same for any relays; the result is a planar forest for any distances. Intervals of the
    //! boundary are closed off one after the other, each by an arc or a Voronoi vertex: those that
    //! are certain first, then those that fit the distances best. Arcs that would cross others are
    //! drawn straight, and if that is not enough all are. Cost: O(k) Voronoi vertices for k
    //! breakpoints, each O(relays), and O(k^2) comparisons.
    void solve(Index face, const std::array<Vec2, 3>& corners,
               std::span<const Breakpoint> breakpoints) {
        begin(face, corners);
        draw(breakpoints);
        if (!straighten() || !straighten()) return;
        redraw_straight(breakpoints);
    }

    //! Draws what the last of these calls drew once more, all straight.
    void redraw_straight(std::span<const Breakpoint> breakpoints) {
        out_.go_back(start_);
        is_safe_ = true;
        draw(breakpoints);
    }

private:
    // Steps that the distances contradict by more (share of the size) are drawn straight.
    static constexpr double largest_violation = 1e-3;
    static std::size_t after(std::size_t i, std::size_t n) { return i + 1 == n ? 0 : i + 1; }
    static std::size_t before(std::size_t i, std::size_t n) { return i == 0 ? n - 1 : i - 1; }
    template <typename T>
    static void erase_at(std::vector<T>& elements, std::size_t i) {
        elements.erase(elements.begin() + static_cast<std::ptrdiff_t>(i));
    }

    // Of the elements i and i + 1, cyclic.
    template <typename T>
    static void erase_both(std::vector<T>& elements, std::size_t i) {
        const std::size_t next = after(i, elements.size());
        erase_at(elements, std::max(i, next));
        erase_at(elements, std::min(i, next));
    }

    // A way to close off an interval.
    struct Ear {
        enum State : std::uint8_t { Unknown, Judged, Settled };
        State state;  // Settled: judged thoroughly.
        bool is_lens;
        bool is_certain;
        double violation;
        VertexCandidate voronoi_vertex;
    };
    struct ArcHead {
        Vec2 position;
        NodeId node;
        bool is_across = false;
    };
    // A piece of an arc.
    struct Segment {
        Index arc;
        Chord chord;
    };

    void begin(Index face, const std::array<Vec2, 3>& corners) {
        face_ = face;
        triangle_.corners = corners;
        triangle_.size = longest_side(corners);
        start_ = out_.mark();
        is_safe_ = false;
    }

    void draw(std::span<const Breakpoint> breakpoints) {
        assert(breakpoints.size() >= 2);
        breakpoints_.assign(breakpoints.begin(), breakpoints.end());
        chords_.clear();
        open_vertices_.clear();
        is_sound_ = true;
        if (breakpoints_.size() > 3) close_ears();
        if (breakpoints_.size() == 3) {
            close_with_vertex(0, find_vertex(0, true));
        } else {
            assert(breakpoints_.size() == 2);
            const Breakpoint& to = breakpoints_[1];
            add_arc(breakpoints_[0], {to.position, to.node, to.is_across}, to.site_after, true);
        }
        assert(open_vertices_.empty());
    }

    void collect_segments() {
        segments_.clear();
        for (Index i = start_.arcs; i < out_.arcs.size(); ++i) {
            const Arc& arc = out_.arcs[i];
            const Chord& chord = chords_[i - start_.arcs];
            Vec2 last = chord.from;
            for (Index j = arc.first_point; j < arc.first_point + arc.num_points; ++j) {
                segments_.push_back({i, {last, out_.points[j]}});
                last = out_.points[j];
            }
            segments_.push_back({i, {last, chord.to}});
        }
    }

    // Takes the inner points from arcs that cross, O(n^2) for n pieces. False: there are none.
    // Where four cells meet in a point, or three on a side, arcs cross by rounding, which no other
    // way of drawing them avoids.
    [[nodiscard]] bool straighten() {
        assert(chords_.size() == out_.arcs.size() - start_.arcs);
        // Two segments that share an end do not cross.
        if (chords_.size() + out_.points.size() - start_.points < 3) return false;
        collect_segments();
        const double slack = inside_tolerance * triangle_.size;
        bool is_any = false;
        for (std::size_t i = 0; i < segments_.size(); ++i) {
            for (std::size_t j = i + 1; j < segments_.size(); ++j) {
                if (!do_cross(segments_[i].chord, segments_[j].chord, slack)) continue;
                out_.arcs[segments_[i].arc].num_points = 0;
                out_.arcs[segments_[j].arc].num_points = 0;
                is_any = true;
            }
        }
        return is_any;
    }

    // Whether both sites are as near as the edge says.
    [[nodiscard]] bool agrees(const Breakpoint& at, Index site_before) const {
        const double limit = at.distance + largest_disagreement * triangle_.size;
        const auto reaches = [&](const PlanarRelay& relay) {
            return reach(relay, at.position).distance <= limit;
        };
        const Relays a = relays_of_site(triangle_, site_before);
        const Relays b = relays_of_site(triangle_, at.site_after);
        return std::any_of(a.begin(), a.end(), reaches) && std::any_of(b.begin(), b.end(), reaches);
    }

    [[nodiscard]] bool is_accepted(double violation) const {
        return !is_safe_ && violation <= largest_violation * triangle_.size;
    }

    // Where an interval meets both neighbours.
    [[nodiscard]] VertexCandidate find_vertex(std::size_t interval, bool is_thorough) const {
        const std::size_t n = breakpoints_.size();
        const auto start = [&](std::size_t i) {
            return IntervalStart{breakpoints_[i].position, breakpoints_[i].site_after};
        };
        return find_voronoi_vertex(
            triangle_, {start(before(interval, n)), start(interval), start(after(interval, n))},
            is_thorough);
    }

    [[nodiscard]] Ear judge_ear(std::size_t i, bool is_thorough) const {
        const Breakpoint& previous = breakpoints_[before(i, breakpoints_.size())];
        const Breakpoint& at = breakpoints_[i];
        const Breakpoint& next = breakpoints_[after(i, breakpoints_.size())];
        Ear ear{};
        ear.state = is_thorough ? Ear::Settled : Ear::Judged;
        ear.is_lens = previous.site_after == next.site_after;
        if (ear.is_lens) {
            judge_lens(at, next, ear);
            return ear;
        }
        ear.voronoi_vertex = find_vertex(i, is_thorough);
        const Vec2& p = ear.voronoi_vertex.position;
        ear.violation = ear.voronoi_vertex.violation;
        if (ear.violation >= no_voronoi_vertex * triangle_.size) return ear;
        ear.violation = std::max(
            {ear.violation,
             arc_undercut(triangle_, {previous.site_after, at.site_after}, {at.position, p}),
             arc_undercut(triangle_, {at.site_after, next.site_after}, {next.position, p})});
        ear.is_certain = ear.violation <= inside_tolerance * triangle_.size;
        return ear;
    }

    // A lens is wrong where a third site is nearer on the arc, and less likely the farther the arc
    // strays. It is certain where the site has no other interval to be connected to. One of a site
    // that is tied at a corner is a point, but for rounding.
    void judge_lens(const Breakpoint& from, const Breakpoint& to, Ear& ear) const {
        const Chord chord{from.position, to.position};
        const bool is_point = (chord.to - chord.from).norm() <= inside_tolerance * triangle_.size;
        double below = 0;
        if (!is_point) {
            const std::array sites{from.site_after, to.site_after};
            const auto middle = project(triangle_, relays_of_site(triangle_, sites[0]),
                                        relays_of_site(triangle_, sites[1]), chord);
            if (!middle) {
                ear.violation = no_voronoi_vertex * triangle_.size;
                return;
            }
            constexpr double stray_weight = 1e-3;
            const Vec2& p = middle->position;
            below = undercut(triangle_, p, middle->distance, sites);
            ear.violation = below + stray_weight * (p - (chord.from + chord.to) / 2).norm();
        }
        ear.is_certain = below <= inside_tolerance * triangle_.size &&
                         std::count_if(breakpoints_.begin(), breakpoints_.end(),
                                       [&](const Breakpoint& breakpoint) {
                                           return breakpoint.site_after == from.site_after;
                                       }) == 1;
    }

    // Closes ears until at most three breakpoints are left: the first that is certain, else the
    // best. Closing one changes the sites around two others at most.
    void close_ears() {
        ears_.assign(breakpoints_.size(), {});
        while (breakpoints_.size() > 3) {
            const std::size_t i = choose_ear();
            const Ear ear = ears_[i];
            const std::size_t next = after(i, breakpoints_.size());
            if (ear.is_lens) {
                close_lens(i, ear.violation);
            } else {
                close_with_vertex(i, ear.voronoi_vertex);
            }
            if (breakpoints_.size() <= 3) return;
            // A Voronoi vertex replaces both breakpoints of the interval; a lens leaves neither.
            if (ear.is_lens) {
                erase_both(ears_, i);
            } else {
                erase_at(ears_, next);
            }
            assert(ears_.size() == breakpoints_.size());
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

    [[nodiscard]] std::size_t choose_ear() {
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
        const auto best =
            std::min_element(ears_.begin(), ears_.end(),
                             [](const Ear& a, const Ear& b) { return a.violation < b.violation; });
        return static_cast<std::size_t>(best - ears_.begin());
    }

    // The interval is cut off by one arc; its two neighbours are one piece.
    void close_lens(std::size_t i, double violation) {
        const bool is_sound = is_accepted(violation);
        is_sound_ = is_sound_ && is_sound;
        const std::size_t n = breakpoints_.size();
        const Breakpoint from = breakpoints_[i];
        const Breakpoint to = breakpoints_[after(i, n)];
        add_arc(from, {to.position, to.node, to.is_across}, to.site_after, is_sound);
        out_.connections.push_back(
            {breakpoints_[before(i, n)].interval, to.interval, to.site_after});
        // The interval before the ear now reaches to the end of the one after it.
        erase_both(breakpoints_, i);
    }

    // An arc from each end of the interval; with three breakpoints left, from all.
    void close_with_vertex(std::size_t i, VertexCandidate voronoi_vertex) {
        const std::size_t n = breakpoints_.size();
        assert(n >= 3);
        const std::size_t next = after(i, n);
        const Breakpoint& previous = breakpoints_[before(i, n)];
        const Index site_before = previous.site_after;
        const Index site = breakpoints_[i].site_after;
        const Index site_after = breakpoints_[next].site_after;
        const bool is_sound = is_accepted(voronoi_vertex.violation);
        is_sound_ = is_sound_ && is_sound;
        if (!is_sound) voronoi_vertex = vertex_on_chord(i);
        const auto name = size_of(out_.voronoi_vertices);
        const auto first_arc = size_of(out_.arcs);
        out_.voronoi_vertices.push_back(
            {face_,
             voronoi_vertex.position,
             voronoi_vertex.distance,
             {ArcEnd::head_of(first_arc), ArcEnd::head_of(first_arc + 1),
              ArcEnd::head_of(first_arc + 2)},
             {site, site_after, site_before}});
        const ArcHead to{voronoi_vertex.position, NodeId::of_voronoi_vertex(name)};
        add_arc(breakpoints_[i], to, site_before, is_sound);
        add_arc(breakpoints_[next], to, site, is_sound);
        if (n == 3) {
            add_arc(previous, to, site_after, is_sound);
            return;
        }
        open_vertices_.push_back(name);
        breakpoints_[i] = {to.position, voronoi_vertex.distance, to.node, site_after,
                           breakpoints_[next].interval};
        erase_at(breakpoints_, next);
    }

    // A position for the Voronoi vertex of interval i such that arcs drawn straight do not cross:
    // on the chord that cuts the ear off what is left stays convex.
    [[nodiscard]] VertexCandidate vertex_on_chord(std::size_t i) const {
        const std::size_t n = breakpoints_.size();
        const Breakpoint& previous = breakpoints_[before(i, n)];
        const Breakpoint& at = breakpoints_[i];
        const Breakpoint& next = breakpoints_[after(i, n)];
        const Vec2& p = at.position;
        const Vec2& q = next.position;
        const Vec2& r = previous.position;
        const Vec2 positions[] = {(p + q) / 2, p, q, (p + q + r) / 3, r, (q + r) / 2, (r + p) / 2};
        const std::size_t count = n == 3 ? 7 : 3;  // The last triangle is all cut off.
        return least_unequal(triangle_, {positions, count},
                             {previous.site_after, at.site_after, next.site_after});
    }

    // An arc inwards from a breakpoint; `left` is the site before the breakpoint.
    void add_arc(const Breakpoint& from, const ArcHead& to, Index left, bool is_curved) {
        assert(left != from.site_after);
        const auto arc = size_of(out_.arcs);
        const auto first_point = size_of(out_.points);
        if (is_curved && !is_safe_) {
            sample_bisector(triangle_, {left, from.site_after}, {from.position, to.position},
                            chord_tolerance_, out_);
        }
        out_.arcs.push_back({face_, from.node, to.node, left, from.site_after, first_point,
                             size_of(out_.points) - first_point, from.is_across, to.is_across});
        chords_.push_back({from.position, to.position});
        connect_open_vertex(from.node, ArcEnd::tail_of(arc));
        connect_open_vertex(to.node, ArcEnd::head_of(arc));
    }

    // A Voronoi vertex that became a breakpoint gets its third arc when that breakpoint is used.
    void connect_open_vertex(NodeId node, ArcEnd end) {
        if (!node.is_voronoi_vertex()) return;
        const auto found =
            std::find(open_vertices_.begin(), open_vertices_.end(), node.voronoi_vertex());
        if (found == open_vertices_.end()) return;
        out_.voronoi_vertices[*found].ends[2] = end;
        open_vertices_.erase(found);
    }

    double chord_tolerance_;
    Arcs& out_;
    TriangleSites triangle_;

    // The triangle at hand.
    Index face_ = 0;
    Arcs::Mark start_{};    // Before it.
    bool is_safe_ = false;  // Draw all straight.
    bool is_sound_ = true;  // Nothing drawn contradicts the distances.
    std::vector<Breakpoint> breakpoints_;
    std::vector<Ear> ears_;  // By interval.
    // Voronoi vertices that became breakpoints and have no third arc so far.
    std::vector<Index> open_vertices_;
    std::vector<Chord> chords_;  // Of the arcs drawn.
    std::vector<Segment> segments_;
};

}  // namespace agvd
