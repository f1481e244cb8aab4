#include "remesh/dual/simplify_narrow.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "agvd/core/groups.h"
#include "agvd/core/union_find.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/dual/reduce_vertices.h"

namespace remesh::detail {
namespace {

// Edges from the vertices that go to the border of the part that changes: of the first try, and how
// much more in each further one.
constexpr Index first_reach = 1, reach_ratio = 4;
// Edge lengths grow by this share of the longest, so that no triangle is flat.
constexpr double least_slack = 1e-6;

class Simplifier {
public:
    Simplifier(std::span<const Vec3> positions, Index num_sites, std::vector<Triangle>& triangles,
               Ticker ticker)
        : positions_(positions), num_sites_(num_sites), triangles_(triangles), ticker_(ticker) {}

    Index run() {
        Index num_parts = 0;
        for (Index reach = first_reach;; reach *= reach_ratio) {
            const std::vector<Part> parts = find_parts(reach);
            bool grows = false;
            std::vector<std::uint8_t> is_replaced(triangles_.size(), 0);
            std::vector<Triangle> added;
            for (const Part& part : parts) {
                if (part.is_done) continue;
                std::optional<std::vector<Triangle>> made = simplified(part);
                if (!made) {
                    grows = grows || !part.is_component;
                    continue;
                }
                for (const Index t : part.triangles) is_replaced[t] = 1;
                added.insert(added.end(), made->begin(), made->end());
                ++num_parts;
            }
            replace(is_replaced, added);
            if (!grows) return num_parts;
        }
    }

private:
    struct Part {
        std::vector<Index> triangles;
        bool is_component = true;  // All that is connected with it.
        bool is_done = true;       // Its vertices have been tried with all around.
    };

    [[nodiscard]] bool is_extra(Index v) const { return v >= num_sites_; }

    // The triangles within some edges of vertices that go, in connected parts.
    [[nodiscard]] std::vector<Part> find_parts(Index reach) {
        const Groups around = triangles_by_vertex(triangles_, positions_.size());
        std::vector<Index> ring(positions_.size(), no_index), now;
        for (Index v = num_sites_; v < positions_.size(); ++v) {
            if (around.of(v).empty()) continue;
            ring[v] = 0;
            now.push_back(v);
        }
        UnionFind joined(triangles_.size());
        std::vector<std::uint8_t> is_in(triangles_.size(), 0), is_cut_off(triangles_.size(), 0);
        for (Index r = 0; r < reach && !now.empty(); ++r) {
            std::vector<Index> next;
            for (const Index v : now) {
                Index first = no_index;
                for (const Index t : around.of(v)) {
                    ticker_.tick();
                    is_in[t] = 1;
                    if (first == no_index) first = t;
                    joined.unite(first, t);
                    for (const Index w : triangles_[t]) {
                        if (ring[w] != no_index) continue;
                        ring[w] = r + 1;
                        next.push_back(w);
                    }
                }
            }
            now = std::move(next);
        }
        for (const Index v : now) {
            for (const Index t : around.of(v)) {
                if (is_in[t] != 0) continue;
                for (const Index in : around.of(v)) is_cut_off[in] = is_in[in];
                break;
            }
        }
        std::vector<Part> parts;
        std::vector<Index> number(triangles_.size(), no_index);
        for (Index t = 0; t < triangles_.size(); ++t) {
            if (is_in[t] == 0) continue;
            Index& n = number[joined.root(t)];
            if (n == no_index) {
                n = static_cast<Index>(parts.size());
                parts.emplace_back();
            }
            Part& part = parts[n];
            part.triangles.push_back(t);
            if (is_cut_off[t] != 0) part.is_component = false;
            for (const Index v : triangles_[t]) {
                if (is_extra(v) && !std::ranges::binary_search(tried_, v)) part.is_done = false;
            }
        }
        return parts;
    }

    // \return none: the part is no mesh, vertices are left, or its edges would repeat others.
    [[nodiscard]] std::optional<std::vector<Triangle>> simplified(const Part& part) {
        std::vector<Index> number;
        for (const Index t : part.triangles) {
            number.insert(number.end(), triangles_[t].begin(), triangles_[t].end());
        }
        number = distinct(std::move(number));
        const std::optional<Surface> surface = straight_surface(part, number);
        std::vector<Triangle> made;
        if (surface) {
            std::vector<SurfacePoint> points;
            for (Index i = 0; i < number.size() && !is_extra(number[i]); ++i) {
                points.push_back(point_at(*surface, i));
            }
            std::vector<Index> faces(surface->num_faces());
            std::iota(faces.begin(), faces.end(), Index{0});
            SimplifiedMesh simple = simplify_patch(*surface, faces, points);
            if (simple.extra.empty() || part.is_component) {
                number.resize(points.size());
                for (const SurfacePoint& extra : simple.extra) {
                    number.push_back(number_of(extra, part));
                }
                made = rename_vertices(simple.triangles, number);
            }
        }
        const bool is_right = !made.empty() && !repeats_edges(part, made);
        if (part.is_component) {
            for (const Index t : part.triangles) {
                for (const Index v : triangles_[t]) {
                    if (is_extra(v)) tried_.push_back(v);
                }
            }
            tried_ = distinct(std::move(tried_));
        }
        if (!is_right) return std::nullopt;
        return made;
    }

    // Of a vertex of the part that stays.
    [[nodiscard]] Index number_of(const SurfacePoint& point, const Part& part) const {
        const auto corner = std::ranges::max_element(point.barycentric) - point.barycentric.begin();
        return triangles_[part.triangles[point.face.value()]][static_cast<std::size_t>(corner)];
    }

    // None if the triangles are no mesh, or not connected.
    [[nodiscard]] std::optional<Surface> straight_surface(const Part& part,
                                                          std::span<const Index> number) const {
        TriangleMesh mesh;
        for (const Index v : number) mesh.positions.push_back(positions_[v]);
        for (const Index t : part.triangles) {
            const auto& [a, b, c] = triangles_[t];
            mesh.triangles.push_back({rank_of(number, a), rank_of(number, b), rank_of(number, c)});
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

    // Whether an inner edge joins two vertices of the rim that an edge outside joins as well.
    [[nodiscard]] bool repeats_edges(const Part& part, std::span<const Triangle> made) const {
        if (part.is_component) return false;
        std::vector<Index> vertices;
        for (const Triangle& t : made) vertices.insert(vertices.end(), t.begin(), t.end());
        vertices = distinct(std::move(vertices));
        std::vector<std::uint64_t> outside;
        Index next = 0;
        for (Index t = 0; t < triangles_.size(); ++t) {
            if (next < part.triangles.size() && part.triangles[next] == t) {
                ++next;
                continue;
            }
            for (Index k = 0; k < 3; ++k) {
                const Index a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
                if (std::ranges::binary_search(vertices, a) &&
                    std::ranges::binary_search(vertices, b)) {
                    outside.push_back(edge_key(a, b));
                }
            }
        }
        outside = distinct(std::move(outside));
        bool repeats = false;
        for_each_edge(sorted_edge_sides(made), [&](std::span<const EdgeSide> sides) {
            if (sides.size() == 2 && std::ranges::binary_search(outside, sides[0].ends)) {
                repeats = true;
            }
        });
        return repeats;
    }

    void replace(const std::vector<std::uint8_t>& is_replaced, std::span<const Triangle> added) {
        std::size_t kept = 0;
        for (Index t = 0; t < is_replaced.size(); ++t) {
            if (is_replaced[t] == 0) triangles_[kept++] = triangles_[t];
        }
        triangles_.resize(kept);
        triangles_.insert(triangles_.end(), added.begin(), added.end());
    }

    const std::span<const Vec3> positions_;
    const Index num_sites_;
    std::vector<Triangle>& triangles_;
    Ticker ticker_;
    std::vector<Index> tried_;  // Ascending: vertices whose whole components have been tried.
};

}  // namespace

Index simplify_narrow(std::span<const Vec3> positions, Index num_sites,
                      std::vector<Triangle>& triangles, Ticker ticker) {
    return Simplifier(positions, num_sites, triangles, ticker).run();
}

}  // namespace remesh::detail
