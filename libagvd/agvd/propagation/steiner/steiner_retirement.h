//! \file
//! Retirement of faces behind the front: their relays are made, and their Steiner points are given
//! back ([meng2023] Sec. 5.2).
#pragma once

#include <vector>

#include "agvd/propagation/steiner/steiner_relays.h"

namespace agvd {

//! Retires faces while the front proceeds. It works on the vertices and the pool of the
//! propagation.
class SteinerRetirement {
public:
    SteinerRetirement(const Surface& surface, const SitePlacement& placement,
                      const SteinerCounts& counts, const std::vector<SteinerNode>& vertices,
                      SteinerPool& pool)
        : surface_(surface),
          vertices_(vertices),
          pool_(pool),
          collector_(surface, placement, counts, vertices, pool),
          state_(surface.num_faces(), State::Untouched) {}

    //! To be called when the front has come to a face.
    void open(Index face) {
        if (state_[face] != State::Untouched) return;
        state_[face] = State::Open;
        open_.push_back(face);
    }

    //! Retires the open faces whose boundary is nearer than `front` by the bound
    //! d(x) <= (d(a) + d(b) + |e|) / 2 on an edge.
    void retire_behind(double front);

    //! Fills in the mixed faces and their relays. Faces retire in an order that depends on lambda;
    //! the result does not.
    void hand_over(Propagation& result) const;

    [[nodiscard]] std::size_t bytes() const {
        return state_.capacity() + open_.capacity() * sizeof(Index) +
               relays_.capacity() * sizeof(Relay) +
               (mixed_faces_.capacity() + relay_offsets_.capacity()) * sizeof(Index);
    }

private:
    enum class State : std::uint8_t { Untouched, Open, Retired };

    [[nodiscard]] bool is_behind(Index face, double front) const;
    void retire(Index face);

    const Surface& surface_;
    const std::vector<SteinerNode>& vertices_;
    SteinerPool& pool_;
    SteinerRelays collector_;
    std::vector<State> state_;  // #F
    std::vector<Index> open_;
    std::vector<Index> mixed_faces_;    // In the order of retirement.
    std::vector<Index> relay_offsets_;  // Where the relays of each mixed face begin.
    std::vector<Relay> relays_;
};

}  // namespace agvd
