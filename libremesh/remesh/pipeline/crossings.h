//! \file
//! Self-intersections of the result.
#pragma once

#include "remesh/pipeline/crossing_places.h"
#include "remesh/pipeline/whole_mesh.h"

namespace remesh::detail {

//! Pairs of faces that intersect.
struct CrossingFaces {
    FacePairs all;
    //! Of these the ones that do not follow from the input's; empty if it has as many.
    FacePairs fresh;

    [[nodiscard]] CrossingCounts counts() const {
        return {static_cast<Index>(all.size()), static_cast<Index>(fresh.size())};
    }
};

//! Calls each(vertex) for the corners of the faces of each pair.
template <typename Each>
void for_each_corner(const FacePairs& pairs, const std::vector<Triangle>& triangles,
                     const Each& each) {
    for (const auto& [f, g] : pairs) {
        for (const Index face : {f, g}) {
            for (const Index v : triangles[face]) each(v);
        }
    }
}

//! Finds self-intersections, and those of the input as soon as a result has any.
class CrossingFinder {
public:
    //! \param domain, context  outlive this.
    CrossingFinder(const Domain& domain, const StageContext& context)
        : domain_(domain), context_(context) {}

    //! Faces of placed.mesh. Sheets that meet at a junction do not count.
    //! \return unset without CGAL.
    //! Cost: that of find_self_intersections.
    [[nodiscard]] std::optional<CrossingFaces> find(const PlacedDual& placed);
    //! The first step of find(): all pairs.
    [[nodiscard]] std::optional<FacePairs> find_all(const PlacedDual& placed);
    //! The second one: tells which of them are fresh.
    [[nodiscard]] CrossingFaces tell_fresh(const PlacedDual& placed, FacePairs all);

private:
    void find_in_input();

    const Domain& domain_;
    const StageContext& context_;
    bool has_searched_input_ = false;
    std::optional<CrossingPlaces> input_places_;  // Unset: there are none.
};

//! Whether a result has so many more intersecting pairs of faces than the input that more sites
//! would not help: more than one for four samples. Meshes with spikes are of this kind; all rounds
//! and attempts took an armadillo with spikes minutes, and it still had a pair for each sample.
//!
//! \param num_pairs  of the result.
[[nodiscard]] bool is_hopeless(std::size_t num_pairs, const StageContext& context);

//! Moves vertices of intersecting triangles back onto the surface, in a few rounds.
//! \return the pairs that still intersect; unset without CGAL.
std::optional<CrossingFaces> unfit_crossings(CrossingFinder& finder, const CurveSites& curves,
                                             PlacedDual& placed, RemeshResult& result);

}  // namespace remesh::detail
