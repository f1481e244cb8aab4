// Exact predicates on pairs of faces whose boxes intersect, by vertex indices, so that it works on
// non-manifold meshes. Candidates are tested in batches of bounded memory.
#include "remesh/quality/evaluate.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "agvd/core/bucket_sort.h"
#include "agvd/core/parallel.h"

namespace remesh {
namespace {

using Pair = std::pair<Index, Index>;
using ExactKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index>;

// Pairs of boxes tested per chunk.
constexpr Index pairs_per_task = 4096;
// Most pairs of boxes in memory at once, for each face and at least. Meshes have some 10 for each
// face; a polygon of 20 000 corners cut into needles has hundreds of millions.
constexpr std::size_t candidates_per_face = 32, least_candidates = std::size_t{1} << 16;

class Soup {
public:
    Soup(const MeshView& mesh, Ticker ticker) : faces_(mesh.triangles), ticker_(ticker) {
        points_.reserve(mesh.positions.size());
        for_each_ticked(mesh.positions, ticker_,
                        [&](const Vec3& p) { points_.emplace_back(p.x(), p.y(), p.z()); });
    }

    [[nodiscard]] std::vector<Box> boxes() {
        std::vector<Box> result;
        for (Index f = 0; f < faces_.size(); ++f) {
            ticker_.tick();
            const ExactKernel::Triangle_3 t = triangle(faces_[f]);
            if (!t.is_degenerate()) result.emplace_back(t.bbox(), f);
        }
        return result;
    }

    // Whether the two faces meet in more than the corners that they share.
    [[nodiscard]] bool intersect(Pair faces) const {
        Triangle a = faces_[faces.first], b = faces_[faces.second];
        switch (move_shared_first(a, b)) {
            case 0:
                return CGAL::do_intersect(triangle(a), triangle(b));
            case 1:
                // If they meet beyond the shared corner, one of the opposite sides does.
                return CGAL::do_intersect(triangle(a), side(b)) ||
                       CGAL::do_intersect(triangle(b), side(a));
            case 2:
                // Only if folded onto each other: in one plane, and on the same side of the shared
                // edge.
                return CGAL::coplanar(point(a[0]), point(a[1]), point(a[2]), point(b[2])) &&
                       CGAL::coplanar_orientation(point(a[0]), point(a[1]), point(a[2]),
                                                  point(b[2])) == CGAL::POSITIVE;
            default:
                return true;
        }
    }

private:
    [[nodiscard]] const ExactKernel::Point_3& point(Index v) const { return points_[v]; }
    [[nodiscard]] ExactKernel::Triangle_3 triangle(const Triangle& t) const {
        return {point(t[0]), point(t[1]), point(t[2])};
    }
    [[nodiscard]] ExactKernel::Segment_3 side(const Triangle& t) const {
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
    std::vector<ExactKernel::Point_3> points_;
    Ticker ticker_;
};

// The pairs that intersect, in order.
std::vector<Pair> intersecting(const Soup& soup, std::vector<Pair> candidates, Index num_faces,
                               int num_threads, Poller& poller) {
    candidates = sort_in_buckets(
        candidates, num_faces, [](const Pair& pair) { return pair.first; }, std::less<>(),
        Ticker(poller));
    const auto test = [&](Index i, std::vector<Pair>& found) {
        if (soup.intersect(candidates[i])) found.push_back(candidates[i]);
    };
    return parallel_collect<Pair>(static_cast<Index>(candidates.size()), pairs_per_task,
                                  num_threads, test, poller);
}

}  // namespace

std::optional<std::vector<Pair>> find_self_intersections(const MeshView& mesh, int num_threads,
                                                         const Progress& progress) {
    Poller poller(progress);
    Soup soup(mesh, Ticker(poller));
    const auto num_faces = static_cast<Index>(mesh.triangles.size());
    std::vector<Box> boxes = soup.boxes();
    std::vector<Pair> candidates, all;
    const std::size_t most_candidates =
        std::max(least_candidates, candidates_per_face * boxes.size());
    const auto test_candidates = [&] {
        const std::vector<Pair> found =
            intersecting(soup, std::exchange(candidates, {}), num_faces, num_threads, poller);
        all.insert(all.end(), found.begin(), found.end());
    };
    // Every face meets its neighbours, so that there are always pairs, and polls with them.
    Ticker ticker(poller);
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
        ticker.tick(2);
        candidates.push_back(std::minmax(a.info(), b.info()));
        if (candidates.size() == most_candidates) test_candidates();
    });
    const bool is_sorted = all.empty();
    test_candidates();
    if (!is_sorted) std::sort(all.begin(), all.end());
    return all;
}

}  // namespace remesh
