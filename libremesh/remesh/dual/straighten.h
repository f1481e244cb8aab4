//! \file
//! Straightens paths on the surface to locally shortest ones.
#pragma once

#include "agvd/core/progress.h"
#include "remesh/dual/face_strip.h"

namespace remesh {

//! A path on the surface.
struct GeodesicPath {
    double length = 0;  //!< Mesh units; of this path up to rounding.
    //! At every vertex that the path touches between its ends, both sides have an angle of at least
    //! pi (less 1e-7) or the boundary; elsewhere the path is straight. False: there were too few
    //! rounds, or rounding hides whether a vertex is better passed on its other side.
    bool is_locally_shortest = false;
    //! The source, the points where the path crosses edges or touches vertices, and the target;
    //! each shares a face with the next. Set by shortest_in() and straightest_path() only.
    std::vector<SurfacePoint> points{};
};

//! Straightens paths one after the other. Keeps its memory; use one for each thread.
//!
//! A funnel gives the shortest path inside the strip ([lee1984]). If it bends at a vertex with an
//! angle below pi on the other side, the strip is rerouted around that side, which is shorter. This
//! is repeated until there is no such vertex ([xin2007]).
class PathStraightener {
public:
    //! \param ticker  of the thread; if it throws Cancelled, the strip is unspecified then.
    explicit PathStraightener(const Surface& surface, Ticker ticker = {})
        : surface_(surface), ticker_(ticker) {}

    //! Replaces the strip by that of a locally shortest path, which is never longer.
    //!
    //! \return without points.
    //! Cost: O(#crossed + degrees of the vertices passed) a round. One to three rounds for ten
    //! crossings are usual; at most 500 and one for each crossing are made, and fewer where these
    //! would look at more than 400 times as many crossings as there are at the start, and 200 000.
    GeodesicPath straighten(FaceStrip& strip);

    //! The shortest path inside the strip as it is, with its points.
    [[nodiscard]] GeodesicPath shortest_in(FaceStrip strip);

private:
    // A vertex of the unfolded strip (or the source, or the target).
    struct Node {
        Vec2 place;
        Index parent;  // The node before it on the shortest path from the source.
        Index first;   // The first of the crossings of which it is an end;
        Index last;    // the last one.
        bool is_left;
    };
    // Ends of a crossed edge in the plane of the unfolded strip.
    struct Ends {
        Vec2 left, right;
    };

    [[nodiscard]] double find_shortest(const FaceStrip& strip);
    void unfold(const FaceStrip& strip);
    void add_to_funnel(Index node);
    [[nodiscard]] double collect_path();
    [[nodiscard]] bool reroute(const std::vector<Index>& crossed);
    struct Detour {
        bool is_shorter;
        Index last;  // The last crossing that it replaces.
    };
    [[nodiscard]] Detour find_detour(const std::vector<Index>& crossed, Index bend);
    [[nodiscard]] Vec2 apex_of(Index half_edge, const Vec2& tail, const Vec2& head) const;

    const Surface& surface_;
    Ticker ticker_;
    std::vector<Node> nodes_;    // The source, both ends of the first crossing, one for each more;
                                 // then the target.
    std::vector<Ends> ends_;     // Of each crossing.
    std::vector<Index> funnel_;  // Left end, ..., apex, ..., right end: [begin_, end_).
    Index begin_ = 0, end_ = 0, apex_ = 0;
    std::vector<Index> path_;     // Nodes from the source to the target.
    std::vector<Index> detour_;   // Crossings on the other side of a bend.
    std::vector<Index> crossed_;  // Of the next round.
    FaceStrip best_;              // Of the shortest path so far.
};

//! The path straightened from a strip, with its points.
//!
//! Cost: see PathStraightener.
[[nodiscard]] GeodesicPath straightest_path(const Surface& surface, FaceStrip strip);

}  // namespace remesh
