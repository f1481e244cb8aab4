// Runs the stages: cleaning once, then attempts with other curves until one gives a mesh without
// self-intersections that the input does not have. The best attempt counts.
#include "remesh/pipeline/run.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "agvd/core/number_text.h"
#include "remesh/pipeline/build_mesh.h"
#include "remesh/pipeline/coarse_input.h"
#include "remesh/pipeline/crossings.h"
#include "remesh/pipeline/curves.h"
#include "remesh/pipeline/meet_distance.h"
#include "remesh/pipeline/sample_count.h"
#include "remesh/pipeline/sizes.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/sites/shares.h"

namespace remesh::detail {
namespace {

// Thrown if no attempt gives a mesh.
struct TooFewSamples {
    Index asked;
    Index reached;  // Vertices that may suffice.
};

// Intersecting pairs of faces, less those that the input has.
Index num_more_crossings(const RemeshResult& result) {
    const Index pairs = result.self_intersections.value_or(0);
    return pairs - std::min(pairs, result.input_self_intersections);
}

// Intersections that follow from the input's are no reason to give up creases: meshes of other
// faces have other numbers of them.
bool is_fine(const RemeshResult& result) {
    return num_more_crossings(result) == 0 || result.new_self_intersections == 0;
}

// Whether the result does not reach a part of the input.
bool has_lost_part(const RemeshResult& result) {
    return result.verdict.largest_distance > result.verdict.spacing;
}

// Whether lengths in places are ours to choose.
bool may_shorten(const RemeshOptions& options) {
    const Sizing& sizing = options.sizing;
    return !options.sites && (sizing.is_adaptive() || sizing.is_even()) &&
           (std::holds_alternative<NumSamples>(sizing.count) ||
            std::holds_alternative<NumFaces>(sizing.count) ||
            std::holds_alternative<MeanEdge>(sizing.count));
}

// Whether an attempt with fewer creases, or without seams, would differ from this one.
bool has_more_to_drop(const KeptCurves& kept, const FeatureCounts& features) {
    return features.curves > 0 && (kept.has_seams || features.length > 0);
}

// A run after cleaning. Tries all curves, the same with other sites, then without strips. Changes
// creases where faces intersect that do not in the input, and at last leaves out all, until a mesh
// has no such faces. If none of these gives a mesh, tries the same without junctions.
class Attempts {
    // Changes of creases in places before all go.
    static constexpr int most_changes = 3;
    // Runs with shorter edges in places.
    static constexpr int most_shortenings = 3;

public:
    // \param lengths  on the cleaned surface: how long edges are at most.
    // \param bound    see run_attempt.
    Attempts(const CleanedInput& cleaned, const RemeshResult& after_cleaning,
             const RemeshOptions& given, std::span<const SizedPoint> lengths,
             const DistanceBound* bound)
        : cleaned_(cleaned),
          options_(given),
          lengths_(lengths),
          bound_(bound),
          first_(after_cleaning) {
        find_lengths();
        if (sizes_.num_samples != options_.num_samples) {
            options_.num_samples = sizes_.num_samples;
            find_lengths();
            options_.num_samples = sizes_.num_samples;
        }
    }

    RemeshResult run() {
        find_mesh();
        shorten_edges();
        if (may_repair(kept_) && !is_best_bound_) bring_near();
        best_->seconds = first_.seconds;
        best_->features.samples_for_all = samples_for_all_;
        return *std::move(best_);
    }

    // \throw TooFewSamples  no attempt gives a mesh.
    void find_mesh() {
        run_all(true);
        if (!best_) run_all(false);
        if (!best_) throw TooFewSamples{options_.num_samples, num_needed_};
    }

private:
    void find_lengths() {
        const double spacing = spacing_for(cleaned_, options_);
        // A crease left out costs distance.
        const CloseCreases close = bound_ != nullptr ? CloseCreases::Stay
                                   : refines_        ? CloseCreases::GoOrRefine
                                                     : CloseCreases::Go;
        found_ = find_curves(cleaned_, spacing, close, {options_, first_});
        sizes_ = find_sizes(cleaned_, found_, spacing, {}, lengths_, {options_, first_});
    }

    void run_all(bool has_junctions) {
        KeptCurves kept{has_junctions, !found_.is_seam.empty(), found_.is_crease};
        BadPoints bad;
        if (try_curves(kept, bad) || try_other_sites(kept)) return;
        for (int num_changes = 0;;) {
            if (!found_.strips.empty()) {
                refines_ = false;
                find_lengths();
                kept.is_crease = found_.is_crease;
            } else if (kept.has_seams) {
                kept.has_seams = false;
            } else if (!change_near(bad, num_changes, kept.is_crease)) {
                // Faces without area are no reason to give up more.
                if (!has_creases(kept.is_crease) || (best_ && is_fine(*best_))) return;
                kept.is_crease.assign(kept.is_crease.size(), 0);
            }
            bad = {};
            if (try_curves(kept, bad)) return;
        }
    }

    bool try_other_sites(const KeptCurves& kept) {
        if (options_.sites) return false;
        BadPoints bad;
        ++options_.seed;
        const bool is_done = try_curves(kept, bad);
        --options_.seed;
        return is_done;
    }

    // Corners of bad faces.
    struct BadPoints {
        std::vector<SurfacePoint> crossings, flats;  // Of faces that intersect, and without area.
    };

    // Changes creases at bad faces: where some intersect, those that were left out come back. The
    // next time all go there.
    // \param num_changes  so far.
    // \return whether there was a change.
    bool change_near(const BadPoints& bad, int& num_changes,
                     std::vector<std::uint8_t>& is_crease) const {
        const double spacing = spacing_for(cleaned_, options_);
        while (num_changes < most_changes) {
            const bool come_back = num_changes++ == 0;
            std::vector<SurfacePoint> points = bad.crossings;
            if (!come_back) points.insert(points.end(), bad.flats.begin(), bad.flats.end());
            std::vector<std::uint8_t> is_among = come_back ? found_.is_close : is_crease;
            if (!come_back) {
                for (Index e = 0; e < is_among.size(); ++e) {
                    if (found_.is_given[e] != 0) is_among[e] = 0;
                }
            }
            std::vector<Vec3> corners;
            corners.reserve(points.size());
            for (const SurfacePoint& point : points) {
                corners.push_back(position(cleaned_.surface.mesh.view(), point));
            }
            const std::vector<Index> near =
                edges_near(corners, cleaned_.surface, spacing, is_among);
            for (const Index e : near) is_crease[e] = come_back ? 1 : 0;
            if (!near.empty()) return true;
        }
        return false;
    }

    // Keeps the result if it is the best.
    // \param[out] bad  no crossings if less creases would not help; empty if there is no mesh.
    // \return whether no other curves would give a better one.
    bool try_curves(const KeptCurves& kept, BadPoints& bad) {
        RemeshResult result = first_;
        // Repairs take long: of further attempts only the best one gets them.
        const bool is_first = std::exchange(is_first_, false);
        const DistanceBound* bound = is_first && may_repair(kept) ? bound_ : nullptr;
        AttemptEnd end = run_attempt(cleaned_, found_, kept, sizes_.field.get(), bound, of_input_,
                                     {options_, result});
        first_.seconds = result.seconds;
        samples_for_all_ = std::max(samples_for_all_, result.features.samples_for_all);
        const bool is_bare = !has_more_to_drop(kept, result.features);
        if (!end.has_mesh) {
            num_needed_ = std::max(end.num_needed, options_.num_samples + 1);
            return is_bare;
        }
        result.features.gave_up = kept.is_crease != found_.is_crease;
        if (!is_hopeless(result.self_intersections.value_or(0), {options_, result})) {
            bad.crossings = end.crossing_corners;
        }
        bad.flats = std::move(end.flat_corners);
        if (!best_ || is_better(result, *best_)) {
            best_ = std::move(result);
            is_best_bound_ = bound != nullptr;
            kept_ = kept;
            seed_ = options_.seed;
            narrow_points_ = std::move(end.narrow_points);
            crossings_ = std::move(end.crossing_corners);
        }
        // Shorter edges are needed first.
        if (bound != nullptr && best_->sizing.largest_distance == 0) return true;
        return is_bare || (is_fine(*best_) && best_->verdict.faces_without_area == 0);
    }

    // Runs the best attempt again with shorter edges on narrow parts, if such a part was lost, and
    // where faces intersect that do not in the input. Keeps the best result.
    void shorten_edges() {
        if (!may_shorten(options_)) return;
        // A rod that is narrower than the spacing gets shorter by some edges.
        if (!has_lost_part(*best_)) narrow_points_.clear();
        double length = best_->verdict.spacing;
        std::vector<SizedPoint> points;
        std::vector<SurfacePoint> crossings = std::move(crossings_);
        for (int round = 0; round < most_shortenings; ++round) {
            // Those of the input would come with any length.
            if (is_fine(*best_) || best_->input_self_intersections > 0 ||
                is_hopeless(best_->self_intersections.value_or(0), {options_, *best_})) {
                crossings.clear();
            }
            const bool is_lost = round == 0 && !narrow_points_.empty();
            if (crossings.empty() && !is_lost) return;
            length /= 2;
            for (const SurfacePoint& point : crossings) points.push_back({point, length});
            crossings = run_shorter(points);
        }
    }

    // \return corners of faces that intersect.
    std::vector<SurfacePoint> run_shorter(std::span<const SizedPoint> points) {
        RemeshResult again = first_;
        // The number stays, whatever it follows from: a mean edge would make the others longer.
        RemeshOptions options = options_;
        options.sizing.count = NumSamples{};
        options.seed = seed_;
        const StageContext context{options, again};
        const RunSizes sizes = find_sizes(cleaned_, found_, spacing_for(cleaned_, options_),
                                          narrow_points_, points, context);
        AttemptEnd end =
            run_attempt(cleaned_, found_, kept_, sizes.field.get(), nullptr, of_input_, context);
        first_.seconds = again.seconds;
        const Index crossings = num_more_crossings(again), before = num_more_crossings(*best_);
        const bool is_nearer = again.verdict.largest_distance < best_->verdict.largest_distance;
        if (end.has_mesh && (crossings < before || (crossings == before && is_nearer))) {
            again.features.gave_up = best_->features.gave_up;
            best_ = std::move(again);
        }
        return std::move(end.crossing_corners);
    }

    // Whether faces are repaired that are too far from the input: meshes with junctions are not
    // edited.
    [[nodiscard]] bool may_repair(const KeptCurves& kept) const {
        return bound_ != nullptr && (!kept.has_junctions || found_.junctions.empty());
    }
    // Runs the best attempt again, and repairs its faces that are too far from the input.
    void bring_near() {
        RemeshResult again = first_;
        options_.seed = seed_;
        const AttemptEnd end = run_attempt(cleaned_, found_, kept_, sizes_.field.get(), bound_,
                                           of_input_, {options_, again});
        first_.seconds = again.seconds;
        if (!end.has_mesh) return;
        again.features.gave_up = best_->features.gave_up;
        best_ = std::move(again);
    }

    const CleanedInput& cleaned_;
    RemeshOptions options_;
    std::span<const SizedPoint> lengths_;
    const DistanceBound* bound_;
    RemeshResult first_;  // Of cleaning and what was found here; its times include all attempts.
    FoundCurves found_;
    RunSizes sizes_;
    bool is_first_ = true;        // The next attempt.
    bool is_best_bound_ = false;  // The best one keeps the distance, or it cannot.
    InputCrossings of_input_;
    // Strips between close creases. With a mean edge given the others would be longer.
    bool refines_ =
        may_shorten(options_) && !std::holds_alternative<MeanEdge>(options_.sizing.count);
    std::optional<RemeshResult> best_;
    KeptCurves kept_;                          // Of the best.
    std::uint64_t seed_ = 0;                   // Of the best.
    std::vector<SurfacePoint> narrow_points_;  // Of the best.
    std::vector<SurfacePoint> crossings_;      // Corners of the best that intersect.
    Index samples_for_all_ = 0;                // Of the attempt with most curves.
    Index num_needed_ = 0;                     // Vertices, by the last attempt without a mesh.
};

// \throw TooFewSamples  no mesh of this topology has as few vertices as are asked for.
void require_least_samples(const Topology& topology, const RemeshOptions& options) {
    // Sheets that are welded share vertices, and sites have a check of their own.
    if (options.vertex_count != VertexCount::Exact || options.junctions == Junctions::Keep ||
        options.sites) {
        return;
    }
    const Index needed = minimum_samples(topology);
    if (options.num_samples < needed) throw TooFewSamples{options.num_samples, needed};
}

struct EnoughSamples {
    Index count = 0;
    bool is_tried = false;    // A run with so many has given a mesh.
    bool is_too_few = false;  // A run with so many has given none.
};

// A number of samples that works. Large numbers are not tried: a run would take minutes.
EnoughSamples find_enough(const CleanedInput& cleaned, const RemeshResult& after_cleaning,
                          const RemeshOptions& options, Index reached) {
    constexpr int max_tries = 6;
    constexpr Index most_tried = 10'000;
    if (reached > std::max(most_tried, options.num_samples)) return {.count = reached};
    RemeshOptions more = options;
    more.sites.reset();
    for (int tries = 0; tries < max_tries; ++tries) {
        more.num_samples = reached;
        RemeshResult result = after_cleaning;
        const std::optional<CleanedInput> coarse =
            coarse_input(cleaned, spacing_for(cleaned, more), {more, result});
        try {
            Attempts(coarse ? *coarse : cleaned, result, more, {}, nullptr).find_mesh();
            return {.count = reached, .is_tried = true};
        } catch (const TooFewSamples& failure) {
            reached = failure.reached > reached + 1 ? failure.reached : reached + reached / 4 + 1;
        }
    }
    return {.count = more.num_samples, .is_too_few = true};
}

// What is too little, and what would do, in the terms of the options.
std::string describe_too_few(const TooFewSamples& failure, const EnoughSamples& enough,
                             const CleanedInput& cleaned, const RemeshOptions& options) {
    const std::string what = cleaned.locked.empty()
                                 ? " for the topology of the mesh; use "
                                 : " for the topology and the vertices that stay; use ";
    const Sizing& sizing = options.sizing;
    constexpr double rounds_down = 0.995;  // A bound times this, with three digits, is no larger.
    const std::string most = enough.is_too_few ? "less than " : "at most ";
    const std::string least = enough.is_too_few ? "more than " : "";
    const auto* mean = std::get_if<MeanEdge>(&sizing.count);
    if (!options.sites && mean != nullptr) {
        return "an edge length of " + number_text(mean->length, 3) + " is too long" + what + most +
               number_text(rounds_down * edge_length_for(enough.count, cleaned, options), 3);
    }
    if (!options.sites && std::holds_alternative<CountOfLengths>(sizing.count)) {
        const double share = std::sqrt(static_cast<double>(failure.asked) / enough.count);
        return "the edge lengths given are too long" + what + "lengths " + most +
               number_text(rounds_down * share, 3) + " times as long";
    }
    const auto* faces = std::get_if<NumFaces>(&sizing.count);
    if (!options.sites && faces != nullptr) {
        return std::to_string(faces->number) + " faces are too few" + what + least +
               std::to_string(faces_for(enough.count, cleaned)) + " faces";
    }
    const std::string asked = std::to_string(failure.asked);
    const std::string who =
        options.sites ? "the given sites, of which " + asked + " have a cell," : asked + " samples";
    return who + " are too few" + what + least + std::to_string(enough.count) + " samples" +
           (enough.is_tried     ? ", which were tried and work"
            : enough.is_too_few ? ""
                                : " or more");
}

// More for the text of an error: few faces for each component are a soup with gaps.
std::string describe_gaps(const CleanedInput& cleaned) {
    const std::size_t components = cleaned.topology.components.size();
    const Index faces = cleaned.surface.num_faces();
    if (components == 1 || 2 * components <= faces) return "";
    return "; its " + std::to_string(faces) + " faces are " + std::to_string(components) +
           " components: if they belong together, weld their vertices first";
}

}  // namespace

// Fewer creases are worth fewer new self-intersections, no lost part, and faces without area.
bool is_better(const RemeshResult& result, const RemeshResult& best) {
    if (is_fine(result) != is_fine(best)) return is_fine(result);
    const Index crossings = num_more_crossings(result), of_best = num_more_crossings(best);
    if (!is_fine(result) && crossings != of_best) {
        return crossings < of_best && result.new_self_intersections < best.new_self_intersections;
    }
    if (has_lost_part(result) != has_lost_part(best)) return has_lost_part(best);
    return result.verdict.faces_without_area < best.verdict.faces_without_area;
}

RemeshResult run_stages(const InputMesh& input, const RemeshOptions& given) {
    RemeshOptions options = given;
    RemeshResult result;
    for (const Stage stage :
         {Stage::Clean, Stage::Sample, Stage::Relax, Stage::Propagate, Stage::Diagram, Stage::Dual,
          Stage::Delaunay, Stage::Place, Stage::Check}) {
        result.seconds.emplace_back(stage, 0.0);
    }
    CleanedInput cleaned = clean_stage(input, {options, result});
    // Nobody asked for a number that what is locked could contradict.
    if (!cleaned.locked.empty() && gives_num_samples(options.sizing)) {
        options.vertex_count = VertexCount::Add;
    }
    try {
        options.num_samples = sample_count(cleaned, options);
        require_least_samples(cleaned.topology, options);
        const std::optional<CleanedInput> coarse =
            coarse_input(cleaned, spacing_for(cleaned, options), {options, result});
        const CleanedInput& used = coarse ? *coarse : cleaned;
        RemeshResult after_cleaning = result;
        const auto run = [&](const RemeshOptions& changed, std::span<const SizedPoint> lengths,
                             const DistanceBound* bound) {
            RemeshResult made = Attempts(used, after_cleaning, changed, lengths, bound).run();
            after_cleaning.seconds = made.seconds;
            return made;
        };
        const auto* distance = std::get_if<MaxDistance>(&options.sizing.count);
        result = distance != nullptr ? meet_distance(cleaned, options, distance->distance, run)
                                     : run(options, {}, nullptr);
        if (const auto length = corrected_edge_length(result.sizing.mean_edge, options)) {
            options.sizing.count = MeanEdge{*length};
            options.num_samples = sample_count(cleaned, options);
            try {
                require_least_samples(cleaned.topology, options);
                result = run(options, {}, nullptr);
            } catch (const TooFewSamples&) {
                // The edges of the first result are as long as the topology allows.
            }
        }
    } catch (const TooFewSamples& failure) {
        const EnoughSamples enough = find_enough(cleaned, result, options, failure.reached);
        throw ConstraintUnmet(describe_too_few(failure, enough, cleaned, given) +
                              describe_gaps(cleaned));
    }
    result.input_topology = std::move(cleaned.topology);
    return result;
}

}  // namespace remesh::detail
