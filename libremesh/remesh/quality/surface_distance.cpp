// Samples stratified by area, and closest points by CGAL's AABB tree. Sums are taken by chunk in a
// fixed order.
#include "remesh/quality/evaluate.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/any_mesh.h"
#include "remesh/quality/area_samples.h"

namespace remesh {
namespace {

// Inexact constructions are enough: the errors are those of double, as in the coordinates.
using DistanceKernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<DistanceKernel::Triangle_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<
    DistanceKernel, CGAL::AABB_triangle_primitive<DistanceKernel, Triangles::const_iterator>>>;

// Queries per chunk: enough to hide the cost of a task, few enough to keep all threads busy.
constexpr Index queries_per_task = 1024;

DistanceKernel::Point_3 to_cgal(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
Vec3 from_cgal(const DistanceKernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

Vec3 normal_of(const DistanceKernel::Triangle_3& t) {
    return (from_cgal(t[1]) - from_cgal(t[0])).cross(from_cgal(t[2]) - from_cgal(t[0]));
}

// The faces with area of one mesh: draws samples and finds closest points.
class Faces {
public:
    // \param mesh  outlives this.
    Faces(const MeshView& mesh, const char* name, Poller& poller) : mesh_(mesh), samples_(mesh) {
        Ticker ticker(poller);
        for (const auto& [a, b, c] : mesh.triangles) {
            ticker.tick();
            const DistanceKernel::Triangle_3 triangle(
                to_cgal(mesh.positions[a]), to_cgal(mesh.positions[b]), to_cgal(mesh.positions[c]));
            if (normal_of(triangle).norm() > 0) triangles_.push_back(triangle);
        }
        if (triangles_.empty()) {
            throw InvalidInput(std::string("no face of the ") + name +
                               " mesh has an area; check that the file holds a surface");
        }
        tree_.insert(triangles_.begin(), triangles_.end());
        const auto& traits = tree_.traits();
        const auto split = traits.split_primitives_object();
        tree_.custom_build(traits.compute_bbox_object(), [&](auto first, auto beyond, auto box) {
            ticker.tick(static_cast<std::size_t>(beyond - first));
            split(first, beyond, box);
        });
        ticker.poll();
        // Faster than to start each search from the previous answer.
        tree_.accelerate_distance_queries();
    }

    [[nodiscard]] const Triangles& triangles() const { return triangles_; }
    [[nodiscard]] const Tree& tree() const { return tree_; }

    // A point in the i-th of n strata of equal area.
    [[nodiscard]] Vec3 sample(Index i, Index n) const { return position(mesh_, samples_.at(i, n)); }

private:
    MeshView mesh_;
    detail::AreaSamples samples_;
    Triangles triangles_;
    Tree tree_;
};

// Calls use(chunk, i, point, closest) for `count` points, with their closest point and face.
template <typename PointAt, typename Use>
void for_each_closest(Index count, int num_threads, Poller& poller, const Faces& faces,
                      const PointAt& point_at, const Use& use) {
    const auto find = [&](Index chunk, Index begin, Index end) {
        Ticker ticker(poller);
        for (Index i = begin; i < end; ++i) {
            ticker.tick(64);  // Steps of a query.
            const Vec3 point = point_at(i);
            use(chunk, i, point, faces.tree().closest_point_and_primitive(to_cgal(point)));
        }
    };
    parallel_chunks(count, queries_per_task, num_threads, find, poller);
}

void take_farther(double distance, const Vec3& point, OneSidedDistance& side) {
    if (distance <= side.max) return;
    side.max = distance;
    side.farthest = point;
}

// Mean, RMS and maximum over the points, summed in a fixed order.
template <typename PointAt>
OneSidedDistance measure(Index count, int num_threads, Poller& poller, const Faces& faces,
                         const PointAt& point_at) {
    std::vector<OneSidedDistance> sums(num_chunks(count, queries_per_task));
    for_each_closest(count, num_threads, poller, faces, point_at,
                     [&](Index chunk, Index, const Vec3& point, const auto& closest) {
                         const double distance = (point - from_cgal(closest.first)).norm();
                         sums[chunk].mean += distance;
                         sums[chunk].rms += distance * distance;
                         take_farther(distance, point, sums[chunk]);
                     });
    OneSidedDistance total;
    for (const OneSidedDistance& sum : sums) {
        total.mean += sum.mean / count;
        total.rms += sum.rms / count;
        take_farther(sum.max, sum.farthest, total);
    }
    total.rms = std::sqrt(total.rms);
    return total;
}

OneSidedDistance one_sided(const MeshView& mesh, const Faces& from, const Faces& to,
                           const EvaluationOptions& options, Poller& poller) {
    OneSidedDistance result = measure(options.samples, options.num_threads, poller, to,
                                      [&](Index i) { return from.sample(i, options.samples); });
    std::vector<Triangle> faces(mesh.triangles.begin(), mesh.triangles.end());
    const std::vector<Vec3> vertices =
        take(mesh.positions, drop_unused(static_cast<Index>(mesh.positions.size()), faces));
    const OneSidedDistance at_vertices =
        measure(static_cast<Index>(vertices.size()), options.num_threads, poller, to,
                [&](Index v) { return vertices[v]; });
    take_farther(at_vertices.max, at_vertices.farthest, result);
    return result;
}

Index count_flipped(const Faces& original, const Faces& result, int num_threads, Poller& poller) {
    const auto count = static_cast<Index>(result.triangles().size());
    std::vector<Index> flipped(num_chunks(count, queries_per_task), 0);
    for_each_closest(
        count, num_threads, poller, original,
        [&](Index f) {
            const DistanceKernel::Triangle_3& t = result.triangles()[f];
            return Vec3((from_cgal(t[0]) + from_cgal(t[1]) + from_cgal(t[2])) / 3);
        },
        [&](Index chunk, Index f, const Vec3&, const auto& closest) {
            const Vec3 normal = normal_of(result.triangles()[f]);
            if (normal.dot(normal_of(*closest.second)) < 0) ++flipped[chunk];
        });
    Index total = 0;
    for (const Index part : flipped) total += part;
    return total;
}

}  // namespace

std::optional<SurfaceDistance> surface_distance(const MeshView& original, const MeshView& result,
                                                const EvaluationOptions& options) {
    if (options.samples < 1) throw InvalidOption("samples is 0; use 1 or more");
    check_num_threads(options.num_threads);
    Poller poller(options.progress);
    const Faces original_faces(original, "original", poller);
    const Faces result_faces(result, "result", poller);
    const CGAL::Bbox_3 box = original_faces.tree().bbox();
    SurfaceDistance distance;
    distance.from_original = one_sided(original, original_faces, result_faces, options, poller);
    distance.from_result = one_sided(result, result_faces, original_faces, options, poller);
    distance.diagonal = Vec3(box.x_span(), box.y_span(), box.z_span()).norm();
    distance.samples = options.samples;
    distance.flipped_faces =
        count_flipped(original_faces, result_faces, options.num_threads, poller);
    return distance;
}

}  // namespace remesh
