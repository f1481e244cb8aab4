#include "remesh/pipeline/region_crossings.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "agvd/core/progress.h"
#include "remesh/quality/evaluate.h"

namespace remesh::detail {
namespace {

// Axis-aligned; empty at first.
struct Box {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = -low;

    void extend(const MeshView& mesh, const Triangle& t) {
        for (const Index v : t) {
            low = low.cwiseMin(mesh.positions[v]);
            high = high.cwiseMax(mesh.positions[v]);
        }
    }
    [[nodiscard]] bool meets(const Box& other) const {
        return (low.array() <= other.high.array()).all() &&
               (other.low.array() <= high.array()).all();
    }
};

}  // namespace

std::optional<Index> count_crossings_at(const MeshView& mesh,
                                        std::span<const std::uint8_t> is_marked, int num_threads,
                                        const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    Box marked;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        if (is_marked[f] != 0) marked.extend(mesh, mesh.triangles[f]);
    }
    std::vector<Index> faces;
    std::vector<Triangle> near;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        Box box;
        box.extend(mesh, mesh.triangles[f]);
        if (!marked.meets(box)) continue;
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
