// The order of a run: cleaning, the number of samples, maybe a coarser input, and the stages from
// the network of curves on (mesh_run.h). An error tells a number of samples that works.
#include "remesh/pipeline/run.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "agvd/core/number_text.h"
#include "remesh/pipeline/coarse_input.h"
#include "remesh/pipeline/meet_distance.h"
#include "remesh/pipeline/mesh_run.h"
#include "remesh/pipeline/mesh_with_curves.h"
#include "remesh/pipeline/promises.h"
#include "remesh/pipeline/sample_count.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/sites/shares.h"

namespace remesh::detail {
namespace {

// \throw TooFewSamples  no mesh of this topology has as few vertices as are asked for.
void require_least_samples(const Topology& topology, const RemeshOptions& options) {
    // Sheets that are welded share vertices, and sites have a check of their own.
    if (options.vertex_count != VertexCount::Exact || options.junctions == Junctions::Keep ||
        options.sites) {
        return;
    }
    const Index needed = minimum_samples(topology);
    if (options.num_samples < needed) throw TooFewSamples{options.num_samples, needed, needed};
}

struct EnoughSamples {
    Index count = 0;
    bool is_tried = false;    // A run with so many has given a mesh.
    bool is_too_few = false;  // A run with so many has given none.
};

// The number to try after one that is too few: a quarter more than what is missing, or than was
// tried, as more sites need more vertices.
Index next_count(const TooFewSamples& failure, Index tried) {
    return failure.reached > tried + 1 ? failure.reached + (failure.reached - tried) / 4
                                       : tried + tried / 4 + 1;
}

// From 1 on, they lead to 40 000 samples and more.
constexpr int most_attempts = 40;

// Whether the number of samples follows from a distance, whatever the topology needs.
bool follows_from_distance(const Sizing& sizing) {
    return std::holds_alternative<MaxError>(sizing.count) ||
           std::holds_alternative<MaxDistance>(sizing.count);
}

// Lengths or densities that are the same everywhere give the bytes that none give. Beside locked
// edges and bounds lengths are not the same everywhere.
void drop_equal_values(RemeshOptions& options) {
    Sizing& sizing = options.sizing;
    const bool has_bounds = sizing.min_edge > 0 || sizing.max_edge < infinity;
    const bool is_scaled = !std::holds_alternative<CountOfLengths>(sizing.count);
    const bool has_locked =
        !options.locked.empty() || !options.locked_edges.empty() || options.lock_boundary;
    if (!is_scaled || has_bounds || has_locked) return;
    const auto are_equal = [](const std::vector<double>& values) {
        return !values.empty() &&
               std::ranges::all_of(values, [&](double value) { return value == values.front(); });
    };
    const auto* at = std::get_if<VertexLengths>(&sizing.edges);
    const auto* of = std::get_if<FaceLengths>(&sizing.edges);
    const auto* densities = std::get_if<VertexDensities>(&sizing.edges);
    if ((at != nullptr && are_equal(at->values)) || (of != nullptr && are_equal(of->values)) ||
        (densities != nullptr && are_equal(densities->values))) {
        sizing.edges = EvenEdges{};
    }
}

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
            (void)run_after_cleaning(coarse ? *coarse : cleaned, result, more, {}, nullptr);
            return {.count = reached, .is_tried = true};
        } catch (const TooFewSamples& failure) {
            reached = next_count(failure, reached);
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

RemeshResult run_stages(const InputMesh& input, const RemeshOptions& given) {
    RemeshOptions options = given;
    RemeshResult result;
    for (const Stage stage :
         {Stage::Clean, Stage::Sample, Stage::Relax, Stage::Propagate, Stage::Diagram, Stage::Dual,
          Stage::Delaunay, Stage::Place, Stage::Check}) {
        result.seconds.emplace_back(stage, 0.0);
    }
    drop_equal_values(options);
    CleanedInput cleaned = clean_stage(input, {options, result});
    // Nobody asked for a number that topology, or what is locked, could contradict.
    const bool is_free = follows_from_distance(options.sizing);
    const bool may_raise =
        (is_free || options.vertex_count != VertexCount::Exact) && !options.sites;
    if (is_free || (!cleaned.locked.empty() && gives_num_samples(options.sizing))) {
        options.vertex_count = VertexCount::Add;
    } else if (options.vertex_count == VertexCount::Raise) {
        options.vertex_count = VertexCount::Exact;
    }
    options.sizing.max_edge = std::min(options.sizing.max_edge, most_mean_edge(options.bounds));
    try {
        options.num_samples = sample_count(cleaned, options);
        if (may_raise) {
            options.num_samples = std::max(options.num_samples, minimum_samples(cleaned.topology));
        } else {
            require_least_samples(cleaned.topology, options);
        }
        const std::optional<CleanedInput> coarse =
            coarse_input(cleaned, spacing_for(cleaned, options), {options, result});
        const CleanedInput& used = coarse ? *coarse : cleaned;
        RemeshResult after_cleaning = result;
        const auto run = [&](const RemeshOptions& changed, std::span<const SizedPoint> lengths,
                             const DistanceBound* bound) {
            RemeshOptions enough = changed;
            for (int tries = 0;; ++tries) {
                try {
                    RemeshResult made =
                        run_after_cleaning(used, after_cleaning, enough, lengths, bound);
                    after_cleaning.seconds = made.seconds;
                    return made;
                } catch (const TooFewSamples& failure) {
                    if (!may_raise || tries == most_attempts) throw;
                    enough.num_samples = next_count(failure, failure.asked);
                    if (is_free) {
                        enough.num_samples = std::max(enough.num_samples, failure.for_all);
                    }
                    enough.sizing.count = NumSamples{};
                }
            }
        };
        const auto* distance = std::get_if<MaxDistance>(&options.sizing.count);
        result = distance != nullptr ? meet_distance(cleaned, options, distance->distance, run)
                                     : run(options, {}, nullptr);
        // The wrap does not intersect itself, and so its remesh must not.
        if (options.wrap && result.self_intersections.value_or(0) > 0) {
            result = run_by_collapses(cleaned, result, options);
        }
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
    require_bounds(result, options.bounds);
    result.input_topology = std::move(cleaned.topology);
    return result;
}

}  // namespace remesh::detail
