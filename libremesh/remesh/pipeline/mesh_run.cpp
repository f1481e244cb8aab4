#include "remesh/pipeline/mesh_run.h"

#include <algorithm>
#include <utility>

#include "remesh/pipeline/crossings.h"
#include "remesh/pipeline/curves.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/mesh_with_curves.h"
#include "remesh/pipeline/sample_count.h"
#include "remesh/pipeline/sized_places.h"
#include "remesh/pipeline/sizes.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/sites/network_plan.h"

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

bool are_mostly_narrow(const RemeshResult& result) {
    return 2 * std::size_t{result.verdict.narrow.count} > result.mesh.triangles.size();
}

// Whether edges may be shorter than asked for in places.
bool may_shorten(const RemeshOptions& options) {
    const Sizing& sizing = options.sizing;
    return !options.sites && !std::holds_alternative<MaxError>(sizing.count) &&
           !std::holds_alternative<MaxDistance>(sizing.count);
}

class MeshRun {
public:
    // \param lengths  on the cleaned surface: how long edges are at most.
    // \param bound    see mesh_with_curves.
    MeshRun(const CleanedInput& cleaned, RemeshResult after_cleaning, const RemeshOptions& given,
            std::span<const SizedPoint> lengths, const DistanceBound* bound)
        : cleaned_(cleaned),
          options_(given),
          lengths_(points_of_places(cleaned, given.sizing.places)),
          bound_(bound),
          result_(std::move(after_cleaning)) {
        lengths_.insert(lengths_.end(), lengths.begin(), lengths.end());
        find_lengths();
        if (sizes_.num_samples != options_.num_samples) {
            options_.num_samples = sizes_.num_samples;
            find_lengths();
            options_.num_samples = sizes_.num_samples;
        }
    }

    // Fewer curves are for where there is no mesh with all.
    // \throw TooFewSamples  no choice of curves gives a mesh.
    RemeshResult run() {
        const RemeshResult start = result_;
        TooFewSamples failure{options_.num_samples, 0, 0};
        Index for_creases = 0;
        const std::vector<std::uint8_t> none(found_.is_crease.size(), 0);
        for (const auto& [has_junctions, has_others] : choices()) {
            KeptCurves kept{has_junctions, has_others && !found_.is_seam.empty(),
                            has_others ? found_.is_crease : none};
            RemeshResult tried = start;
            const MadeMesh made = try_curves(kept, options_, tried);
            failure.reached = std::max(made.num_needed, options_.num_samples + 1);
            FeatureCounts& features = tried.features;
            features.samples_for_all = std::max(features.samples_for_all, for_creases);
            features.gave_up = kept.is_crease != found_.is_crease;
            for_creases = features.samples_for_all;
            failure.for_all =
                std::max({failure.for_all, for_creases, tried.junctions.samples_for_all});
            if (!made.has_mesh) continue;
            result_ = std::move(tried);
            mend(start, made, std::move(kept));
            return std::move(result_);
        }
        throw failure;
    }

private:
    void find_lengths() {
        const double spacing = spacing_for(cleaned_, options_);
        // A crease left out costs distance. With a mean edge given, shorter edges between close
        // creases would make the others longer. Close creases of wraps are those of thin walls.
        const bool refines = may_shorten(options_) && !options_.wrap &&
                             !std::holds_alternative<MeanEdge>(options_.sizing.count);
        const CloseCreases close = bound_ != nullptr ? CloseCreases::Stay
                                   : refines         ? CloseCreases::GoOrRefine
                                                     : CloseCreases::Go;
        found_ = find_curves(cleaned_, spacing, {options_, result_});
        // Which creases are too close depends on the lengths around them.
        const bool chooses = may_leave_out(found_, close, options_);
        if (chooses) {
            sizes_ = find_sizes(cleaned_, found_, spacing, {}, lengths_, {options_, result_});
        }
        choose_curves(cleaned_, spacing, close, sizes_.field.get(), {options_, result_}, found_);
        const bool has_hinges = bound_ != nullptr && !bound_->hinges.empty();
        if (has_hinges) found_.is_crease.assign(bound_->hinges.begin(), bound_->hinges.end());
        const bool are_all_kept = chooses && found_.strips.empty() && !has_creases(found_.is_close);
        if (!are_all_kept) {
            sizes_ = find_sizes(cleaned_, found_, spacing, {}, lengths_, {options_, result_});
        }
        if (has_hinges) {
            sizes_.num_samples =
                std::max(sizes_.num_samples,
                         fewest_network_vertices(cleaned_.surface, found_.is_crease, spacing,
                                                 found_.junctions, cleaned_.locked));
        }
        check_count(sizes_.num_samples);
    }

    // Whether junctions stay, and whether creases and seams do. All curves first. Junctions go last
    // if sheets are welded there, otherwise before creases and seams.
    [[nodiscard]] std::vector<std::pair<bool, bool>> choices() const {
        const bool has_others = !found_.is_seam.empty() || has_creases(found_.is_crease);
        const bool has_junctions = !found_.junctions.empty();
        const bool are_welded = options_.junctions == Junctions::Keep;
        std::vector<std::pair<bool, bool>> result{{true, true}};
        if (has_junctions && !are_welded) result.emplace_back(false, true);
        if (has_others) result.emplace_back(true, false);
        if (has_junctions && are_welded) result.emplace_back(false, true);
        if (has_junctions && has_others) result.emplace_back(false, false);
        return result;
    }

    MadeMesh try_curves(const KeptCurves& kept, const RemeshOptions& options, RemeshResult& tried) {
        tried.seconds = result_.seconds;
        MadeMesh made = mesh_with_curves(cleaned_, found_, kept, sizes_.field.get(), bound_,
                                         of_input_, {options, tried});
        result_.seconds = tried.seconds;
        return made;
    }

    // Runs once more. Where faces intersect: with the creases that were left out, which may keep
    // walls apart, and with shorter edges; if very many do, without curves. Where the
    // result does not reach a narrow part: with shorter edges there. Other means part the faces of
    // wraps, and their edges are shorter on all narrow parts. Keeps the better result.
    void mend(RemeshResult again, const MadeMesh& made, KeptCurves kept) {
        const bool is_wrap = options_.wrap.has_value();
        const bool crosses = has_own_crossings(result_) && !result_.features.gave_up && !is_wrap;
        const bool is_in_vain = crosses && is_crushed(result_);
        const bool gives_up = is_in_vain && (has_creases(kept.is_crease) || kept.has_seams);
        const bool parts = crosses && !is_in_vain;
        const bool adds_creases = parts && has_creases(found_.is_close);
        std::vector<SizedPoint> points = lengths_;
        if (parts) {
            const double length = result_.verdict.spacing / 2;
            for (const SurfacePoint& p : made.crossing_corners) points.push_back({p, length});
        }
        std::span<const SurfacePoint> narrow;
        if (has_lost_part(result_) || is_wrap) narrow = made.narrow_points;
        const bool shortens =
            may_shorten(options_) && (!narrow.empty() || points.size() > lengths_.size());
        if (!adds_creases && !shortens && !gives_up) return;
        const bool drops_creases = gives_up && has_creases(kept.is_crease);
        if (gives_up)
            kept = {kept.has_junctions, false, std::vector<std::uint8_t>(kept.is_crease.size())};
        for (Index e = 0; adds_creases && e < found_.is_close.size(); ++e) {
            kept.is_crease[e] |= found_.is_close[e];
        }
        RemeshOptions options = options_;
        if (shortens) {
            // The number stays, whatever it follows from: a mean edge would make the others longer.
            options.sizing.count = NumSamples{};
            sizes_ = find_sizes(cleaned_, found_, spacing_for(cleaned_, options_), narrow, points,
                                {options, result_});
        }
        const bool has_mesh = try_curves(kept, options, again).has_mesh;
        const Index crossings = num_more_crossings(again), before = num_more_crossings(result_);
        const bool is_nearer =
            is_wrap || again.verdict.largest_distance < result_.verdict.largest_distance;
        // Without creases a mesh is worth it if no faces intersect. Close creases leave narrow
        // faces between them: if most are, a few that intersect are better.
        const bool is_fine =
            gives_up ? crossings == 0 : !(adds_creases && are_mostly_narrow(again));
        const bool is_better = crossings < before || (crossings == before && is_nearer);
        if (!has_mesh || !is_fine || !is_better) return;
        again.features.gave_up = result_.features.gave_up || drops_creases;
        again.features.samples_for_all =
            std::max(again.features.samples_for_all, result_.features.samples_for_all);
        again.seconds = result_.seconds;
        result_ = std::move(again);
    }

    const CleanedInput& cleaned_;
    RemeshOptions options_;
    std::vector<SizedPoint> lengths_;  // Of places, and those given.
    const DistanceBound* bound_;
    RemeshResult result_;
    FoundCurves found_;
    RunSizes sizes_;
    InputCrossings of_input_;
};

}  // namespace

RemeshResult run_after_cleaning(const CleanedInput& cleaned, RemeshResult after_cleaning,
                                const RemeshOptions& options, std::span<const SizedPoint> lengths,
                                const DistanceBound* bound) {
    return MeshRun(cleaned, std::move(after_cleaning), options, lengths, bound).run();
}

RemeshResult run_by_collapses(const CleanedInput& cleaned, const RemeshResult& before,
                              const RemeshOptions& options) {
    InputCrossings of_input;
    RemeshResult result = before;
    const MadeMesh made = mesh_with_curves(cleaned, {}, {.has_junctions = false}, nullptr, nullptr,
                                           of_input, {options, result}, Vertices::Surface);
    const bool is_better = made.has_mesh && num_more_crossings(result) < num_more_crossings(before);
    return is_better ? result : before;
}

}  // namespace remesh::detail
