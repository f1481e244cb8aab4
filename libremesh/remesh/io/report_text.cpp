// Formats results as text for people: the report of a run, the table of remesh-eval, and the table
// of agvd compare. Each part of a report has a function of its own. Lines for things that did not
// happen are left out. Numbers do not depend on the locale.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

#include "remesh/io/report.h"
#include "remesh/io/report_common.h"

namespace remesh {
namespace {

using detail::degrees;
constexpr const char* not_measured = "needs CGAL";

// "1 face", "2 faces", "2 vertices", "2 patches".
std::string counted(std::size_t count, const std::string& noun) {
    std::string plural = noun + 's';
    if (noun.ends_with("vertex")) plural.replace(plural.size() - 3, 3, "ices");
    if (noun.ends_with("ch")) plural.insert(plural.size() - 1, 1, 'e');
    return std::to_string(count) + ' ' + (count == 1 ? noun : plural);
}

// printf's %.*f, without a locale's comma.
std::string fixed(double value, int digits) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << std::fixed << std::setprecision(digits) << value;
    return out.str();
}

// printf's %.4g, without a locale's comma.
std::string significant(double value) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << std::setprecision(4) << value;
    return out.str();
}

std::string describe(const Topology& topology) {
    return counted(topology.components.size(), "component") + ", genus " +
           std::to_string(topology.genus()) + ", " +
           counted(static_cast<std::size_t>(topology.boundary_loops()), "boundary loop");
}

class Table {
public:
    explicit Table(std::ostringstream& out) : out_(out) {}

    template <typename... Cells>
    void row(const std::string& name, const Cells&... cells) {
        out_ << std::left << std::setw(28) << name << std::right;
        ((out_ << std::setw(14) << cells), ...);
        out_ << '\n';
    }

private:
    std::ostringstream& out_;
};

void add_meshes(Table& table, const MeshFigures& a, const MeshFigures& b) {
    const auto both = [&](const char* name, const auto& text_of) {
        table.row(name, text_of(a), text_of(b));
    };
    const auto number = [&](const char* name, int digits, const auto& value_of) {
        both(name, [&](const MeshFigures& m) { return fixed(value_of(m.triangles), digits); });
    };
    using Mesh = const MeshFigures&;
    using Quality = const TriangleQuality&;
    const auto yes_no = [](bool value) { return value ? "yes" : "no"; };
    table.row("", "original", "result");
    both("vertices", [](Mesh m) { return m.vertices; });
    both("faces", [](Mesh m) { return m.faces; });
    both("manifold", [&](Mesh m) { return yes_no(m.topology.is_manifold); });
    both("oriented", [&](Mesh m) { return yes_no(m.topology.is_oriented); });
    both("components", [](Mesh m) { return m.topology.components.size(); });
    both("genus", [](Mesh m) { return m.topology.genus(); });
    both("boundary loops", [](Mesh m) { return m.topology.boundary_loops(); });
    number("mean Q", 4, [](Quality q) { return q.mean_quality; });
    number("min Q", 4, [](Quality q) { return q.min_quality; });
    number("mean smallest angle (deg)", 2, [](Quality q) { return q.mean_min_angle * degrees; });
    number("smallest angle (deg)", 2, [](Quality q) { return q.min_angle * degrees; });
    number("largest angle (deg)", 2, [](Quality q) { return q.max_angle * degrees; });
    number("faces below 30 deg (%)", 2, [](Quality q) { return 100 * q.small_angle_share; });
    number("valence 6 (%)", 2, [](Quality q) { return 100 * q.regular_share; });
    number("edge length variation", 4, [](Quality q) { return q.edge_length_variation; });
    both("non-Delaunay edges", [](Mesh m) { return m.triangles.non_delaunay_edges; });
    both("faces without area", [](Mesh m) { return m.triangles.faces_without_area; });
    both("self-intersecting pairs", [](Mesh m) {
        return m.self_intersections ? std::to_string(m.self_intersections->size()) : not_measured;
    });
}

void add_features(Table& table, const FeatureCoverage& features) {
    const auto diagonals = [&](double length) { return fixed(length / features.diagonal, 3); };
    table.row("sharp edges (diagonals)", diagonals(features.length),
              diagonals(features.result_length));
    if (features.length > 0) {
        table.row("covered within .1 % (%)", fixed(100 * features.covered, 2), "");
        table.row("covered within .02 % (%)", fixed(100 * features.covered_closely, 2), "");
    }
    if (features.result_length > 0) {
        table.row("false sharp edges (%)", "", fixed(100 * features.false_share, 2));
    }
    if (features.corners > 0)
        table.row("corners, corners kept", features.corners, features.corners_kept);
    if (features.acute_corners > 0) {
        table.row("corners below 30 deg", features.acute_corners, "");
        table.row("smallest angle elsewhere", "", fixed(features.min_angle_elsewhere * degrees, 2));
    }
}

void add_distance(Table& table, const SurfaceDistance& distance) {
    const auto row = [&](const char* name, const OneSidedDistance& d) {
        const OneSidedDistance percent = distance.percent_of_diagonal(d);
        table.row(name, fixed(percent.mean, 5), fixed(percent.rms, 5), fixed(percent.max, 5));
    };
    table.row("distance (% of diagonal)", "mean", "RMS", "max");
    row("original to result", distance.from_original);
    row("result to original", distance.from_result);
    row("two-sided (the larger)", distance.two_sided());
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

std::string to_text(agvd::Engine engine, double certified_error) {
    const std::string text = std::string("distances: ") + agvd::engine_name(engine) + " engine, ";
    if (certified_error == 0) return text + "exact";
    if (!std::isfinite(certified_error)) return text + "error unknown";
    constexpr double steps = 1e4;  // Per percent; rounded up, since it is a bound.
    const double percent = std::ceil(100 * certified_error * steps) / steps;
    return text + "at most " + fixed(percent, 4) + " % above exact";
}

namespace {

std::string describe(const DelaunayCounts& counts, Delaunay delaunay) {
    const double inner_edges = std::max<agvd::Index>(counts.inner_edges, 1);
    const auto percent = [&](agvd::Index count) {
        return fixed(100 * count / inner_edges, 2) + " %";
    };
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
    return text + "with all creases no mesh was found, or only one that self-intersects";
}

// Empty without creases.
std::string describe(const FeatureCounts& features) {
    if (features.curves == 0 && features.dropped_length + features.dropped_seam_length == 0) {
        return "";
    }
    std::string text = "\ncreases and boundary: " + counted(features.curves, "curve") + ", " +
                       counted(features.nodes, "corner") + ", " +
                       counted(features.vertices, "vertex") + "; creases of length " +
                       fixed(features.length, 4) + " kept";
    if (features.dropped_length > 0) {
        text += ", creases of length " + fixed(features.dropped_length, 4) + " dropped (" +
                why_dropped(features) + ")";
    }
    if (features.seam_length + features.dropped_seam_length > 0) {
        text += "; texture seams of length " + fixed(features.seam_length, 4) + " kept";
    }
    if (features.dropped_seam_length > 0) {
        text += ", of length " + fixed(features.dropped_seam_length, 4) +
                " left out as too short or too close to each other";
    }
    if (features.thinned_patches > 0) {
        text += "; " + counted(features.thinned_patches, "patch") +
                " between them thinned to the sites, because cells failed there";
    }
    return text;
}

// Empty if the whole mesh was remeshed.
std::string describe(const KeptPart& kept, std::size_t num_faces) {
    if (kept.faces.empty()) return "";
    return "\nregion: " + counted(num_faces - kept.faces.size(), "face") + " of the result, " +
           counted(kept.faces.size(), "face") + " stayed as they were; " +
           counted(kept.seam_edges, "edge") + " between them";
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

std::string samples_for(agvd::Index count) {
    constexpr agvd::Index most_named = 10'000'000;
    if (count > most_named) return ")";
    return "; about " + std::to_string(count) + " samples would do)";
}

std::string describe(const Verdict& verdict, const FeatureCounts& features) {
    std::string small;
    const auto add = [&](const std::string& text) { small += (small.empty() ? "" : ", ") + text; };
    if (features.dropped_length > 0) {
        add("creases of length " + significant(features.dropped_length) + " (" +
            why_dropped(features) + ")");
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
    const agvd::Vec3& at = verdict.farthest;
    return "smaller than the spacing (" + significant(verdict.spacing) +
           "): " + (small.empty() ? "nothing" : small) +
           "\nlargest distance: " + significant(100 * verdict.largest_distance / verdict.diagonal) +
           " % of the diagonal, from the input's vertex at " + significant(at.x()) + ' ' +
           significant(at.y()) + ' ' + significant(at.z()) +
           "\nsmallest angle: " + fixed(verdict.min_angle * degrees, 1) + " degrees";
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
    std::string text = "edges: " + counted(sizing.num_samples, "sample") + ", mean edge " +
                       significant(sizing.mean_edge);
    if (sizing.largest_target == 0) return text;
    return text + ", targets from " + significant(sizing.least_target) + " to " +
           significant(sizing.largest_target) + ", 90 % of the edges are " +
           fixed(sizing.low_ratio, 2) + " to " + fixed(sizing.high_ratio, 2) + " times theirs";
}

}  // namespace

std::string to_text(const RemeshResult& result, const RunInfo& info) {
    std::string text;
    if (!info.input_path.empty()) text += "input: " + info.input_path + '\n';
    text += to_text(result.cleaned) + '\n';
    text += "surface: " + counted(result.input_topology.face_component.size(), "face") + ", " +
            describe(result.input_topology) + '\n';
    text += to_text(info.options.propagation.engine, result.certified_error) + '\n';
    for (const RelaxLevel& level : result.relaxation) {
        const double rise = level.energy.back() / level.energy.front() - 1;
        text += "relaxation: " + counted(level.num_sites, "site") + ", " +
                counted(level.energy.size() - 1, "step") + ", energy " +
                (rise > 0 ? "raised" : "lowered") + " by " + fixed(100 * std::abs(rise), 1) +
                " %\n";
    }
    text += to_text(result.sizing) + '\n';
    text += "result: " + counted(result.mesh.positions.size(), "vertex") + ", " +
            counted(result.mesh.triangles.size(), "face") +
            (result.junctions.welded_edges > 0 ? "; same topology before the sheets were welded"
                                               : "; same topology");
    text += describe(result.kept, result.mesh.triangles.size());
    if (result.repair_rounds > 0 || result.sites_removed > 0) {
        text += "\ntopology repair: " + counted(result.sites_added, "site") + " added, " +
                counted(result.sites_moved, "site") + " moved, " +
                counted(result.sites_removed, "site") + " removed in " +
                counted(static_cast<std::size_t>(result.repair_rounds), "round");
    }
    for (const auto& [reason, count] : result.added_because) {
        text += "\n  " + counted(count, "site") + " added " + place_text(reason);
    }
    if (result.components_thinned > 0) {
        text += "\n" + counted(result.components_thinned, "component") +
                " thinned to the sites, because cells failed there";
    }
    if (info.options.features != Features::Off) text += describe(result.features);
    text += describe(result.junctions);
    if (result.components_dropped > 0) {
        text += "\n" + counted(result.components_dropped, "component") +
                " dropped, because the area is too small";
    }
    if (result.sites_dropped > 0) {
        text +=
            "\n" + counted(result.sites_dropped, "site") + " dropped, because they have no cell";
    }
    if (result.self_intersections.value_or(0) > 0) {
        text +=
            "\nself-intersecting pairs of faces: " + std::to_string(*result.self_intersections) +
            " in the result, " + std::to_string(result.input_self_intersections) + " in the input";
    }
    if (info.options.delaunay != Delaunay::Off) {
        text += '\n' + describe(result.delaunay, info.options.delaunay);
    }
    text += '\n' + describe(result.verdict, result.features);
    text += "\ntime:";
    for (const auto& [stage, seconds] : result.seconds) {
        text += std::string(" ") + stage_name(stage) + ' ' + fixed(seconds, 2) + " s,";
    }
    text += " total " + fixed(detail::total_seconds(result), 2) + " s; propagation memory " +
            fixed(static_cast<double>(result.propagation_bytes) * 1e-6, 1) + " MB";
    text += describe(info.attributes);
    if (!info.output_path.empty()) text += "\nwritten: " + info.output_path;
    return text;
}

std::string to_text(const Evaluation& evaluation, const EvaluationInfo& info) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    Table table(out);
    if (!info.original_path.empty()) out << "original: " << info.original_path << '\n';
    if (!info.result_path.empty()) out << "result: " << info.result_path << '\n';
    out << "original " << to_text(evaluation.cleaned) << "\n\n";
    add_meshes(table, evaluation.original, evaluation.result);
    table.row("topology kept", "", evaluation.topology_kept ? "yes" : "no");
    if (evaluation.features) add_features(table, *evaluation.features);
    if (!evaluation.distance) {
        table.row("flipped normals", "", not_measured);
        out << "\ndistance: not measured, as this build lacks CGAL";
        return out.str();
    }
    table.row("flipped normals", "", evaluation.distance->flipped_faces);
    out << '\n';
    add_distance(table, *evaluation.distance);
    out << "diagonal of the original: " << evaluation.distance->diagonal
        << " mesh units; distances from all vertices and "
        << counted(evaluation.distance->samples, "sample") << " of each surface";
    return out.str();
}

std::string to_text(const Comparison& comparison, const ComparisonInfo& info) {
    const agvd::DiagramDifference& difference = comparison.difference;
    const agvd::FrechetError& frechet = difference.frechet;
    const auto in_radii = [&](double length) { return length / difference.cell_radius; };
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << std::setprecision(4);
    Table table(out);
    if (!info.a.empty()) out << "A: " << info.a << '\n';
    if (!info.b.empty()) out << "B: " << info.b << '\n';
    out << counted(comparison.sites, "site") << ", mean cell radius " << difference.cell_radius
        << " mesh units\n\n";
    table.row("", "mesh units", "cell radii");
    const auto length = [&](const char* name, double value) {
        table.row(name, value, in_radii(value));
    };
    length("Frechet sum (Eq. 8)", frechet.sum);
    length("largest of one loop", frechet.largest);
    length("Hausdorff of bisectors", difference.hausdorff);
    table.row("delta (Eq. 9)", "", fixed(100 * frechet.delta, 4) + " %");
    table.row("area in other cells", "", fixed(100 * difference.wrong_label_area, 4) + " %");
    out << counted(frechet.matched_loops, "pair") << " of loops, "
        << counted(frechet.unmatched_loops, "loop") << " unmatched; points " << frechet.spacing
        << " mesh units apart\n\n";
    table.row("|dA - dB| / cell radius", "mean", "95 %", "max");
    const auto bisectors = [&](const char* name, const std::optional<agvd::BisectorError>& error) {
        if (error) {
            table.row(name, error->mean, error->p95, error->max);
        } else {
            table.row(name, "not measured");
        }
    };
    bisectors("bisectors of A", comparison.bisectors_a);
    bisectors("bisectors of B", comparison.bisectors_b);
    std::string text = out.str();
    text.pop_back();
    return text;
}

}  // namespace remesh
