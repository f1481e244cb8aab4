// The surface's faces, some divided, with all vertices of a label merged into their site. Those of
// narrow labels stay, as do those of more labels until the merged mesh has the surface's topology.
#include "remesh/sites/label_triangles.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/curves/walk.h"
#include "remesh/dual/fan_mesh.h"
#include "remesh/sites/simplify_merged.h"
#include "remesh/sites/site_mesh.h"

namespace remesh::detail {
namespace {

class LabelTriangulation {
public:
    LabelTriangulation(const Surface& surface, const DistanceBounds& labels,
                       std::span<const SurfacePoint> sites, std::span<const DirectedEdge> chain,
                       Ticker ticker)
        : surface_(surface),
          sites_(sites),
          chain_(chain.begin(), chain.end()),
          ticker_(ticker),
          faces_(surface.mesh.triangles),
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
        insert_missing();
    }

    LabelTriangles run(NarrowLabels narrow) {
        LabelTriangles result{.triangles = closed(merge())};
        result.narrow = find_narrow(result.triangles);
        if (narrow == NarrowLabels::Simplify && split(result.narrow)) simplify_narrow(result);
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

    // Divides the faces that hold sites which label no vertex, so that each gets one.
    void insert_missing() {
        std::vector<std::pair<Index, Index>> missing;  // By face.
        for (Index s = 0; s < num_sites(); ++s) {
            if (place_[s] == no_index) missing.emplace_back(sites_[s].face.value(), s);
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

    // Twice the Euler characteristic of each label. Of a disc it is 2, of a label that wraps around
    // a tube 0, which the triangles do not tell if all others wrap around it, too.
    [[nodiscard]] std::vector<Index> twice_euler() const {
        std::vector<Index> twice(num_numbers(), 0);
        for (const Index i : number_) {
            if (i != no_index) twice[i] += 2;
        }
        for (const Triangle& t : faces_) {
            const Index a = number_[t[0]], b = number_[t[1]], c = number_[t[2]];
            if (a == no_index) continue;  // So are the others.
            twice[a] -= (a == b ? 1 : 0) + (c == a ? 1 : 0);
            twice[b] -= b == c ? 1 : 0;
            if (a == b && b == c) twice[a] += 2;
        }
        for (Index h = 0; h < surface_.twin.size(); ++h) {
            if (surface_.twin[h] != no_index) continue;
            const Index a = number_[surface_.tail(h)];
            if (a != no_index && a == number_[surface_.head(h)]) --twice[a];
        }
        return twice;
    }

    // Sites whose labels are no disc, or whose triangles are no fan, and ends of edges by which rim
    // and chain differ.
    [[nodiscard]] std::vector<Index> find_narrow(std::vector<Triangle> triangles) const {
        std::vector<Index> narrow;
        if (!chain_.empty()) {
            std::vector<DirectedEdge> wrong;
            const std::vector<DirectedEdge> rim = rim_of(triangles);
            std::set_symmetric_difference(rim.begin(), rim.end(), chain_.begin(), chain_.end(),
                                          std::back_inserter(wrong));
            for (const auto& [from, to] : wrong) narrow.insert(narrow.end(), {from, to});
        }
        const std::vector<Fan> fans =
            find_fans(build_site_mesh(std::move(triangles), num_numbers(), ticker_));
        const std::vector<Index> euler = twice_euler();
        for (Index s = 0; s < num_sites(); ++s) {
            if (fans[s] == Fan::Broken || euler[s] != 2) narrow.push_back(s);
        }
        std::erase_if(narrow, [&](Index i) { return i >= num_sites(); });
        return distinct(std::move(narrow));
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

    // Leaves the vertices of narrow labels in place, and simplifies the components that have some.
    void simplify_narrow(LabelTriangles& result) {
        std::vector<Triangle> merged = merge();
        while (split(find_narrow(closed(merged)))) merged = merge();
        result.num_simplified =
            simplify_merged(surface_, sites_, {merged, vertex_}, result.triangles, ticker_);
        result.triangles = closed(std::move(result.triangles));
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

    const Surface& surface_;
    const std::span<const SurfacePoint> sites_;
    std::vector<DirectedEdge> chain_;  // Ascending.
    Ticker ticker_;
    std::vector<Triangle> faces_;            // Of the surface; some are divided.
    std::vector<Index> number_;              // By vertex, those of missing sites last.
    std::vector<Index> place_;               // #sites: the vertex where it stays.
    std::vector<std::uint8_t> is_on_chain_;  // #sites
    std::vector<Index> vertex_;              // See MergedMesh.
};

}  // namespace

LabelTriangles triangulate_by_labels(const Surface& surface, const DistanceBounds& labels,
                                     std::span<const SurfacePoint> sites,
                                     std::span<const DirectedEdge> chain, NarrowLabels narrow,
                                     Ticker ticker) {
    return LabelTriangulation(surface, labels, sites, chain, ticker).run(narrow);
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
