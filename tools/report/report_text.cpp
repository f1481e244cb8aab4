// Formats the report of a run as text for people: what it means to any user (to_text), and what
// tells more to those who know the method (details_to_text). Each part has a function of its own.
// Lines for things that did not happen are left out.
#include <algorithm>
#include <cmath>

#include "remesh/meshfile/text.h"
#include "report/report.h"
#include "report/report_common.h"

namespace remesh {
namespace {

using detail::counted;
using detail::degrees;
using detail::fixed;
using detail::significant;

std::string describe(const Topology& topology) {
    return counted(topology.components.size(), "component") + ", genus " +
           std::to_string(topology.genus()) + ", " +
           counted(static_cast<std::size_t>(topology.boundary_loops()), "boundary loop");
}

}  // namespace

std::string to_text(const CleanCounts& counts) {
    std::string text;
    for (const detail::RepairRow& row : detail::repair_rows) {
        if (counts.*row.count == 0) continue;
        text += (text.empty() ? "repaired: " : ", ") + counted(counts.*row.count, row.what);
    }
    return text.empty() ? "repaired: nothing" : text;
}

std::string to_text(Engine engine, double certified_error) {
    const std::string text = std::string("distances: ") + engine_name(engine) + " engine, ";
    if (certified_error == 0) return text + "exact";
    if (!std::isfinite(certified_error)) return text + "error unknown";
    constexpr double steps = 1e4;  // Per percent; rounded up, since it is a bound.
    const double percent = std::ceil(100 * certified_error * steps) / steps;
    return text + "at most " + fixed(percent, 4) + " % above exact";
}

namespace {

std::string describe(const DelaunayCounts& counts, Delaunay delaunay) {
    const double inner_edges = std::max<Index>(counts.inner_edges, 1);
    const auto percent = [&](Index count) { return fixed(100 * count / inner_edges, 2) + " %"; };
    std::string text = std::string(delaunay_name(delaunay)) +
                       " Delaunay condition: " + percent(counts.failing_before) +
                       " of the edges failed it before " + counted(counts.flips, "flip") + ", " +
                       percent(counts.failing_after) + " after";
    if (!counts.is_finished) text += "; the flips reached their limit";
    if (counts.not_locally_shortest > 0) {
        text +=
            "; " + counted(counts.not_locally_shortest, "edge") + " not proved locally shortest";
    }
    if (counts.broken_triangles > 0) {
        text += "; the triangle inequality fails in " + counted(counts.broken_triangles, "face");
    }
    return text;
}

std::string why_dropped(const FeatureCounts& features) {
    std::string text;
    if (features.uncarried_curves > 0) {
        text = "too few of the given sites lie on " + counted(features.uncarried_curves, "crease") +
               " or on the boundary";
        if (!features.gave_up) return text;
        text += "; ";
    }
    if (!features.gave_up) {
        return "to keep all, use " + std::to_string(features.samples_for_all) + " samples";
    }
    return text + "with creases no mesh was found";
}

// Empty without creases.
std::string describe(const FeatureCounts& features) {
    if (features.curves == 0 &&
        features.close_length + features.dropped_length + features.dropped_seam_length == 0) {
        return "";
    }
    std::string text = "\ncreases and boundary: " + counted(features.curves, "curve") + ", " +
                       counted(features.nodes, "corner") + ", " +
                       counted(features.vertices, "vertex");
    const auto add_length = [&](double length, const char* what) {
        if (length > 0) text += "; " + significant(length) + " long: " + what;
    };
    add_length(features.length, "creases kept");
    add_length(features.close_length, "creases left out as too close to stronger ones");
    add_length(features.dropped_length, "creases dropped");
    add_length(features.freed_length, "creases given up where faces would intersect or be narrow");
    add_length(features.seam_length, "texture seams kept");
    add_length(features.dropped_seam_length,
               "texture seams left out as too short or too close to each other");
    return text;
}

// Empty if the whole mesh was remeshed.
std::string describe(const KeptPart& kept, std::size_t num_faces) {
    if (kept.faces.empty()) return "";
    return "\nregion: " + counted(num_faces - kept.faces.size(), "face") + " of the result, " +
           counted(kept.faces.size(), "face") + " stayed as they were; " +
           counted(kept.rim_edges, "edge") + " between them";
}

// Empty for manifolds.
std::string describe(const JunctionCounts& junctions) {
    if (junctions.edges == 0) return "";
    const std::string text =
        "\nnon-manifold edges of the input: " + counted(junctions.edges, "edge") +
        " where sheets meet; ";
    if (junctions.apart_edges > 0) {
        return text + "each sheet has its own points there" +
               (junctions.samples_for_all == 0
                    ? ""
                    : "; for common points use at least " +
                          std::to_string(junctions.samples_for_all) + " samples");
    }
    const std::string on_curves =
        counted(junctions.vertices, "vertex") + " on " + counted(junctions.curves, "curve");
    if (junctions.welded_edges > 0) {
        return text + "welded in the result: " + on_curves + ", " +
               counted(junctions.welded_edges, "edge") + " with more than two faces";
    }
    return text + "the sheets have the same points there: " + on_curves;
}

std::string samples_for(Index count) {
    constexpr Index most_named = 10'000'000;
    if (count > most_named) return ")";
    return "; about " + std::to_string(count) + " samples would do)";
}

std::string describe(const BodyCounts& bodies) {
    std::string text = "\nwatertight: ";
    text += bodies.holes == 0 ? "yes"
                              : "no, " + counted(bodies.holes, "hole") + " of " +
                                    counted(bodies.hole_edges, "edge");
    const auto add = [&](Index count, const char* what) {
        if (count > 0) text += "; " + counted(count, "closed shell") + what;
    };
    add(bodies.closed, "");
    add(bodies.inside_out, " inside out (normals point inward)");
    add(bodies.cavities, " around cavities of others");
    add(bodies.inner_bodies,
        " inside others, around no cavity (normals point outward; --wrap leaves them out)");
    return text;
}

// Parts of the input that are smaller than the result's edges; empty: none.
std::string describe_lost(const Verdict& verdict, const FeatureCounts& features) {
    std::string small;
    const auto add = [&](const std::string& text) { small += (small.empty() ? "" : ", ") + text; };
    if (features.dropped_length > 0) {
        add("creases of length " + significant(features.dropped_length) + " (" +
            why_dropped(features) + ")");
    }
    if (features.close_length > 0) {
        add("creases of length " + significant(features.close_length) +
            " (too close to stronger ones)");
    }
    if (features.freed_length > 0) {
        add("creases of length " + significant(features.freed_length) + " (given up near " +
            agvd::place_text(features.freed_near, verdict.diagonal) +
            ", where faces would intersect or be narrow)");
    }
    if (verdict.thin_walls > 0) {
        add(counted(verdict.thin_walls, "wall") + " (thinnest " +
            significant(verdict.thinnest_wall) + samples_for(verdict.samples_for_walls));
    }
    if (verdict.small_components > 0) {
        add(counted(verdict.small_components, "component") + " (fewer than " +
            std::to_string(least_component_vertices) + " vertices" +
            samples_for(verdict.samples_for_components));
    }
    return small;
}

std::string describe_crossings(const RemeshResult& result) {
    if (!result.self_intersections) return "crossings not counted";
    if (*result.self_intersections == 0) return "no crossing";
    return std::to_string(*result.self_intersections) + " pairs cross (" +
           std::to_string(result.input_self_intersections) + " in the input" +
           (result.input_self_intersections > 0 ? "; --wrap makes one closed surface)" : ")");
}

// Empty if there are none.
std::string describe_narrow(const NarrowFaces& narrow) {
    if (narrow.count == 0) return "";
    std::string why;
    const auto add = [&](Index count, const char* where) {
        if (count > 0) why += (why.empty() ? ": " : ", ") + std::to_string(count) + where;
    };
    add(narrow.at_acute_corners, " at acute corners");
    add(narrow.at_thin_walls, " at walls thinner than the edges");
    add(narrow.between_creases, " between close creases");
    return " (" + counted(narrow.count, "face") + " below 30" + why + ")";
}

// Three lines: the shape of the triangles, the distance, and what is lost.
std::string describe_verdict(const RemeshResult& result) {
    const Verdict& verdict = result.verdict;
    constexpr double few = 0.01;
    const std::string share =
        verdict.small_angle_share > few ? fixed(100 * verdict.small_angle_share, 1) + " %" : "few";
    const std::string shape =
        verdict.small_angle_share > 0 ? share + " narrow (an angle below 30 degrees)" : "even";
    const std::string lost = describe_lost(verdict, result.features);
    return "triangles: " + shape + ", smallest angle " + fixed(verdict.min_angle * degrees, 1) +
           " degrees" + describe_narrow(verdict.narrow) + "; " + describe_crossings(result) +
           "\ndistance: farthest at least " +
           significant(100 * verdict.largest_distance / verdict.diagonal) +
           " % of the size, from the input's vertex at " +
           agvd::place_text(verdict.farthest, verdict.diagonal) + "\ntoo small for edges of " +
           significant(verdict.spacing) + ": " + (lost.empty() ? "nothing" : lost);
}

// Empty if the file has no attributes.
std::string describe(const AttributeReport& attributes) {
    const auto list = [](const char* title, const auto& items, const auto& name_of) {
        std::string text;
        for (const auto& item : items) text += (text.empty() ? title : ", ") + name_of(item);
        return text;
    };
    return list("\nattributes carried over: ", attributes.carried,
                [](const std::string& name) { return name; }) +
           list("\nattributes not carried over: ", attributes.declined,
                [](const DeclinedAttribute& declined) { return declined.name; });
}

std::string to_text(const SizingResult& sizing) {
    std::string text = "edges: mean length " + significant(sizing.mean_edge);
    if (sizing.largest_target == 0) return text;
    return text + ", targets from " + significant(sizing.least_target) + " to " +
           significant(sizing.largest_target) + ", 90 % of the edges are " +
           fixed(sizing.low_ratio, 2) + " to " + fixed(sizing.high_ratio, 2) + " times theirs";
}

}  // namespace

std::string to_text(const RemeshResult& result, const RunInfo& info) {
    std::string text;
    if (!info.input_path.empty()) text += "input: " + info.input_path + '\n';
    text += to_text(result.cleaned);
    text += "\nresult: " + counted(result.mesh.positions.size(), "vertex") + ", " +
            counted(result.mesh.triangles.size(), "face") +
            (result.junctions.welded_edges > 0 ? "; same topology before the sheets were welded"
                                               : "; same topology");
    text += describe(result.verdict.bodies);
    text += '\n' + to_text(result.sizing);
    text += describe(result.kept, result.mesh.triangles.size());
    text += describe(result.junctions);
    if (result.components_dropped > 0) {
        text += "\n" + counted(result.components_dropped, "component") +
                " dropped, because the area is too small";
    }
    if (result.sites_dropped > 0) {
        text +=
            "\n" + counted(result.sites_dropped, "site") + " dropped, because they have no cell";
    }
    text += '\n' + describe_verdict(result);
    text += describe(info.attributes);
    if (!info.output_path.empty()) text += "\nwritten: " + info.output_path;
    return text;
}

std::string details_to_text(const RemeshResult& result, const RunInfo& info) {
    std::string text = "surface: " + counted(result.input_topology.face_component.size(), "face") +
                       ", " + describe(result.input_topology);
    text += '\n' + to_text(info.options.propagation.engine, result.certified_error);
    for (const RelaxLevel& level : result.relaxation) {
        text += "\nrelaxation: " + counted(level.num_sites, "site") + ", " +
                counted(level.energy.size() - 1, "step");
        if (const auto energy = energy_share(level, level.energy.size() - 1)) {
            text += std::string(", energy ") + (*energy > 1 ? "raised" : "lowered") + " by " +
                    fixed(100 * std::abs(*energy - 1), 1) + " %";
        }
    }
    if (result.dual.simplified_parts > 0) {
        text += "\n" + counted(result.dual.simplified_parts, "part") +
                " simplified to the sites, because cells are no discs there: " +
                fixed(100.0 * result.dual.sites_of_cells / std::max(result.dual.sites, 1U), 1) +
                " % of the sites have the triangles of their cells";
    }
    if (info.options.features != Features::Off) text += describe(result.features);
    if (info.options.delaunay != Delaunay::Off) {
        text += '\n' + describe(result.delaunay, info.options.delaunay);
    }
    text += "\ntime:";
    for (const auto& [stage, seconds] : result.seconds) {
        text += std::string(" ") + stage_name(stage) + ' ' + fixed(seconds, 2) + " s,";
    }
    text += " total " + fixed(detail::total_seconds(result), 2) + " s";
    if (result.propagation_bytes == 0) return text;
    return text + "; propagation memory " +
           fixed(static_cast<double>(result.propagation_bytes) * 1e-6, 1) + " MB";
}

}  // namespace remesh
