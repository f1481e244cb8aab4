#include "agvd/propagation/steiner/steiner_retirement.h"

#include <algorithm>
#include <numeric>

namespace agvd {

bool SteinerRetirement::is_behind(Index face, double front) const {
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const double bound = (vertices_[surface_.tail(h)].distance +
                              vertices_[surface_.head(h)].distance + surface_.length_of(h)) /
                             2;
        if (!(bound < front)) return false;
    }
    return true;
}

void SteinerRetirement::retire_behind(double front) {
    std::size_t kept = 0;
    for (const Index face : open_) {
        if (is_behind(face, front)) {
            retire(face);
        } else {
            open_[kept++] = face;
        }
    }
    open_.resize(kept);
}

void SteinerRetirement::retire(Index face) {
    state_[face] = State::Retired;
    if (collector_.is_mixed(face)) {
        mixed_faces_.push_back(face);
        relay_offsets_.push_back(static_cast<Index>(relays_.size()));
        collector_.collect(face, relays_);
    }
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const Index twin = surface_.twin[h];
        if (twin == no_index || state_[Surface::face(twin)] == State::Retired) {
            pool_.retire(surface_.edge[h]);
        }
    }
}

void SteinerRetirement::hand_over(Propagation& result) const {
    const auto count = static_cast<Index>(mixed_faces_.size());
    std::vector<Index> order(count);
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return mixed_faces_[a] < mixed_faces_[b]; });
    result.relays.reserve(relays_.size());
    result.mixed_faces.reserve(count);
    result.relay_ranges.reserve(count);
    for (const Index i : order) {
        result.mixed_faces.push_back(mixed_faces_[i]);
        const auto begin = static_cast<Index>(result.relays.size());
        const std::size_t end = i + 1 < count ? relay_offsets_[i + 1] : relays_.size();
        result.relays.insert(result.relays.end(), relays_.begin() + relay_offsets_[i],
                             relays_.begin() + static_cast<std::ptrdiff_t>(end));
        result.relay_ranges.push_back({begin, static_cast<Index>(result.relays.size())});
    }
}

}  // namespace agvd
