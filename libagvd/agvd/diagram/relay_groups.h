//! \file
//! The relays of each mixed face, grouped by where their image lies.
#pragma once

#include <memory>

#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/diagram/stage_input.h"

namespace agvd {

//! Keeps nothing but indices into Propagation::relays: 4 bytes a relay.
class RelayGroups {
public:
    //! Parallel; O(relays of those faces). Keeps a reference.
    //! \param mixed  positions in mixed_faces: the faces whose groups will be read.
    RelayGroups(const Propagation& propagation, std::span<const Index> mixed, int num_threads,
                Poller& poller);

    //! The relays whose image lies across a half-edge of a mixed face. This group and the others
    //! keep the order of the relays.
    [[nodiscard]] std::span<const Index> across(Index mixed_index, Index half_edge) const {
        return group(mixed_index, half_edge % 3);
    }
    //! Those whose image lies in the face, but for its corners.
    [[nodiscard]] std::span<const Index> inside(Index mixed_index) const {
        return group(mixed_index, inside_group);
    }
    //! Those whose image is a corner of the face, the tail of their half-edge.
    [[nodiscard]] std::span<const Index> corners(Index mixed_index) const {
        return group(mixed_index, corner_group);
    }

    //! Always inline: g++ drops calls of functions that do nothing but prefetch.
    [[gnu::always_inline]] void prefetch(Index mixed_index) const {
        __builtin_prefetch(&begins_[stride * mixed_index]);
        __builtin_prefetch(&relays_[ranges_[mixed_index].begin]);
    }

private:
    static constexpr Index inside_group = 3, corner_group = 4, num_groups = 5;
    static constexpr Index stride = num_groups + 1;

    [[nodiscard]] std::span<const Index> group(Index mixed_index, Index group) const {
        const Index* const begin = &begins_[stride * mixed_index + group];
        return {&relays_[begin[0]], begin[1] - begin[0]};
    }

    std::span<const RelayRange> ranges_;  // By mixed face, in relays_ as in Propagation::relays.
    std::unique_ptr<Index[]> relays_;     // Face after face, group after group.
    std::unique_ptr<Index[]> begins_;     // Of the groups of each face, and the end of the last.
};

//! The relays of these faces and of their neighbours.
[[nodiscard]] RelayGroups group_relays_around(const StageInput& input, const EdgeLabels& labels,
                                              std::span<const Index> faces);

}  // namespace agvd
