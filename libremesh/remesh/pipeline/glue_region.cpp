// Vertices of the remeshed region are recognised as those of the seam by their positions.
#include <algorithm>
#include <unordered_map>

#include "agvd/core/random.h"
#include "remesh/curves/glue.h"
#include "remesh/pipeline/region.h"

namespace remesh::detail {
namespace {

using SharedVertices = std::unordered_map<Vec3, Index, PositionHash>;

// Most rounds of flips: one can repeat another kept edge.
constexpr int most_flip_rounds = 10;

// Flips edges of the region that gluing would give other faces than those beside them.
class Parting {
public:
    // \param kept   edges of the kept faces.
    // \param alone  edges that are left as they are, ascending.
    Parting(const std::vector<EdgeSide>& kept, const std::vector<std::uint64_t>& alone,
            std::span<const Index> vertex, std::vector<Triangle>& triangles)
        : kept_(kept), alone_(alone), vertex_(vertex), triangles_(triangles) {}

    // \return whether no such edge is left.
    bool run() {
        for (int round = 0; round < most_flip_rounds; ++round) {
            edges_ = sorted_edge_sides(rename_vertices(triangles_, vertex_));
            added_.clear();
            is_changed_.assign(triangles_.size(), false);
            bool has_repeated = false;
            for_each_edge(std::span<const EdgeSide>(edges_), [&](std::span<const EdgeSide> sides) {
                if (!is_repeated(sides)) return;
                has_repeated = true;
                flip_one(sides);
            });
            if (!has_repeated) return true;
            if (added_.empty()) return false;
        }
        return false;
    }

private:
    [[nodiscard]] Index tail(Index h) const { return triangles_[h / 3][h % 3]; }
    [[nodiscard]] Index head(Index h) const { return triangles_[h / 3][(h % 3 + 1) % 3]; }
    [[nodiscard]] Index apex(Index h) const { return triangles_[h / 3][(h % 3 + 2) % 3]; }

    // Whether the sides of an edge of the glued mesh come from different edges.
    [[nodiscard]] bool is_repeated(std::span<const EdgeSide> sides) const {
        if (std::ranges::binary_search(alone_, sides[0].ends)) return false;
        if (has_edge(kept_, sides[0].ends)) return true;
        const auto ends_of = [&](const EdgeSide& side) {
            return edge_key(tail(side.half_edge), head(side.half_edge));
        };
        return std::ranges::any_of(
            sides, [&](const EdgeSide& side) { return ends_of(side) != ends_of(sides[0]); });
    }

    void flip_one(std::span<const EdgeSide> sides) {
        for (std::size_t i = 0; i < sides.size(); ++i) {
            for (std::size_t j = i + 1; j < sides.size(); ++j) {
                if (try_flip(sides[i].half_edge, sides[j].half_edge)) return;
            }
        }
    }
    bool try_flip(Index h, Index twin) {
        const Index a = tail(h), b = head(h), c = apex(h), d = apex(twin);
        if (tail(twin) != b || head(twin) != a || vertex_[c] == vertex_[d]) return false;
        const std::uint64_t edge = edge_key(vertex_[c], vertex_[d]);
        if (is_changed_[h / 3] || is_changed_[twin / 3] || has_edge(edges_, edge) ||
            has_edge(kept_, edge) || std::ranges::find(added_, edge) != added_.end()) {
            return false;
        }
        triangles_[h / 3] = {c, d, b};
        triangles_[twin / 3] = {d, c, a};
        is_changed_[h / 3] = is_changed_[twin / 3] = true;
        added_.push_back(edge);
        return true;
    }

    const std::vector<EdgeSide>& kept_;
    const std::vector<std::uint64_t>& alone_;
    std::span<const Index> vertex_;
    std::vector<Triangle>& triangles_;
    std::vector<EdgeSide> edges_;
    std::vector<std::uint64_t> added_;  // In this round.
    std::vector<bool> is_changed_;      // By triangle: in this round.
};

// Edges of the glued mesh that may have more than two faces, ascending: the seam and what was so
// before.
// \param shared  vertex of the glued mesh by position.
std::vector<std::uint64_t> edges_left_alone(const Region& region, const SharedVertices& shared) {
    std::vector<std::uint64_t> edges;
    for (const auto* some : {&region.seam_edges, &region.branched_edges}) {
        for (const auto& [a, b] : *some) {
            const auto at_a = shared.find(region.mesh.positions[a]);
            const auto at_b = shared.find(region.mesh.positions[b]);
            if (at_a == shared.end() || at_b == shared.end()) continue;
            edges.push_back(edge_key(at_a->second, at_b->second));
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

}  // namespace

GluedRegion glue_region(const MeshView& mesh, const Region& region, const TriangleMesh& remeshed,
                        Ticker& ticker) {
    GluedRegion result;
    std::vector<Index> number(mesh.positions.size(), no_index);
    for (const Index f : region.kept) {
        ticker.tick();
        for (const Index v : mesh.triangles[f]) number[v] = 0;
    }
    for (Index v = 0; v < number.size(); ++v) {
        if (number[v] == no_index) continue;
        number[v] = static_cast<Index>(result.kept_vertices.size());
        result.kept_vertices.push_back(v);
        result.mesh.positions.push_back(mesh.positions[v]);
    }
    SharedVertices shared;
    for (const SeamVertex& seam : region.seam) {
        if (seam.shared == no_index) continue;
        shared.emplace(region.mesh.positions[seam.vertex], number[seam.shared]);
    }
    for (const Vec3& position : remeshed.positions) {
        ticker.tick();
        const auto found = shared.find(position);
        if (found != shared.end()) {
            result.vertex.push_back(found->second);
            continue;
        }
        result.vertex.push_back(static_cast<Index>(result.mesh.positions.size()));
        result.mesh.positions.push_back(position);
    }
    for (const Index f : region.kept) {
        const auto& [a, b, c] = mesh.triangles[f];
        result.mesh.triangles.push_back({number[a], number[b], number[c]});
    }
    std::vector<Triangle> triangles = remeshed.triangles;
    const std::vector<EdgeSide> kept = sorted_edge_sides(result.mesh.triangles);
    const std::vector<std::uint64_t> alone = edges_left_alone(region, shared);
    result.is_joined = Parting(kept, alone, result.vertex, triangles).run();
    for (const Triangle& t : rename_vertices(triangles, result.vertex)) {
        result.mesh.triangles.push_back(t);
    }
    return result;
}

}  // namespace remesh::detail
