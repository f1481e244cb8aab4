#include "remesh/io/point_welder.h"

#include <bit>

namespace remesh {
namespace {

using agvd::Index;
using agvd::Vec3;

// Multiply and fold each coordinate's bits (as splitmix64 does): neighbouring floats differ in
// high bits only once widened, and the table is indexed by low ones.
std::size_t hash(const Vec3& p) {
    std::uint64_t h = 0;
    for (const double x : p) {
        h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0xbf58476d1ce4e5b9u;
        h ^= h >> 32;
    }
    return h;
}

// The slot that holds p's index, or the free one where it belongs.
Index& find_slot(std::vector<Index>& slots, const std::vector<Vec3>& points, const Vec3& p) {
    const std::size_t mask = slots.size() - 1;
    std::size_t i = hash(p) & mask;
    while (slots[i] != agvd::no_index && points[slots[i]] != p) i = (i + 1) & mask;
    return slots[i];
}

}  // namespace

Index PointWelder::index_of(const Vec3& p) {
    if (2 * points_.size() >= slots_.size()) grow();
    const Vec3 key = p + Vec3::Zero();  // Turns -0 into 0, whose bits the hash sees.
    Index& slot = find_slot(slots_, points_, key);
    if (slot == agvd::no_index) {
        slot = static_cast<Index>(points_.size());
        points_.push_back(key);
    }
    return slot;
}

void PointWelder::grow() {
    std::vector<Index> larger(slots_.empty() ? 1024 : 2 * slots_.size(), agvd::no_index);
    for (Index i = 0; i < points_.size(); ++i) find_slot(larger, points_, points_[i]) = i;
    slots_ = std::move(larger);
}

}  // namespace remesh
