//! \file
//! Faces in a row, from one surface point to another: which way round a path goes.
#pragma once

#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_point.h"

namespace remesh {

//! Half-edge i is crossed out of its face, into the face of the next. All paths through one strip
//! pass every vertex on the same side; a face may come twice.
struct FaceStrip {
    agvd::SurfacePoint source;           //!< Seen from the face of the first half-edge.
    agvd::SurfacePoint target;           //!< Seen from the face across the last one; without any,
                                         //!< from the face of the source.
    std::vector<agvd::Index> crossed{};  //!< None on the boundary.
};

//! Crosses one more half-edge, or takes the last crossing back.
void cross(const agvd::Surface& surface, agvd::Index half_edge, std::vector<agvd::Index>& crossed);

//! The same strip from its target to its source.
[[nodiscard]] FaceStrip reversed(const agvd::Surface& surface, const FaceStrip& strip);

//! From the source of `first` to the target of `second`, which starts where `first` ends.
[[nodiscard]] FaceStrip joined(const agvd::Surface& surface, const FaceStrip& first,
                               const FaceStrip& second);

//! A point that lies on a vertex or an edge up to rounding (see agvd::vertex_of), exactly there.
[[nodiscard]] agvd::SurfacePoint snapped(const agvd::Surface& surface,
                                         const agvd::SurfacePoint& point);

//! Drops crossings of edges on which the source or the target lies.
void trim(const agvd::Surface& surface, FaceStrip& strip);

//! Whether the point lies in the face, on its edges or at its corners.
[[nodiscard]] bool holds(const agvd::Surface& surface, agvd::Index face,
                         const agvd::SurfacePoint& point);

//! Builds a strip along points of which each shares a face with the next. Where that face has the
//! next one at several places, it goes to the nearest.
class StripBuilder {
public:
    StripBuilder(const agvd::Surface& surface, const agvd::SurfacePoint& source);
    //! Goes on where `strip` ends.
    StripBuilder(const agvd::Surface& surface, FaceStrip strip);

    //! Goes on to `vertex`, which shares a face with where the strip has come to.
    void to_vertex(agvd::Index vertex);
    //! Goes into `face`, which holds what the strip has come to; at one corner of several.
    void to_face(agvd::Index face);
    //! Ends at `target`, which shares a face with where the strip has come to.
    [[nodiscard]] FaceStrip finish(const agvd::SurfacePoint& target);
    //! The same; the strip `onwards` starts where this one has come to.
    [[nodiscard]] FaceStrip finish(const FaceStrip& onwards);

private:
    template <typename IsGoal>
    void turn_to(const IsGoal& is_goal);

    const agvd::Surface& surface_;
    FaceStrip strip_;
    agvd::SurfacePoint here_;  // The last point, seen from the face that the strip has come to.
};

}  // namespace remesh
