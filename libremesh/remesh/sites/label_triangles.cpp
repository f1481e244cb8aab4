// Numbers of the vertices: the site whose cell is merged into it, or one of their own from the
// number of sites on.
#include "remesh/sites/label_triangles.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/curves/walk.h"
#include "remesh/dual/fan_mesh.h"
#include "remesh/dual/reduce_vertices.h"
#include "remesh/sites/site_mesh.h"

namespace remesh::detail {
namespace {

class LabelTriangulation {
public:
    LabelTriangulation(const Surface& surface, const DistanceBounds& labels,
                       std::span<const SurfacePoint> sites, std::span<const DirectedEdge> chain,
                       const Progress& progress)
        : surface_(surface),
          labels_(labels),
          sites_(sites),
          chain_(chain.begin(), chain.end()),
          progress_(progress),
          poller_(progress),
          faces_(surface.mesh.triangles),
          number_(labels.site),
          nearest_(sites.size(), no_index),
          is_on_chain_(sites.size(), 0),
          is_split_(sites.size(), 0) {
        std::ranges::sort(chain_);
        for (const auto& [from, to] : chain_) is_on_chain_[from] = is_on_chain_[to] = 1;
        for (Index v = 0; v < number_.size(); ++v) {
            const Index s = number_[v];
            if (s == no_index) continue;
            if (is_on_chain_[s] != 0 && !surface.is_boundary_vertex(v)) continue;
            Index& best = nearest_[s];
            if (best == no_index || labels.distance[v] < labels.distance[best]) best = v;
        }
        insert_missing();
    }

    LabelTriangles run(NarrowLabels narrow) {
        LabelTriangles result{closed(merge()), {}};
        result.narrow = find_broken(result.triangles);
        if (narrow == NarrowLabels::Reduce && !result.narrow.empty()) reduce_labels(result);
        if (!chain_.empty()) open_ears(result.triangles);
        return result;
    }

private:
    [[nodiscard]] Index num_sites() const { return static_cast<Index>(sites_.size()); }
    [[nodiscard]] Index num_numbers() const {
        return num_sites() + static_cast<Index>(vertex_.size());
    }

    // A corner of a part of a face: the vertex, and where it lies in the face.
    struct PartCorner {
        Index vertex;
        std::array<double, 3> at;  // Barycentric.
    };
    using Part = std::array<PartCorner, 3>;

    // Replaces the triangles if that leaves no narrow labels.
    void reduce_labels(LabelTriangles& result) {
        std::vector<Triangle> triangles;
        for (std::vector<Index> broken = result.narrow; split(broken);) {
            triangles = merge();
            broken = find_broken(closed(triangles));
        }
        if (vertex_.empty() || !reduce(triangles)) return;
        triangles = closed(std::move(triangles));
        if (find_broken(triangles).empty()) result.triangles = std::move(triangles);
    }

    // Divides the faces that hold sites which label no vertex, so that each gets one.
    void insert_missing() {
        std::vector<std::pair<Index, Index>> missing;  // By face.
        for (Index s = 0; s < num_sites(); ++s) {
            if (nearest_[s] == no_index) missing.emplace_back(sites_[s].face.value(), s);
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
        const PartCorner added{static_cast<Index>(number_.size()), sites_[site].barycentric};
        number_.push_back(site);
        nearest_[site] = added.vertex;
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
            const Index a = number_[t[0]], b = number_[t[1]], c = number_[t[2]];
            if (a != b && b != c && c != a) triangles.push_back({a, b, c});
        }
        return triangles;
    }

    [[nodiscard]] std::vector<Triangle> closed(std::vector<Triangle> triangles) const {
        if (!chain_.empty()) close_rim(chain_, triangles);
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

    // Sites whose triangles are no fan, and ends of edges by which rim and chain differ.
    std::vector<Index> find_broken(std::vector<Triangle> triangles) {
        std::vector<Index> broken;
        if (!chain_.empty()) {
            std::vector<DirectedEdge> wrong;
            std::ranges::set_symmetric_difference(rim_of(triangles), chain_,
                                                  std::back_inserter(wrong));
            for (const auto& [from, to] : wrong) broken.insert(broken.end(), {from, to});
        }
        const std::vector<Fan> fans =
            find_fans(build_site_mesh(std::move(triangles), num_numbers(), Ticker(poller_)));
        for (Index s = 0; s < num_sites(); ++s) {
            if (fans[s] == Fan::Broken) broken.push_back(s);
        }
        std::erase_if(broken, [&](Index i) { return i >= num_sites(); });
        return distinct(std::move(broken));
    }

    // Gives the vertices of these sites numbers of their own.
    // \return whether there are any.
    bool split(const std::vector<Index>& sites) {
        bool is_new = false;
        for (const Index s : sites) {
            if (nearest_[s] != no_index && is_split_[s] == 0) {
                is_split_[s] = 1;
                is_new = true;
            }
        }
        if (!is_new) return false;
        const std::size_t before = vertex_.size();
        for (Index v = 0; v < labels_.site.size(); ++v) {
            const Index s = number_[v];
            const bool is_split = s < num_sites() && is_split_[s] != 0;
            if (!is_split || v == nearest_[s]) continue;
            number_[v] = num_numbers();
            vertex_.push_back(v);
        }
        return vertex_.size() > before;
    }

    // Removes the vertices that are no sites.
    // \return whether all could be.
    bool reduce(std::vector<Triangle>& triangles) const {
        std::vector<Vec3> positions;
        for (const SurfacePoint& s : sites_) positions.push_back(position(surface_.mesh.view(), s));
        for (const Index v : vertex_) positions.push_back(surface_.mesh.positions[v]);
        std::vector<std::uint8_t> keep(sites_.size(), 1);
        keep.resize(positions.size(), 0);
        std::vector<std::uint8_t> is_used(sites_.size(), 0);
        for (const Triangle& t : triangles) {
            for (const Index i : t) {
                if (i < num_sites()) is_used[i] = 1;
            }
        }
        const auto num_used = static_cast<Index>(std::ranges::count(is_used, 1));
        const std::vector<Index> gone =
            reduce_vertices(positions, triangles, num_used, keep, progress_);
        return gone.size() == vertex_.size() &&
               std::ranges::all_of(gone, [&](Index i) { return i >= num_sites(); });
    }

    const Surface& surface_;
    const DistanceBounds& labels_;
    const std::span<const SurfacePoint> sites_;
    std::vector<DirectedEdge> chain_;  // Ascending.
    const Progress& progress_;
    Poller poller_;
    std::vector<Triangle> faces_;            // Of the surface; some are divided.
    std::vector<Index> number_;              // By vertex, those of missing sites last.
    std::vector<Index> nearest_;             // #sites: of the vertices that it labels.
    std::vector<std::uint8_t> is_on_chain_;  // #sites
    std::vector<std::uint8_t> is_split_;     // #sites: 1 if its vertices have own numbers.
    std::vector<Index> vertex_;              // By number, from the number of sites on.
};

}  // namespace

LabelTriangles triangulate_by_labels(const Surface& surface, const DistanceBounds& labels,
                                     std::span<const SurfacePoint> sites,
                                     std::span<const DirectedEdge> chain, NarrowLabels narrow,
                                     const Progress& progress) {
    return LabelTriangulation(surface, labels, sites, chain, progress).run(narrow);
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
