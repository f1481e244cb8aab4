#include "remesh/meshfile/point_welder.h"

#include "agvd/core/random.h"

namespace remesh {
namespace {

// The slot that holds p's index, or the free one where it belongs.
Index& find_slot(std::vector<Index>& slots, const std::vector<Vec3>& points, const Vec3& p) {
    const std::size_t mask = slots.size() - 1;
    const std::size_t hash = PositionHash{}(p);
    std::size_t i = hash & mask;
    while (slots[i] != no_index && points[slots[i]] != p) i = (i + 1) & mask;
    return slots[i];
}

}  // namespace

Index PointWelder::index_of(const Vec3& p) {
    if (2 * points_.size() >= slots_.size()) grow();
    Index& slot = find_slot(slots_, points_, p);
    if (slot == no_index) {
        slot = static_cast<Index>(points_.size());
        points_.push_back(p);
    }
    return slot;
}

void PointWelder::grow() {
    std::vector<Index> larger(slots_.empty() ? 1024 : 2 * slots_.size(), no_index);
    for (Index i = 0; i < points_.size(); ++i) find_slot(larger, points_, points_[i]) = i;
    slots_ = std::move(larger);
}

}  // namespace remesh
