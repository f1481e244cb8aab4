//! \file
//! What the faces of an intrinsic triangulation hold of the input, in space.
#pragma once

#include <vector>

#include "agvd/intrinsic/intrinsic_triangulation.h"

namespace agvd {

//! A part of the input's surface, taken as flat.
struct SurfacePiece {
    Vec3 position;  //!< A point of it.
    Vec3 vector;    //!< Its normal, as long as its area.
};

//! Faces that are the input's own are one piece each, and so are changed faces whose sides are as
//! long in space as on the surface: these are flat. Other changed faces are bent in space: its
//! pieces are points spread evenly over it, each for an equal share of the area, with the normal of
//! the input there. Immutable; threads may share it.
class FacePieces {
public:
    //! \param base        outlives this.
    //! \param piece_area  of a face of needles one piece for each so much area, up to 16; > 0.
    //! Cost: a map to the input for each piece of a changed face; 48 bytes.
    //! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
    //! \throw Cancelled  the progress callback returned false.
    FacePieces(const IntrinsicTriangulation& base, double piece_area, int num_threads = 0,
               const Progress& progress = {});

    //! Calls each(SurfacePiece) for the pieces of a face of base.surface().
    template <typename Each>
    void for_each(Index face, const Each& each) const {
        if (face >= begin_.size() || begin_[face] == no_index) {
            each(whole(input_, face));
            return;
        }
        Index i = begin_[face];
        do {
            each(pieces_[i]);
        } while (is_last_[i++] == 0);
    }

private:
    [[nodiscard]] static SurfacePiece whole(const Surface& surface, Index face);

    const Surface& input_;
    std::vector<Index> begin_;           // By face, if any is changed; no_index: the input's own.
    std::vector<SurfacePiece> pieces_;   // Of changed faces.
    std::vector<std::uint8_t> is_last_;  // By piece: of its face.
};

}  // namespace agvd
