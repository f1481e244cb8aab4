#include "remesh/tiles/tiling.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "agvd/core/union_find.h"
#include "agvd/mesh/patch.h"
#include "remesh/curves/curve_sites.h"
#include "remesh/sites/shares.h"

namespace remesh {
namespace {

// In spacings: vertices this near to a plane lie on it, sites this near to a vertex at it.
constexpr double snap_to_plane = 0.02, snap_to_vertex = 1e-3;
// Of the vertices of a tile: parts with less join their neighbour.
constexpr double least_share = 0.125;

// The tile of each face: its cell, but for small parts of one, which join the neighbour with which
// they have the longest border.
class TileJoiner {
public:
    TileJoiner(const Surface& surface, std::span<const Index> cell, double least_area,
               Ticker& ticker)
        : surface_(surface),
          cell_(cell),
          least_area_(least_area),
          ticker_(ticker),
          part_(surface.num_faces()) {}

    std::vector<Index> run() {
        for_each_inner_edge([&](Index, Index f, Index g) {
            if (cell_[f] == cell_[g]) part_.unite(f, g);
        });
        area_.assign(surface_.num_faces(), 0);
        for (Index f = 0; f < surface_.num_faces(); ++f)
            area_[part_.root(f)] += face_area(surface_, f);
        std::vector<Index> tile(cell_.begin(), cell_.end());  // Of a root.
        while (join_small(tile)) {
        }
        for (Index f = 0; f < tile.size(); ++f) tile[f] = tile[part_.root(f)];
        return tile;
    }

private:
    template <typename Each>
    void for_each_inner_edge(const Each& each) {
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            ticker_.tick();
            const Index h = surface_.edge_half[e], twin = surface_.twin[h];
            if (twin != no_index) each(e, Surface::face(h), Surface::face(twin));
        }
    }

    // Joins each small part that has a neighbour, the smaller one of two to the other.
    // \return whether there was one.
    bool join_small(std::vector<Index>& tile) {
        std::map<std::pair<Index, Index>, double> border;  // Small part, neighbour.
        for_each_inner_edge([&](Index e, Index f, Index g) {
            const Index a = part_.root(f), b = part_.root(g);
            if (a == b) return;
            for (const auto& [small, other] : {std::pair(a, b), std::pair(b, a)}) {
                const bool is_smaller =
                    area_[small] < area_[other] || (area_[small] == area_[other] && small > other);
                if (area_[small] < least_area_ && is_smaller) {
                    border[{small, other}] += surface_.length[e];
                }
            }
        });
        std::map<Index, std::pair<double, Index>> longest;  // Of each small part: its neighbour.
        for (const auto& [parts, length] : border) {
            auto& best = longest.try_emplace(parts.first, 0.0, no_index).first->second;
            if (best.second == no_index || length > best.first) best = {length, parts.second};
        }
        // A part joins a larger one, so there are no circles.
        for (const auto& [small, best] : longest) {
            const Index from = part_.root(small), to = part_.root(best.second);
            const double area = area_[from] + area_[to];
            const Index of = tile[to];
            if (!part_.unite(from, to)) continue;
            const Index root = part_.root(from);
            area_[root] = area;
            tile[root] = of;
        }
        return !longest.empty();
    }

    const Surface& surface_;
    const std::span<const Index> cell_;
    const double least_area_;
    Ticker& ticker_;
    UnionFind part_;
    std::vector<double> area_;  // Of a root.
};

class TilingBuilder {
public:
    TilingBuilder(const Surface& given, std::span<const std::uint8_t> is_crease,
                  const TilingOptions& options, Ticker& ticker)
        : given_(given), is_crease_(is_crease), options_(options), ticker_(ticker) {}

    Tiling run() {
        cut();
        find_borders();
        find_curves();
        share_vertices();
        return std::move(made_);
    }

private:
    void cut() {
        std::vector<Vec3> middle;
        std::vector<double> weight;
        for (Index f = 0; f < given_.num_faces(); ++f) {
            const auto [a, b, c] = corners_of(given_.mesh.view(), f);
            middle.emplace_back((a + b + c) / 3);
            weight.push_back(face_area(given_, f));
        }
        area_ = surface_area(given_);
        const double tile_area = area_ * options_.per_tile / options_.num_vertices;
        const PlaneTree tree = divide_by_planes(middle, weight, tile_area, ticker_);
        CutMesh cut =
            cut_by_planes(given_.mesh.view(), tree, snap_to_plane * options_.spacing, ticker_);
        made_.surface = build_surface(cut.mesh, 1, options_.progress);
        made_.parts = std::move(cut.parts);
        made_.tile = TileJoiner(made_.surface, cut.cell, least_share * tile_area, ticker_).run();
        const std::vector<Index> used = distinct(made_.tile);
        for (Index& t : made_.tile) t = rank_of(used, t);
        made_.num_tiles = static_cast<Index>(used.size());
    }

    void find_borders() {
        const Surface& surface = made_.surface;
        made_.is_border.assign(surface.num_edges(), 0);
        is_curve_.assign(surface.num_edges(), 0);
        for (Index e = 0; e < surface.num_edges(); ++e) {
            const Index h = surface.edge_half[e], twin = surface.twin[h];
            if (twin == no_index) continue;
            if (made_.tile[Surface::face(h)] != made_.tile[Surface::face(twin)]) {
                made_.is_border[e] = 1;
            }
            const Index of_given = made_.parts.half_edge_of_whole(h);
            is_curve_[e] = made_.is_border[e] != 0 ||
                                   (of_given != no_index && is_crease_[given_.edge[of_given]] != 0)
                               ? 1
                               : 0;
        }
    }

    // Sites of the borders, and the number of vertices on the other curves of each tile.
    void find_curves() {
        const Surface& surface = made_.surface;
        on_curves_.assign(made_.num_tiles, 0);
        const CurveNetwork network = find_network(surface, is_curve_, options_.spacing);
        const std::vector<std::vector<double>> along =
            even_positions(surface, network, options_.spacing,
                           curve_intervals(surface, network, options_.spacing));
        std::vector<Index> at_vertex(surface.num_vertices(), no_index);
        for (Index c = 0; c < network.curves.size(); ++c) {
            const Curve& curve = network.curves[c];
            const CurveSide& side = curve.sides.front();
            if (made_.is_border[surface.edge[side.half_edges.front()]] == 0) {
                on_curves_[made_.tile[Surface::face(side.half_edges.front())]] +=
                    static_cast<double>(along[c].size());
                continue;
            }
            for (const std::size_t end : {std::size_t{0}, curve.num_edges()}) {
                if (!curve.is_closed()) add_at_vertex(curve.vertex(surface, end), at_vertex);
            }
            for (const double at : along[c]) add_on_curve(curve, at, at_vertex);
        }
        // Sites at a vertex belong to all edges of borders there.
        for (Index e = 0; e < surface.num_edges(); ++e) {
            if (made_.is_border[e] == 0) continue;
            const Index h = surface.edge_half[e];
            if (const Index number = at_vertex[surface.tail(h)]; number != no_index) {
                made_.sites.push_back({e, 0, number});
            }
            if (const Index number = at_vertex[surface.head(h)]; number != no_index) {
                made_.sites.push_back({e, 1, number});
            }
        }
        std::sort(made_.sites.begin(), made_.sites.end(),
                  [](const BorderSite& a, const BorderSite& b) {
                      return std::tie(a.edge, a.share) < std::tie(b.edge, b.share);
                  });
    }

    void add_at_vertex(Index vertex, std::vector<Index>& at_vertex) {
        if (at_vertex[vertex] == no_index) at_vertex[vertex] = made_.num_sites++;
    }

    void add_on_curve(const Curve& curve, double at, std::vector<Index>& at_vertex) {
        const Surface& surface = made_.surface;
        if (curve.is_closed()) at -= curve.length() * std::floor(at / curve.length());
        const auto after = std::upper_bound(curve.up_to.begin(), curve.up_to.end(), at);
        const auto last = static_cast<std::ptrdiff_t>(curve.num_edges()) - 1;
        const auto i = static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(after - curve.up_to.begin() - 1, 0, last));
        const double from_begin = at - curve.up_to[i], to_end = curve.up_to[i + 1] - at;
        const double snap = snap_to_vertex * options_.spacing;
        if (from_begin < snap || to_end < snap) {
            add_at_vertex(curve.vertex(surface, from_begin < to_end ? i : i + 1), at_vertex);
            return;
        }
        const Index e = surface.edge[curve.sides.front().half_edges[i]];
        const double share = share_before(at, curve.up_to[i], curve.up_to[i + 1]);
        const bool is_along = surface.tail(surface.edge_half[e]) == curve.vertex(surface, i);
        made_.sites.push_back({e, is_along ? share : 1 - share, made_.num_sites++});
    }

    // How many vertices each tile gets: what it lacks at one spacing.
    void share_vertices() {
        const Surface& surface = made_.surface;
        UnionFind patch(surface.num_faces());
        for (Index e = 0; e < surface.num_edges(); ++e) {
            const Index h = surface.edge_half[e], twin = surface.twin[h];
            if (twin != no_index && is_curve_[e] == 0) {
                patch.unite(Surface::face(h), Surface::face(twin));
            }
        }
        std::vector<double> area(surface.num_faces(), 0), length(surface.num_faces(), 0);
        for (Index f = 0; f < surface.num_faces(); ++f) {
            const Index root = patch.root(f);
            area[root] += face_area(surface, f);
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                const bool is_rim = surface.twin[h] == no_index || is_curve_[surface.edge[h]] != 0;
                if (is_rim) length[root] += surface.length_of(h);
            }
        }
        std::vector<double> inner = on_curves_;
        for (Index f = 0; f < surface.num_faces(); ++f) {
            if (!patch.is_root(f)) continue;
            inner[made_.tile[f]] +=
                std::max(detail::inner_sites(area[f], length[f], options_.spacing), 0.0);
        }
        const Index num_inner =
            options_.num_vertices - std::min(options_.num_vertices, made_.num_sites);
        made_.num_inner = detail::apportion(inner, num_inner);
    }

    const Surface& given_;
    const std::span<const std::uint8_t> is_crease_;
    const TilingOptions& options_;
    Ticker& ticker_;
    double area_ = 0;
    std::vector<std::uint8_t> is_curve_;  // #E: borders and creases.
    std::vector<double> on_curves_;       // By tile: vertices on creases and boundaries.
    Tiling made_;
};

}  // namespace

Tiling divide_into_tiles(const Surface& surface, std::span<const std::uint8_t> is_crease,
                         const TilingOptions& options) {
    Poller poller(options.progress);
    Ticker ticker(poller);
    return TilingBuilder(surface, is_crease, options, ticker).run();
}

Tile take_tile(const Tiling& tiling, std::span<const Index> faces, Ticker ticker) {
    Patch patch = patch_of(tiling.surface, {faces.begin(), faces.end()}, ticker);
    const MeshView mesh = patch.surface.mesh.view();
    Tile tile;
    tile.border_site.assign(mesh.positions.size(), no_index);
    std::vector<Vec3> added;
    std::map<std::pair<Index, Index>, Index> vertex_at;  // By edge of the tile and number.
    std::vector<PartPoint> polygon;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        polygon.clear();
        for (Index k = 0; k < 3; ++k) {
            const Index h = 3 * patch.faces[f] + k, next = (k + 1) % 3;
            const auto& [from, to] = std::pair(mesh.triangles[f][k], mesh.triangles[f][next]);
            polygon.push_back({from, whole_face[k]});
            const Index edge = tiling.surface.edge[h];
            const bool is_along = tiling.surface.edge_half[edge] == h;
            const auto first = polygon.end() - polygon.begin();
            auto next_site =
                std::lower_bound(tiling.sites.begin(), tiling.sites.end(), edge,
                                 [](const BorderSite& site, Index e) { return site.edge < e; });
            for (; next_site != tiling.sites.end() && next_site->edge == edge; ++next_site) {
                const BorderSite& site = *next_site;
                if (site.share == 0 || site.share == 1) {
                    tile.border_site[(site.share == 0) == is_along ? from : to] = site.number;
                    continue;
                }
                const auto number = static_cast<Index>(mesh.positions.size() + added.size());
                const auto vertex =
                    vertex_at.try_emplace({patch.surface.edge[3 * f + k], site.number}, number);
                const double share = is_along ? site.share : 1 - site.share;
                const PartPoint point{vertex.first->second,
                                      between(whole_face[k], whole_face[next], share)};
                if (vertex.second) {
                    tile.border_site.push_back(site.number);
                    added.push_back(position(mesh, {FaceId(f), point.weights}));
                }
                polygon.push_back(point);
            }
            if (!is_along) std::reverse(polygon.begin() + first, polygon.end());
        }
        if (polygon.size() == 3) {
            tile.mesh.triangles.push_back(mesh.triangles[f]);
            tile.parts.add(tiling.parts, patch.faces[f]);
            continue;
        }
        for (const Triangle& t : triangulate_part(corners_of(mesh, f), polygon)) {
            PartCorners corners;
            Triangle& made = tile.mesh.triangles.emplace_back();
            for (Index k = 0; k < 3; ++k) {
                made[k] = polygon[t[k]].vertex;
                corners[k] = tiling.parts.to_whole({FaceId(patch.faces[f]), polygon[t[k]].weights})
                                 .barycentric;
            }
            tile.parts.add(tiling.parts.face(patch.faces[f]), corners);
        }
    }
    tile.mesh.positions = std::move(patch.surface.mesh.positions);
    tile.mesh.positions.insert(tile.mesh.positions.end(), added.begin(), added.end());
    return tile;
}

}  // namespace remesh
