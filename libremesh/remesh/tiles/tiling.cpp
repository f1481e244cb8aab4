#include "remesh/tiles/tiling.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "agvd/core/union_find.h"
#include "agvd/mesh/patch.h"
#include "remesh/curves/curve_sites.h"
#include "remesh/sites/shares.h"
#include "remesh/tiles/join_parts.h"

namespace remesh {
namespace {

// The tile of each face: its cell, but for small parts of one, which join a neighbour.
std::vector<Index> join_small_parts(const Surface& surface, std::span<const Index> cell,
                                    double least_area, Ticker& ticker) {
    UnionFind part(surface.num_faces());
    const auto for_each_inner_edge = [&](const auto& each) {
        for (Index e = 0; e < surface.num_edges(); ++e) {
            ticker.tick();
            const Index h = surface.edge_half[e], twin = surface.twin[h];
            if (twin != no_index) each(e, Surface::face(h), Surface::face(twin));
        }
    };
    for_each_inner_edge([&](Index, Index f, Index g) {
        if (cell[f] == cell[g]) part.unite(f, g);
    });
    std::vector<Index> roots;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        if (part.is_root(f)) roots.push_back(f);
    }
    const auto number_of = [&](Index f) { return rank_of(roots, part.root(f)); };
    std::vector<double> area(roots.size(), 0);
    for (Index f = 0; f < surface.num_faces(); ++f) area[number_of(f)] += face_area(surface, f);
    std::vector<PartBorder> borders;
    for_each_inner_edge([&](Index e, Index f, Index g) {
        if (cell[f] != cell[g]) {
            borders.push_back({number_of(f), number_of(g), surface.length[e]});
        }
    });
    const std::vector<Index> joined = join_parts(std::move(area), borders, least_area);
    std::vector<Index> tile(surface.num_faces());
    for (Index f = 0; f < tile.size(); ++f) tile[f] = cell[roots[joined[number_of(f)]]];
    return tile;
}

// At least so many points stand for the area of a tile.
constexpr double points_of_tile = 256;

// Appends the middles of the triangles into which parallels to its sides divide a face.
void add_points(const std::array<Vec3, 3>& face, Index rows, std::vector<Vec3>& points) {
    const Vec3 along = (face[1] - face[0]) / rows, up = (face[2] - face[0]) / rows;
    for (Index i = 0; i < rows; ++i) {
        for (Index j = 0; i + j < rows; ++j) {
            const Vec3 corner = face[0] + i * along + j * up;
            points.emplace_back(corner + (along + up) / 3);
            if (i + j + 1 < rows) points.emplace_back(corner + (along + up) * 2 / 3);
        }
    }
}

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
        area_ = surface_area(given_);
        const Index num_cells = num_tiles_for(options_.num_vertices, options_.per_tile);
        std::vector<Vec3> points;
        std::vector<double> weights;
        for (Index f = 0; f < given_.num_faces(); ++f) {
            const double area = face_area(given_, f);
            const double share = area / area_ * num_cells;
            const auto rows = std::max(
                static_cast<Index>(std::ceil(std::sqrt(points_of_tile * share))), Index{1});
            add_points(corners_of(given_.mesh.view(), f), rows, points);
            weights.resize(points.size(), area / (static_cast<double>(rows) * rows));
        }
        const PlaneTree tree = divide_by_planes(points, weights, num_cells, ticker_);
        CutMesh cut =
            cut_by_planes(given_.mesh.view(), tree, snap_to_plane * options_.spacing, ticker_);
        made_.surface = build_surface(cut.mesh, 1, options_.progress);
        made_.parts = std::move(cut.parts);
        made_.tile =
            join_small_parts(made_.surface, cut.cell, least_share * area_ / num_cells, ticker_);
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
        made_.borders = border_sites(surface, made_.is_border, network, along, options_.spacing);
        for (Index c = 0; c < network.curves.size(); ++c) {
            const Index h = network.curves[c].sides.front().half_edges.front();
            if (made_.is_border[surface.edge[h]] != 0) continue;
            on_curves_[made_.tile[Surface::face(h)]] += static_cast<double>(along[c].size());
        }
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
            options_.num_vertices - std::min(options_.num_vertices, made_.borders.num_sites);
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
    const std::vector<BorderSite>& sites = tiling.borders.sites;
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
                std::lower_bound(sites.begin(), sites.end(), edge,
                                 [](const BorderSite& site, Index e) { return site.edge < e; });
            for (; next_site != sites.end() && next_site->edge == edge; ++next_site) {
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
