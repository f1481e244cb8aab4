//! \file
//! How far a result lies from the original surface.
#pragma once

#include <algorithm>
#include <optional>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! `{}` gives the defaults.
struct DistanceOptions {
    Index samples = 200'000;  //!< On each of the two surfaces, >= 1; vertices are added.
    int num_threads = 0;      //!< >= 0; 0: all cores. Any number gives the same bytes.
    Progress progress = {};   //!< Polled during the call; see poll.
};

//! From one surface to the closest points of another, mesh units.
struct OneSidedDistance {
    double mean = 0;  //!< Over the area: from the samples alone.
    double rms = 0;   //!< Likewise.
    double max = 0;   //!< Over samples and vertices.
};

//! Lengths in mesh units.
struct SurfaceDistance {
    OneSidedDistance from_original;  //!< From points of the original to the result.
    OneSidedDistance from_result;    //!< From points of the result to the original.
    double diagonal = 0;             //!< Of the box around the original's faces.
    Index samples = 0;               //!< On each surface, without the vertices.
    //! Faces of the result whose normal points against (more than a right angle away from) the
    //! normal of the original's face closest to their centroid.
    Index flipped_faces = 0;

    //! Lengths as percentages of the diagonal.
    [[nodiscard]] OneSidedDistance percent_of_diagonal(const OneSidedDistance& d) const {
        return {100 * d.mean / diagonal, 100 * d.rms / diagonal, 100 * d.max / diagonal};
    }
    //! The larger of the two sides, for mean, RMS and max each (so `max` is the Hausdorff
    //! distance).
    [[nodiscard]] OneSidedDistance two_sided() const {
        return {std::max(from_original.mean, from_result.mean),
                std::max(from_original.rms, from_result.rms),
                std::max(from_original.max, from_result.max)};
    }
};

//! Compares two surfaces by stratified area-uniform samples and by their vertices. Faces without
//! area are skipped.
//!
//! \return unset in a build without CGAL, whose AABB tree finds the closest points.
//! \throw InvalidOption  samples < 1 or num_threads < 0.
//! \throw InvalidInput   no face of a mesh has area.
//! \throw Cancelled      the progress callback returned false.
//! Cost: O((samples + n) log n), about 2 us a sample.
[[nodiscard]] std::optional<SurfaceDistance> surface_distance(const MeshView& original,
                                                              const MeshView& result,
                                                              const DistanceOptions& options = {});

}  // namespace remesh
