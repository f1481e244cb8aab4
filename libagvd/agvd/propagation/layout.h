//! \file
//! The surface stored for walks from face to face and for shortest paths along arcs: what a step
//! reads is stored side by side.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"

namespace agvd {

//! The corner at the tail of a half-edge. 32 bytes, so that a face lies in two cache lines.
struct alignas(32) Corner {
    Vec2 turn;      //!< Turns and stretches the half-edge into the other edge of the corner.
    double length;  //!< Of the half-edge.
    Index twin;
    Index tail;
};

//! The corners of all half-edges, with the functions of Surface that walks need.
class Corners {
public:
    //! Cost: O(#H) time and space.
    Corners(const Surface& surface, int num_threads, const Progress& progress = {});

    //! The same with cuts, which nothing crosses.
    //! \param cut  half-edges; both sides of an edge are to be named.
    [[nodiscard]] Corners cut_along(std::span<const Index> cut) const;

    [[nodiscard]] const Corner& operator[](Index h) const { return corners_[h]; }
    [[nodiscard]] Index tail(Index h) const { return corners_[h].tail; }
    [[nodiscard]] Index head(Index h) const { return corners_[Surface::next(h)].tail; }
    [[nodiscard]] Index twin(Index h) const { return corners_[h].twin; }
    [[nodiscard]] double length(Index h) const { return corners_[h].length; }
    //! Mean length of the half-edges.
    [[nodiscard]] double mean_length() const { return mean_length_; }
    //! In the frame of h.
    [[nodiscard]] Vec2 apex(Index h) const { return corners_[h].turn * corners_[h].length; }
    [[nodiscard]] Index apex_vertex(Index h) const { return corners_[Surface::previous(h)].tail; }

    //! Starts to load a face that will be read soon. Functions that only prefetch must be inlined
    //! by force: g++ drops calls to them, since they change nothing.
    [[gnu::always_inline]] void prefetch(Index face) const {
        __builtin_prefetch(&corners_[3 * std::size_t{face}]);
        __builtin_prefetch(&corners_[3 * std::size_t{face} + 2]);
    }

    [[nodiscard]] std::size_t bytes() const { return num_half_edges_ * sizeof(Corner); }

private:
    Corners() = default;

    std::size_t num_half_edges_ = 0;
    double mean_length_ = 0;
    std::unique_ptr<Corner[]> corners_;  // A vector would write everything twice.
};

//! Edges, and straight lines between the apexes of two neighbouring faces where these cross the
//! shared edge. Lengths are floats, rounded up by more than the rounding of any path along them.
struct ArcGraph {
    struct Arc {
        Index head;
        float length;
    };
    std::vector<Index> offsets;  //!< #V + 1
    std::vector<Index> ends;  //!< #V: the arcs of v are [offsets[v], ends[v]); the rest is empty.
    //! offsets.back() arcs; those of a vertex in any order. This is not a vector because a vector
    //! would write everything twice, the first time on one thread.
    std::unique_ptr<Arc[]> arcs;

    //! Cost: O(#H) time and space.
    ArcGraph(const Surface& surface, const Corners& corners, int num_threads,
             const Progress& progress = {});

    //! Starts to load the arcs of a vertex, which will be read soon.
    [[gnu::always_inline]] void prefetch(Index tail) const {
        __builtin_prefetch(arcs.get() + offsets[tail]);
        __builtin_prefetch(arcs.get() + offsets[tail] + 8);
    }
    [[nodiscard]] std::size_t bytes() const {
        return offsets.back() * sizeof(Arc) +
               (offsets.capacity() + ends.capacity()) * sizeof(Index);
    }
};

}  // namespace agvd
