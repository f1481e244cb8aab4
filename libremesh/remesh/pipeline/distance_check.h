//! \file
//! How far a result lies from the cleaned surface, and where it must be finer.
#pragma once

#include "agvd/mesh/closest_point.h"
#include "remesh/pipeline/cleaned_input.h"

namespace remesh::detail {

//! The distance of a result.
struct MeasuredDistance {
    double largest = 0;         //!< Both ways, at the points looked at; mesh units.
    bool is_within = false;     //!< Proved: no point of either surface is too far.
    Vec3 where = Vec3::Zero();  //!< A point of either surface that is so far.
};

//! Measures results of one surface. The search tree of the surface is built once.
class DistanceCheck {
public:
    //! \param mesh  the cleaned mesh; copied.
    //! Cost: O(n log n).
    DistanceCheck(const MeshView& mesh, int num_threads, const Progress& progress);

    //! Measures at all vertices and at 100 000 points of each surface. If these are near enough,
    //! faces are divided until all of both surfaces is proved to be, or a point is found that is
    //! not.
    //!
    //! \param limit  where a point is near it or beyond, lengths are lowered.
    //! \param most_lengths  #V of the cleaned mesh: at most so long are edges there. Edited.
    //! \throw Cancelled  the progress callback returned false.
    //! Cost: O((n + 100 000) log n); for the proof about O((n + length of all edges / limit) log
    //! n).
    [[nodiscard]] MeasuredDistance measure(const MeshView& result, double limit,
                                           std::vector<double>& most_lengths,
                                           const Progress& progress = {}) const;

private:
    TriangleMesh mesh_;
    ClosestPointTree tree_;
    int num_threads_;
};

}  // namespace remesh::detail
