//! \file
//! Arcs of a diagram on the faces of another mesh of the same surface.
#pragma once

#include "agvd/diagram/conic.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"

namespace agvd {

//! A part of an arc in one face of the input.
struct InputSegment {
    SurfacePoint begin, end;    //!< In this face.
    Vec2 at_begin, at_end;      //!< In its own frame.
    Vec2 base_begin, base_end;  //!< In the frame of the base's face.

    //! From the frame of the base's face into that of the input's; exact at `begin`.
    [[nodiscard]] Motion motion() const;
};

[[nodiscard]] Conic moved(const Motion& motion, const Conic& conic);

//! Maps arcs piece by piece. Scratch memory is kept.
class ArcMapper {
public:
    explicit ArcMapper(const IntrinsicTriangulation& base) : base_(base), input_(base.input()) {}

    //! Appends the parts of an arc between two points of it. Points on edges of the input lie on
    //! the arc as well.
    //! \param conic  in the frame of the base's face.
    //! Cost: that of mapping the chord; where it and the arc cross other edges, of finer ones.
    void map(const Conic& conic, bool is_line, const SurfacePoint& begin, const SurfacePoint& end,
             std::vector<InputSegment>& out);

private:
    // Of a face of the base. What lies on its sides does so exactly.
    struct BasePoint {
        SurfacePoint point;
        Vec2 at;
    };
    void map_between(const BasePoint& begin, const BasePoint& end, int depth,
                     std::vector<InputSegment>& out);
    void cut(const BasePoint& begin, const BasePoint& end);
    [[nodiscard]] bool follow_arc();
    [[nodiscard]] bool move_crossing(InputSegment& before, InputSegment& behind) const;
    [[nodiscard]] bool stays_in_face(const InputSegment& segment) const;

    const IntrinsicTriangulation& base_;
    const Surface& input_;
    std::vector<SurfacePoint> points_;  // Two a part.
    std::vector<InputSegment> segments_;

    // The arc at hand.
    Conic conic_;
    bool is_line_ = false;
    Index face_ = 0;  // Of the base.
    int halvings_left_ = 0;
};

}  // namespace agvd
