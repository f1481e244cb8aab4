//! \file
//! The parts of the input, in space, in the faces of an intrinsic triangulation.
#pragma once

#include <vector>

#include "agvd/intrinsic/intrinsic_triangulation.h"

namespace agvd {

//! A part of the input's surface, treated as flat.
struct SurfacePiece {
    Vec3 position;  //!< A point of it.
    Vec3 vector;    //!< Its normal; its length is the area.
};

//! A face of the input is one piece. So is a changed face whose sides are as long in space as on
//! the surface, since it is flat. Other changed faces are bent in space: their pieces are the parts
//! of the input's faces in them, or, where these are too many, evenly spread points with equal
//! shares of the area and the normals of the input. Immutable; threads may share it.
class FacePieces {
public:
    //! \param base        outlives this.
    //! \param piece_area  the area of a piece where a face holds many needles, > 0; such a face has
    //! at most 16 pieces.
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

    //! At least the number of pieces of all faces together.
    [[nodiscard]] std::size_t num_pieces_at_most() const { return num_faces_ + pieces_.size(); }

private:
    [[nodiscard]] static SurfacePiece whole(const Surface& surface, Index face);

    const Surface& input_;
    std::size_t num_faces_;
    std::vector<Index> begin_;           // By face, if any is changed; no_index: the input's own.
    std::vector<SurfacePiece> pieces_;   // Of changed faces.
    std::vector<std::uint8_t> is_last_;  // By piece: of its face.
};

}  // namespace agvd
