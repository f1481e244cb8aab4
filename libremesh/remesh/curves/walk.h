//! \file
//! Moves of points along the surface.
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Least barycentric coordinate of a point inside a face. It keeps points off edges by more than
//! the rounding of any position, and biases the density by no more than this share.
inline constexpr double interior_margin = 1e-6;

//! Moves a point of a face off its edges by at least that, where it is nearer.
inline void keep_inside(std::array<double, 3>& barycentric) {
    double sum = 0;
    for (double& b : barycentric) sum += b = std::max(b, interior_margin);
    for (double& b : barycentric) b /= sum;
}

//! The unit normal of the surface at a point.
[[nodiscard]] inline Vec3 facing_at(const Surface& surface, const SurfacePoint& point) {
    const Triangle& t = surface.mesh.triangles[point.face.value()];
    return doubled_normal(surface.mesh.positions, t).normalized();
}

struct Walk {
    SurfacePoint end;
    int num_crossings = 0;    //!< From face to face.
    bool is_cut_off = false;  //!< After 2000 crossings: at a spike it may circle for ever.
};

//! Walks the straightest geodesic ([polthier1998]) from a point along `step`, from face to face,
//! never through a wall, and stops short of the boundary. The end lies strictly inside a face,
//! unless `step` is nearly normal to the first one: then the point stays.
//! \param step  mesh units; its component in the plane of the face gives the direction.
//! Cost: O(faces crossed).
[[nodiscard]] Walk walk_straight(const Surface& surface, const SurfacePoint& from,
                                 const Vec3& step);

//! Whether a mesh without a vertex or edge is too far from the surface there. A leg goes from it to
//! each side as far as the surface or curve is straight; the chord between their ends tells.
struct LostDistance {
    //! A leg is straight if its middle is nearer to its chord than this share of the distance. The
    //! legs of a round course that is fine for the distance lose a quarter of that at most.
    static constexpr double most_bend = 1.0 / 16;
    //! This share of the distance counts: half an angle is more than its sine.
    static constexpr double least_lost = 0.9;

    double distance = 0;  //!< Mesh units, > 0.

    //! The legs that lose the distance at an angle (radians); longer ones need not be looked at.
    [[nodiscard]] double leg(double angle) const { return 2 * distance / angle; }

    //! \param leg            at most so long.
    //! \param before, after  (way): positions along the legs, from 0 to their length.
    template <typename Before, typename After>
    [[nodiscard]] bool is_lost(double leg, const Before& before, const After& after) const {
        return distance_to_segment(before(0), straight_end(leg, before), straight_end(leg, after)) >
               least_lost * distance;
    }

private:
    template <typename At>
    [[nodiscard]] Vec3 straight_end(double length, const At& at) const {
        const Vec3 from = at(0);
        const auto is_straight = [&](double part) {
            return distance_to_segment(at(part * length / 2), from, at(part * length)) <=
                   most_bend * distance;
        };
        double straight = 0, bent = 1.0 / 32;
        while (straight < 1 && is_straight(bent)) {
            straight = bent;
            bent *= 2;
        }
        for (int i = 0; i < 3 && straight > 0 && straight < 1; ++i) {
            const double middle = (straight + bent) / 2;
            (is_straight(middle) ? straight : bent) = middle;
        }
        return at(straight * length);
    }
};

//! The boundary half-edge that a point lies on, if any; at a vertex the one that leaves it.
[[nodiscard]] std::optional<Index> boundary_half_edge(const Surface& surface,
                                                      const SurfacePoint& point);

//! The end of a walk along the boundary, strictly inside a boundary edge. Its length is that of the
//! component of `step` along the half-edge, in its direction or against it.
//! \param from  a point of boundary half-edge h.
//! Cost: O(edges passed).
[[nodiscard]] SurfacePoint walk_boundary(const Surface& surface, const SurfacePoint& from, Index h,
                                         const Vec3& step);

}  // namespace remesh::detail
