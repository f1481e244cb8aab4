//! \file
//! Steps that improve the triangles of an edited mesh, and what they gain. Private to mending.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "remesh/placement/edited_mesh.h"

namespace remesh::detail {

//! A split or a collapse of the edge from corner k of a face to the next.
struct ShapeEdit {
    Index face = no_index, k = 0;
    bool is_split = false;
    bool is_reversed = false;  //!< A collapse removes the second end, not the first.
};

//! The gain of the triangles touched since a mark, each counted up to the wanted quality.
struct ShapeGain {
    double worst = 0, sum = 0;
    bool is_all = false;  //!< All have the wanted quality.
};

//! Improves triangles below a wanted quality by flips and slides, and keeps a budget of slides.
class ShapeSteps {
public:
    //! \param mesh, ticker  outlive this.
    //! \param num_faces     of the surface: small faces make slides long.
    //! \param wanted        triangles below this shape_quality() are bad.
    ShapeSteps(EditedMesh& mesh, Index num_faces, double wanted, Ticker& ticker);

    //! From now on at most so many slides are done. Initially none.
    void allow_slides(std::size_t count) { slides_left_ = count; }

    //! Whether a face is there, below the wanted quality, and has a vertex that may move.
    [[nodiscard]] bool is_bad(Index face) const;
    //! The bad faces with their qualities, the worst first.
    [[nodiscard]] std::vector<std::pair<double, Index>> bad_faces() const;
    [[nodiscard]] ShapeGain gain_since(const EditedMesh::Mark& mark);
    //! The lowest quality of the triangles touched since.
    [[nodiscard]] double worst_since(const EditedMesh::Mark& mark);

    //! Takes a step that makes the worst triangle it touches better.
    //! \return false if there is none.
    bool improve(Index face);
    //! Improves the bad triangles among those touched since, as long as that helps.
    void relax(const EditedMesh::Mark& mark);
    //! Splits or collapses, then relaxes.
    //! \return false if the edge cannot be edited; the mesh has not changed then.
    bool edit(const ShapeEdit& edit);
    //! Moves a vertex towards the mean of its neighbours if no triangle around it gets worse.
    bool move_to_mean(Index vertex);

private:
    // Directions in which a vertex may go, and the mean length of the edges around it.
    struct Ways {
        std::vector<Vec3> steps;  // Unit.
        Vec3 to_mean = Vec3::Zero();
        double length = 0;
    };

    // The bad ones of some faces, the worst first.
    [[nodiscard]] std::vector<std::pair<double, Index>> bad_among(
        std::span<const Index> faces) const;
    [[nodiscard]] Ways ways_of(Index v) const;
    bool try_flip(Index f, Index k);
    bool slide(Index v);

    EditedMesh& mesh_;
    Ticker& ticker_;
    const double wanted_;
    const std::size_t crossings_of_slide_;
    std::size_t slides_left_ = 0;
    std::vector<Index> changed_;  // Scratch.
    std::vector<double> before_;  // Scratch.
};

}  // namespace remesh::detail
