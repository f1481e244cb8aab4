#include "remesh/sites/site_order.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "agvd/mesh/scale.h"

namespace remesh::detail {
namespace {

constexpr int bits = 16;  // Of each coordinate.

// Puts two zeros before each bit.
std::uint64_t spread(std::uint64_t number) {
    std::uint64_t result = 0;
    for (int bit = 0; bit < bits; ++bit) result |= (number >> bit & 1) << (3 * bit);
    return result;
}

}  // namespace

std::vector<Index> order_in_space(std::span<const Vec3> points) {
    MeshBox box;
    for (const Vec3& point : points) box.add(point);
    const double side = points.empty() ? 0 : (box.high - box.low).maxCoeff();
    const double scale = side > 0 ? ((1 << bits) - 1) / side : 0;
    std::vector<std::uint64_t> code;
    code.reserve(points.size());
    for (const Vec3& point : points) {
        const Vec3 at = scale * (point - box.low);
        const auto along = [&](int axis) { return spread(static_cast<std::uint64_t>(at[axis])); };
        code.push_back(along(0) | along(1) << 1 | along(2) << 2);
    }
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::ranges::stable_sort(order, {}, [&](Index i) { return code[i]; });
    return order;
}

}  // namespace remesh::detail
