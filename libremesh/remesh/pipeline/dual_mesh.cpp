#include "remesh/pipeline/dual_mesh.h"

#include <algorithm>
#include <set>
#include <utility>

#include "agvd/core/groups.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/curves/walk.h"
#include "remesh/dual/triangulate_sites.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/place_sites.h"
#include "remesh/pipeline/stage_context.h"

namespace remesh::detail {
namespace {

// Most rounds that divide edges between patches.
constexpr int most_divisions = 5;

std::vector<SurfacePoint> with_dividing(const PlacedSites& placed) {
    std::vector<SurfacePoint> sites = placed.sites;
    sites.insert(sites.end(), placed.dividing.begin(), placed.dividing.end());
    return sites;
}

// From sites, with copies on the sides of curves, to one mesh.
class DualBuilder {
public:
    DualBuilder(Domain& domain, const PlacedSites& placed, const StageContext& context)
        : domain_(domain),
          placed_(placed),
          context_(context),
          base_(domain.base()),
          sites_(domain.prepared.base.to_intrinsic(with_dividing(placed))) {}

    DualMesh run() {
        DistanceBounds labels;
        const CellComplex cells = find_cells(labels);
        {
            const StageClock clock(Stage::Dual, context_.result);
            triangulate(cells, labels);
            if (!has_chain()) return std::move(dual_);
            name_copies();
            part_edges();
        }
        flip_edges();
        glue_copies();
        return std::move(dual_);
    }

private:
    [[nodiscard]] Index num_copies() const {
        return static_cast<Index>(placed_.curves.sites.size());
    }

    // \param[out] labels  of the vertices of the base, by the cells.
    CellComplex find_cells(DistanceBounds& labels) {
        const auto& [options, result] = context_;
        Propagation propagation;
        {
            const StageClock clock(Stage::Propagate, result);
            propagation =
                propagate(base_, std::move(domain_.prepared.layout), sites_,
                          options.propagation.for_propagation(
                              options.num_threads, progress_of(Stage::Propagate, options)));
            result.certified_error = propagation.certified_error;
            result.propagation_bytes = propagation.peak_bytes;
        }
        const StageClock clock(Stage::Diagram, result);
        CellComplex cells = build_cell_complex(
            base_, sites_, propagation,
            {.num_threads = options.num_threads, .progress = progress_of(Stage::Diagram, options)});
        labels.distance.assign(propagation.vertex_distance.begin(),
                               propagation.vertex_distance.end());
        for (const SiteId site : cells.nearest_site) {
            labels.site.push_back(site.is_valid() ? site.value() : no_index);
        }
        return cells;
    }

    // Sets triangles of the sites, and of the vertices that had to stay, which follow.
    void triangulate(const CellComplex& cells, DistanceBounds& labels) {
        const Progress progress = progress_of(Stage::Dual, context_.options);
        Poller poller(progress);
        poller.poll();
        const bool is_divided = !placed_.dividing.empty();
        SiteTriangles made =
            triangulate_sites(base_, labels, &cells, sites_,
                              is_divided ? placed_.divided_chain : ends_of(placed_.chain),
                              Narrow::Simplify, Ticker(poller));
        const auto num_kept = static_cast<Index>(placed_.sites.size());
        if (is_divided) remove_dividing(base_, sites_, num_kept, made, Ticker(poller));
        context_.result.dual = made.counts;
        triangles_ = std::move(made.triangles);
        dual_.has_cell.assign(cells.has_cell.begin(), cells.has_cell.begin() + num_kept);
        dual_.nearest_site = std::move(labels.site);
        for (Index& site : dual_.nearest_site) {
            if (site >= num_kept) site = no_index;
        }
        std::vector<SurfacePoint> points(sites_.begin(), sites_.begin() + num_kept);
        points.insert(points.end(), made.extra.begin(), made.extra.end());
        site_ = drop_unused(static_cast<Index>(points.size()), triangles_);
        points_ = take(points, site_);
        for (Index& site : site_) {
            if (site >= num_kept) site = no_index;
        }
        find_bounds(labels.distance);
    }

    // Two sites are not farther apart than by an edge of the base between vertices that they label.
    void find_bounds(std::span<const float> distance) {
        std::vector<Index> vertex(placed_.sites.size(), no_index);
        for (Index v = 0; v < site_.size(); ++v) {
            if (site_[v] != no_index) vertex[site_[v]] = v;
        }
        for (Index e = 0; e < base_.num_edges(); ++e) {
            const Index h = base_.edge_half[e], tail = base_.tail(h), head = base_.head(h);
            const Index a = dual_.nearest_site[tail], b = dual_.nearest_site[head];
            if (a == b || a == no_index || b == no_index) continue;
            if (vertex[a] == no_index || vertex[b] == no_index) continue;
            const double most = double{distance[tail]} + base_.length[e] + double{distance[head]};
            bounds_.push_back({edge_key(vertex[a], vertex[b]), most});
        }
        std::ranges::sort(bounds_);
    }

    // Whether each curve is the same chain of edges in all patches on its sides. Edges of the
    // boundary may have vertices between their ends.
    [[nodiscard]] bool has_chain() const {
        std::set<DirectedEdge> rim;
        for (const auto& [from, to] : rim_of(triangles_)) rim.emplace(site_[from], site_[to]);
        std::size_t num_divided = 0, num_found = 0;
        for (const ChainEdge& edge : placed_.chain) {
            const Curve& curve = domain_.plan->network.network.curves[edge.curve];
            if (rim.contains({edge.from, edge.to})) {
                ++num_found;
            } else if (curve.sides.size() > 1 || curve.is_locked) {
                return false;
            } else {
                ++num_divided;
            }
        }
        return placed_.chain.empty() || num_divided > 0 || num_found == rim.size();
    }

    // Finds which vertices are at one place, and which of these become one vertex of the result:
    // those of one sheet.
    void name_copies() {
        const std::vector<Index> groups = groups_of_copies(placed_.curves);
        Index next_place = placed_.curves.num_groups(), next_vertex = placed_.curves.num_vertices;
        for (const Index site : site_) {
            const bool is_copy = site < num_copies();
            place_.push_back(is_copy ? groups[site] : next_place++);
            vertex_.push_back(is_copy ? placed_.curves.vertex[site] : next_vertex++);
        }
        place_ = first_of_groups(place_);
        vertex_ = first_of_groups(vertex_);
        is_last_.assign(site_.size(), 0);
    }

    // Flips inner edges of patches that would coincide with other edges when patches are glued.
    // Divides those that no flip removes.
    void part_edges() {
        for (int round = 0; round < most_divisions; ++round) {
            (void)flip_repeated(triangles_, place_);
            const std::vector<InnerEdge> repeated = repeated_edges(triangles_, place_);
            if (repeated.empty()) return;
            std::vector<bool> is_changed(triangles_.size(), false);
            for (const auto& [h, g] : repeated) {
                if (is_changed[h / 3] || is_changed[g / 3]) continue;
                is_changed[h / 3] = is_changed[g / 3] = true;
                divide(h, g);
            }
        }
        triangles_.clear();
    }

    // Divides an inner edge in the middle.
    void divide(Index h, Index g) {
        const Index t = h / 3, u = g / 3, a = triangles_[t][h % 3], b = triangles_[t][(h + 1) % 3];
        const Index c = triangles_[t][(h + 2) % 3], d = triangles_[u][(g + 2) % 3];
        const SurfacePoint from = on_input(a);
        const Vec3 way = position(input(), on_input(b)) - position(input(), from);
        const SurfacePoint middle = walk_straight(domain_.prepared.input(), from, way / 2).end;
        const auto added = static_cast<Index>(points_.size());
        points_.push_back(domain_.prepared.base.to_intrinsic(middle));
        site_.push_back(no_index);
        is_last_.push_back(1);
        place_.push_back(added);
        vertex_.push_back(added);
        triangles_[t] = {a, added, c};
        triangles_[u] = {b, added, d};
        triangles_.push_back({added, b, c});
        triangles_.push_back({added, a, d});
    }

    void flip_edges() {
        const auto& [options, result] = context_;
        const StageClock clock(Stage::Delaunay, result);
        const Progress progress = progress_of(Stage::Delaunay, options);
        poll(progress, 0);
        std::vector<Vec3> positions;
        for (Index v = 0; v < points_.size(); ++v) {
            positions.push_back(position(input(), on_input(v)));
        }
        DelaunayResult made = make_delaunay(base_, points_, positions, triangles_,
                                            {.mode = options.delaunay,
                                             .group = place_,
                                             .bounds = bounds_,
                                             .num_threads = options.num_threads,
                                             .progress = progress});
        poll(progress, 1);
        triangles_ = std::move(made.triangles);
        result.delaunay = made.counts;
    }

    void glue_copies() {
        GluedMesh glued = glue(triangles_, vertex_);
        PlacedMesh& mesh = dual_.mesh;
        for (const auto& [from, to] : rim_of(triangles_)) {
            mesh.hard.emplace_back(glued.vertex[from], glued.vertex[to]);
        }
        mesh.triangles = std::move(glued.triangles);
        for (const Index v : glued.first) {
            mesh.points.push_back(on_input(v));
            dual_.site.push_back(site_[v]);
            dual_.is_last.push_back(is_last_[v] != 0 || site_[v] < num_copies() ? 1 : 0);
        }
        mesh.offsets.assign(mesh.points.size(), Vec3::Zero());
    }

    [[nodiscard]] MeshView input() const { return domain_.prepared.input().mesh.view(); }
    [[nodiscard]] SurfacePoint on_input(Index v) const {
        return site_[v] != no_index ? placed_.sites[site_[v]]
                                    : domain_.prepared.base.to_input(points_[v]);
    }

    Domain& domain_;
    const PlacedSites& placed_;
    const StageContext& context_;
    const Surface& base_;
    const std::vector<SurfacePoint> sites_;  // On the base, those of dividing points last.
    std::vector<Triangle> triangles_;        // Of vertices of patches: copies are apart.
    std::vector<SurfacePoint> points_;       // #V, on the base.
    std::vector<Index> site_;                // #V: no_index: none.
    std::vector<Index> place_, vertex_;      // #V: the first copy there, and of its sheet.
    std::vector<std::uint8_t> is_last_;      // #V
    std::vector<PairBound> bounds_;          // Ascending.
    DualMesh dual_;
};

}  // namespace

DualMesh build_dual_mesh(Domain& domain, const PlacedSites& placed, const StageContext& context) {
    return DualBuilder(domain, placed, context).run();
}

}  // namespace remesh::detail
