//! \file
//! The count of vertices while triangles are mended. Private to mending.
#pragma once

#include <queue>
#include <tuple>
#include <vector>

#include "remesh/placement/shape_steps.h"

namespace remesh::detail {

//! Collapses leave spare vertices, splits need them. Balances the count by edits elsewhere.
class SpareVertices {
public:
    //! \param mesh, steps, ticker  outlive this.
    //! \param wanted  of `steps`: all triangles that edits touch here keep at least this quality.
    SpareVertices(EditedMesh& mesh, ShapeSteps& steps, double wanted, Ticker& ticker)
        : mesh_(mesh), steps_(steps), ticker_(ticker), wanted_(wanted) {}

    //! Begins at 0.
    //! \param elsewhere  least quality of triangles, before and after, where collapse_one()
    //!                   removes a vertex.
    void restart(double elsewhere);

    //! Vertices that were removed and not yet added elsewhere; below 0: to be removed.
    [[nodiscard]] int count() const { return count_; }
    //! Counts a split (-1) or a collapse (+1) of the caller.
    void add(int change) { count_ += change; }

    //! Removes a vertex where triangles stay good, by the best collapses first.
    //! \return false if there is none. Cost: O(#triangles log #triangles) for the first call after
    //! restart().
    bool collapse_one();
    //! Splits long edges or removes vertices until the count is 0.
    //! \return false if that fails. Cost: O(log #edges) and a trial for each edge and each change.
    bool balance();

private:
    struct Candidate {
        double quality;
        Index gone, into;
        [[nodiscard]] bool operator<(const Candidate& other) const {
            return std::tie(quality, gone, into) < std::tie(other.quality, other.gone, other.into);
        }
    };

    struct LongEdge {
        double square;  // Of its length.
        Index face, k;
        // The longest one is on top of a heap; of equal ones the first.
        [[nodiscard]] bool operator<(const LongEdge& other) const {
            return square != other.square ? square < other.square
                                          : std::tie(face, k) > std::tie(other.face, other.k);
        }
    };

    void prune();
    void list_collapses();
    void push_edges(Index face);
    [[nodiscard]] double quality_of_middle(Index a, Index b) const;
    bool split_one();

    EditedMesh& mesh_;
    ShapeSteps& steps_;
    Ticker& ticker_;
    const double wanted_;
    double elsewhere_ = 0;
    int count_ = 0;
    bool has_collapses_ = false, has_edges_ = false;
    std::vector<Candidate> collapses_;  // The best one last.
    // Edges to split. One that could not be split comes back when its face changes.
    std::priority_queue<LongEdge> edges_;
    std::vector<Index> changed_;
    std::vector<double> before_;
};

}  // namespace remesh::detail
