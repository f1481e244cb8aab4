//! \file
//! The local Apollonius diagram of a triangle whose boundary is already labelled ([meng2023]
//! Sec. 4.2): which arcs join the label changes on the boundary, and where three arcs meet.
#pragma once

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
    void set_relays(std::span<const PlanarRelay> relays, std::span<const Index> sites);

    //! Appends the diagram if the relays agree with the breakpoints and with each other: equal
    //! breakpoints no farther than they say, Voronoi vertices where they should be, no arcs that
    //! cross.
    //! \param breakpoints  at least 2, neighbours differ in site_after.
    //! \return false: nothing was appended.
    [[nodiscard]] bool try_solve(Index face, const std::array<Vec2, 3>& corners,
                                 std::span<const Breakpoint> breakpoints);

    //! The same for any relays. The result is a planar forest for any distances: the boundary's
    //! intervals are closed off one after the other, each by an arc or a Voronoi vertex, those that
    //! are certain first and then those that fit the distances best, and each step leaves a shorter
    //! cycle. Where the distances are those of an Apollonius diagram the result is that diagram.
    //! Arcs that would cross others are drawn straight, and if that is not enough all are, with
    //! Voronoi vertices on the chords that cut intervals off. Cost: O(k) Voronoi
    //! vertices for k breakpoints, each O(relays), and O(k^2) comparisons.
    void solve(Index face, const std::array<Vec2, 3>& corners,
               std::span<const Breakpoint> breakpoints);

    //! Draws what the last of these calls drew once more, all straight.
    void redraw_straight(std::span<const Breakpoint> breakpoints);

private:
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
    // Where an arc begins and ends.
    struct ArcEnds {
        Vec2 tail, head;
    };
    // A piece of an arc.
    struct Segment {
        Index arc;
        Vec2 from, to;
    };

    void begin(Index face, const std::array<Vec2, 3>& corners);
    void draw(std::span<const Breakpoint> breakpoints);
    void collect_segments();
    [[nodiscard]] static bool do_cross(const Segment& s, const Segment& t);
    [[nodiscard]] bool straighten();

    [[nodiscard]] bool agrees(const Breakpoint& at, Index site_before) const;
    [[nodiscard]] bool is_accepted(double violation) const;
    [[nodiscard]] VertexCandidate find_vertex(std::size_t interval, bool is_thorough) const;
    [[nodiscard]] Ear judge_ear(std::size_t i, bool is_thorough) const;
    void judge_lens(const Breakpoint& from, const Breakpoint& to, Ear& ear) const;
    void close_ears();
    [[nodiscard]] std::size_t choose_ear();
    void close_ear(std::size_t i, const Ear& ear);
    void close_lens(std::size_t i, double violation);
    void close_with_vertex(std::size_t i, VertexCandidate voronoi_vertex);
    [[nodiscard]] VertexCandidate vertex_on_chord(std::size_t i) const;
    void add_arc(const Breakpoint& from, const ArcHead& to, Index left, bool is_curved);
    void connect_open_vertex(NodeId node, ArcEnd end);

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
    std::vector<ArcEnds> arc_ends_;  // Of the arcs drawn.
    std::vector<Segment> segments_;
};

}  // namespace agvd
