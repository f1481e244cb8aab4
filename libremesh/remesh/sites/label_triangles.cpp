// The surface's faces, some divided, with all vertices of a label merged into their site.
#include "remesh/sites/label_triangles.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/curves/walk.h"
#include "remesh/dual/fan_mesh.h"

namespace remesh::detail {
namespace {

class LabelTriangulation {
public:
    LabelTriangulation(const Surface& surface, const DistanceBounds& labels,
                       std::span<const SurfacePoint> sites, std::span<const DirectedEdge> chain)
        : sites_(sites),
          chain_(chain),
          faces_(surface.mesh.triangles),
          label_(labels.site),
          is_on_chain_(sites.size(), 0) {
        for (const auto& [from, to] : chain_) is_on_chain_[from] = is_on_chain_[to] = 1;
        std::vector<std::uint8_t> has_vertex(sites.size(), 0);
        for (Index v = 0; v < label_.size(); ++v) {
            const Index s = label_[v];
            if (s == no_index) continue;
            if (is_on_chain_[s] == 0 || surface.is_boundary_vertex(v)) has_vertex[s] = 1;
        }
        insert_missing(has_vertex);
    }

    std::vector<Triangle> run() {
        std::vector<Triangle> triangles = merge();
        if (chain_.empty()) return triangles;
        close_rim(chain_, triangles);
        open_ears(triangles);
        return triangles;
    }

private:
    [[nodiscard]] Index num_sites() const { return static_cast<Index>(sites_.size()); }

    // A corner of a part of a face: the vertex, and where it lies in the face.
    struct PartCorner {
        Index vertex;
        std::array<double, 3> at;  // Barycentric.
    };
    using Part = std::array<PartCorner, 3>;

    // Divides the faces that hold sites which label no vertex, so that each gets one.
    void insert_missing(std::span<const std::uint8_t> has_vertex) {
        std::vector<std::pair<Index, Index>> missing;  // By face.
        for (Index s = 0; s < num_sites(); ++s) {
            if (has_vertex[s] == 0) missing.emplace_back(sites_[s].face.value(), s);
        }
        std::ranges::sort(missing);
        for (std::size_t i = 0; i < missing.size();) {
            const Index face = missing[i].first;
            const Triangle corners = faces_[face];
            std::vector<Part> parts{
                {{{corners[0], {1, 0, 0}}, {corners[1], {0, 1, 0}}, {corners[2], {0, 0, 1}}}}};
            for (; i < missing.size() && missing[i].first == face; ++i) {
                insert(missing[i].second, parts);
            }
            faces_[face] = triangle_of(parts[0]);
            for (std::size_t k = 1; k < parts.size(); ++k) faces_.push_back(triangle_of(parts[k]));
        }
    }

    void insert(Index site, std::vector<Part>& parts) {
        const PartCorner added{static_cast<Index>(label_.size()), sites_[site].barycentric};
        label_.push_back(site);
        const auto around = [&](const Part& part) {
            std::array<Part, 3> three{part, part, part};
            for (std::size_t k = 0; k < 3; ++k) three[k][k] = added;
            return three;
        };
        const auto holds = std::ranges::max_element(parts, {}, [&](const Part& part) {
            const std::array<Part, 3> three = around(part);
            return std::min({area(three[0]), area(three[1]), area(three[2])});
        });
        std::array<Part, 3> three = around(*holds);
        // A site on the boundary divides an edge: the third part has no area.
        std::ranges::sort(three, std::greater<>(), area);
        *holds = three[0];
        parts.push_back(three[1]);
        if (is_on_chain_[site] == 0) parts.push_back(three[2]);
    }

    static Triangle triangle_of(const Part& part) {
        return {part[0].vertex, part[1].vertex, part[2].vertex};
    }
    // As a share of that of the face.
    static double area(const Part& part) {
        const auto& [a, b, c] = part;
        return (b.at[1] - a.at[1]) * (c.at[2] - a.at[2]) -
               (b.at[2] - a.at[2]) * (c.at[1] - a.at[1]);
    }

    [[nodiscard]] std::vector<Triangle> merge() const {
        std::vector<Triangle> triangles;
        for (const Triangle& t : faces_) {
            const Index a = label_[t[0]], b = label_[t[1]], c = label_[t[2]];
            if (a != b && b != c && c != a) triangles.push_back({a, b, c});
        }
        return triangles;
    }

    // A site of a curve that labels no inner vertex gets one triangle, which may be flat where the
    // curve was jagged. Flips the edge opposite.
    void open_ears(std::vector<Triangle>& triangles) const {
        FanMesh mesh(triangles, num_sites());
        for (Index f = 0; f < mesh.num_faces(); ++f) {
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                const bool is_ear = mesh.faces_at(mesh.apex(h)).size() == 1;
                if (is_ear && mesh.twin(h) != no_index && mesh.can_flip(h)) {
                    mesh.flip(h);
                    break;
                }
            }
        }
        triangles = mesh.triangles();
    }

    const std::span<const SurfacePoint> sites_;
    const std::span<const DirectedEdge> chain_;
    std::vector<Triangle> faces_;            // Of the surface; some are divided.
    std::vector<Index> label_;               // By vertex, those of missing sites last.
    std::vector<std::uint8_t> is_on_chain_;  // #sites
};

}  // namespace

std::vector<Triangle> triangulate_by_labels(const Surface& surface, const DistanceBounds& labels,
                                            std::span<const SurfacePoint> sites,
                                            std::span<const DirectedEdge> chain) {
    return LabelTriangulation(surface, labels, sites, chain).run();
}

void correct_labels(const PreparedSurface& surface, std::span<const SurfacePoint> sites,
                    std::span<const Triangle> triangles, std::vector<Index>& label) {
    struct Place {
        Vec3 at, facing;
    };
    const auto place_of = [&](const SurfacePoint& point) {
        return Place{position(surface.input().mesh.view(), point),
                     facing_at(surface.input(), point)};
    };
    std::vector<Place> places;
    places.reserve(sites.size());
    for (const SurfacePoint& site : sites) places.push_back(place_of(site));
    const FanMesh fans(triangles, static_cast<Index>(sites.size()));
    const IntrinsicTriangulation& base = surface.base;
    for (Index v = 0; v < label.size(); ++v) {
        if (label[v] == no_index) continue;
        const Place here = place_of(base.to_input(point_at(base.surface(), v)));
        const auto distance = [&](Index s) { return (places[s].at - here.at).squaredNorm(); };
        for (bool is_done = false; !is_done;) {
            Index best = label[v];
            for (const Index f : fans.faces_at(label[v])) {
                for (const Index s : triangles[f]) {
                    if (!(distance(s) < distance(best))) continue;
                    if (places[s].facing.dot(here.facing) > 0) best = s;
                }
            }
            is_done = std::exchange(label[v], best) == best;
        }
    }
}

}  // namespace remesh::detail
