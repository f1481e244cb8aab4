//! \file
//! Locally shortest paths over the surface, from any path.
#pragma once

#include "agvd/core/poller.h"
#include "remesh/dual/face_strip.h"

namespace remesh {

//! A path on the surface.
struct GeodesicPath {
    double length = 0;  //!< Mesh units; of this very path up to rounding.
    //! On both sides of every vertex that the path touches between its ends lies an angle of at
    //! least pi (less 1e-7), or the boundary; elsewhere it is straight. False: the rounds were not
    //! enough, or rounding hides whether a vertex is better passed on its other side.
    bool is_locally_shortest = false;
    //! The source, then where the path crosses edges or touches vertices, then the target; each
    //! shares a face with the next. Only of straightest_path().
    std::vector<agvd::SurfacePoint> points{};
};

//! Straightens paths one after the other. Keeps its memory; one for each thread.
//!
//! The shortest path inside the strip comes from a funnel ([lee1984]). Where it bends at a vertex
//! that has less than pi on the other side, the strip goes round that side instead, which is
//! shorter, until there is no such vertex ([xin2007]).
class PathStraightener {
public:
    //! \param ticker  of the thread; where it throws Cancelled, the strip is of no use any more.
    explicit PathStraightener(const agvd::Surface& surface, agvd::Ticker ticker = {})
        : surface_(surface), ticker_(ticker) {}

    //! Replaces the strip by one of a locally shortest path, never a longer one.
    //!
    //! \return without points.
    //! Cost: O(#crossed + degrees of the vertices passed) a round; one to three rounds for ten
    //! crossings are usual, at most 500 and one for each crossing are made.
    GeodesicPath straighten(FaceStrip& strip);

    //! The shortest path inside the strip as it is, with its points.
    [[nodiscard]] GeodesicPath shortest_in(FaceStrip strip);

private:
    // A vertex of the unfolded strip (or the source, or the target).
    struct Node {
        agvd::Vec2 place;
        agvd::Index parent;  // The node before it on the shortest path from the source.
        agvd::Index first;   // The first of the crossings of which it is an end;
        agvd::Index last;    // the last one.
        bool is_left;
    };
    // Ends of a crossed edge in the plane of the unfolded strip.
    struct Ends {
        agvd::Vec2 left, right;
    };

    [[nodiscard]] double find_shortest(const FaceStrip& strip);
    void unfold(const FaceStrip& strip);
    void add_to_funnel(agvd::Index node);
    [[nodiscard]] double collect_path();
    [[nodiscard]] bool reroute(const std::vector<agvd::Index>& crossed);
    struct Detour {
        bool is_shorter;
        agvd::Index last;  // The last crossing that it replaces.
    };
    [[nodiscard]] Detour find_detour(const std::vector<agvd::Index>& crossed, agvd::Index bend);
    [[nodiscard]] agvd::Vec2 apex_of(agvd::Index half_edge, const agvd::Vec2& tail,
                                     const agvd::Vec2& head) const;

    const agvd::Surface& surface_;
    agvd::Ticker ticker_;
    std::vector<Node> nodes_;  // The source, both ends of the first crossing, one for each more;
                               // then the target.
    std::vector<Ends> ends_;   // Of each crossing.
    std::vector<agvd::Index> funnel_;  // Left end, ..., apex, ..., right end: [begin_, end_).
    agvd::Index begin_ = 0, end_ = 0, apex_ = 0;
    std::vector<agvd::Index> path_;     // Nodes from the source to the target.
    std::vector<agvd::Index> detour_;   // Crossings on the other side of a bend.
    std::vector<agvd::Index> crossed_;  // Of the next round.
    FaceStrip best_;                    // Of the shortest path so far.
};

//! The straightened path through the strip's way round the surface, with its points.
//!
//! Cost: see PathStraightener.
[[nodiscard]] GeodesicPath straightest_path(const agvd::Surface& surface, FaceStrip strip);

}  // namespace remesh
