//! \file
//! Texture coordinates of an input for its remesh.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/meshfile/texture_seams.h"

namespace remesh {

//! `{}` gives the defaults.
struct CornerOptions {
    int num_threads = 0;     //!< >= 0; 0: all cores.
    Progress progress = {};  //!< Polled during the call; see poll.
};

//! Texture coordinates for the corners of a result's faces. They are interpolated linearly in the
//! input's triangles, at the point nearest to the corner on that side of the seams on which the
//! face lies: that of the face's centroid, or, if other corners lie beyond a seam, the side that is
//! nearest to all three. So no face spans a jump of the coordinates, and faces on one side have the
//! same bits at their common corner. A face across a seam that is no edge of the result gets
//! coordinates of one side only: its corners beyond the seam get those at the seam. Without seams
//! each vertex has one value.
//!
//! \param values  #F of the input; NaN where a corner has none: so has what lies there.
//! \param places  where the result's vertices lie on the input: InputMap::vertices.
//! \return #F of the result.
//! \throw InvalidOption  num_threads < 0, or there is not one value for each face of the
//!        input or not one place for each vertex of the result.
//! \throw Cancelled      the progress callback returned false.
//! Cost: O(#F log #F) of the input; for each face of the result, if there are seams, 13 searches
//! over a quarter of its width.
[[nodiscard]] std::vector<CornerCoordinates> transfer_corner_values(
    std::span<const CornerCoordinates> values, const MeshView& input, const MeshView& result,
    std::span<const SurfacePoint> places, const CornerOptions& options = {});

}  // namespace remesh
