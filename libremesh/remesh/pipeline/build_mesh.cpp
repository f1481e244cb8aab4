// Each round builds cells, dual, the exact vertex count, Delaunay flips and positions. The mesh
// with the fewest intersecting pairs of faces counts.
#include "remesh/pipeline/build_mesh.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/dual/closed_ball.h"
#include "remesh/dual/reduce_vertices.h"
#include "remesh/pipeline/crossings.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/improvable_mesh.h"
#include "remesh/pipeline/place_sites.h"
#include "remesh/pipeline/placed_dual.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/pipeline/valid_dual.h"
#include "remesh/pipeline/work_limit.h"

namespace remesh::detail {
namespace {

// Most rounds that add sites at self-intersections.
constexpr int most_rounds = 4;
// Most rounds that divide edges between patches.
constexpr int most_split_rounds = 5;
// As a multiple of the input's pairs. Up to this, further rounds can come down to their number.
constexpr std::size_t few_more = 2;

// Frees what only the Delaunay stage and those before read: after it Voronoi vertices suffice.
void drop_points(Diagram& diagram) {
    diagram.points = {};
    diagram.point_distance = {};
    diagram.passages = {};
    diagram.edge_points = {};
}

// Removes these vertices and renumbers the others in their order.
void compact(std::span<const Index> gone, ValidDual& dual) {
    std::vector<Index> number(dual.points.size(), 0), left;
    for (const Index v : gone) number[v] = no_index;
    for (Index v = 0; v < number.size(); ++v) {
        if (number[v] == no_index) continue;
        number[v] = static_cast<Index>(left.size());
        left.push_back(v);
    }
    dual.points = take(dual.points, left);
    dual.site = take(dual.site, left);
    if (!dual.stays.empty()) dual.stays = take(dual.stays, left);
    dual.triangles = rename_vertices(dual.triangles, number);
}

// The mesh of one round.
struct Candidate {
    bool is_failed = false;  // It lacks curves, or has too many vertices.
    ValidDual dual;
    PlacedDual placed;
    std::optional<CrossingFaces> crossings;
    Index num_removed = 0;
    DelaunayCounts flips;
};

class MeshBuilder {
public:
    MeshBuilder(Domain& domain, const PlacedSites& placed, const StageContext& context)
        : domain_(domain),
          placed_(placed),
          context_(context),
          finder_(domain, context),
          layout_(std::move(domain.prepared.layout)),
          on_base_(domain.prepared.base.to_intrinsic(placed.sites)),
          first_on_base_(on_base_) {
        domain.prepared.pieces.reset();  // Not needed until vertices are placed.
    }

    BuiltMesh run(WorkLimit& work) {
        const Index base_faces = domain_.base().num_faces();
        for (int round = 0;; ++round) {
            work.add(base_faces);
            Candidate candidate = build_candidate();
            if (candidate.is_failed) {
                if (round == 0) fail(candidate);
                break;
            }
            if (round == 0 || is_better(candidate)) keep(candidate);
            const std::optional<CrossingFaces>& crossings = candidate.crossings;
            if (!crossings || domain_.plan || round == most_rounds ||
                work.num_left(base_faces) == 0 || is_hopeless(crossings->all.size(), context_) ||
                !add_sites_at(pairs_to_separate(*crossings), candidate.dual)) {
                break;
            }
        }
        improve_best();
        return std::move(best_);
    }

private:
    Candidate build_candidate() {
        Candidate candidate;
        ValidDual& dual = candidate.dual;
        dual = build_cells();
        if (domain_.plan && !has_chain(dual, placed_.chain)) {
            candidate.is_failed = true;
            return candidate;
        }
        if (!target_) target_ = target_count(dual.diagram);
        candidate.is_failed = !fix_edges(candidate);
        if (candidate.is_failed) return candidate;
        drop_points(dual.diagram);
        candidate.placed =
            place_dual(domain_, placed_.curves, dual, points_of_vertices(dual), context_);
        candidate.crossings =
            unfit_crossings(finder_, placed_.curves, candidate.placed, context_.result);
        return candidate;
    }

    // Gives the dual its number of vertices and its edges. Edges that would coincide where patches
    // are joined get a vertex in the middle, for which another one goes.
    // \return false: there are too many vertices, or still such edges.
    bool fix_edges(Candidate& candidate) {
        ValidDual& dual = candidate.dual;
        const bool is_exact = context_.options.vertex_count == VertexCount::Exact;
        for (int round = 0; round < most_split_rounds; ++round) {
            candidate.num_removed += reduce(dual);
            const auto num_vertices = static_cast<Index>(dual.points.size());
            if (is_exact && num_vertices > *target_) return false;
            if (is_exact && num_vertices < *target_ && !context_.options.sites) {
                add_vertices(domain_, points_of_vertices(dual), *target_ - num_vertices, dual);
            }
            candidate.flips = flip_edges(dual);
            if (!domain_.plan ||
                split_repeated(domain_, placed_.curves, points_of_vertices(dual), dual) == 0) {
                return true;
            }
        }
        return false;
    }

    ValidDual build_cells() {
        ValidDual dual =
            build_valid_dual(domain_, placed_, layout_, on_base_, is_simplified_, context_);
        if (domain_.plan) {
            RemeshResult& result = context_.result;
            result.features.simplified_patches = std::exchange(result.components_simplified, 0);
        }
        return dual;
    }

    // How many vertices the dual is to have, copies on curves included: as many as were asked for,
    // or one for each given site that owns a part of the surface. Counts the other given sites.
    // \param diagram  of the first round.
    [[nodiscard]] Index target_count(const Diagram& diagram) const {
        const auto& [options, result] = context_;
        const Index num_other_copies = placed_.num_other_copies(domain_);
        if (!options.sites) return options.num_samples + num_other_copies;
        const auto num_copies = static_cast<Index>(placed_.curves.sites.size());
        const auto area = diagram.cell_area.begin();
        const auto num_owning =
            std::count_if(area + num_copies, area + static_cast<Index>(placed_.sites.size()),
                          [](double cell) { return cell > 0; });
        const Index target = num_copies + static_cast<Index>(num_owning);
        result.sites_dropped =
            static_cast<Index>(options.sites->size()) - (target - num_other_copies);
        return target;
    }

    // Where the vertices of the dual lie on the cleaned surface.
    [[nodiscard]] std::vector<SurfacePoint> points_of_vertices(const ValidDual& dual) const {
        std::vector<SurfacePoint> points;
        points.reserve(dual.site.size());
        for (Index v = 0; v < dual.site.size(); ++v) {
            const Index site = dual.site[v];
            // Not moved or added by repair.
            const bool is_placed =
                site < first_on_base_.size() && dual.points[v] == first_on_base_[site];
            points.push_back(is_placed ? placed_.sites[site]
                                       : domain_.prepared.base.to_input(dual.points[v]));
        }
        return points;
    }

    [[nodiscard]] std::vector<Vec3> positions_of_vertices(const ValidDual& dual) const {
        std::vector<Vec3> positions;
        positions.reserve(dual.site.size());
        for (const SurfacePoint& point : points_of_vertices(dual)) {
            positions.push_back(position(domain_.whole->mesh.view(), point));
        }
        return positions;
    }

    // Removes vertices until the target is reached or the topology allows no further removal. With
    // VertexCount::Add only simplified components have surplus vertices: more than sites.
    // \return how many were removed.
    Index reduce(ValidDual& dual) const {
        const bool adds = context_.options.vertex_count == VertexCount::Add;
        if (adds && context_.result.components_simplified == 0) return 0;
        const auto num_vertices = static_cast<Index>(dual.points.size());
        const Index target = adds ? static_cast<Index>(on_base_.size()) : *target_;
        if (num_vertices <= target) return 0;
        std::vector<std::uint8_t> is_last(num_vertices, 0);  // 1: removed last.
        for (Index i = 0; i < num_vertices; ++i) {
            const auto v = vertex_of(domain_.base(), dual.points[i]);
            const Index site = dual.site[i];
            is_last[i] = (v && std::ranges::binary_search(placed_.boundary_corners, *v)) ||
                         site < placed_.curves.sites.size() ||
                         (i < dual.stays.size() && dual.stays[i] != 0) ||
                         (site != no_index && site < is_wanted_.size() && is_wanted_[site]);
        }
        const std::vector<Vec3> positions = positions_of_vertices(dual);
        const StageClock clock(Stage::Dual, context_.result);
        const std::vector<Index> gone = reduce_vertices(positions, dual.triangles, target, is_last,
                                                        progress_of(Stage::Dual, context_.options));
        compact(gone, dual);
        return static_cast<Index>(gone.size());
    }

    DelaunayCounts flip_edges(ValidDual& dual) const {
        const auto& [options, result] = context_;
        const StageClock clock(Stage::Delaunay, result);
        const Progress progress = progress_of(Stage::Delaunay, options);
        poll(progress, 0);
        DelaunayResult made = make_delaunay(
            domain_.base(), dual.points, positions_of_vertices(dual), dual.triangles,
            {.mode = options.delaunay, .num_threads = options.num_threads, .progress = progress});
        poll(progress, 1);
        dual.triangles = std::move(made.triangles);
        return made.counts;
    }

    [[noreturn]] void fail(const Candidate& candidate) const {
        if (domain_.plan) throw NetworkFailed{};
        throw TooFewSamples{*target_, static_cast<Index>(candidate.dual.points.size())};
    }

    [[nodiscard]] bool is_better(const Candidate& candidate) const {
        return !candidate.crossings ||
               candidate.crossings->all.size() < best_.self_intersections->all;
    }

    // Takes the placed mesh out of the candidate.
    void keep(Candidate& candidate) {
        const PlacedDual& placed = candidate.placed;
        if (best_.mesh.triangles.empty()) {
            best_.narrow_points = domain_.prepared.base.to_input(candidate.dual.narrow_points);
        }
        best_.num_wanted = *target_ - placed_.num_other_copies(domain_);
        best_.mesh = whole_mesh(*domain_.whole, placed);
        best_.sites = placed.mesh.points;
        if (placed.patches) {
            best_.sites = take(placed.mesh.points, placed.patches->glued.representative);
            if (domain_.has_junctions()) {
                best_.first_of_group = placed.patches->glued.first_of_group;
            }
            if (domain_.plan->given) order_as_given(candidate.dual, placed.patches->glued);
        }
        if (candidate.crossings) {
            best_.self_intersections = candidate.crossings->counts();
            best_.crossing_corners.clear();
            for_each_corner(candidate.crossings->added, placed.mesh.triangles, [&](Index v) {
                best_.crossing_corners.push_back(
                    placed.mesh.position(domain_.whole->mesh.view(), v));
            });
        }
        context_.result.sites_removed = candidate.num_removed;
        context_.result.delaunay = candidate.flips;
        improvable_.reset();
        if (!is_relaxed(context_.options)) return;
        improvable_ = find_improvable(domain_, std::move(candidate.placed), context_.options);
    }

    // Sorts the vertices in the caller's order of the sites, vertices that repair added last.
    // Before, the vertices of curves come first.
    void order_as_given(const ValidDual& dual, const GluedMesh& glued) {
        const std::vector<Index>& number = domain_.plan->given->number;
        std::vector<std::pair<Index, Index>> order;  // (number of the site, vertex)
        for (Index v = 0; v < glued.representative.size(); ++v) {
            const Index site = dual.site[glued.representative[v]];
            order.emplace_back(site < number.size() ? number[site] : no_index, v);
        }
        std::sort(order.begin(), order.end());
        std::vector<Index> before, after(order.size());
        for (const auto& [site, v] : order) {
            after[v] = static_cast<Index>(before.size());
            before.push_back(v);
        }
        best_.mesh = {take(best_.mesh.positions, before),
                      rename_vertices(best_.mesh.triangles, after)};
        best_.sites = take(best_.sites, before);
    }

    // None if there are no more than in the input.
    [[nodiscard]] FacePairs pairs_to_separate(const CrossingFaces& crossings) const {
        const std::size_t in_input = context_.result.input_self_intersections;
        if (crossings.all.size() <= in_input) return {};
        return crossings.all.size() <= few_more * in_input ? crossings.all : crossings.added;
    }

    // Adds a site at the farthest Voronoi vertex of the cell of each corner of these faces, and
    // marks the sites of the cells as wanted. False if there is no such vertex.
    bool add_sites_at(const FacePairs& crossings, const ValidDual& dual) {
        const std::vector<Index> farthest = farthest_voronoi_vertices(dual.diagram);
        std::vector<Index> points;  // Vertices of the diagram.
        is_wanted_.resize(on_base_.size(), false);
        for_each_corner(crossings, dual.triangles, [&](Index v) {
            const Index site = dual.site[v];
            if (site == no_index || farthest[site] == no_index) return;
            points.push_back(farthest[site]);
            is_wanted_[site] = true;
        });
        if (points.empty()) return false;
        std::sort(points.begin(), points.end());
        points.erase(std::unique(points.begin(), points.end()), points.end());
        for (const Index v : points) on_base_.push_back(dual.diagram.vertices[v]);
        is_wanted_.resize(on_base_.size(), true);
        const auto count = static_cast<Index>(points.size());
        context_.result.sites_added += count;
        context_.result.added_because[SiteReason::SelfIntersection] += count;
        return true;
    }

    void improve_best() {
        if (!improvable_) return;
        if (!improve(domain_, finder_, *improvable_, best_.self_intersections, context_)) return;
        const PlacedDual improved{std::move(improvable_->mesh), {}};
        best_.mesh = whole_mesh(*domain_.whole, improved);
        best_.sites = improved.mesh.points;
    }

    Domain& domain_;
    const PlacedSites& placed_;
    const StageContext& context_;
    CrossingFinder finder_;
    std::optional<SurfaceLayout> layout_;
    std::vector<SurfacePoint> on_base_;  // The sites: the placed ones, and those added by repair.
    const std::vector<SurfacePoint> first_on_base_;  // The placed ones.
    std::vector<bool> is_wanted_;      // By site: its vertex is removed last; may be shorter.
    std::vector<bool> is_simplified_;  // By component.
    std::optional<Index> target_;      // Vertices of the dual.
    BuiltMesh best_;
    std::optional<ImprovableMesh> improvable_;  // Of best_.
};

}  // namespace

BuiltMesh build_mesh(Domain& domain, const PlacedSites& sites, WorkLimit& work,
                     const StageContext& context) {
    return MeshBuilder(domain, sites, context).run(work);
}

}  // namespace remesh::detail
