//! \file
//! A sequence of faces from one surface point to another. It fixes on which side a path passes
//! vertices.
#pragma once

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh {

//! A path leaves its face across half-edge i into the face of half-edge i + 1. All paths through
//! one strip pass every vertex on the same side; a face may occur twice.
struct FaceStrip {
    SurfacePoint source;           //!< Seen from the face of the first half-edge.
    SurfacePoint target;           //!< Seen from the face across the last one; without any,
                                   //!< from the face of the source.
    std::vector<Index> crossed{};  //!< None is on the boundary.
};

//! Appends a crossing of a half-edge, or undoes the last one if it is the reverse.
void cross(const Surface& surface, Index half_edge, std::vector<Index>& crossed);

//! The same strip from its target to its source.
[[nodiscard]] FaceStrip reversed(const Surface& surface, const FaceStrip& strip);

//! The strip from the source of `first` to the target of `second`, which starts where `first` ends.
[[nodiscard]] FaceStrip joined(const Surface& surface, const FaceStrip& first,
                               const FaceStrip& second);

//! Puts a point that lies on a vertex or an edge up to rounding (see vertex_of) exactly
//! there.
[[nodiscard]] SurfacePoint snapped(const Surface& surface, const SurfacePoint& point);

//! Drops crossings of edges on which the source or the target lies.
void trim(const Surface& surface, FaceStrip& strip);

//! Whether the point lies in the face, on its edges or at its corners.
[[nodiscard]] bool holds(const Surface& surface, Index face, const SurfacePoint& point);

//! Builds a strip along points, each of which shares a face with the next. If that face has the
//! next point at several places, the strip goes to the nearest.
class StripBuilder {
public:
    StripBuilder(const Surface& surface, const SurfacePoint& source);
    //! Continues from the end of `strip`.
    StripBuilder(const Surface& surface, FaceStrip strip);

    //! Continues to `vertex`, which shares a face with the current point.
    void to_vertex(Index vertex);
    //! Continues into `face`, which holds the current point; at one of its corners if at several.
    void to_face(Index face);
    //! Ends at `target`, which shares a face with the current point.
    [[nodiscard]] FaceStrip finish(const SurfacePoint& target);
    //! Appends the strip `onwards`, which starts at the current point.
    [[nodiscard]] FaceStrip finish(const FaceStrip& onwards);

private:
    template <typename IsGoal>
    void turn_to(const IsGoal& is_goal);

    const Surface& surface_;
    FaceStrip strip_;
    SurfacePoint here_;  // The current point, in the strip's last face.
};

}  // namespace remesh
