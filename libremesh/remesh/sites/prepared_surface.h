//! \file
//! A surface with the data derived from it once, for sites of a given spacing. What was reset is
//! found again as it was. Held by PreparedSurface.FindsThePiecesAgainThatWereReset in
//! tests/remesh/sites.
#pragma once

#include <optional>
#include <span>

#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/propagation/propagate.h"
#include "remesh/names.h"

namespace remesh {

class SizeField;

//! Labels, propagation and diagram use `base`; operations in space use its input.
struct PreparedSurface {
    //! \param input    outlives this.
    //! \param spacing  mean distance of the sites, > 0: the base's edges are not much longer, and
    //!        vertices without curvature not much closer. Infinity: its vertices are those of the
    //!        input.
    //! \param sizes  its lengths are counted in target lengths instead; not kept. Null: all equal.
    //! \throw Cancelled  the progress callback returned false.
    //! Cost: that of the base, and O(#F) for the rest. Some 280 bytes for each face of the base.
    PreparedSurface(const Surface& input, double spacing, int num_threads = 0,
                    const Progress& progress = {}, const SizeField* sizes = nullptr);
    //! The input would not outlive this.
    PreparedSurface(Surface&& input, double spacing, int num_threads = 0,
                    const Progress& progress = {}, const SizeField* sizes = nullptr) = delete;

    IntrinsicTriangulation base;  //!< On which distances are computed.
    double piece_area;            //!< As FacePieces takes it.
    //! Of the base's faces. May be reset where they are not needed for long: some 70 bytes a face.
    std::optional<FacePieces> pieces;
    SurfaceLayout layout;  //!< Of base.surface(). May be moved from when sites are final.

    //! The surface that was given.
    [[nodiscard]] const Surface& input() const { return base.input(); }
    //! Sets `pieces` if they were reset.
    //! \throw Cancelled  the progress callback returned false.
    void find_pieces(int num_threads, const Progress& progress = {});
};

//! The square root of the area for each site, mesh units.
[[nodiscard]] double mean_spacing(const Surface& surface, std::size_t num_sites);

}  // namespace remesh
