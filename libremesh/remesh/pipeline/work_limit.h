//! \file
//! An end to further attempts.
#pragma once

#include <algorithm>
#include <cstddef>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Ends further attempts and rounds when they have cost a few times what a run usually costs. The
//! cost is counted, not timed, so that a run always ends in the same way.
class WorkLimit {
public:
    //! The limit of a run on a surface of so many faces.
    WorkLimit(std::size_t num_faces, std::size_t num_samples)
        : most_(std::max(least_most, usual_times * (num_faces + faces_per_sample * num_samples))) {}
    //! A limit that is spent from the start.
    [[nodiscard]] static WorkLimit spent() {
        WorkLimit limit(0, 0);
        limit.most_ = 0;
        return limit;
    }

    //! Counts one pass of stages over a base of so many faces: a relaxation, or cells.
    void add(Index base_faces) { done_ += base_faces; }
    //! \return what is counted so far, faces.
    [[nodiscard]] std::size_t done() const { return done_; }
    //! Counts an attempt that gave no mesh once more: the next one seldom gives a mesh either.
    //! \param done  what was counted before the attempt.
    void add_again(std::size_t done) { done_ += done_ - done; }
    //! Whether only what gives a result at all should follow.
    [[nodiscard]] bool is_spent() const { return done_ >= most_; }
    //! Passes that may still follow.
    [[nodiscard]] int num_left(Index base_faces) const {
        if (is_spent()) return 0;
        constexpr std::size_t enough = 1000;
        return static_cast<int>(std::min(enough, (most_ - done_) / std::max(base_faces, 1U)));
    }

private:
    // Small meshes may take longer in proportion.
    static constexpr std::size_t least_most = 800'000;
    static constexpr std::size_t usual_times = 4;
    static constexpr std::size_t faces_per_sample = 8;  // Of the base, if the input is coarse.

    std::size_t most_;
    std::size_t done_ = 0;
};

}  // namespace remesh::detail
