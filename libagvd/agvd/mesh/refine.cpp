#include "agvd/mesh/refine.h"

#include <algorithm>
#include <cassert>
#include <unordered_map>

#include "agvd/core/poller.h"

namespace agvd {
namespace {

class EdgeSplitter {
public:
    EdgeSplitter(const MeshView& mesh, double max_length, Ticker ticker)
        : max_length_sq_(max_length * max_length), ticker_(ticker) {
        result_.mesh.positions.assign(mesh.positions.begin(), mesh.positions.end());
        result_.mesh.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
        result_.face_origin.resize(mesh.triangles.size());
        for (Index f = 0; f < result_.face_origin.size(); ++f) result_.face_origin[f] = f;
        ticker_.poll();
    }

    RefinedMesh run() {
        while (split_once()) {
        }
        return std::move(result_);
    }

private:
    bool split_once() {
        middle_.clear();
        TriangleMesh& mesh = result_.mesh;
        std::vector<Triangle> triangles;
        std::vector<Index> origin;
        triangles.reserve(mesh.triangles.size());
        origin.reserve(mesh.triangles.size());
        for (Index f = 0; f < mesh.triangles.size(); ++f) {
            ticker_.tick();
            const Triangle t = mesh.triangles[f];
            std::array<Index, 3> m{};
            for (std::size_t k = 0; k < 3; ++k) m[k] = middle_of(t[k], t[(k + 1) % 3]);
            if ((m[0] & m[1] & m[2]) == no_index) {  // Most faces.
                triangles.push_back(t);
                origin.push_back(result_.face_origin[f]);
                continue;
            }
            append_parts(t, m, triangles);
            origin.resize(triangles.size(), result_.face_origin[f]);
        }
        ticker_.poll();
        mesh.triangles = std::move(triangles);
        result_.face_origin = std::move(origin);
        return !middle_.empty();
    }

    // The midpoint of an edge, or no_index if it is short enough.
    Index middle_of(Index a, Index b) {
        std::vector<Vec3>& positions = result_.mesh.positions;
        if ((positions[a] - positions[b]).squaredNorm() <= max_length_sq_) return no_index;
        const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        const auto [found, is_new] = middle_.try_emplace(key, static_cast<Index>(positions.size()));
        if (is_new) positions.push_back((positions[a] + positions[b]) / 2);
        return found->second;
    }

    void append_parts(const Triangle& t, const std::array<Index, 3>& m,
                      std::vector<Triangle>& out) const {
        const auto num_split =
            std::count_if(m.begin(), m.end(), [](Index i) { return i != no_index; });
        if (num_split == 3) {
            out.insert(
                out.end(),
                {{t[0], m[0], m[2]}, {m[0], t[1], m[1]}, {m[2], m[1], t[2]}, {m[0], m[1], m[2]}});
        } else {
            // Turned so that edge 0 is split and, of two split edges, edge 1 is the other.
            std::size_t k = 0;
            while (m[k] == no_index || (num_split == 2 && m[(k + 1) % 3] == no_index)) ++k;
            const Index a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            const Index ab = m[k], bc = m[(k + 1) % 3];
            if (num_split == 1) {
                out.insert(out.end(), {{a, ab, c}, {ab, b, c}});
                return;
            }
            out.push_back({ab, b, bc});
            const std::vector<Vec3>& p = result_.mesh.positions;
            if ((p[a] - p[bc]).squaredNorm() <= (p[ab] - p[c]).squaredNorm()) {
                out.insert(out.end(), {{a, ab, bc}, {a, bc, c}});
            } else {
                out.insert(out.end(), {{a, ab, c}, {ab, bc, c}});
            }
        }
    }

    double max_length_sq_;
    Ticker ticker_;
    RefinedMesh result_;
    std::unordered_map<std::uint64_t, Index> middle_;  // Looked up only: its order does not matter.
};

}  // namespace

bool has_long_edges(const MeshView& mesh, double max_length) {
    const auto is_long = [&](Index a, Index b) {
        return (mesh.positions[a] - mesh.positions[b]).squaredNorm() > max_length * max_length;
    };
    return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
        return is_long(t[0], t[1]) || is_long(t[1], t[2]) || is_long(t[2], t[0]);
    });
}

RefinedMesh split_long_edges(const MeshView& mesh, double max_length, const Progress& progress) {
    assert(max_length > 0);
    Poller poller(progress);
    return EdgeSplitter(mesh, max_length, Ticker(poller)).run();
}

}  // namespace agvd
