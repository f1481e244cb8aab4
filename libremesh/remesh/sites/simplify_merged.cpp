#include "remesh/sites/simplify_merged.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/dual/reduce_vertices.h"

namespace remesh::detail {
namespace {

// Edge lengths grow by this share of the longest, so that no triangle is flat.
constexpr double least_slack = 1e-6;

class MergedSimplifier {
public:
    MergedSimplifier(const Surface& surface, std::span<const SurfacePoint> sites,
                     const MergedMesh& merged, Ticker ticker)
        : surface_(surface),
          sites_(sites),
          merged_(merged),
          component_(label_components(surface.twin, ticker)) {}

    Index run(std::vector<Triangle>& triangles) const {
        const std::vector<Part> parts = find_parts(triangles);
        for (const Part& part : parts) append_simplified(part, triangles);
        return static_cast<Index>(parts.size());
    }

private:
    // A component with vertices besides sites.
    struct Part {
        std::vector<Triangle> merged;  // Of numbers.
        std::vector<Index> faces;      // Of the surface, ascending.
        std::vector<Index> sites;      // One at each position.
    };

    [[nodiscard]] Index num_sites() const { return static_cast<Index>(sites_.size()); }

    [[nodiscard]] Index component_of(Index number) const {
        if (number < num_sites()) return component_.of_face[sites_[number].face.value()];
        const Index vertex = merged_.vertex[number - num_sites()];
        return component_.of_face[Surface::face(surface_.outgoing[vertex])];
    }

    // Drops their triangles of sites.
    std::vector<Part> find_parts(std::vector<Triangle>& triangles) const {
        std::vector<Part> parts;
        std::vector<Index> rank(component_.count, no_index);
        for (Index i = 0; i < merged_.vertex.size(); ++i) {
            Index& r = rank[component_of(num_sites() + i)];
            if (r != no_index) continue;
            r = static_cast<Index>(parts.size());
            parts.emplace_back();
        }
        for (const Triangle& t : merged_.triangles) {
            if (const Index r = rank[component_of(t[0])]; r != no_index) {
                parts[r].merged.push_back(t);
            }
        }
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            if (const Index r = rank[component_.of_face[f]]; r != no_index) {
                parts[r].faces.push_back(f);
            }
        }
        for (const Index s : distinct_points(surface_, sites_)) {
            if (const Index r = rank[component_of(s)]; r != no_index) parts[r].sites.push_back(s);
        }
        std::erase_if(triangles,
                      [&](const Triangle& t) { return rank[component_of(t[0])] != no_index; });
        return parts;
    }

    void append_simplified(const Part& part, std::vector<Triangle>& triangles) const {
        std::vector<Index> numbers;
        for (const Triangle& t : part.merged) numbers.insert(numbers.end(), t.begin(), t.end());
        numbers = distinct(std::move(numbers));
        if (const std::optional<Surface> merged = straight_surface(part.merged, numbers)) {
            numbers.erase(std::lower_bound(numbers.begin(), numbers.end(), num_sites()),
                          numbers.end());
            std::vector<SurfacePoint> points;
            for (Index v = 0; v < numbers.size(); ++v) points.push_back(point_at(*merged, v));
            std::vector<Index> faces(merged->num_faces());
            std::iota(faces.begin(), faces.end(), Index{0});
            append(simplify_patch(*merged, faces, points), numbers, triangles);
        } else {
            append(simplify_patch(surface_, part.faces, take(sites_, part.sites)), part.sites,
                   triangles);
        }
    }

    // None if the triangles are no mesh, or not connected.
    // \param numbers  of their corners, ascending; the numbers of the surface's vertices are ranks.
    [[nodiscard]] std::optional<Surface> straight_surface(std::span<const Triangle> triangles,
                                                          std::span<const Index> numbers) const {
        TriangleMesh mesh;
        for (const Index i : numbers) {
            mesh.positions.push_back(
                i < num_sites() ? position(surface_.mesh.view(), sites_[i])
                                : surface_.mesh.positions[merged_.vertex[i - num_sites()]]);
        }
        for (const auto& [a, b, c] : triangles) {
            mesh.triangles.push_back(
                {rank_of(numbers, a), rank_of(numbers, b), rank_of(numbers, c)});
        }
        std::optional<Connectivity> connectivity = find_connectivity(mesh.view());
        if (!connectivity || label_components(connectivity->twin).count != 1) return std::nullopt;
        std::vector<double> length;
        for (const Triangle& t : mesh.triangles) {
            for (Index k = 0; k < 3; ++k) {
                length.push_back((mesh.positions[t[(k + 1) % 3]] - mesh.positions[t[k]]).norm());
            }
        }
        const double slack = least_slack * std::ranges::max(length);
        for (double& l : length) l += slack;
        return build_surface(std::move(mesh), *std::move(connectivity), length, 1, {});
    }

    static void append(const SimplifiedMesh& part, std::span<const Index> sites,
                       std::vector<Triangle>& triangles) {
        for (const auto& [i, j, k] : part.triangles) {
            if (std::max({i, j, k}) >= sites.size()) continue;
            triangles.push_back({sites[i], sites[j], sites[k]});
        }
    }

    const Surface& surface_;
    const std::span<const SurfacePoint> sites_;
    const MergedMesh& merged_;
    const FaceLabels component_;
};

}  // namespace

Index simplify_merged(const Surface& surface, std::span<const SurfacePoint> sites,
                      const MergedMesh& merged, std::vector<Triangle>& triangles, Ticker ticker) {
    return MergedSimplifier(surface, sites, merged, ticker).run(triangles);
}

}  // namespace remesh::detail
