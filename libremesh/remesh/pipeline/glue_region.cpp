// Vertices of the remeshed region are recognised as those of the seam by their positions.
#include "remesh/pipeline/glue_region.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "agvd/core/random.h"
#include "agvd/core/types.h"

namespace remesh::detail {
namespace {

using SharedVertices = std::unordered_map<Vec3, Index, PositionHash>;

// Most rounds of flips: one can repeat another kept edge.
constexpr int most_flip_rounds = 10;

struct EdgeOfFace {
    std::uint64_t edge;  // Of vertices of the glued mesh.
    Index half_edge;     // 3 t + k

    [[nodiscard]] bool operator<(const EdgeOfFace& other) const {
        return edge != other.edge ? edge < other.edge : half_edge < other.half_edge;
    }
};

// \param vertex  of the glued mesh, for each vertex of the triangles.
std::vector<EdgeOfFace> sorted_edges(std::span<const Triangle> triangles,
                                     std::span<const Index> vertex) {
    std::vector<EdgeOfFace> edges;
    edges.reserve(3 * triangles.size());
    for (Index f = 0; f < triangles.size(); ++f) {
        for (Index k = 0; k < 3; ++k) {
            const Index a = triangles[f][k], b = triangles[f][(k + 1) % 3];
            edges.push_back({edge_key(vertex[a], vertex[b]), 3 * f + k});
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

bool has_edge(const std::vector<EdgeOfFace>& edges, std::uint64_t edge) {
    const auto found = std::lower_bound(edges.begin(), edges.end(), EdgeOfFace{edge, 0});
    return found != edges.end() && found->edge == edge;
}

// Flips edges of the region that gluing would give other faces than those beside them.
class Parting {
public:
    // \param kept   edges of the kept faces.
    // \param alone  edges that are left as they are, ascending.
    Parting(const std::vector<EdgeOfFace>& kept, const std::vector<std::uint64_t>& alone,
            std::span<const Index> vertex, std::vector<Triangle>& triangles)
        : kept_(kept), alone_(alone), vertex_(vertex), triangles_(triangles) {}

    // \return whether no such edge is left.
    bool run() {
        for (int round = 0; round < most_flip_rounds; ++round) {
            edges_ = sorted_edges(triangles_, vertex_);
            added_.clear();
            is_changed_.assign(triangles_.size(), false);
            bool has_repeated = false;
            for (std::size_t first = 0, last = 0; first < edges_.size(); first = last) {
                while (last < edges_.size() && edges_[last].edge == edges_[first].edge) ++last;
                if (!is_repeated(first, last)) continue;
                has_repeated = true;
                flip_one(first, last);
            }
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
    [[nodiscard]] bool is_repeated(std::size_t first, std::size_t last) const {
        const std::uint64_t edge = edges_[first].edge;
        if (std::binary_search(alone_.begin(), alone_.end(), edge)) return false;
        if (has_edge(kept_, edge)) return true;
        const auto ends_of = [&](std::size_t i) {
            return edge_key(tail(edges_[i].half_edge), head(edges_[i].half_edge));
        };
        for (std::size_t i = first + 1; i < last; ++i) {
            if (ends_of(i) != ends_of(first)) return true;
        }
        return false;
    }

    void flip_one(std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            for (std::size_t j = i + 1; j < last; ++j) {
                if (try_flip(edges_[i].half_edge, edges_[j].half_edge)) return;
            }
        }
    }
    bool try_flip(Index h, Index twin) {
        const Index a = tail(h), b = head(h), c = apex(h), d = apex(twin);
        if (tail(twin) != b || head(twin) != a || vertex_[c] == vertex_[d]) return false;
        const std::uint64_t edge = edge_key(vertex_[c], vertex_[d]);
        if (is_changed_[h / 3] || is_changed_[twin / 3] || has_edge(edges_, edge) ||
            has_edge(kept_, edge) ||
            std::find(added_.begin(), added_.end(), edge) != added_.end()) {
            return false;
        }
        triangles_[h / 3] = {c, d, b};
        triangles_[twin / 3] = {d, c, a};
        is_changed_[h / 3] = is_changed_[twin / 3] = true;
        added_.push_back(edge);
        return true;
    }

    const std::vector<EdgeOfFace>& kept_;
    const std::vector<std::uint64_t>& alone_;
    std::span<const Index> vertex_;
    std::vector<Triangle>& triangles_;
    std::vector<EdgeOfFace> edges_;
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
    std::vector<Index> itself(result.mesh.positions.size());
    std::iota(itself.begin(), itself.end(), Index{0});
    std::vector<Triangle> triangles = remeshed.triangles;
    const std::vector<EdgeOfFace> kept = sorted_edges(result.mesh.triangles, itself);
    const std::vector<std::uint64_t> alone = edges_left_alone(region, shared);
    result.is_joined = Parting(kept, alone, result.vertex, triangles).run();
    for (const auto& [a, b, c] : triangles) {
        result.mesh.triangles.push_back({result.vertex[a], result.vertex[b], result.vertex[c]});
    }
    return result;
}

}  // namespace remesh::detail
