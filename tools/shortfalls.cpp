#include "shortfalls.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "agvd/core/error.h"
#include "agvd/core/number_text.h"

namespace cli {
namespace {

using Warnings = std::vector<std::string>;

// What makes the edges of the result shorter.
std::string finer(const remesh::RemeshOptions& options) {
    const auto& count = options.sizing.count;
    const bool has_lengths = std::holds_alternative<remesh::MeanEdge>(count) ||
                             std::holds_alternative<remesh::CountOfLengths>(count);
    return has_lengths ? "shorter edges" : "more --samples";
}

// More samples help where the input does not intersect itself; elsewhere the result has the more
// pairs the more samples there are.
std::string describe_crossings(const remesh::RemeshResult& result, const std::string& more) {
    const agvd::Index in_input = result.input_self_intersections;
    const agvd::Index fresh = result.new_self_intersections;
    const std::string text = "the result has " + std::to_string(*result.self_intersections) +
                             " pairs of intersecting faces, the input has " +
                             std::to_string(in_input);
    const std::string where =
        ", one near " + agvd::place_text(result.crossing_near, result.verdict.diagonal);
    if (in_input == 0) return text + (fresh > 0 ? where : "") + "; use " + more;
    if (fresh == 0) {
        return text + "; they are where the input intersects itself, and " + more +
               " give more; repair the input, or use --wrap";
    }
    return text + "; " + std::to_string(fresh) + " are not where the input intersects itself" +
           where + ": for these use " + more + ", for the others repair the input, or use --wrap";
}

// Of the vertices in the part that was remeshed.
double spacing_of(const remesh::RemeshResult& result) {
    double area = 0;
    for (const auto& component : result.input_topology.components) area += component.area;
    const std::size_t kept = result.kept.vertices.size() - result.kept.rim_edges;
    return std::sqrt(area / static_cast<double>(result.mesh.positions.size() - kept));
}

// Empty: no part of the input is lost.
std::string describe_lost_part(const remesh::RemeshResult& result, const std::string& more) {
    constexpr double most_spacings = 2;
    const remesh::Verdict& verdict = result.verdict;
    if (!(verdict.largest_distance > most_spacings * spacing_of(result))) return {};
    return "the result is " + agvd::number_text(verdict.largest_distance, 4) +
           " away from the input at " + agvd::place_text(verdict.farthest, verdict.diagonal) +
           ", farther than two distances of neighbouring vertices; use " + more;
}

// \throw agvd::ConstraintUnmet  with --strict.
void judge(const remesh::RemeshResult& result, const std::string& more, bool strict,
           Warnings& warnings) {
    const auto refuse = [](const std::string& text) {
        throw agvd::ConstraintUnmet(text + ", or leave out --strict");
    };
    if (const std::string text = coarseness_text(result); strict && !text.empty()) refuse(text);
    const auto tell = [&](const std::string& text) {
        if (strict) refuse(text);
        warnings.push_back(text);
    };
    if (const std::string text = describe_lost_part(result, more); !text.empty()) tell(text);
    if (const agvd::Index flat = result.verdict.faces_without_area; flat > 0) {
        tell("the result has " + std::to_string(flat) + (flat == 1 ? " face" : " faces") +
             " without area, whose corners lie on one line; "
             "use " +
             more + ", or other --features");
    }
    if (result.self_intersections.value_or(0) > result.input_self_intersections) {
        tell(describe_crossings(result, more));
    }
}

void warn_of_bodies(const remesh::BodyCounts& bodies, Warnings& warnings) {
    if (bodies.inside_out == 0) return;
    warnings.push_back(std::to_string(bodies.inside_out) +
                       (bodies.inside_out == 1 ? " closed body is" : " closed bodies are") +
                       " inside out, as in the input: normals point inward; turn the faces over "
                       "before you print the mesh");
}

void warn_of_junctions(const remesh::JunctionCounts& counts, remesh::Junctions wanted,
                       Warnings& warnings) {
    if (counts.apart_edges == 0 || wanted == remesh::Junctions::Apart) return;
    warnings.push_back(
        "the sheets at " + std::to_string(counts.apart_edges) +
        " non-manifold edges of the input could not be welded; use more --samples, and "
        "leave out --sites and --boundary free");
}

void warn_of_bounds(const remesh::SizingResult& sizes, const remesh::Sizing& wanted,
                    Warnings& warnings) {
    constexpr double tolerance = 0.02;
    const std::string count = std::to_string(sizes.num_samples) + " vertices are too ";
    if (sizes.largest_target > (1 + tolerance) * wanted.max_edge) {
        warnings.push_back(count + "few for --max-edge; use more, or longer edges");
    }
    if (sizes.largest_target > 0 && sizes.least_target < (1 - tolerance) * wanted.min_edge) {
        warnings.push_back(count + "many for --min-edge; use fewer, or shorter edges");
    }
    if (wanted.places.empty()) return;
    const double length =
        std::ranges::min_element(wanted.places, {}, &remesh::SizedPlace::length)->length;
    if (sizes.least_target > (1 + tolerance) * length) {
        warnings.push_back(count +
                           "few for --size-at; use more, longer edges, or a larger "
                           "--gradation");
    }
}

void warn_of_seams(const remesh::FeatureCounts& counts, Warnings& warnings) {
    constexpr double least_share = 0.01;
    const double all = counts.seam_length + counts.dropped_seam_length;
    if (!(counts.dropped_seam_length > least_share * all)) return;
    warnings.push_back(
        std::to_string(std::lround(100 * counts.dropped_seam_length / all)) +
        " % of the seams of texture coordinates are too short or too close to each other "
        "to be edges of the result, whose faces there have coordinates of one side only; "
        "use more --samples");
}

void warn_of_sheets(const remesh::WrapCounts& wrapped, Warnings& warnings) {
    constexpr double least_share = 0.05;
    if (!(wrapped.sheets > least_share)) return;
    warnings.push_back(
        std::to_string(std::lround(100 * wrapped.sheets)) +
        " % of the result are the two sides of sheets: the input is open wider than two radii of "
        "--wrap; a larger --wrap or --fill-holes closes it, and without --wrap sheets stay single");
}

}  // namespace

std::string coarseness_text(const remesh::RemeshResult& result) {
    const remesh::FeatureCounts& creases = result.features;
    const remesh::Verdict& verdict = result.verdict;
    std::string text;
    agvd::Index enough = 0;  // 0: not known.
    const auto add = [&](bool is_so, const char* what, agvd::Index samples) {
        if (!is_so) return;
        text += (text.empty() ? "" : ", ") + std::string(what);
        enough = std::max(enough, samples);
    };
    add(creases.close_length > 0, "close creases", 0);
    add(creases.dropped_length > 0, "creases", creases.samples_for_all);
    add(verdict.thin_walls > 0, "walls", verdict.samples_for_walls);
    add(verdict.small_components > 0, "components", verdict.samples_for_components);
    if (text.empty()) return text;
    text = "the result is too coarse for some " + text + "; use more --samples";
    return enough == 0 ? text : text + " (about " + std::to_string(enough) + " would do)";
}

std::string creases_of_tiles_text(double length) {
    return "the mesh has creases of length " + agvd::number_text(length) +
           " in mesh units, which tiles do not keep: they come out cut off; remesh it in one piece "
           "if memory suffices";
}

std::string welded_slit_text(double length) {
    return "a slit of length " + agvd::number_text(length) +
           " in mesh units was welded, as its two sides lie at one place; use --keep-slits to "
           "leave it open, unless it is a seam of a texture";
}

std::string loose_vertices_text(agvd::Index count) {
    return std::to_string(count) + (count == 1 ? " vertex" : " vertices") + " of the boundary " +
           (count == 1 ? "lies" : "lie") +
           " beside an edge of the boundary, with a gap between them; use --weld of remesh with "
           "the width of the gap to close it, unless it is meant to be there";
}

std::vector<std::string> shortfalls_of(const remesh::RemeshResult& result,
                                       const remesh::RemeshOptions& options, bool strict) {
    Warnings warnings;
    judge(result, finer(options), strict, warnings);
    // Seams of a texture are told below.
    if (result.welded_slit_length > spacing_of(result) && options.texture_seams.empty()) {
        warnings.push_back(welded_slit_text(result.welded_slit_length));
    }
    if (result.loose_vertices > 0) warnings.push_back(loose_vertices_text(result.loose_vertices));
    warn_of_bodies(result.verdict.bodies, warnings);
    warn_of_junctions(result.junctions, options.junctions, warnings);
    warn_of_sheets(result.wrapped, warnings);
    warn_of_seams(result.features, warnings);
    warn_of_bounds(result.sizing, options.sizing, warnings);
    return warnings;
}

}  // namespace cli
