//! \file
//! Indices, ids and vectors used by every stage: an index of one kind cannot be taken for another.
//! Held by EitherIndex in tests/agvd/core.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <compare>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

namespace agvd {

//! Plain index of a vertex, face, half-edge, edge or site inside one array.
using Index = std::uint32_t;
//! No element; the largest index.
inline constexpr Index no_index = std::numeric_limits<Index>::max();
//! Farther than any point.
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double degree = std::numbers::pi / 180;  //!< In radians.

using Vec2 = Eigen::Vector2d;  //!< A point of a face's plane.
using Vec3 = Eigen::Vector3d;  //!< A point in space.
//! Above 0 if the second vector lies on the left of the first one; the area that they span.
[[nodiscard]] inline double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}
//! Vertex indices of a triangle, counter-clockwise seen from outside.
using Triangle = std::array<Index, 3>;

//! An index that cannot be mixed up with one of another kind. Default: none.
template <typename Tag>
class Id {
public:
    constexpr Id() = default;
    explicit constexpr Id(Index value) : value_(value) {}  //!< Takes no_index, too.
    //! The index; no_index if there is none.
    [[nodiscard]] constexpr Index value() const { return value_; }
    //! Whether it names an element.
    [[nodiscard]] constexpr bool is_valid() const { return value_ != no_index; }
    //! By index.
    constexpr auto operator<=>(const Id&) const = default;

private:
    Index value_ = no_index;
};

using VertexId = Id<struct VertexTag>;  //!< A vertex of a mesh.
using FaceId = Id<struct FaceTag>;      //!< A face of a mesh.
using SiteId = Id<struct SiteTag>;      //!< A site of a diagram.

//! Half-edge 3 t + k runs from corner k to corner k + 1 of triangle t. This is the next one of the
//! triangle. Compilers do not turn this arithmetic into branches, of which one in three would be
//! predicted wrongly.
[[nodiscard]] constexpr Index next_half_edge(Index half_edge) {
    return half_edge + 1 - 3 * (half_edge % 3 / 2);
}
//! The previous half-edge of the triangle.
[[nodiscard]] constexpr Index previous_half_edge(Index half_edge) {
    return half_edge + 2 - 3 * ((half_edge % 3 + 1) / 2);
}

//! An edge by its ends: the same number for (a, b) and (b, a); ascending by the lower index, then
//! by the higher one.
[[nodiscard]] constexpr std::uint64_t edge_key(Index a, Index b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

//! The values in ascending order, each once. Cost: O(n log n).
template <typename Value>
[[nodiscard]] std::vector<Value> distinct(std::vector<Value> values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

//! An index into the first or the second of two arrays, in one word: the highest bit tells which.
//! Types that name the two arrays hold one of these.
class EitherIndex {
public:
    //! Neither.
    constexpr EitherIndex() = default;
    //! An index of the first array.
    [[nodiscard]] static constexpr EitherIndex first(Index index) {
        assert(index < second_bit);
        return EitherIndex(index);
    }
    //! An index of the second array.
    [[nodiscard]] static constexpr EitherIndex second(Index index) {
        assert(index < second_bit - 1);
        return EitherIndex(index | second_bit);
    }

    //! Whether it is an index of either.
    [[nodiscard]] constexpr bool is_valid() const { return word_ != no_index; }
    //! \pre is_valid()
    [[nodiscard]] constexpr bool is_second() const {
        assert(is_valid());
        return word_ >= second_bit;
    }
    //! \pre !is_second()
    [[nodiscard]] constexpr Index first() const {
        assert(!is_second());
        return word_;
    }
    //! \pre is_second()
    [[nodiscard]] constexpr Index second() const {
        assert(is_second());
        return word_ - second_bit;
    }

    //! Equal indices of the same array.
    friend constexpr bool operator==(const EitherIndex&, const EitherIndex&) = default;

private:
    static constexpr Index second_bit = Index{1} << 31;

    explicit constexpr EitherIndex(Index word) : word_(word) {}

    Index word_ = no_index;
};

}  // namespace agvd
