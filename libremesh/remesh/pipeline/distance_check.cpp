// Points of each surface are compared with the other one. A point that is too far lowers the length
// at the corners of the input's face that it lies on, or that is nearest to it: to the length of
// the edges of the result there, times what the distance needs if it falls with their square.
#include "remesh/pipeline/distance_check.h"

#include <algorithm>
#include <cmath>

#include "agvd/core/parallel.h"
#include "remesh/quality/area_samples.h"

namespace remesh::detail {
namespace {

using agvd::Index;
using agvd::Vec3;

constexpr Index num_samples = 100'000;  // On each surface.
constexpr Index query_grain = 1024;
// Share of the limit from which edges get shorter, and that they aim at.
constexpr double too_far = 0.9, aim = 0.7;

// A point whose distance is too large.
struct FarPoint {
    Index input_face;
    double length;  // That edges there may have.
};

struct ChunkOfPoints {
    MeasuredDistance distance;
    std::vector<FarPoint> far;
};

double mean_side(const agvd::MeshView& mesh, Index face) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& t = mesh.triangles[face];
        sum += (mesh.positions[t[(k + 1) % 3]] - mesh.positions[t[k]]).norm();
    }
    return sum / 3;
}

// #V: a face of each vertex; agvd::no_index: none.
std::vector<Index> face_of_vertex(const agvd::MeshView& mesh) {
    std::vector<Index> face(mesh.positions.size(), agvd::no_index);
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        for (const Index v : mesh.triangles[f]) face[v] = f;
    }
    return face;
}

// All vertices and the samples of a mesh.
class Points {
public:
    explicit Points(const agvd::MeshView& mesh)
        : mesh_(mesh), samples_(mesh), face_of_vertex_(face_of_vertex(mesh)) {}

    [[nodiscard]] Index size() const {
        return static_cast<Index>(mesh_.positions.size()) + num_samples;
    }
    // Position and face.
    [[nodiscard]] std::pair<Vec3, Index> operator[](Index i) const {
        if (i < mesh_.positions.size()) return {mesh_.positions[i], face_of_vertex_[i]};
        const auto first = static_cast<Index>(mesh_.positions.size());
        const agvd::SurfacePoint point = samples_.at(i - first, num_samples);
        return {position(mesh_, point), point.face.value()};
    }

private:
    agvd::MeshView mesh_;
    AreaSamples samples_;
    std::vector<Index> face_of_vertex_;
};

}  // namespace

DistanceCheck::DistanceCheck(agvd::MeshView mesh, int num_threads, const agvd::Progress& progress)
    : mesh_{{mesh.positions.begin(), mesh.positions.end()},
            {mesh.triangles.begin(), mesh.triangles.end()}},
      tree_(mesh, progress),
      num_threads_(num_threads),
      progress_(progress) {}

MeasuredDistance DistanceCheck::measure(const agvd::MeshView& result, double limit,
                                        std::vector<double>& most_lengths) const {
    agvd::Poller poller(progress_);
    const agvd::ClosestPointTree result_tree(result, poller.progress());
    MeasuredDistance largest;
    // \param faces_of  (face of the point, nearest face) -> (face of the input, of the result).
    const auto compare = [&](const Points& points, const agvd::ClosestPointTree& other,
                             const auto& faces_of) {
        std::vector<ChunkOfPoints> chunks(agvd::num_chunks(points.size(), query_grain));
        agvd::parallel_chunks(
            points.size(), query_grain, num_threads_,
            [&](Index chunk, Index begin, Index end) {
                ChunkOfPoints& found = chunks[chunk];
                for (Index i = begin; i < end; ++i) {
                    const auto [point, face] = points[i];
                    if (face == agvd::no_index) continue;
                    const agvd::ClosestPoint nearest = other.query(point);
                    const double distance = std::sqrt(nearest.distance_sq);
                    if (distance > found.distance.largest) found.distance = {distance, point};
                    if (distance < too_far * limit) continue;
                    const auto [of_input, of_result] = faces_of(face, nearest.point.face.value());
                    found.far.push_back({of_input, mean_side(result, of_result) *
                                                       std::sqrt(aim * limit / distance)});
                }
            },
            poller);
        for (const ChunkOfPoints& chunk : chunks) {
            if (chunk.distance.largest > largest.largest) largest = chunk.distance;
            for (const FarPoint& point : chunk.far) {
                for (const Index v : mesh_.triangles[point.input_face]) {
                    most_lengths[v] = std::min(most_lengths[v], point.length);
                }
            }
        }
    };
    compare(Points(mesh_.view()), result_tree,
            [](Index face, Index nearest) { return std::pair(face, nearest); });
    compare(Points(result), tree_,
            [](Index face, Index nearest) { return std::pair(nearest, face); });
    return largest;
}

}  // namespace remesh::detail
