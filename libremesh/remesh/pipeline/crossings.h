//! \file
//! Self-intersections of the result.
#pragma once

#include "remesh/pipeline/whole_mesh.h"

namespace remesh::detail {

//! Pairs of faces that intersect; unset without CGAL.
using CrossingFaces = std::optional<std::vector<std::pair<agvd::Index, agvd::Index>>>;

//! Calls each(vertex) for the corners of the faces of each pair.
template <typename Each>
void for_each_corner(const std::vector<std::pair<agvd::Index, agvd::Index>>& pairs,
                     const std::vector<agvd::Triangle>& triangles, const Each& each) {
    for (const auto& [f, g] : pairs) {
        for (const agvd::Index face : {f, g}) {
            for (const agvd::Index v : triangles[face]) each(v);
        }
    }
}

//! Finds self-intersections, and counts those of the input as soon as a result has any.
class CrossingFinder {
public:
    //! \param domain, context  outlive this.
    CrossingFinder(const Domain& domain, const StageContext& context)
        : domain_(domain), context_(context) {}

    //! Faces of placed.mesh. Sheets that meet at a junction do not count.
    //! Cost: that of find_self_intersections.
    [[nodiscard]] CrossingFaces find(const PlacedDual& placed);

private:
    void count_in_input();

    const Domain& domain_;
    const StageContext& context_;
    bool has_counted_input_ = false;
};

//! Whether a result has so many more intersecting pairs of faces than the input that more sites
//! would not help: more than one for four samples. Meshes with spikes are of this kind; all rounds
//! and attempts took an armadillo with spikes minutes, and it still had a pair for each sample.
//!
//! \param num_pairs  of the result.
[[nodiscard]] bool is_hopeless(std::size_t num_pairs, const StageContext& context);

//! Moves vertices of intersecting triangles back onto the surface, in a few rounds.
//! \return the pairs that still intersect.
CrossingFaces unfit_crossings(CrossingFinder& finder, const CurveSites& curves, PlacedDual& placed,
                              RemeshResult& result);

}  // namespace remesh::detail
