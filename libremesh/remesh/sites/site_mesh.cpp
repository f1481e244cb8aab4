// Flips are one pass over the edges: those with a negative sum of cotangents, as measured before,
// are tested again and flipped unless that folds the mesh or repeats an edge. In comments a, b are
// the ends of an edge and c, d the corners opposite.
#include "remesh/sites/site_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "agvd/core/types.h"
#include "agvd/mesh/any_mesh.h"

namespace remesh::detail {
namespace {

// Sum of two cotangents below which an edge is flipped: below 0, so that the diagonals of a square
// do not alternate.
constexpr double flip_tolerance = -1e-9;
// Least cosine between the normals of the triangles before and after a flip.
constexpr double least_flip_cosine = 0.2;

double cotangent(const Vec3& a, const Vec3& b) {
    const double sine = a.cross(b).norm();
    return a.dot(b) / std::max(sine, 1e-300);
}

class Flipper {
public:
    Flipper(SiteMesh& mesh, std::span<const Vec3> positions, Ticker ticker)
        : mesh_(mesh), positions_(positions), ticker_(ticker) {}

    Index run(std::span<const double> cotangent) {
        Index flips = 0;
        for (Index h = 0; h < mesh_.twin.size(); ++h) {
            ticker_.tick();
            const Index twin = mesh_.twin[h];
            if (twin == no_index || twin < h) continue;
            if (cotangent[h] + cotangent[twin] >= flip_tolerance) continue;
            // Another flip may have changed the triangles since.
            if (is_delaunay(h, twin) || !can_flip(h, twin)) continue;
            flip(h, twin);
            ++flips;
        }
        return flips;
    }

private:
    [[nodiscard]] const Vec3& at(Index site) const { return positions_[site]; }
    [[nodiscard]] Index apex(Index h) const { return mesh_.tail(SiteMesh::previous(h)); }

    [[nodiscard]] bool is_delaunay(Index h, Index twin) const {
        const Vec3 &a = at(mesh_.tail(h)), &b = at(mesh_.head(h));
        const Vec3 &c = at(apex(h)), &d = at(apex(twin));
        return cotangent(a - c, b - c) + cotangent(a - d, b - d) >= flip_tolerance;
    }

    [[nodiscard]] bool can_flip(Index h, Index twin) const {
        const Index a = mesh_.tail(h), b = mesh_.head(h), c = apex(h), d = apex(twin);
        if (c == d || are_joined(mesh_.triangles, mesh_.twin, SiteMesh::previous(h), d))
            return false;
        const Vec3 before = (at(b) - at(a)).cross(at(c) - at(a)).normalized() +
                            (at(a) - at(b)).cross(at(d) - at(b)).normalized();
        const Vec3 left = (at(d) - at(c)).cross(at(b) - at(c));
        const Vec3 right = (at(c) - at(d)).cross(at(a) - at(d));
        const double least = least_flip_cosine * before.norm();
        return before.dot(left) > least * left.norm() && before.dot(right) > least * right.norm();
    }

    // Triangles (a, b, c) and (b, a, d) become (c, d, b) and (d, c, a), in place.
    void flip(Index h, Index twin) {
        const Index a = mesh_.tail(h), b = mesh_.head(h), c = apex(h), d = apex(twin);
        const Index outer[4] = {mesh_.twin[SiteMesh::next(h)], mesh_.twin[SiteMesh::previous(h)],
                                mesh_.twin[SiteMesh::next(twin)],
                                mesh_.twin[SiteMesh::previous(twin)]};
        const Index left = 3 * (h / 3), right = 3 * (twin / 3);
        mesh_.triangles[h / 3] = {c, d, b};
        mesh_.triangles[twin / 3] = {d, c, a};
        join(left, right);
        join(left + 1, outer[3]);   // d b
        join(left + 2, outer[0]);   // b c
        join(right + 1, outer[1]);  // c a
        join(right + 2, outer[2]);  // a d
    }
    void join(Index h, Index other) {
        mesh_.twin[h] = other;
        if (other != no_index) mesh_.twin[other] = h;
    }

    SiteMesh& mesh_;
    std::span<const Vec3> positions_;
    Ticker ticker_;
};

}  // namespace

SiteMesh build_site_mesh(std::vector<Triangle> triangles, Index num_sites, Ticker ticker) {
    SiteMesh mesh{std::move(triangles), {}, {}};
    const auto num_half_edges = static_cast<Index>(3 * mesh.triangles.size());
    std::vector<std::pair<std::uint64_t, Index>> keys(num_half_edges);
    for (Index h = 0; h < num_half_edges; ++h) {
        keys[h] = {edge_key(mesh.tail(h), mesh.head(h)), h};
    }
    sort_ticked(keys, ticker, std::less<>());
    mesh.twin.assign(num_half_edges, no_index);
    mesh.is_rim.assign(num_sites, 0);
    for (std::size_t i = 0, end = 0; i < keys.size(); i = end) {
        while (end < keys.size() && keys[end].first == keys[i].first) ++end;
        const Index h = keys[i].second;
        if (end - i == 2 && mesh.tail(h) != mesh.tail(keys[i + 1].second)) {
            mesh.twin[h] = keys[i + 1].second;
            mesh.twin[keys[i + 1].second] = h;
        } else {
            mesh.is_rim[mesh.tail(h)] = mesh.is_rim[mesh.head(h)] = 1;
        }
    }
    return mesh;
}

Index flip_towards_delaunay(SiteMesh& mesh, std::span<const Vec3> positions,
                            std::span<const double> cotangent, Ticker ticker) {
    return Flipper(mesh, positions, ticker).run(cotangent);
}

}  // namespace remesh::detail
