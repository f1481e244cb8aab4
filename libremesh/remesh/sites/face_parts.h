//! \file
//! Faces shared out among threads that add up what labels hold of the surface.
#pragma once

#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Labels count off by part; a part has the faces with a corner of its labels, ascending. So sums
//! of labels run in the order of the faces, whatever the number of threads.
//! One part, for one thread, needs no list.
class FaceParts {
public:
    //! \param label        #V of the surface; no_index: none. Outlives this, as `surface`.
    //! \param num_threads  >= 0; 0: all cores.
    //! Cost: O(#F); 4 bytes for each part of a face.
    FaceParts(const Surface& surface, std::span<const Index> label, int num_threads,
              Poller& poller);

    [[nodiscard]] Index count() const { return count_; }
    [[nodiscard]] bool has(Index part, Index label) const {
        return label != no_index && (label & (count_ - 1)) == part;
    }
    template <typename Each>
    void for_each_face(Index part, const Each& each) const {
        if (count_ == 1) {
            for (Index f = 0; f < num_faces_; ++f) each(f);
            return;
        }
        for (Index i = begin_[part]; i < begin_[part + 1]; ++i) each(faces_[i]);
    }

private:
    Index count_;  // A power of two.
    Index num_faces_;
    std::vector<Index> begin_;  // By part, and the end.
    std::vector<Index> faces_;
};

}  // namespace remesh::detail
