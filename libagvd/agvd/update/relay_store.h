//! \file
//! The relays of all faces, for updates that replace the relays of some faces.
#pragma once

#include <span>
#include <vector>

#include "agvd/propagation/relays.h"

namespace agvd {

//! Counts of the relays of one face.
struct StoredFace {
    Index begin = 0;
    Index num_windows = 0;  //!< Relays of windows; they come first.
    Index count = 0;        //!< All relays: those that start in the face come last.
    Index room = 0;
    bool is_mixed = false;
};

//! Keeps the relays, mixed faces and relay ranges of a Propagation. Faces stay where they are while
//! they have room, so that replacing some does not move the others.
class RelayStore {
public:
    explicit RelayStore(Index num_faces) : faces_(num_faces) {}

    //! Relays of windows of a face, mixed or not.
    [[nodiscard]] std::span<const Relay> windows(const Propagation& result, Index face) const {
        return std::span(result.relays).subspan(faces_[face].begin, faces_[face].num_windows);
    }
    //! Replaces the relays of a face. list_mixed_faces() must follow.
    void replace(Index face, std::span<const Relay> relays, Index num_windows, bool is_mixed,
                 Propagation& result);
    //! Brings the list of mixed faces up to date.
    //! \param faces  ascending: those that were replaced.
    //! Cost: O(#mixed), and O(relays) when gaps are closed.
    void list_mixed_faces(std::span<const Index> faces, Propagation& result);
    //! \param new_site  of every site that has relays.
    void renumber_sites(std::span<const SiteId> new_site, Propagation& result) const;

    //! Starts to load what replace() writes. Inlined by force, as Corners::prefetch().
    [[gnu::always_inline]] void prefetch_place(Index face) const {
        __builtin_prefetch(&faces_[face]);
    }
    [[gnu::always_inline]] void prefetch_relays(const Propagation& result, Index face) const {
        const Relay* const first = result.relays.data() + faces_[face].begin;
        for (Index r = 0; r < faces_[face].count; ++r) __builtin_prefetch(first + r);
    }

private:
    // At most half of the store is gaps.
    [[nodiscard]] std::size_t most_relays() const { return 2 * num_stored_ + 1024; }
    void reserve(std::vector<Relay>& relays) const;
    void close_gaps(Propagation& result);

    std::vector<StoredFace> faces_;
    std::size_t num_stored_ = 0;      // Relays, without gaps.
    std::vector<Index> mixed_faces_;  // Memory for the next list.
    std::vector<RelayRange> ranges_;
};

}  // namespace agvd
