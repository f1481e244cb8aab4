//! \file
//! How much of the surface belongs to each site, by labels of the vertices, and how it is bent.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace agvd {
struct DistanceBounds;
}

namespace remesh {
struct PreparedSurface;
}

namespace remesh::detail {

//! A quadric ([garland1997]): x^T `spread` x - 2 x^T `lift` + `constant` is the integral over a
//! cell of the squared distance of x from the planes of its faces. Moves within a plane cost
//! nothing.
struct CellPlanes {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  //!< Integral of n n^T, square mesh units.
    Vec3 lift = Vec3::Zero();                          //!< Integral of n n^T p, p on the surface.
    double constant = 0;                               //!< Integral of (n^T p)^2.

    //! \param vector  the normal of a piece, as long as its area.
    void add(const Vec3& vector, double area, const Vec3& point) {
        const Vec3 normal = (1 / area) * vector;
        const double height = normal.dot(point);
        spread += normal * vector.transpose();
        lift += height * vector;
        constant += height * height * area;
    }
    //! The integral: of fourth order in lengths; rounding may make it negative.
    [[nodiscard]] double at(const Vec3& x) const {
        return x.dot(spread * x) - 2 * x.dot(lift) + constant;
    }
    //! Half the gradient of the integral.
    [[nodiscard]] Vec3 half_slope(const Vec3& x) const { return spread * x - lift; }
    //! The growth of the integral from x to x + step.
    [[nodiscard]] double growth(const Vec3& x, const Vec3& step) const {
        return step.dot(spread * step + 2 * half_slope(x));
    }
};

//! Shares faces out among threads by their labels; a part has the faces with a corner of its
//! labels, ascending, so that sums do not depend on the number of threads.
class FaceParts {
public:
    //! \param label        #V of the surface; no_index: none. Outlives this, as `surface`.
    //! \param num_threads  >= 0; 0: all cores.
    FaceParts(const Surface& surface, std::span<const Index> label, int num_threads)
        : surface_(surface), label_(label), count_(num_threads == 1 ? 1 : 8) {}

    [[nodiscard]] Index count() const { return count_; }
    [[nodiscard]] bool has(Index part, Index label) const {
        return label != no_index && (label & (count_ - 1)) == part;
    }
    //! Cost: O(#F), whatever the part has.
    template <typename Each>
    void for_each_face(Index part, const Each& each) const {
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            const auto& [a, b, c] = surface_.mesh.triangles[f];
            if (has(part, label_[a]) || has(part, label_[b]) || has(part, label_[c])) each(f);
        }
    }

private:
    const Surface& surface_;
    std::span<const Index> label_;
    Index count_;  // A power of two. With more, faces of two or three labels are in more parts.
};

//! What cells hold of the surface.
struct CellMeasures {
    std::vector<double> area;  //!< #sites, square mesh units.
    //! #sites, in [0, 1]: the share of the area that the largest projection onto a plane lacks. 0
    //! for a planar cell, half for a hemisphere.
    std::vector<double> bending;
    std::vector<CellPlanes> planes;  //!< #sites
};

//! Measures the cells given by labels. Faces with two labels are cut where these meet. The same for
//! any number of threads.
//! Cost: O(#F and pieces).
[[nodiscard]] CellMeasures measure_cells(const PreparedSurface& surface,
                                         const DistanceBounds& labels, Index num_sites,
                                         int num_threads, const Progress& progress = {});

//! Where the labels meet on the way from u to v, in [0, 1].
[[nodiscard]] double meeting_share(const DistanceBounds& labels, Index u, Index v, double length);

}  // namespace remesh::detail
