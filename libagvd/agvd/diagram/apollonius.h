//! \file
//! The local Apollonius diagram of a triangle whose boundary is already labelled ([meng2023]
//! Sec. 4.2): which arcs join the label changes on the boundary, and where three arcs meet.
#pragma once

#include "agvd/diagram/face_relays.h"
#include "agvd/diagram/local_diagram.h"

namespace agvd {

//! Distances at a breakpoint that differ by more (share of the triangle's longest side) are not
//! those of its labels.
inline constexpr double largest_disagreement = 1e-2;

[[nodiscard]] double longest_side(const std::array<Vec2, 3>& corners);

//! Draws diagrams into `out`. Scratch memory is kept from triangle to triangle.
class TriangleSolver {
public:
    //! \param chord_tolerance  arcs are sampled until they stray less than this share of a chord.
    TriangleSolver(double chord_tolerance, LocalDiagram& out)
        : chord_tolerance_(chord_tolerance), out_(out) {}

    //! \param relays  by ascending site; kept by reference until the next call.
    //! \param sites   those that the next triangle's boundary shows: nobody else is asked.
    void set_relays(std::span<const PlanarRelay> relays, std::span<const Index> sites);

    //! Appends the diagram if the relays agree with the breakpoints and with each other: equal
    //! breakpoints no farther than they say, Voronoi vertices where they should be, no arcs that
    //! cross.
    //! \param breakpoints  at least 2, neighbours differ in site_after.
    //! \return false: nothing was appended.
    [[nodiscard]] bool try_solve(Index face, const std::array<Vec2, 3>& corners,
                                 std::span<const Breakpoint> breakpoints);

    //! The same for any relays. The result is a planar forest whatever the distances are: the
    //! boundary's intervals are closed off one after the other, each by an arc or Voronoi vertex,
    //! those about which there is no doubt first and then what fits the distances best, and each
    //! step leaves a shorter cycle. Where the distances are those of a true Apollonius diagram it
    //! is that diagram. Arcs that would cross others are drawn straight, and if that is not enough
    //! all are, with Voronoi vertices on the chords that cut intervals off. Cost: O(k) Voronoi
    //! vertices for k breakpoints, each O(relays), and O(k^2) comparisons.
    void solve(Index face, const std::array<Vec2, 3>& corners,
               std::span<const Breakpoint> breakpoints);

    //! Draws what the last of these calls drew once more, all straight.
    void redraw_straight(std::span<const Breakpoint> breakpoints);

private:
    using Relays = std::span<const PlanarRelay>;

    struct VertexPlace {
        Vec2 position;
        double distance;
        double violation;  // How badly the distances contradict it; 0: not at all.
    };
    // A way to close off an interval.
    struct Ear {
        enum State : std::uint8_t { Unknown, Judged, Settled };
        State state;  // Settled: judged thoroughly.
        bool is_lens;
        bool is_certain;
        double violation;
        VertexPlace voronoi_vertex;
    };
    struct Group {
        Index site;
        Relays relays;
    };
    struct Ends {
        Vec2 tail, head;
    };
    // Sizes of `out_`, to go back to.
    struct Mark {
        std::size_t points, arcs, voronoi_vertices, connections;
    };
    struct Segment {
        Index arc;
        Vec2 from, to;
    };

    void begin(Index face, const std::array<Vec2, 3>& corners);
    void draw(std::span<const Breakpoint> breakpoints);
    [[nodiscard]] Mark mark() const;
    void go_back(const Mark& mark);

    [[nodiscard]] bool agrees(const Breakpoint& at, Index site_before) const;
    [[nodiscard]] bool is_accepted(double violation) const;
    [[nodiscard]] Ear judge_ear(std::size_t i, bool is_thorough) const;
    void judge_lens(const Breakpoint& from, const Breakpoint& to, Ear& ear) const;
    void close_ears();
    [[nodiscard]] std::size_t choose_ear();
    void close_ear(std::size_t i, const Ear& ear);
    void close_with_vertex(std::size_t i, VertexPlace voronoi_vertex);
    void add_arc(const Breakpoint& from, const Vec2& to, NodeId head, Index left, bool is_curved);
    void connect_open_vertex(NodeId node, Index arc, bool at_tail);

    [[nodiscard]] bool straighten_crossing_arcs(const Mark& since);
    void collect_segments(const Mark& since);

    [[nodiscard]] Relays relays_of_site(Index site) const;
    [[nodiscard]] double signed_height(const Vec2& p, std::size_t k) const;
    [[nodiscard]] double outside(const Vec2& p) const;
    [[nodiscard]] Vec2 inside(const Vec2& p) const;
    [[nodiscard]] double undercut(const Vec2& p, double distance, Index a, Index b, Index c) const;
    [[nodiscard]] bool find_equal(Relays a, Relays b, Relays c, Vec2& p, double& distance,
                                  double& turn) const;
    [[nodiscard]] VertexPlace find_voronoi_vertex(const Breakpoint& before, const Breakpoint& at,
                                                  const Breakpoint& after, bool is_thorough) const;
    [[nodiscard]] VertexPlace least_unequal(std::span<const Vec2> places, Index a, Index b,
                                            Index c) const;
    [[nodiscard]] double arc_undercut(Index site_before, const Breakpoint& from,
                                      const Vec2& to) const;
    [[nodiscard]] bool project(Relays a, Relays b, const Vec2& from, const Vec2& to, Vec2& p,
                               double& distance) const;
    [[nodiscard]] bool is_straight(Relays a, Relays b, const Vec2& from, const Vec2& to) const;
    void sample_arc(Relays a, Relays b, const Vec2& from, const Vec2& to, int depth);

    double chord_tolerance_;
    LocalDiagram& out_;
    std::vector<Group> groups_;

    // The triangle at hand.
    Index face_ = 0;
    std::array<Vec2, 3> corners_;
    Mark start_{};          // Before it.
    double size_ = 0;       // Longest side.
    bool is_safe_ = false;  // Draw all straight.
    bool is_sound_ = true;  // Nothing drawn contradicts the distances.
    std::vector<Breakpoint> breakpoints_;
    std::vector<Ear> ears_;
    std::vector<Index> open_vertices_;
    std::vector<Ends> ends_;  // Of the arcs drawn.
    std::vector<Segment> segments_;
    std::vector<Index> crossing_;  // Arcs.
};

}  // namespace agvd
