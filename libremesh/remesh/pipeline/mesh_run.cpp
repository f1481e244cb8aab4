#include "remesh/pipeline/mesh_run.h"

#include <algorithm>
#include <utility>

#include "remesh/pipeline/crossings.h"
#include "remesh/pipeline/curves.h"
#include "remesh/pipeline/mesh_with_curves.h"
#include "remesh/pipeline/sizes.h"
#include "remesh/pipeline/stage_context.h"

namespace remesh::detail {
namespace {

// Intersecting pairs of faces, less those that the input has.
Index num_more_crossings(const RemeshResult& result) {
    const Index pairs = result.self_intersections.value_or(0);
    return pairs - std::min(pairs, result.input_self_intersections);
}

// Whether the result does not reach a part of the input.
bool has_lost_part(const RemeshResult& result) {
    return result.verdict.largest_distance > result.verdict.spacing;
}

bool has_own_crossings(const RemeshResult& result) {
    return are_mostly_added({result.self_intersections.value_or(0), result.new_self_intersections});
}

// As where few vertices lie on the creases of one plane.
bool is_crushed(const RemeshResult& result) {
    return are_too_many(result.new_self_intersections, result.mesh.triangles.size());
}

// Whether lengths in places are ours to choose.
bool may_shorten(const RemeshOptions& options) {
    const Sizing& sizing = options.sizing;
    return !options.sites && (sizing.is_adaptive() || sizing.is_even()) &&
           (std::holds_alternative<NumSamples>(sizing.count) ||
            std::holds_alternative<NumFaces>(sizing.count) ||
            std::holds_alternative<MeanEdge>(sizing.count));
}

// Which creases and seams a mesh is to have, in the order in which they are tried: the selected
// ones; those that are close to others as well, without which walls between them may intersect; the
// selected ones without shorter edges between them; none.
enum class Choice { Selected, CloseToo, NoStrips, None };

class MeshRun {
    // Runs with shorter edges in places.
    static constexpr int most_shortenings = 3;

public:
    // \param lengths  on the cleaned surface: how long edges are at most.
    // \param bound    see mesh_with_curves.
    MeshRun(const CleanedInput& cleaned, RemeshResult after_cleaning, const RemeshOptions& given,
            std::span<const SizedPoint> lengths, const DistanceBound* bound)
        : cleaned_(cleaned),
          options_(given),
          lengths_(lengths),
          bound_(bound),
          result_(std::move(after_cleaning)) {
        find_lengths();
        if (sizes_.num_samples != options_.num_samples) {
            options_.num_samples = sizes_.num_samples;
            find_lengths();
            options_.num_samples = sizes_.num_samples;
        }
    }

    RemeshResult run() {
        MadeMesh made = find_mesh();
        if (!may_shorten(options_)) return std::move(result_);
        shorten_edges(std::move(made));
        if (options_.wrap && has_own_crossings(result_)) {
            best_kept_.is_crease.assign(best_kept_.is_crease.size(), 0);
            shorten_edges(run_shorter({}, {}));
        }
        return std::move(result_);
    }

    // \throw TooFewSamples  no choice of curves gives a mesh.
    MadeMesh find_mesh() {
        const RemeshResult start = result_;
        Index num_needed = 0, samples_for_all = 0, num_for_all = 0;
        std::optional<RemeshResult> best;
        MadeMesh best_made;
        for (const bool has_junctions : {true, false}) {
            if (!has_junctions && (best || found_.junctions.empty())) break;
            for (const Choice choice :
                 {Choice::Selected, Choice::CloseToo, Choice::NoStrips, Choice::None}) {
                if (!is_worth_trying(choice, best) || !choose(choice)) continue;
                kept_.has_junctions = has_junctions;
                RemeshResult tried = start;
                tried.seconds = result_.seconds;
                MadeMesh made = mesh_with_curves(cleaned_, found_, kept_, sizes_.field.get(),
                                                 bound_, of_input_, {options_, tried});
                result_.seconds = tried.seconds;
                samples_for_all = std::max(samples_for_all, tried.features.samples_for_all);
                num_for_all =
                    std::max({num_for_all, samples_for_all, tried.junctions.samples_for_all});
                tried.features.gave_up =
                    choice == Choice::None && kept_.is_crease != found_.is_crease;
                if (!made.has_mesh) {
                    num_needed = std::max(made.num_needed, options_.num_samples + 1);
                } else if (!best || is_worth_it(choice, tried, *best)) {
                    best = std::move(tried);
                    best_made = std::move(made);
                    best_kept_ = kept_;
                }
            }
        }
        if (!best) throw TooFewSamples{options_.num_samples, num_needed, num_for_all};
        best->seconds = result_.seconds;
        best->features.samples_for_all = samples_for_all;
        result_ = *std::move(best);
        return best_made;
    }

private:
    void find_lengths() {
        const double spacing = spacing_for(cleaned_, options_);
        // A crease left out costs distance. With a mean edge given, shorter edges between close
        // creases would make the others longer.
        const bool refines = has_strips_ && !options_.wrap && may_shorten(options_) &&
                             !std::holds_alternative<MeanEdge>(options_.sizing.count);
        const CloseCreases close = bound_ != nullptr ? CloseCreases::Stay
                                   : refines         ? CloseCreases::GoOrRefine
                                                     : CloseCreases::Go;
        found_ = find_curves(cleaned_, spacing, close, {options_, result_});
        sizes_ = find_sizes(cleaned_, found_, spacing, {}, lengths_, {options_, result_});
    }

    // Close creases leave needles between them.
    static bool is_worth_it(Choice choice, const RemeshResult& tried, const RemeshResult& best) {
        return choice == Choice::CloseToo
                   ? tried.new_self_intersections == 0
                   : tried.new_self_intersections < best.new_self_intersections;
    }

    // Other curves are for faces that still intersect, fewer ones only where there is no good mesh.
    [[nodiscard]] bool is_worth_trying(Choice choice,
                                       const std::optional<RemeshResult>& best) const {
        switch (choice) {
            case Choice::Selected:
                return true;
            case Choice::CloseToo:
                return best && has_own_crossings(*best) && !options_.wrap;
            case Choice::NoStrips:
            case Choice::None:
                return !best || is_crushed(*best) || (options_.wrap && has_own_crossings(*best));
        }
        return false;
    }

    // Sets the curves that are kept.
    // \return whether they differ from those of the choice before.
    bool choose(Choice choice) {
        const KeptCurves before = kept_;
        kept_ = {true, !found_.is_seam.empty(), found_.is_crease};
        switch (choice) {
            case Choice::Selected:
                return true;
            case Choice::CloseToo:
                for (Index e = 0; e < found_.is_close.size(); ++e) {
                    if (found_.is_close[e] != 0) kept_.is_crease[e] = 1;
                }
                return kept_.is_crease != found_.is_crease;
            case Choice::NoStrips:
                if (found_.strips.empty()) return false;
                has_strips_ = false;
                find_lengths();
                kept_.is_crease = found_.is_crease;
                return true;
            case Choice::None:
                kept_.has_seams = false;
                kept_.is_crease.assign(kept_.is_crease.size(), 0);
                return before.has_seams || before.is_crease != kept_.is_crease;
        }
        return false;
    }

    // Runs again with shorter edges on narrow parts, if such a part was lost, and where faces still
    // intersect. Keeps the best result.
    void shorten_edges(MadeMesh made) {
        // A rod that is narrower than the spacing gets shorter by some edges.
        const std::vector<SurfacePoint> narrow = has_lost_part(result_) || options_.wrap
                                                     ? std::move(made.narrow_points)
                                                     : std::vector<SurfacePoint>();
        double length = result_.verdict.spacing;
        if (options_.wrap) found_.is_crease = best_kept_.is_crease;  // Others divide rods.
        std::vector<SizedPoint> points;
        // Wraps have collapses instead.
        for (int round = 0; round < (options_.wrap ? 1 : most_shortenings); ++round) {
            const bool crosses = has_own_crossings(result_) && !is_crushed(result_);
            if (!crosses && (round > 0 || narrow.empty())) return;
            length /= 2;
            for (const SurfacePoint& p : made.crossing_corners) points.push_back({p, length});
            made = run_shorter(narrow, points);
        }
    }

    MadeMesh run_shorter(std::span<const SurfacePoint> narrow, std::span<const SizedPoint> points) {
        RemeshResult again = result_;
        // The number stays, whatever it follows from: a mean edge would make the others longer.
        RemeshOptions options = options_;
        options.sizing.count = NumSamples{};
        const StageContext context{options, again};
        const RunSizes sizes =
            find_sizes(cleaned_, found_, spacing_for(cleaned_, options_), narrow, points, context);
        MadeMesh made = mesh_with_curves(cleaned_, found_, best_kept_, sizes.field.get(), nullptr,
                                         of_input_, context);
        result_.seconds = again.seconds;
        const Index crossings = num_more_crossings(again), before = num_more_crossings(result_);
        const bool is_nearer = again.verdict.largest_distance < result_.verdict.largest_distance;
        // Faces around rods of wraps are narrow.
        const bool is_better = is_nearer || (options_.wrap && points.empty());
        if (made.has_mesh && (crossings < before || (crossings == before && is_better))) {
            again.features.gave_up = result_.features.gave_up;
            again.features.samples_for_all = result_.features.samples_for_all;
            result_ = std::move(again);
        }
        return made;
    }

    const CleanedInput& cleaned_;
    RemeshOptions options_;
    std::span<const SizedPoint> lengths_;
    const DistanceBound* bound_;
    RemeshResult result_;
    FoundCurves found_;
    KeptCurves kept_, best_kept_;  // At hand, and of the result.
    RunSizes sizes_;
    InputCrossings of_input_;
    bool has_strips_ = true;
};

}  // namespace

RemeshResult run_after_cleaning(const CleanedInput& cleaned, RemeshResult after_cleaning,
                                const RemeshOptions& options, std::span<const SizedPoint> lengths,
                                const DistanceBound* bound) {
    return MeshRun(cleaned, std::move(after_cleaning), options, lengths, bound).run();
}

RemeshResult run_by_collapses(const CleanedInput& cleaned, RemeshResult before,
                              const RemeshOptions& options) {
    InputCrossings of_input;
    RemeshResult result = before;
    const MadeMesh made = mesh_with_curves(cleaned, {}, {.has_junctions = false}, nullptr, nullptr,
                                           of_input, {options, result}, Vertices::Surface);
    return made.has_mesh && num_more_crossings(result) < num_more_crossings(before) ? result
                                                                                    : before;
}

void require_mesh(const CleanedInput& cleaned, RemeshResult after_cleaning,
                  const RemeshOptions& options) {
    (void)MeshRun(cleaned, std::move(after_cleaning), options, {}, nullptr).find_mesh();
}

}  // namespace remesh::detail
