#include "agvd/mesh/first_at_position.h"

#include <bit>

#include "agvd/core/position_hash.h"

namespace agvd {

std::vector<Index> first_at_position(std::span<const Vec3> positions, Ticker& ticker) {
    std::vector<Index> slots(std::bit_ceil(2 * positions.size() + 1), no_index);
    const std::size_t mask = slots.size() - 1;
    std::vector<Index> first;
    first.reserve(positions.size());
    for (Index v = 0; v < positions.size(); ++v) {
        ticker.tick(2);
        std::size_t i = PositionHash{}(positions[v]) & mask;
        while (slots[i] != no_index && positions[slots[i]] != positions[v]) i = (i + 1) & mask;
        if (slots[i] == no_index) slots[i] = v;
        first.push_back(slots[i]);
    }
    return first;
}

}  // namespace agvd
