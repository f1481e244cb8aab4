//! \file
//! Points of a surface: their faces, which of them coincide, distances within a face, random ones.
#pragma once

#include <cmath>
#include <optional>

#include "agvd/mesh/surface.h"

namespace agvd {

//! The vertex a point lies on, if it does: up to 1e-12 of the shorter edge of its face there.
//! Nearer than that, rounding hides from which side the point sees the faces around the vertex.
[[nodiscard]] std::optional<Index> vertex_of(const Surface& surface, const SurfacePoint& point);

//! The same, as the half-edge of the point's face that leaves the vertex. It tells the corner where
//! the face has the vertex at several corners.
[[nodiscard]] std::optional<Index> corner_of(const Surface& surface, const SurfacePoint& point);

//! The half-edge of the point's face in whose interior the point lies, if it does: up to 1e-12 of
//! the face's height. If it were nearer, windows through the edge would consist of rounding.
[[nodiscard]] std::optional<Index> half_edge_of(const SurfacePoint& point);

//! The point at a share of the way along a half-edge, as a point of its face; 0: the tail.
[[nodiscard]] inline SurfacePoint point_on(Index half_edge, double at) {
    SurfacePoint point{FaceId(Surface::face(half_edge)), {0, 0, 0}};
    point.barycentric[half_edge % 3] = 1 - at;
    point.barycentric[(half_edge + 1) % 3] = at;
    return point;
}

//! The same point of an edge's interior, seen from the face across `half_edge` (which must exist).
[[nodiscard]] SurfacePoint across_edge(const Surface& surface, const SurfacePoint& point,
                                       Index half_edge);

//! Calls visit(SurfacePoint) for all names of a point: one for each corner around a vertex, in the
//! order of the one-ring; one for each side of an edge (a coordinate is exactly 0), the given one
//! first; else the point itself. A face may be visited several times.
template <typename Visit>
void for_each_view(const Surface& surface, const SurfacePoint& point, const Visit& visit) {
    const auto& b = point.barycentric;
    const auto num_zeros = (b[0] == 0 ? 1 : 0) + (b[1] == 0 ? 1 : 0) + (b[2] == 0 ? 1 : 0);
    const Index face = point.face.value();
    if (num_zeros == 2) {
        const Index k = b[0] != 0 ? 0 : b[1] != 0 ? 1 : 2;
        for_each_outgoing(surface, surface.tail(3 * face + k), [&](Index h) {
            SurfacePoint view{FaceId(Surface::face(h)), {0, 0, 0}};
            view.barycentric[h % 3] = b[k];
            visit(view);
        });
        return;
    }
    visit(point);
    if (num_zeros != 1) return;
    const Index k = b[2] == 0 ? 0 : b[0] == 0 ? 1 : 2;
    const Index h = 3 * face + k;
    if (surface.twin[h] != no_index) visit(across_edge(surface, point, h));
}

//! The same point as a point of `face`, the first if there are several; none if it does not lie in
//! that face.
[[nodiscard]] std::optional<SurfacePoint> seen_from(const Surface& surface,
                                                    const SurfacePoint& point, Index face);

//! The faces that hold both of two different points, at most two. There are no more unless the
//! surface is a Delta-complex (see IntrinsicTriangulation). Cost: O(faces around a and b).
struct CommonFaces {
    Index first = no_index;   //!< no_index: none.
    Index second = no_index;  //!< Where both lie on one edge; no_index otherwise.
};
//! See CommonFaces.
[[nodiscard]] CommonFaces common_faces(const Surface& surface, const SurfacePoint& a,
                                       const SurfacePoint& b);

//! Whether a point lies on a boundary edge or on one of its ends.
[[nodiscard]] bool is_on_boundary(const Surface& surface, const SurfacePoint& point);

//! Position of a surface point in the frame of one of its face's half-edges.
[[nodiscard]] Vec2 position_in_frame(const Surface& surface, const SurfacePoint& point,
                                     Index half_edge);

//! The length of the straight segment within the face, in mesh units. The face need not lie in
//! space.
//! \param a, b  of one face.
[[nodiscard]] inline double face_distance(const Surface& surface, const SurfacePoint& a,
                                          const SurfacePoint& b) {
    const std::size_t h = std::size_t{3} * a.face.value();
    const double head = b.barycentric[1] - a.barycentric[1];
    const double apex = b.barycentric[2] - a.barycentric[2];
    return (apex * surface.apex[h] + Vec2(head * surface.length[surface.edge[h]], 0)).norm();
}

//! Puts a point that lies on a vertex or an edge up to rounding (see vertex_of) exactly there.
[[nodiscard]] SurfacePoint snapped(const Surface& surface, const SurfacePoint& point);

//! A vertex, an edge or a face, and a position on it. Keys are equal for equal points, whichever of
//! its faces a point names.
struct SurfaceKey {
    //! Vertices first, then edges by their lower half-edge, then faces.
    std::uint64_t element = std::numeric_limits<std::uint64_t>::max();
    //! Vertex: 0. Edge: shares of the ends of that half-edge. Face: barycentric coordinates.
    std::array<double, 3> where{};

    auto operator<=>(const SurfaceKey&) const = default;
};

[[nodiscard]] SurfaceKey key_of(const Surface& surface, const SurfacePoint& point);

//! The points that do not lie exactly where an earlier one does, ascending: as sites the others own
//! nothing. Points of two parts of the surface at one position differ. Cost: O(n log n).
[[nodiscard]] std::vector<Index> distinct_points(const Surface& surface,
                                                 std::span<const SurfacePoint> points);

//! The chosen elements of an array, in the order of `chosen`.
template <typename Array>
[[nodiscard]] auto take(const Array& all, std::span<const Index> chosen) {
    std::vector<typename Array::value_type> result;
    result.reserve(chosen.size());
    for (const Index i : chosen) result.push_back(all[i]);
    return result;
}

//! For each element its place in an order, which holds each once.
[[nodiscard]] inline std::vector<Index> places_in(std::span<const Index> order) {
    std::vector<Index> place(order.size());
    for (Index i = 0; i < order.size(); ++i) place[order[i]] = i;
    return place;
}

//! \throw InvalidSites naming the site when its face does not exist or it is off the face.
void check_sites(const Surface& surface, std::span<const SurfacePoint> sites);

//! Uniform in a triangle for u and v uniform in [0, 1]: u is the share of the area cut off at
//! corner 0, v runs across.
[[nodiscard]] inline std::array<double, 3> uniform_barycentric(double u, double v) {
    const double root = std::sqrt(u);
    return {1 - root, root * (1 - v), root * v};
}

//! `count` independent points in face interiors, uniform by area; point i depends on the surface,
//! the seed and i only. Cost: O(n + count log n).
[[nodiscard]] std::vector<SurfacePoint> uniform_points(const Surface& surface, Index count,
                                                       std::uint64_t seed);

}  // namespace agvd
