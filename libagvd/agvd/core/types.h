//! \file
//! Indices, ids and vectors used by every stage.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <compare>
#include <cstdint>
#include <limits>
#include <numbers>

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

}  // namespace agvd
