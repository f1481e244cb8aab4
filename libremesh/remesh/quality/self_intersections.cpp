#include "remesh/quality/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

#include "agvd/core/parallel.h"

// Works on faces that share indices instead of a half-edge structure, so that it can judge meshes
// that are not manifold.
namespace remesh {
namespace {

using agvd::Index;
using agvd::Triangle;
using Pair = std::pair<Index, Index>;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index>;

// Pairs of boxes tested per chunk.
constexpr Index grain = 4096;

class Soup {
public:
    explicit Soup(const agvd::MeshView& mesh) : faces_(mesh.triangles) {
        points_.reserve(mesh.positions.size());
        for (const agvd::Vec3& p : mesh.positions) points_.emplace_back(p.x(), p.y(), p.z());
    }

    [[nodiscard]] std::vector<Box> boxes() const {
        std::vector<Box> result;
        for (Index f = 0; f < faces_.size(); ++f) {
            const Kernel::Triangle_3 t = triangle(faces_[f]);
            if (!t.is_degenerate()) result.emplace_back(t.bbox(), f);
        }
        return result;
    }

    // Do the two faces meet in more than the corners that they share?
    [[nodiscard]] bool intersect(Pair faces) const {
        Triangle a = faces_[faces.first], b = faces_[faces.second];
        switch (move_shared_first(a, b)) {
            case 0:
                return CGAL::do_intersect(triangle(a), triangle(b));
            case 1:
                // Beyond the shared corner there is only one of the opposite sides to meet.
                return CGAL::do_intersect(triangle(a), side(b)) ||
                       CGAL::do_intersect(triangle(b), side(a));
            case 2:
                // Only when folded flat: same plane, and both on one side of the shared edge.
                return CGAL::coplanar(point(a[0]), point(a[1]), point(a[2]), point(b[2])) &&
                       CGAL::coplanar_orientation(point(a[0]), point(a[1]), point(a[2]),
                                                  point(b[2])) == CGAL::POSITIVE;
            default:
                return true;
        }
    }

private:
    [[nodiscard]] const Kernel::Point_3& point(Index v) const { return points_[v]; }
    [[nodiscard]] Kernel::Triangle_3 triangle(const Triangle& t) const {
        return {point(t[0]), point(t[1]), point(t[2])};
    }
    [[nodiscard]] Kernel::Segment_3 side(const Triangle& t) const {
        return {point(t[1]), point(t[2])};
    }

    // Brings the common corners to the front of both, in the same order; returns their number.
    static std::size_t move_shared_first(Triangle& a, Triangle& b) {
        std::size_t shared = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto found =
                std::find(b.begin() + static_cast<std::ptrdiff_t>(shared), b.end(), a[i]);
            if (found == b.end()) continue;
            std::swap(a[shared], a[i]);
            std::iter_swap(b.begin() + static_cast<std::ptrdiff_t>(shared), found);
            ++shared;
        }
        return shared;
    }

    std::span<const Triangle> faces_;
    std::vector<Kernel::Point_3> points_;
};

std::vector<Pair> overlapping_boxes(std::vector<Box> boxes) {
    std::vector<Pair> pairs;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
        pairs.push_back(std::minmax(a.info(), b.info()));
    });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace

std::optional<std::vector<Pair>> find_self_intersections(const agvd::MeshView& mesh,
                                                         int num_threads) {
    const Soup soup(mesh);
    const std::vector<Pair> candidates = overlapping_boxes(soup.boxes());
    const auto count = static_cast<Index>(candidates.size());
    std::vector<std::vector<Pair>> found(agvd::num_chunks(count, grain));
    agvd::parallel_chunks(count, grain, num_threads, [&](Index chunk, Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            if (soup.intersect(candidates[i])) found[chunk].push_back(candidates[i]);
        }
    });
    std::vector<Pair> all;
    for (const std::vector<Pair>& part : found) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace remesh
