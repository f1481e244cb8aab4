// Formats the tables of remesh-eval and of agvd compare.
#include <iomanip>
#include <locale>
#include <sstream>

#include "remesh/meshfile/text.h"
#include "report/report.h"
#include "report/report_common.h"

namespace remesh {
namespace {

using detail::counted;
using detail::degrees;
using detail::fixed;
constexpr const char* not_measured = "needs CGAL";

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

void add_sharp_edges(Table& table, const FeatureCoverage& features) {
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
}

void add_corners(Table& table, const FeatureCoverage& features) {
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

std::string to_text(const Evaluation& evaluation, const EvaluationInfo& info) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    Table table(out);
    if (!info.original_path.empty()) out << "original: " << info.original_path << '\n';
    if (!info.result_path.empty()) out << "result: " << info.result_path << '\n';
    out << "original " << to_text(evaluation.cleaned) << "\n\n";
    add_meshes(table, evaluation.original, evaluation.result);
    table.row("topology kept", "", evaluation.topology_kept ? "yes" : "no");
    // The boundary has corners without creases.
    if (evaluation.has_creases) add_sharp_edges(table, *evaluation.features);
    if (evaluation.features &&
        (evaluation.has_creases || evaluation.original.topology.boundary_loops() > 0)) {
        add_corners(table, *evaluation.features);
    }
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
    const DiagramDifference& difference = comparison.difference;
    const FrechetError& frechet = difference.frechet;
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
    const auto bisectors = [&](const char* name, const std::optional<BisectorError>& error) {
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
