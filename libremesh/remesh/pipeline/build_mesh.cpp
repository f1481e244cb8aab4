// Builds cells, dual, the exact vertex count, Delaunay flips and positions in rounds. If the mesh
// of a round self-intersects where the input does not, and more often, sites are added there and
// another round follows. The mesh with the fewest intersecting pairs of faces wins. Its thin
// triangles are mended last.
#include "remesh/pipeline/build_mesh.h"

#include <algorithm>
#include <span>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/curves/glue.h"
#include "remesh/dual/closed_ball.h"
#include "remesh/pipeline/place_vertices.h"
#include "remesh/pipeline/vertex_count.h"
#include "remesh/placement/placement.h"

namespace remesh::detail {
namespace {

// Sites of one round: the placed ones, and those that repair has added.
struct RoundSites {
    std::vector<SurfacePoint> on_surface;  // On the cleaned surface.
    std::vector<SurfacePoint> on_base;     // The same sites on the base.
    std::vector<bool> is_wanted;           // By site: its vertex is removed last; may be shorter.
};

// Most rounds that add sites at self-intersections.
constexpr int max_mends = 4;

// As a multiple of the input's pairs. Rounds at pairs that follow from these have come down to
// their number in 4 of 50 attempts on damaged meshes, each time from at most twice that number.
constexpr std::size_t few_more = 2;

// Frees what only the Delaunay stage and those before read: after it Voronoi vertices suffice.
void drop_points(Diagram& diagram) {
    diagram.points = {};
    diagram.point_distance = {};
    diagram.passages = {};
    diagram.edge_points = {};
}

enum class Fault { None, WrongCurves, TooManyVertices };

// The mesh of one round.
struct Candidate {
    Fault fault = Fault::None;
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
          is_corner_(domain.base().num_vertices(), false) {
        for (const Index v : placed_.boundary_corners) is_corner_[v] = true;
        sites_.on_surface = placed_.sites;
        first_on_base_ = domain.prepared.base.to_intrinsic(placed_.sites);
        sites_.on_base = first_on_base_;
        domain.prepared.pieces.reset();  // Not needed until vertices are placed.
    }

    BuiltMesh run(WorkLimit& work) {
        const Index base_faces = domain_.base().num_faces();
        for (int mends = 0;; ++mends) {
            work.add(base_faces);
            Candidate candidate = build_candidate();
            if (candidate.fault != Fault::None) {
                if (mends == 0) fail(candidate);
                break;
            }
            const std::optional<CrossingFaces> crossings = std::move(candidate.crossings);
            const ValidDual dual = keep_if_better(std::move(candidate), crossings);
            if (!crossings || mends == max_mends || work.num_left(base_faces) == 0 ||
                is_hopeless(crossings->all.size(), context_) ||
                !add_sites_at(pairs_to_mend(*crossings), dual)) {
                break;
            }
        }
        mend_best();
        return std::move(best_);
    }

private:
    Candidate build_candidate() {
        Candidate candidate;
        ValidDual& dual = candidate.dual;
        dual = build_cells();
        if (domain_.plan && !has_chain(dual, placed_.chain)) {
            candidate.fault = Fault::WrongCurves;
            return candidate;
        }
        if (!target_) target_ = target_count(domain_, placed_, dual.diagram, context_);
        candidate.num_removed = reduce(dual);
        if (dual.mesh.points.size() > *target_ &&
            context_.options.vertex_count == VertexCount::Exact) {
            candidate.fault = Fault::TooManyVertices;
            return candidate;
        }
        candidate.flips = flip_edges(dual);
        drop_points(dual.diagram);
        if (domain_.plan) candidate.placed.patches = join_patches(dual, placed_.curves);
        candidate.placed.mesh =
            place_vertices(domain_, placed_.curves, dual, places_of(dual),
                           domain_.plan ? &*candidate.placed.patches : nullptr, context_);
        flip_flat(candidate.placed);
        candidate.crossings =
            unfit_crossings(finder_, placed_.curves, candidate.placed, context_.result);
        return candidate;
    }

    ValidDual build_cells() {
        RemeshResult& result = context_.result;
        const DualInput input{
            domain_.base(),           layout_,       domain_.parts->components, domain_.component,
            placed_.boundary_corners, placed_.chain, domain_.has_locked()};
        ValidDual dual =
            build_valid_dual(input, sites_.on_base, is_thinned_, cell_options(), context_.result);
        carry_sites_back();
        if (domain_.plan) {
            result.features.thinned_patches = std::exchange(result.components_thinned, 0);
        }
        return dual;
    }

    // Narrow patches between curves are thinned at once: adding sites does not help there.
    [[nodiscard]] RemeshOptions cell_options() const {
        RemeshOptions options = context_.options;
        if (!domain_.plan) return options;
        options.boundary = Boundary::Free;
        options.repair_rounds = 0;
        return options;
    }

    // Carries the sites that repair moved or added on the base back to the surface.
    void carry_sites_back() {
        std::vector<SurfacePoint>& sites = sites_.on_surface;
        sites.resize(first_on_base_.size());
        for (Index s = 0; s < sites_.on_base.size(); ++s) {
            const SurfacePoint& site = sites_.on_base[s];
            if (s >= sites.size()) {
                sites.push_back(domain_.prepared.base.to_input(site));
            } else if (site != first_on_base_[s]) {
                sites[s] = domain_.prepared.base.to_input(site);
            }
        }
    }

    void flip_flat(PlacedDual& placed) const {
        TriangleMesh mesh = whole_mesh(*domain_.whole, placed);
        flip_flat_faces(mesh.positions, mesh.triangles);
        auto& triangles = placed.patches ? placed.patches->glued.triangles : placed.mesh.triangles;
        triangles = std::move(mesh.triangles);
    }

    // Where the vertices of the dual lie on the cleaned surface.
    [[nodiscard]] std::vector<SurfacePoint> places_of(const ValidDual& dual) const {
        std::vector<SurfacePoint> places;
        places.reserve(dual.site.size());
        for (Index v = 0; v < dual.site.size(); ++v) {
            const Index site = dual.site[v];
            places.push_back(site != no_index
                                 ? sites_.on_surface[site]
                                 : domain_.prepared.base.to_input(dual.mesh.points[v]));
        }
        return places;
    }

    [[nodiscard]] std::vector<Vec3> positions_of_vertices(const ValidDual& dual) const {
        std::vector<Vec3> positions;
        positions.reserve(dual.site.size());
        for (const SurfacePoint& place : places_of(dual)) {
            positions.push_back(position(domain_.whole->mesh.view(), place));
        }
        return positions;
    }

    // With VertexCount::Add only thinned components have surplus vertices: more than sites.
    Index reduce(ValidDual& dual) const {
        const bool adds = context_.options.vertex_count == VertexCount::Add;
        if (adds && context_.result.components_thinned == 0) return 0;
        const auto num_vertices = static_cast<Index>(dual.mesh.points.size());
        const Index target = adds ? static_cast<Index>(sites_.on_base.size()) : *target_;
        if (num_vertices <= target) return 0;
        std::vector<std::uint8_t> keep(num_vertices, 0);
        for (Index i = 0; i < num_vertices; ++i) {
            const auto v = vertex_of(domain_.base(), dual.mesh.points[i]);
            const Index site = dual.site[i];
            const bool is_wanted =
                site != no_index && site < sites_.is_wanted.size() && sites_.is_wanted[site];
            keep[i] = (v && is_corner_[*v]) || site < placed_.curves.sites.size() || is_wanted;
        }
        return reduce_to(target, positions_of_vertices(dual), keep, dual, context_);
    }

    DelaunayCounts flip_edges(ValidDual& dual) const {
        const auto& [options, result] = context_;
        const StageClock clock(Stage::Delaunay, result);
        const Progress progress = progress_of(Stage::Delaunay, options);
        poll(progress, 0);
        DelaunayResult made = make_delaunay(
            domain_.base(), dual.mesh.points, positions_of_vertices(dual), dual.mesh.triangles,
            {.mode = options.delaunay, .num_threads = options.num_threads, .progress = progress});
        poll(progress, 1);
        dual.mesh.triangles = std::move(made.triangles);
        return made.counts;
    }

    [[noreturn]] void fail(const Candidate& candidate) const {
        if (domain_.plan) throw NetworkFailed{};
        throw TooFewSamples{*target_, static_cast<Index>(candidate.dual.mesh.points.size())};
    }

    // \return the candidate's dual.
    ValidDual keep_if_better(Candidate candidate, const std::optional<CrossingFaces>& crossings) {
        const bool is_first = best_.mesh.triangles.empty();
        if (!is_first && crossings && crossings->counts().all >= best_.self_intersections->all) {
            return std::move(candidate.dual);
        }
        const PlacedDual& placed = candidate.placed;
        if (is_first)
            best_.thin_places = domain_.prepared.base.to_input(candidate.dual.thin_places);
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
        if (crossings) best_.self_intersections = crossings->counts();
        context_.result.sites_removed = candidate.num_removed;
        context_.result.delaunay = candidate.flips;
        keep_mendable(candidate.dual, std::move(candidate.placed.mesh));
        return std::move(candidate.dual);
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

    void keep_mendable(const ValidDual& dual, PlacedMesh placed) {
        mendable_.reset();
        if (domain_.plan || !is_relaxed(context_.options)) return;
        mendable_ = find_mendable(domain_, dual, std::move(placed), is_thinned_, context_.options);
    }

    // None if there are no more than in the input.
    [[nodiscard]] FacePairs pairs_to_mend(const CrossingFaces& crossings) const {
        const std::size_t in_input = context_.result.input_self_intersections;
        if (crossings.all.size() <= in_input) return {};
        return crossings.all.size() <= few_more * in_input ? crossings.all : crossings.fresh;
    }

    // Adds a site at the farthest Voronoi vertex of the cell of each corner of these faces, and
    // marks the sites of the cells as wanted. False if there is no such place.
    bool add_sites_at(const FacePairs& crossings, const ValidDual& dual) {
        const std::vector<Index> farthest = farthest_voronoi_vertices(dual.diagram);
        std::vector<Index> places;
        sites_.is_wanted.resize(sites_.on_base.size(), false);
        for_each_corner(crossings, dual.mesh.triangles, [&](Index v) {
            const Index site = dual.site[v];
            if (site == no_index || farthest[site] == no_index) return;
            places.push_back(farthest[site]);
            sites_.is_wanted[site] = true;
        });
        if (places.empty()) return false;
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
        add_sites(places, SiteReason::SelfIntersection, dual);
        sites_.is_wanted.resize(sites_.on_base.size(), true);
        return true;
    }

    // \param places  vertices of the diagram.
    void add_sites(std::span<const Index> places, SiteReason reason, const ValidDual& dual) {
        for (const Index v : places) sites_.on_base.push_back(dual.diagram.vertices[v]);
        const auto count = static_cast<Index>(places.size());
        context_.result.sites_added += count;
        context_.result.added_because[reason] += count;
    }

    void mend_best() {
        if (!mendable_) return;
        std::optional<Index> most_crossings;
        if (best_.self_intersections) most_crossings = best_.self_intersections->all;
        std::optional<MendedMesh> mended =
            mend(domain_, *std::move(mendable_), most_crossings, finder_, context_);
        if (!mended) return;
        best_.mesh = whole_mesh(*domain_.whole, {mended->mesh, {}});
        best_.sites = std::move(mended->mesh.points);
        best_.self_intersections = mended->self_intersections;
    }

    Domain& domain_;
    const PlacedSites& placed_;
    const StageContext& context_;
    CrossingFinder finder_;
    std::optional<SurfaceLayout> layout_;
    std::vector<bool> is_corner_;  // #V of the base.
    std::vector<SurfacePoint> first_on_base_;
    RoundSites sites_;
    std::vector<bool> is_thinned_;  // By component.
    std::optional<Index> target_;   // Vertices of the dual.
    BuiltMesh best_;
    std::optional<MendableMesh> mendable_;  // Of best_.
};

}  // namespace

BuiltMesh build_mesh(Domain& domain, const PlacedSites& sites, WorkLimit& work,
                     const StageContext& context) {
    return MeshBuilder(domain, sites, context).run(work);
}

}  // namespace remesh::detail
