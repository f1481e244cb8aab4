//! \file
//! Self-intersections of the result, and which of them follow from the input's.
#pragma once

#include "agvd/mesh/closest_point.h"
#include "remesh/pipeline/remesh.h"

namespace remesh {
struct PlacedMesh;
}

namespace remesh::detail {

struct CurvedSurface;
struct StageContext;

using FacePairs = std::vector<std::pair<Index, Index>>;

//! Pairs of faces that intersect.
struct CrossingFaces {
    FacePairs all;
    //! Of these the ones that do not follow from the input's; empty if it has as many.
    FacePairs added;

    [[nodiscard]] CrossingCounts counts() const {
        return {static_cast<Index>(all.size()), static_cast<Index>(added.size())};
    }
};

//! Whether so many faces are bad, or pairs of faces intersect, that creases are in vain.
[[nodiscard]] inline bool are_too_many(std::size_t num_bad, std::size_t num_faces) {
    return 4 * num_bad > num_faces;
}

//! Whether faces intersect, and most of these pairs do not follow from the input's.
[[nodiscard]] inline bool are_mostly_added(const CrossingCounts& pairs) {
    return pairs.added > 0 && 2 * pairs.added >= pairs.all;
}

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

//! Pairs of faces at an edge that are folds (is_fold). Cost: O(n log n).
[[nodiscard]] FacePairs find_folds(const MeshView& mesh);

//! A triangle, mostly a segment with its second end twice, that holds all points which two
//! intersecting triangles have in common: of the two segments in the plane of the other the shorter
//! one, or the triangle of smaller area if they lie in one plane.
[[nodiscard]] std::array<Vec3, 3> crossing_triangle(const std::array<Vec3, 3>& a,
                                                    const std::array<Vec3, 3>& b);

//! Where the segments in which faces intersect lie: intersecting pairs of faces as triangles.
[[nodiscard]] TriangleMesh crossing_triangles(const MeshView& mesh, const FacePairs& pairs);

//! The pairs of faces that intersect farther from all these triangles than the longest edge of the
//! two. Cost: O(log #triangles) for each pair near one.
[[nodiscard]] FacePairs pairs_elsewhere(const ClosestPointTree& triangles, const MeshView& mesh,
                                        const FacePairs& pairs);

//! Self-intersections of the cleaned input. All meshes of a run share them.
struct InputCrossings {
    bool is_searched = false;
    bool is_welded = false;  //!< Sheets that meet at junctions did not count.
    Index num_pairs = 0;
    std::optional<ClosestPointTree> triangles;  //!< See crossing_triangles; unset: there are none.
    bool are_folds_searched = false;
    std::optional<ClosestPointTree> folds;  //!< The same of folds (is_fold).
};

//! Finds self-intersections, and those of the input as soon as a result has any.
class CrossingFinder {
public:
    //! \param curved, of_input, context  outlive this.
    CrossingFinder(const CurvedSurface& curved, InputCrossings& of_input,
                   const StageContext& context)
        : curved_(curved), of_input_(of_input), context_(context) {}

    //! Intersecting faces, and folds (is_fold) where the input has none. Sheets that meet at a
    //! junction do not count.
    //! \return unset without CGAL.
    //! Cost: that of find_self_intersections.
    [[nodiscard]] std::optional<FacePairs> find(const PlacedMesh& mesh);
    //! Tells which of them are added.
    [[nodiscard]] CrossingFaces tell_added(const PlacedMesh& mesh, FacePairs all);

private:
    void add_folds(const MeshView& mesh, FacePairs& pairs);
    void find_in_input();

    const CurvedSurface& curved_;
    InputCrossings& of_input_;
    const StageContext& context_;
};

//! Moves vertices of intersecting triangles back onto the surface, in a few rounds.
//! \return the pairs that still intersect; unset without CGAL.
std::optional<CrossingFaces> unfit_crossings(CrossingFinder& finder, PlacedMesh& mesh,
                                             RemeshResult& result);

//! The number of intersecting pairs of faces of which at least one is marked.
//! \param is_marked  #F: other than 0 for marked faces, of which there is one.
//! \return unset without CGAL.
//! Cost: O(#F), and that of find_self_intersections for the faces near the marked ones.
[[nodiscard]] std::optional<Index> count_crossings_at(const MeshView& mesh,
                                                      std::span<const std::uint8_t> is_marked,
                                                      int num_threads, const Progress& progress);

}  // namespace remesh::detail
