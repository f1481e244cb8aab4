//! \file
//! How far a result lies from the cleaned surface, and where it must be finer.
#pragma once

#include "agvd/mesh/closest_point.h"
#include "remesh/pipeline/cleaned_input.h"

namespace remesh::detail {

//! The distance of a result.
struct MeasuredDistance {
    double largest = 0;                     //!< Both ways; mesh units.
    agvd::Vec3 where = agvd::Vec3::Zero();  //!< A point of either surface that is so far.
};

//! Measures results of one surface. The search tree of the surface is built once.
class DistanceCheck {
public:
    //! \param mesh  the cleaned mesh; copied.
    //! Cost: O(n log n).
    DistanceCheck(agvd::MeshView mesh, int num_threads, const agvd::Progress& progress);

    //! The largest distance at all vertices and at 100 000 points of each surface.
    //!
    //! \param limit  where the distance is near it or above, lengths are lowered;
    //! \param most_lengths  #V of the cleaned mesh: at most so long are edges there. Edited.
    //! \throw agvd::Cancelled  the progress callback returned false.
    //! Cost: O((n + 100 000) log n).
    [[nodiscard]] MeasuredDistance measure(const agvd::MeshView& result, double limit,
                                           std::vector<double>& most_lengths) const;

private:
    agvd::TriangleMesh mesh_;
    agvd::ClosestPointTree tree_;
    int num_threads_;
    agvd::Progress progress_;
};

}  // namespace remesh::detail
