#include "shortfalls.h"

#include <cmath>
#include <string>

#include "remesh/io/write_mesh.h"

namespace cli {
namespace {

// What the result is too coarse to show; empty: nothing.
std::string too_small(const remesh::RemeshResult& result) {
    std::string text;
    const auto add = [&](bool is_so, const char* what) {
        if (is_so) text += (text.empty() ? "" : ", ") + std::string(what);
    };
    add(result.features.dropped_length > 0, "creases");
    add(result.verdict.thin_walls > 0, "walls");
    add(result.verdict.small_components > 0, "components");
    return text;
}

// More samples help where the input does not intersect itself; elsewhere the result has the more
// pairs the more samples there are.
std::string describe_crossings(const remesh::RemeshResult& result) {
    const agvd::Index in_input = result.input_self_intersections;
    const agvd::Index fresh = result.new_self_intersections;
    const std::string text = "the result has " + std::to_string(*result.self_intersections) +
                             " pairs of intersecting faces, the input has " +
                             std::to_string(in_input);
    if (in_input == 0) return text + "; use more --samples";
    if (fresh == 0) {
        const bool has_sites = result.added_because.contains(remesh::SiteReason::SelfIntersection);
        return text + "; they are where the input intersects itself, and more --samples give more" +
               (has_sites ? "" : ", so that no sites were added there") + "; mend the input";
    }
    return text + "; " + std::to_string(fresh) +
           " are not where the input intersects itself: for these use more --samples, for the "
           "others mend the input";
}

// \throw agvd::ConstraintUnmet  with --strict.
void judge(const remesh::RemeshResult& result, bool strict, Console& console) {
    if (const std::string small = too_small(result); strict && !small.empty()) {
        throw agvd::ConstraintUnmet("the result is too coarse for some " + small +
                                    "; use more --samples (without --strict the report tells how "
                                    "many), or leave out --strict");
    }
    if (result.self_intersections.value_or(0) <= result.input_self_intersections) return;
    const std::string text = describe_crossings(result);
    if (strict) throw agvd::ConstraintUnmet(text + ", or leave out --strict");
    console.warn(text);
}

void warn_of_junctions(const remesh::JunctionCounts& counts, remesh::Junctions wanted,
                       Console& console) {
    if (counts.apart_edges == 0 || wanted == remesh::Junctions::Apart) return;
    console.warn("the sheets at " + std::to_string(counts.apart_edges) +
                 " non-manifold edges of the input could not be welded; use more --samples, and "
                 "leave out --sites and --boundary free");
}

void warn_of_bounds(const remesh::SizingResult& sizes, const remesh::Sizing& wanted,
                    Console& console) {
    constexpr double tolerance = 0.02;
    const std::string count = std::to_string(sizes.num_samples) + " vertices are too ";
    if (sizes.largest_target > (1 + tolerance) * wanted.max_edge) {
        console.warn(count + "few for --max-edge; use more, or longer edges");
    }
    if (sizes.largest_target > 0 && sizes.least_target < (1 - tolerance) * wanted.min_edge) {
        console.warn(count + "many for --min-edge; use fewer, or shorter edges");
    }
}

void warn_of_seams(const remesh::FeatureCounts& counts, Console& console) {
    constexpr double least_share = 0.01;
    const double all = counts.seam_length + counts.dropped_seam_length;
    if (!(counts.dropped_seam_length > least_share * all)) return;
    console.warn(std::to_string(std::lround(100 * counts.dropped_seam_length / all)) +
                 " % of the seams of texture coordinates are too short or too close to each other "
                 "to be edges of the result, whose faces there have coordinates of one side only; "
                 "use more --samples");
}

}  // namespace

void warn_of_shortfalls(const remesh::RemeshResult& result, const remesh::RemeshOptions& options,
                        bool strict, Console& console) {
    judge(result, strict, console);
    warn_of_junctions(result.junctions, options.junctions, console);
    warn_of_seams(result.features, console);
    warn_of_bounds(result.sizing, options.sizing, console);
}

void warn_of_rounding(const remesh::MeshPath& target, const agvd::MeshView& mesh,
                      const agvd::Progress& progress, Console& console) {
    const std::string text =
        remesh::describe(remesh::rounding_loss(target, mesh, progress), target);
    if (!text.empty()) console.warn(text);
}

}  // namespace cli
