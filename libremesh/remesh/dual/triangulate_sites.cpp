// Each face of the surface gives triangles of sites: those of the Voronoi vertices in it or, where
// labels count, the one of its corners' labels. Around narrow sites labels count, and vertices with
// the label of one stay, until all that is left has the surface's topology. Cells and labels fit
// together at edges on which the cells change as the labels of the ends tell.
#include "remesh/dual/triangulate_sites.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/dual/fan_mesh.h"
#include "remesh/dual/reduce_vertices.h"
#include "remesh/dual/simplify_narrow.h"
#include "remesh/dual/site_mesh.h"

namespace remesh::detail {
namespace {

// The number of sites that are corners of new triangles.
Index num_touched(std::vector<Triangle> before, std::vector<Triangle> after, Index num_sites) {
    const auto turn = [](Triangle& t) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    };
    std::vector<Triangle> added;
    std::ranges::for_each(before, turn);
    std::ranges::for_each(after, turn);
    std::ranges::sort(before);
    std::ranges::sort(after);
    std::ranges::set_difference(after, before, std::back_inserter(added));
    std::vector<Index> touched;
    for (const Triangle& t : added) {
        std::ranges::copy_if(t, std::back_inserter(touched),
                             [&](Index v) { return v < num_sites; });
    }
    return static_cast<Index>(distinct(std::move(touched)).size());
}

class SiteTriangulation {
public:
    SiteTriangulation(const Surface& surface, const DistanceBounds& labels,
                      const CellComplex* cells, std::span<const SurfacePoint> sites,
                      std::span<const DirectedEdge> chain, Ticker ticker)
        : surface_(surface),
          cells_(cells),
          sites_(sites),
          chain_(chain.begin(), chain.end()),
          ticker_(ticker),
          faces_(surface.mesh.triangles),
          shows_labels_(faces_.size(), cells == nullptr ? 1 : 0),
          number_(labels.site),
          place_(sites.size(), no_index),
          is_on_chain_(sites.size(), 0) {
        std::ranges::sort(chain_);
        for (const auto& [from, to] : chain_) is_on_chain_[from] = is_on_chain_[to] = 1;
        for (Index v = 0; v < number_.size(); ++v) {
            const Index s = number_[v];
            if (s == no_index) continue;
            if (is_on_chain_[s] != 0 && !surface.is_boundary_vertex(v)) continue;
            Index& best = place_[s];
            if (best == no_index || labels.distance[v] < labels.distance[best]) best = v;
        }
        if (cells == nullptr) insert_missing();
    }

    SiteTriangles run(Narrow narrow) {
        SiteTriangles result{.triangles = closed(merge())};
        result.narrow = find_narrow(result.triangles);
        for (Index s = 0; s < num_sites(); ++s) result.counts.sites += has_cell(s) ? 1 : 0;
        result.counts.sites_of_cells = cells_ != nullptr ? result.counts.sites : 0;
        result.counts.narrow_sites = static_cast<Index>(result.narrow.size());
        if (narrow == Narrow::Simplify && (!result.narrow.empty() || !has_all_components())) {
            const std::vector<Triangle> before = result.triangles;
            simplify_narrow_parts(result);
            if (cells_ != nullptr) {
                result.counts.sites_of_cells -= num_touched(before, result.triangles, num_sites());
            }
        }
        if (!chain_.empty() && cells_ == nullptr) open_ears(result);
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

    // Divides the faces that hold sites which label no vertex, so that each gets one, where labels
    // count.
    void insert_missing() {
        std::vector<std::pair<Index, Index>> missing;  // By face.
        for (Index s = 0; s < num_sites(); ++s) {
            const Index face = sites_[s].face.value();
            if (place_[s] == no_index && shows_labels_[face] != 0 && has_cell(s)) {
                missing.emplace_back(face, s);
            }
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
        shows_labels_.resize(faces_.size(), 1);
    }
    [[nodiscard]] bool has_cell(Index site) const {
        return cells_ == nullptr || cells_->has_cell[site] != 0;
    }

    void insert(Index site, std::vector<Part>& parts) {
        const PartCorner added{static_cast<Index>(number_.size()), sites_[site].barycentric};
        number_.push_back(site);
        place_[site] = added.vertex;
        const auto around = [&](const Part& part) {
            std::array<Part, 3> three{part, part, part};
            for (std::size_t k = 0; k < 3; ++k) three[k][k] = added;
            return three;
        };
        const auto least_area = [&](const Part& part) {
            const std::array<Part, 3> three = around(part);
            return std::min({area(three[0]), area(three[1]), area(three[2])});
        };
        const auto holds = std::max_element(
            parts.begin(), parts.end(),
            [&](const Part& a, const Part& b) { return least_area(a) < least_area(b); });
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
        for (Index f = 0; f < faces_.size(); ++f) {
            if (shows_labels_[f] == 0) continue;
            const Triangle& t = faces_[f];
            const Index a = number_[t[0]], b = number_[t[1]], c = number_[t[2]];
            if (a != b && b != c && c != a) triangles.push_back({a, b, c});
        }
        for_each_cell_triangle([&](Index face, const Triangle& t) {
            if (shows_labels_[face] == 0) triangles.push_back(t);
        });
        return triangles;
    }
    // Calls each(face, triangle) for the Voronoi vertices where three cells meet.
    template <typename Each>
    void for_each_cell_triangle(const Each& each) const {
        if (cells_ == nullptr) return;
        for (Index v = 0; v < cells_->vertex_face.size(); ++v) {
            const auto& [a, b, c] = cells_->vertex_sites[v];
            if (!a.is_valid() || !b.is_valid() || !c.is_valid()) continue;
            if (a == b || b == c || c == a) continue;
            each(cells_->vertex_face[v].value(), {a.value(), b.value(), c.value()});
        }
    }

    [[nodiscard]] std::vector<Triangle> closed(std::vector<Triangle> triangles) const {
        if (!chain_.empty()) close_rim(chain_, triangles);
        return triangles;
    }

    // Edges of the rim or of the chain that the other one lacks; none if any rim will do.
    [[nodiscard]] std::vector<DirectedEdge> wrong_edges(std::span<const Triangle> triangles) const {
        std::vector<DirectedEdge> wrong;
        if (chain_.empty()) return wrong;
        const std::vector<DirectedEdge> rim = rim_of(triangles);
        std::set_symmetric_difference(rim.begin(), rim.end(), chain_.begin(), chain_.end(),
                                      std::back_inserter(wrong));
        return wrong;
    }

    // Twice the Euler characteristic of each label. Of a disc it is 2, of a label that wraps around
    // a tube 0, which the triangles do not tell if all others wrap around it, too.
    [[nodiscard]] std::vector<Index> twice_euler() const {
        std::vector<Index> twice(num_numbers(), 0);
        std::vector<std::uint8_t> is_shown(num_numbers(), cells_ == nullptr ? 1 : 0);
        for (const Index i : number_) {
            if (i != no_index) twice[i] += 2;
        }
        for (Index f = 0; f < faces_.size(); ++f) {
            const Triangle& t = faces_[f];
            const Index a = number_[t[0]], b = number_[t[1]], c = number_[t[2]];
            if (a == no_index) continue;  // So are the others.
            if (shows_labels_[f] != 0) is_shown[a] = is_shown[b] = is_shown[c] = 1;
            twice[a] -= (a == b ? 1 : 0) + (c == a ? 1 : 0);
            twice[b] -= b == c ? 1 : 0;
            if (a == b && b == c) twice[a] += 2;
        }
        for (Index h = 0; h < surface_.twin.size(); ++h) {
            if (surface_.twin[h] != no_index) continue;
            const Index a = number_[surface_.tail(h)];
            if (a != no_index && a == number_[surface_.head(h)]) --twice[a];
        }
        for (Index s = 0; s < num_sites(); ++s) {
            if (is_shown[s] == 0) twice[s] = static_cast<Index>(2 * cells_->cell_euler[s]);
        }
        return twice;
    }

    // Sites whose cells or labels are no disc, or whose triangles are no fan, and ends of edges by
    // which rim and chain differ.
    [[nodiscard]] std::vector<Index> find_narrow(std::vector<Triangle> triangles) const {
        std::vector<Index> narrow;
        for (const auto& [from, to] : wrong_edges(triangles)) {
            narrow.insert(narrow.end(), {from, to});
        }
        const std::vector<Fan> fans =
            find_fans(build_site_mesh(std::move(triangles), num_numbers(), ticker_));
        const std::vector<Index> euler = twice_euler();
        for (Index s = 0; s < num_sites(); ++s) {
            if (has_cell(s) && (fans[s] == Fan::Broken || euler[s] != 2)) narrow.push_back(s);
        }
        std::erase_if(narrow, [&](Index i) { return i >= num_sites(); });
        return distinct(std::move(narrow));
    }

    // Lets labels count where these sites have vertices or cells, and where cells and labels would
    // not fit together.
    // \return whether that changes anything.
    bool show_labels(const std::vector<Index>& sites) {
        if (cells_ == nullptr) return false;
        const auto is_narrow = [&](Index s) { return std::ranges::binary_search(sites, s); };
        std::vector<Index> open;
        const auto show = [&](Index face) {
            if (std::exchange(shows_labels_[face], 1) == 0) open.push_back(face);
        };
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            if (std::ranges::any_of(faces_[f], [&](Index v) { return is_narrow(number_[v]); })) {
                show(f);
            }
        }
        for_each_cell_triangle([&](Index face, const Triangle& t) {
            if (std::ranges::any_of(t, is_narrow)) show(face);
        });
        const bool is_changed = !open.empty();
        while (!open.empty()) {
            const Index face = open.back();
            open.pop_back();
            for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                if (surface_.twin[h] != no_index &&
                    cells_->has_hidden_change[surface_.edge[h]] != 0) {
                    show(Surface::face(surface_.twin[h]));
                }
            }
        }
        if (is_changed) insert_missing();
        return is_changed;
    }

    // Gives the vertices that these sites label numbers of their own.
    // \return whether there are any.
    bool split(const std::vector<Index>& sites) {
        const std::size_t before = vertex_.size();
        for (Index v = 0; v < number_.size(); ++v) {
            const Index s = number_[v];
            if (s >= num_sites() || v == place_[s]) continue;
            if (!std::ranges::binary_search(sites, s)) continue;
            number_[v] = num_numbers();
            vertex_.push_back(v);
        }
        return vertex_.size() > before;
    }

    // Leaves the vertices of narrow labels in place, and simplifies the parts that have some.
    void simplify_narrow_parts(SiteTriangles& result) {
        std::vector<Triangle> merged;
        std::vector<Index> narrow = result.narrow;
        for (bool is_changed = true; is_changed;) {
            is_changed = show_labels(narrow);
            is_changed = split(narrow) || is_changed;
            merged = merge();
            narrow = find_narrow(closed(merged));
        }
        std::vector<Vec3> positions;
        for (const SurfacePoint& site : sites_) {
            positions.push_back(position(surface_.mesh.view(), site));
        }
        for (const Index v : vertex_) positions.push_back(surface_.mesh.positions[v]);
        result.counts.simplified_parts = simplify_narrow(positions, num_sites(), merged, ticker_);
        result.triangles = closed(std::move(merged));
        for (const Index v : vertex_) result.extra.push_back(point_at(surface_, v));
        simplify_components(result);
        drop_unused_extra(result);
    }

    // Whether each component has a site.
    [[nodiscard]] bool has_all_components() const {
        const FaceLabels component = label_components(surface_.twin, ticker_);
        std::vector<Index> found;
        for (const SurfacePoint& s : sites_) found.push_back(component.of_face[s.face.value()]);
        return distinct(std::move(found)).size() == component.count;
    }

    // Replaces the triangles of components of which they are no triangulation.
    void simplify_components(SiteTriangles& result) {
        const FaceLabels component = label_components(surface_.twin, ticker_);
        const std::vector<Component> components = find_components(surface_);
        const auto component_of = [&](Index i) {
            const SurfacePoint& point = i < num_sites() ? sites_[i] : result.extra[i - num_sites()];
            return component.of_face[point.face.value()];
        };
        const std::vector<std::uint8_t> is_right = find_right(components, component_of, result);
        if (std::ranges::find(is_right, 0) == is_right.end()) return;
        std::erase_if(result.triangles,
                      [&](const Triangle& t) { return is_right[component_of(t[0])] == 0; });
        std::vector<std::vector<Index>> sites(component.count);
        for (const Index s : distinct_points(surface_, sites_)) sites[component_of(s)].push_back(s);
        for (Index c = 0; c < component.count; ++c) {
            if (is_right[c] != 0) continue;
            const SimplifiedMesh simple =
                simplify_patch(surface_, components[c].faces, take(sites_, sites[c]));
            for (Index i = 0; i < simple.extra.size(); ++i) {
                sites[c].push_back(num_sites() + static_cast<Index>(result.extra.size()) + i);
            }
            result.extra.insert(result.extra.end(), simple.extra.begin(), simple.extra.end());
            const std::vector<Triangle> made = rename_vertices(simple.triangles, sites[c]);
            result.triangles.insert(result.triangles.end(), made.begin(), made.end());
            ++result.counts.simplified_parts;
            ++result.counts.simplified_patches;
        }
    }

    // By component: 1 if its triangles are a manifold with its Euler characteristic and its chain.
    template <typename ComponentOf>
    [[nodiscard]] std::vector<std::uint8_t> find_right(std::span<const Component> components,
                                                       const ComponentOf& component_of,
                                                       const SiteTriangles& result) const {
        const auto num_vertices = num_sites() + static_cast<Index>(result.extra.size());
        std::vector<std::uint8_t> is_right(components.size(), 1);
        std::vector<int> twice;
        for (const Component& component : components) twice.push_back(2 * component.euler);
        const SiteMesh mesh = build_site_mesh(result.triangles, num_vertices, ticker_);
        const std::vector<Fan> fans = find_fans(mesh);
        std::vector<std::uint8_t> is_used(num_vertices, 0);
        for (Index t = 0; t < mesh.triangles.size(); ++t) {
            const Index c = component_of(mesh.triangles[t][0]);
            ++twice[c];
            for (Index k = 0; k < 3; ++k) {
                is_used[mesh.triangles[t][k]] = 1;
                if (mesh.twin[3 * t + k] == no_index) ++twice[c];
            }
        }
        for (Index v = 0; v < num_vertices; ++v) {
            const bool must_be = v < num_sites() && has_cell(v);
            if (is_used[v] == 0 && !must_be) continue;
            const Index c = component_of(v);
            twice[c] -= 2;
            if (fans[v] == Fan::Broken) is_right[c] = 0;
        }
        for (Index c = 0; c < twice.size(); ++c) {
            if (twice[c] != 0) is_right[c] = 0;
        }
        for (const auto& [from, to] : wrong_edges(result.triangles)) {
            is_right[component_of(from)] = 0;
        }
        return is_right;
    }

    void drop_unused_extra(SiteTriangles& result) const {
        const auto num_vertices = num_sites() + static_cast<Index>(result.extra.size());
        std::vector<Index> number(num_vertices, no_index);
        std::vector<SurfacePoint> extra;
        for (Triangle& t : result.triangles) {
            for (Index& v : t) {
                if (v < num_sites()) continue;
                if (number[v] == no_index) {
                    number[v] = num_sites() + static_cast<Index>(extra.size());
                    extra.push_back(result.extra[v - num_sites()]);
                }
                v = number[v];
            }
        }
        result.extra = std::move(extra);
    }

    // A site of a curve that labels no inner vertex gets one triangle, which may be flat where the
    // curve was jagged. Flips the edge opposite.
    void open_ears(SiteTriangles& result) const {
        FanMesh mesh(result.triangles, num_sites() + static_cast<Index>(result.extra.size()));
        for (Index f = 0; f < mesh.num_faces(); ++f) {
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                const bool is_ear = mesh.faces_at(mesh.apex(h)).size() == 1;
                if (is_ear && mesh.twin(h) != no_index && mesh.can_flip(h)) {
                    mesh.flip(h);
                    break;
                }
            }
        }
        result.triangles = mesh.triangles();
    }

    const Surface& surface_;
    const CellComplex* cells_;
    const std::span<const SurfacePoint> sites_;
    std::vector<DirectedEdge> chain_;  // Ascending.
    Ticker ticker_;
    std::vector<Triangle> faces_;             // Of the surface; some are divided.
    std::vector<std::uint8_t> shows_labels_;  // By face: 1 where labels count.
    std::vector<Index> number_;               // By vertex, those of missing sites last.
    std::vector<Index> place_;                // #sites: the vertex where it stays.
    std::vector<std::uint8_t> is_on_chain_;   // #sites
    std::vector<Index> vertex_;               // By number from #sites on: of the surface.
};

}  // namespace

SiteTriangles triangulate_sites(const Surface& surface, const DistanceBounds& labels,
                                const CellComplex* cells, std::span<const SurfacePoint> sites,
                                std::span<const DirectedEdge> chain, Narrow narrow, Ticker ticker) {
    return SiteTriangulation(surface, labels, cells, sites, chain, ticker).run(narrow);
}

void remove_dividing(const Surface& surface, std::span<const SurfacePoint> sites, Index num_kept,
                     SiteTriangles& triangles, Ticker ticker) {
    std::vector<Vec3> positions;
    for (const auto some : {sites, std::span<const SurfacePoint>(triangles.extra)}) {
        for (const SurfacePoint& p : some) positions.push_back(position(surface.mesh.view(), p));
    }
    const std::vector<Triangle> before = triangles.triangles;
    (void)simplify_narrow(positions, num_kept, triangles.triangles, ticker);
    triangles.extra.insert(triangles.extra.begin(), sites.begin() + num_kept, sites.end());
    DualCounts& counts = triangles.counts;
    const Index num_changed = num_touched(before, triangles.triangles, num_kept);
    const auto num_removed = static_cast<Index>(sites.size()) - num_kept;
    counts.sites -= num_removed;
    counts.sites_of_cells -= std::min(counts.sites_of_cells, num_changed + num_removed);
}

}  // namespace remesh::detail
