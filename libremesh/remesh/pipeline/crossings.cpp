#include "remesh/pipeline/crossings.h"

#include "remesh/curves/glue.h"
#include "remesh/quality/evaluate.h"

namespace remesh::detail {
namespace {

// Most rounds that move vertices back onto the surface.
constexpr int max_unfits = 4;
// Fewer samples than this for each new pair are hopeless.
constexpr std::size_t samples_per_pair = 4;

std::optional<FacePairs> find_in(const MeshView& mesh, const RemeshOptions& options) {
    return find_self_intersections(mesh, options.num_threads, progress_of(Stage::Check, options));
}

// Moves a vertex and all its copies back onto the surface.
void unfit(Index v, const CurveSites& curves, PlacedDual& placed) {
    placed.mesh.offsets[v].setZero();
    if (!placed.patches) return;
    const std::vector<Index>& group = placed.patches->group;
    if (group[v] >= curves.num_groups()) return;
    for (Index other = 0; other < group.size(); ++other) {
        if (group[other] == group[v]) placed.mesh.offsets[other].setZero();
    }
}

}  // namespace

std::optional<CrossingFaces> CrossingFinder::find(const PlacedDual& placed) {
    std::optional<FacePairs> all = find_all(placed);
    if (!all) return std::nullopt;
    return tell_fresh(placed, *std::move(all));
}

std::optional<FacePairs> CrossingFinder::find_all(const PlacedDual& placed) {
    const StageClock clock(Stage::Check, context_.result);
    poll(progress_of(Stage::Check, context_.options), 0);
    std::optional<FacePairs> all = find_in(welded_mesh(domain_, placed).view(), context_.options);
    if (all && !all->empty() && !has_searched_input_) find_in_input();
    return all;
}

CrossingFaces CrossingFinder::tell_fresh(const PlacedDual& placed, FacePairs all) {
    const StageClock clock(Stage::Check, context_.result);
    CrossingFaces found{std::move(all), {}};
    if (found.all.size() <= context_.result.input_self_intersections) return found;
    found.fresh = input_places_ ? input_places_->pairs_elsewhere(
                                      welded_mesh(domain_, placed).view(), found.all)
                                : found.all;
    return found;
}

void CrossingFinder::find_in_input() {
    const TriangleMesh& input = domain_.whole->mesh;
    std::vector<Triangle> welded;
    if (domain_.has_locked()) {
        welded = join_positions(input.positions, input.triangles);
    } else if (domain_.has_junctions()) {
        welded = rename_vertices(input.triangles, first_copies(domain_.plan->network.junctions,
                                                               domain_.whole->num_vertices()));
    }
    const MeshView mesh{input.positions, welded.empty() ? input.triangles : welded};
    const FacePairs pairs = find_in(mesh, context_.options).value();
    if (!pairs.empty()) {
        input_places_.emplace(mesh, pairs, progress_of(Stage::Check, context_.options));
    }
    context_.result.input_self_intersections = static_cast<Index>(pairs.size());
    has_searched_input_ = true;
}

bool is_hopeless(std::size_t num_pairs, const StageContext& context) {
    const std::size_t most = context.options.num_samples / samples_per_pair;
    return num_pairs > context.result.input_self_intersections + most;
}

std::optional<CrossingFaces> unfit_crossings(CrossingFinder& finder, const CurveSites& curves,
                                             PlacedDual& placed, RemeshResult& result) {
    std::optional<FacePairs> crossings = finder.find_all(placed);
    result.unfitted_vertices = 0;
    for (int round = 0; round < max_unfits && crossings && !crossings->empty(); ++round) {
        bool is_changed = false;
        for_each_corner(*crossings, placed.mesh.triangles, [&](Index v) {
            if (placed.mesh.offsets[v].isZero(0)) return;
            unfit(v, curves, placed);
            ++result.unfitted_vertices;
            is_changed = true;
        });
        if (!is_changed) break;
        crossings = finder.find_all(placed);
    }
    if (!crossings) return std::nullopt;
    return finder.tell_fresh(placed, *std::move(crossings));
}

}  // namespace remesh::detail
