#include "remesh/pipeline/region_crossings.h"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include "agvd/core/poller.h"
#include "remesh/quality/self_intersections.h"

namespace remesh::detail {
namespace {

using agvd::Index;
using Box = Eigen::AlignedBox3d;

Box box_of_face(const agvd::MeshView& mesh, const agvd::Triangle& t) {
    Box box(mesh.positions[t[0]]);
    box.extend(mesh.positions[t[1]]);
    box.extend(mesh.positions[t[2]]);
    return box;
}

}  // namespace

std::optional<Index> count_crossings_at(const agvd::MeshView& mesh,
                                        std::span<const std::uint8_t> is_marked, int num_threads,
                                        const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    agvd::Ticker ticker(poller);
    Box marked;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        if (is_marked[f] != 0) marked.extend(box_of_face(mesh, mesh.triangles[f]));
    }
    std::vector<Index> faces;
    std::vector<agvd::Triangle> near;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        if (!marked.intersects(box_of_face(mesh, mesh.triangles[f]))) continue;
        faces.push_back(f);
        near.push_back(mesh.triangles[f]);
    }
    const auto pairs = find_self_intersections({mesh.positions, near}, num_threads, progress);
    if (!pairs) return std::nullopt;
    return static_cast<Index>(std::count_if(pairs->begin(), pairs->end(), [&](const auto& pair) {
        return is_marked[faces[pair.first]] != 0 || is_marked[faces[pair.second]] != 0;
    }));
}

}  // namespace remesh::detail
