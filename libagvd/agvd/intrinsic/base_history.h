//! \file
//! What has happened between the input and the base. Private to intrinsic.
#pragma once

#include <vector>

#include "agvd/core/poller.h"
#include "agvd/intrinsic/face_history.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"

namespace agvd::detail {

//! First flat vertices went, then edges were flipped and split.
class BaseHistory {
public:
    explicit BaseHistory(Index num_faces) : removal(num_faces), flips(num_faces) {}

    FaceHistory removal;
    FaceHistory flips;

    //! To be called between the two, if vertices went: remembers which faces are flat in space.
    //! \param reduced  the surface that is left, without gaps.
    void end_removal(const Surface& reduced, Ticker& ticker);

    [[nodiscard]] bool is_changed(Index face) const {
        return flips.is_changed(face) || removal.is_changed(face);
    }
    [[nodiscard]] SurfacePoint forward(const SurfacePoint& point) const {
        return flips.forward(removal.forward(point));
    }
    [[nodiscard]] SurfacePoint backward(const SurfacePoint& point) const {
        return removal.backward(flips.backward(point));
    }
    //! As FaceHistory's.
    void forward(const FaceSegment& segment, std::vector<FaceSegment>& parts) const;
    void backward(const FaceSegment& segment, std::vector<FaceSegment>& parts) const;

    //! See IntrinsicTriangulation::parts_of(). A part is not cut further where a face that was left
    //! when vertices had gone lies in one plane: 1.4 M faces that were split in four twice have a
    //! hundredth of the parts.
    [[nodiscard]] bool parts_of(const Surface& input, Index face,
                                std::vector<InputPart>& parts) const;

private:
    [[nodiscard]] bool is_flat(Index reduced_face) const {
        return reduced_face < flat_area_.size() && flat_area_[reduced_face] > 0;
    }

    // By face that is left when vertices have gone: its area where it was changed, but lies in one
    // plane of the input; else 0.
    std::vector<double> flat_area_;
};

//! The sides of a face are as long in space as on the surface: they lie on it, and between them no
//! surface is as small as the triangle but itself.
[[nodiscard]] bool is_flat_in_space(const Surface& surface, Index face);

}  // namespace agvd::detail
