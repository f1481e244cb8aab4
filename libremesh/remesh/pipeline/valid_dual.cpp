// Flips lead from any triangulation of the sites to the intrinsic Delaunay one, which is the dual
// of the cells, so labels of vertices suffice for the first. Where these fail, and without flips,
// the cells are found. Their dual is right where all cells and what they have in common are discs
// and arcs ([edelsbrunner1997]). Narrow patches lack that: they are simplified to their sites
// ([liu2023]).
#include "remesh/pipeline/valid_dual.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/dual/reduce_vertices.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/place_sites.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/sites/label_triangles.h"
#include "remesh/sites/levels.h"
#include "remesh/sites/site_dual.h"

namespace remesh::detail {
namespace {

class ValidDualBuilder {
public:
    ValidDualBuilder(Domain& domain, const PlacedSites& placed, std::span<const SurfacePoint> sites,
                     const StageContext& context)
        : domain_(domain),
          placed_(placed),
          surface_(domain.base()),
          patches_(domain.plan->patches.components),
          options_(context.options),
          result_(context.result),
          sites_(sites),
          chain_(chain_by_part(placed.chain, static_cast<Index>(patches_.size()),
                               [&](Index site) { return patch_of(sites_[site]); })),
          has_failed_(patches_.size(), false) {}

    ValidDual run() {
        dual_.is_of_cells = asks_for_cells() || !take_labels();
        if (dual_.is_of_cells) take_cells();
        const StageClock clock(Stage::Dual, result_);
        poll(progress_of(Stage::Dual, options_), 0);
        build_mesh();
        poll(progress_of(Stage::Dual, options_), 1);
        return std::move(dual_);
    }

private:
    // Whether flips do not lead from any triangulation to the dual, or distances are asked for.
    [[nodiscard]] bool asks_for_cells() const {
        return !is_relaxed(options_) || !gives_cells(surface_, sites_.size()) ||
               options_.delaunay != Delaunay::Intrinsic ||
               options_.propagation.engine != Engine::Window ||
               options_.propagation.max_error.has_value();
    }

    // \return whether all sites have triangles, and those of all patches are right.
    bool take_labels() {
        const StageClock clock(Stage::Dual, result_);
        const Progress progress = progress_at(Stage::Dual, options_, 0);
        DistanceBounds labels =
            label_vertices(domain_.prepared, placed_.sites, options_.num_threads, progress);
        Poller poller(progress);
        const auto [triangles, narrow, num_simplified] =
            triangulate_by_labels(surface_, labels, sites_, ends_of(placed_.chain),
                                  NarrowLabels::Simplify, Ticker(poller));
        dual_.has_cell.assign(sites_.size(), 0);
        for (const Triangle& t : triangles) {
            for (const Index site : t) dual_.has_cell[site] = 1;
        }
        if (std::ranges::find(dual_.has_cell, 0) != dual_.has_cell.end()) return false;
        triangles_ = by_patch(triangles);
        find_failed();
        if (std::ranges::find(has_failed_, true) != has_failed_.end()) return false;
        correct_labels(domain_.prepared, placed_.sites, triangles, labels.site);
        dual_.nearest_site = std::move(labels.site);
        result_.features.simplified_patches = num_simplified;
        return true;
    }

    void take_cells() {
        const Diagram diagram = build_diagram();
        const StageClock clock(Stage::Dual, result_);
        triangles_ = by_patch(build_dual(surface_, diagram, progress_at(Stage::Dual, options_, 0)));
        for (Index c = 0; c < patches_.size(); ++c) {
            if (!chain_[c].empty()) close_rim(chain_[c], triangles_[c]);
        }
        find_failed();
        result_.features.simplified_patches =
            static_cast<Index>(std::ranges::count(has_failed_, true));
        dual_.has_cell.clear();
        for (const double area : diagram.cell_area) dual_.has_cell.push_back(area > 0 ? 1 : 0);
        for (const SiteId site : diagram.nearest_site) {
            dual_.nearest_site.push_back(site.is_valid() ? site.value() : no_index);
        }
    }

    Diagram build_diagram() {
        Propagation propagation;
        {
            const StageClock clock(Stage::Propagate, result_);
            PropagationOptions options = options_.propagation;
            options.num_threads = options_.num_threads;
            options.progress = progress_of(Stage::Propagate, options_);
            propagation = propagate(surface_, std::move(domain_.prepared.layout), sites_, options);
            result_.certified_error = propagation.certified_error;
            result_.propagation_bytes = propagation.peak_bytes;
        }
        const StageClock clock(Stage::Diagram, result_);
        return agvd::build_diagram(surface_, sites_, std::move(propagation),
                                   {.num_threads = options_.num_threads,
                                    .progress = progress_of(Stage::Diagram, options_)});
    }

    [[nodiscard]] Index patch_of(const SurfacePoint& point) const {
        return domain_.patch[point.face.value()];
    }

    // Vertices in the order of their sites, then those of simplified patches.
    void build_mesh() {
        std::vector<bool> has_vertex(sites_.size(), false);
        for (Index c = 0; c < triangles_.size(); ++c) {
            if (has_failed_[c]) continue;
            for (const Triangle& t : triangles_[c]) {
                for (const Index site : t) has_vertex[site] = true;
            }
        }
        std::vector<Index> number(sites_.size(), no_index);
        for (Index s = 0; s < sites_.size(); ++s) {
            if (!has_vertex[s]) continue;
            number[s] = static_cast<Index>(dual_.site.size());
            dual_.site.push_back(s);
            dual_.points.push_back(sites_[s]);
        }
        // By patch that is to be simplified: faces, ascending, and sites, one at each position.
        std::vector<std::vector<Index>> faces(patches_.size()), sites(patches_.size());
        if (std::ranges::count(has_failed_, true) > 0) find_parts(faces, sites);
        for (Index c = 0; c < triangles_.size(); ++c) {
            if (has_failed_[c]) {
                append_simplified(faces[c], sites[c]);
                continue;
            }
            for (const auto& [i, j, k] : triangles_[c]) {
                dual_.triangles.push_back({number[i], number[j], number[k]});
            }
        }
    }

    [[nodiscard]] std::vector<std::vector<Triangle>> by_patch(
        std::span<const Triangle> triangles) const {
        std::vector<std::vector<Triangle>> result(patches_.size());
        for (const Triangle& t : triangles) result[patch_of(sites_[t[0]])].push_back(t);
        return result;
    }

    // Marks patches whose triangles have another topology or boundary.
    void find_failed() {
        for (Index c = 0; c < patches_.size(); ++c) {
            has_failed_[c] = !has_right_topology(triangles_[c], patches_[c]) ||
                             (!placed_.chain.empty() && rim_of(triangles_[c]) != chain_[c]);
        }
    }

    // False for polygons of the dual without a valid diagonal.
    [[nodiscard]] bool has_right_topology(std::span<const Triangle> triangles,
                                          const ComponentTopology& wanted) const {
        std::vector<Index> used;
        for (const Triangle& t : triangles) used.insert(used.end(), t.begin(), t.end());
        used = distinct(std::move(used));
        TriangleMesh mesh{{}, {triangles.begin(), triangles.end()}};
        for (const Index site : used) {
            mesh.positions.push_back(position(surface_.mesh.view(), sites_[site]));
        }
        for (Triangle& t : mesh.triangles) {
            for (Index& v : t) {
                v = static_cast<Index>(std::lower_bound(used.begin(), used.end(), v) -
                                       used.begin());
            }
        }
        const Topology topology = analyze_topology(mesh.view());
        return topology.is_manifold && topology.is_oriented && topology.components.size() == 1 &&
               topology.components[0].same_type(wanted);
    }

    void find_parts(std::vector<std::vector<Index>>& faces,
                    std::vector<std::vector<Index>>& sites) const {
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            const Index patch = domain_.patch[f];
            if (has_failed_[patch]) faces[patch].push_back(f);
        }
        for (const Index s : distinct_points(surface_, sites_)) {
            const Index patch = patch_of(sites_[s]);
            if (has_failed_[patch]) sites[patch].push_back(s);
        }
    }

    // Appends a patch, simplified to its sites and the extra vertices that must stay.
    void append_simplified(std::span<const Index> faces, std::span<const Index> sites) {
        const auto first = static_cast<Index>(dual_.points.size());
        std::vector<SurfacePoint> points = take(sites_, sites);
        dual_.site.insert(dual_.site.end(), sites.begin(), sites.end());
        SimplifiedMesh part = placed_.chain.empty() ? simplify(surface_, faces, points)
                                                    : simplify_patch(surface_, faces, points);
        if (!placed_.chain.empty()) free_rim(surface_, points, part);
        points.insert(points.end(), part.extra.begin(), part.extra.end());
        dual_.points.insert(dual_.points.end(), points.begin(), points.end());
        dual_.site.resize(dual_.points.size(), no_index);
        for (const auto& [i, j, k] : part.triangles) {
            dual_.triangles.push_back({i + first, j + first, k + first});
        }
    }

    Domain& domain_;
    const PlacedSites& placed_;
    const Surface& surface_;  // On which cells lie.
    const std::vector<ComponentTopology>& patches_;
    const RemeshOptions& options_;
    RemeshResult& result_;
    const std::span<const SurfacePoint> sites_;
    const std::vector<std::vector<DirectedEdge>> chain_;  // By patch.
    std::vector<std::vector<Triangle>> triangles_;        // Of sites, by patch.
    std::vector<bool> has_failed_;                        // By patch.
    ValidDual dual_;
};

}  // namespace

ValidDual build_valid_dual(Domain& domain, const PlacedSites& placed,
                           std::span<const SurfacePoint> sites, const StageContext& context) {
    return ValidDualBuilder(domain, placed, sites, context).run();
}

}  // namespace remesh::detail
