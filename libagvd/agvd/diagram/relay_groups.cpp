#include "agvd/diagram/relay_groups.h"

#include <algorithm>
#include <utility>

#include "agvd/core/parallel.h"

namespace agvd {

RelayGroups::RelayGroups(const Propagation& propagation, std::span<const Index> mixed,
                         int num_threads, Poller& poller)
    : ranges_(propagation.relay_ranges) {
    constexpr Index grain = 512;
    const auto num_mixed = static_cast<Index>(propagation.mixed_faces.size());
    relays_ = std::make_unique_for_overwrite<Index[]>(propagation.relays.size());
    begins_ = std::make_unique_for_overwrite<Index[]>(std::size_t{stride} * num_mixed);
    const auto count = static_cast<Index>(mixed.size());
    const auto group_chunk = [&](Index, Index begin, Index end) {
        std::vector<Index> groups;
        for (const Index i : mixed.subspan(begin, end - begin)) {
            const Index first_half_edge = 3 * propagation.mixed_faces[i];
            const std::span<const Relay> relays = relays_of(propagation, i);
            std::array<Index, num_groups> next{};
            groups.clear();
            for (const Relay& r : relays) {
                const Index inner = r.x == 0 && r.y == 0 ? corner_group : inside_group;
                groups.push_back(r.y < 0 ? r.half_edge - first_half_edge : inner);
                ++next[groups.back()];
            }
            const Index first = ranges_[i].begin;
            Index place = first;
            for (Index g = 0; g < num_groups; ++g) {
                begins_[stride * i + g] = place;
                place += std::exchange(next[g], place);
            }
            begins_[stride * i + num_groups] = place;
            for (Index r = 0; r < relays.size(); ++r) {
                relays_[next[groups[r]]++] = first + r;
            }
        }
    };
    parallel_chunks(count, grain, num_threads, group_chunk, poller);
}

RelayGroups group_relays_around(const StageInput& input, const EdgeLabels& labels,
                                std::span<const Index> faces) {
    std::vector<Index> all(faces.begin(), faces.end());
    for (const Index face : faces) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Index twin = input.surface.twin[h];
            if (twin != no_index) all.push_back(Surface::face(twin));
        }
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return {input.propagation, positions_of(labels, all), input.num_threads, input.poller};
}

}  // namespace agvd
