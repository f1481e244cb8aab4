// The dihedral angle of an edge comes from the normals of its two faces as seen from the edge. A
// thin face has no reliable normal: it takes the one of the face across its longest other side,
// over a few such steps.
#include "remesh/quality/edge_dihedrals.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <unordered_map>

#include "agvd/core/random.h"
#include "agvd/mesh/any_mesh.h"

namespace remesh::detail {
namespace {

constexpr int most_steps = 6;

// Normals of faces as seen from their edges.
class FaceNormals {
public:
    FaceNormals(const MeshView& mesh, double thin, Ticker& ticker)
        : sides_(sorted_edge_sides(mesh.triangles, ticker)),
          first_side_(sides_.size()),
          length_(sides_.size()) {
        for_each_edge(sides_, [&](std::span<const EdgeSide> edge) {
            ticker.tick();
            const double length =
                (mesh.positions[edge[0].low()] - mesh.positions[edge[0].high()]).norm();
            for (const EdgeSide& side : edge) {
                first_side_[side.half_edge] = static_cast<Index>(edge.data() - sides_.data());
                length_[side.half_edge] = length;
            }
        });
        for (Index f = 0; f < mesh.triangles.size(); ++f) {
            ticker.tick();
            const auto& [a, b, c] = mesh.triangles[f];
            const auto& p = mesh.positions;
            const Vec3 area = (p[b] - p[a]).cross(p[c] - p[a]);
            const double twice = area.norm();
            const double longest =
                std::max({length_[3 * f], length_[3 * f + 1], length_[3 * f + 2]});
            is_thin_.push_back(twice <= thin * longest ? 1 : 0);
            normals_.push_back(twice > 0 ? Vec3(area / twice) : Vec3(Vec3::Zero()));
        }
    }

    [[nodiscard]] const std::vector<EdgeSide>& sides() const { return sides_; }

    // Normal of the surface at this side, on the left of its edge from the lower vertex to the
    // higher; zero if there is none.
    [[nodiscard]] Vec3 normal(const EdgeSide& side) const {
        Index h = side.half_edge;
        bool is_up = side.forward;
        for (int step = 0; is_thin_[h / 3] != 0 && step <= most_steps; ++step) {
            const Index exit = longest_other_side(h);
            if (exit == no_index) break;
            const EdgeSide& here = side_of(exit);
            const EdgeSide& across = other_side(here);
            // The face across is oriented the other way.
            if (across.forward == here.forward) is_up = !is_up;
            h = across.half_edge;
        }
        return is_up ? normals_[h / 3] : Vec3(-normals_[h / 3]);
    }

private:
    // The longest other half-edge of the face that has exactly one face across.
    [[nodiscard]] Index longest_other_side(Index h) const {
        Index best = no_index;
        for (Index k = 3 * (h / 3); k < 3 * (h / 3) + 3; ++k) {
            if (k == h || num_sides(k) != 2) continue;
            if (best == no_index || length_[k] > length_[best]) best = k;
        }
        return best;
    }
    [[nodiscard]] Index num_sides(Index h) const {
        const Index first = first_side_[h];
        Index end = first;
        while (end < sides_.size() && sides_[end].ends == sides_[first].ends) ++end;
        return end - first;
    }
    [[nodiscard]] const EdgeSide& side_of(Index h) const {
        Index i = first_side_[h];
        while (sides_[i].half_edge != h) ++i;
        return sides_[i];
    }
    // Of an edge with two sides: the other one.
    [[nodiscard]] const EdgeSide& other_side(const EdgeSide& side) const {
        const Index first = first_side_[side.half_edge];
        return sides_[first].half_edge == side.half_edge ? sides_[first + 1] : sides_[first];
    }

    std::vector<EdgeSide> sides_;
    std::vector<Index> first_side_;      // #H: of its edge, in sides_.
    std::vector<double> length_;         // #H.
    std::vector<std::uint8_t> is_thin_;  // #F.
    std::vector<Vec3> normals_;          // #F.
};

}  // namespace

TriangleMesh without_copies(const MeshView& mesh, Ticker& ticker) {
    TriangleMesh result;
    std::unordered_map<Vec3, Index, PositionHash> indices;
    std::vector<Index> index_of(mesh.positions.size(), no_index);
    std::vector<std::pair<Triangle, Index>> faces;  // Sorted corners, face.
    std::vector<Triangle> kept;
    for (const Triangle& t : mesh.triangles) {
        ticker.tick(8);
        Triangle face;
        for (int k = 0; k < 3; ++k) {
            Index& index = index_of[t[k]];
            if (index == no_index) {
                const auto [it, is_new] = indices.try_emplace(
                    mesh.positions[t[k]], static_cast<Index>(result.positions.size()));
                if (is_new) result.positions.push_back(mesh.positions[t[k]]);
                index = it->second;
            }
            face[k] = index;
        }
        if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
        Triangle corners = face;
        std::sort(corners.begin(), corners.end());
        faces.emplace_back(corners, static_cast<Index>(kept.size()));
        kept.push_back(face);
    }
    sort_ticked(faces, ticker, std::less<>());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        ticker.tick();
        if (i > 0 && faces[i].first == faces[i - 1].first) continue;
        result.triangles.push_back(kept[faces[i].second]);
    }
    return result;
}

std::vector<EdgeDihedral> edge_dihedrals(const MeshView& mesh, double thin, Ticker& ticker) {
    const FaceNormals normals(mesh, thin, ticker);
    std::vector<EdgeDihedral> edges;
    for_each_edge(normals.sides(), [&](std::span<const EdgeSide> edge) {
        ticker.tick();
        const auto num_faces = static_cast<Index>(edge.size());
        double angle = std::numbers::pi;
        if (num_faces == 2) {
            // Seen from the edge, the other face lies on the other side, so its normal is turned.
            const Vec3 a = normals.normal(edge[0]), b = -normals.normal(edge[1]);
            angle = std::atan2(a.cross(b).norm(), a.dot(b));
        }
        edges.push_back({{edge[0].low(), edge[0].high()}, angle, num_faces});
    });
    return edges;
}

}  // namespace remesh::detail
