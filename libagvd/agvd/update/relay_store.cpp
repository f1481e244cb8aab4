#include "agvd/update/relay_store.h"

#include <algorithm>

namespace agvd {

void RelayStore::replace(Index face, std::span<const Relay> relays, Index num_windows,
                         bool is_mixed, Propagation& result) {
    StoredFace& stored = faces_[face];
    const auto count = static_cast<Index>(relays.size());
    num_stored_ += count;
    num_stored_ -= stored.count;
    if (count > stored.room) {
        constexpr Index spare = 2;
        const bool is_new = stored.room == 0;
        stored.begin = static_cast<Index>(result.relays.size());
        stored.room = is_new ? count : count + spare;
        result.relays.resize(result.relays.size() + stored.room);
    }
    std::copy(relays.begin(), relays.end(), result.relays.begin() + stored.begin);
    stored.num_windows = num_windows;
    stored.count = count;
    stored.is_mixed = is_mixed;
}

void RelayStore::list_mixed_faces(std::span<const Index> faces, Propagation& result) {
    if (result.relays.size() > most_relays()) {
        close_gaps(result);
        return;
    }
    if (result.relays.capacity() < most_relays()) reserve(result.relays);
    mixed_faces_.clear();
    ranges_.clear();
    std::size_t old = 0;
    const auto keep_before = [&](Index face) {
        for (; old < result.mixed_faces.size() && result.mixed_faces[old] < face; ++old) {
            mixed_faces_.push_back(result.mixed_faces[old]);
            ranges_.push_back(result.relay_ranges[old]);
        }
    };
    for (const Index face : faces) {
        keep_before(face);
        if (old < result.mixed_faces.size() && result.mixed_faces[old] == face) ++old;
        const StoredFace& stored = faces_[face];
        if (!stored.is_mixed) continue;
        mixed_faces_.push_back(face);
        ranges_.push_back({stored.begin, stored.begin + stored.count});
    }
    keep_before(no_index);
    std::swap(result.mixed_faces, mixed_faces_);
    std::swap(result.relay_ranges, ranges_);
}

// Adds spare room, since the number of relays changes from update to update.
void RelayStore::reserve(std::vector<Relay>& relays) const {
    relays.reserve(most_relays() + most_relays() / 8);
}

void RelayStore::close_gaps(Propagation& result) {
    std::vector<Relay> relays;
    reserve(relays);
    result.mixed_faces.clear();
    result.relay_ranges.clear();
    for (Index face = 0; face < faces_.size(); ++face) {
        StoredFace& stored = faces_[face];
        const auto first = result.relays.begin() + stored.begin;
        stored.begin = static_cast<Index>(relays.size());
        stored.room = stored.count;
        relays.insert(relays.end(), first, first + stored.count);
        if (!stored.is_mixed) continue;
        result.mixed_faces.push_back(face);
        result.relay_ranges.push_back({stored.begin, stored.begin + stored.count});
    }
    result.relays = std::move(relays);
}

void RelayStore::renumber_sites(std::span<const SiteId> new_site, Propagation& result) const {
    for (const StoredFace& stored : faces_) {
        for (Index r = stored.begin; r < stored.begin + stored.count; ++r) {
            SiteId& site = result.relays[r].site;
            site = new_site[site.value()];
        }
    }
}

}  // namespace agvd
