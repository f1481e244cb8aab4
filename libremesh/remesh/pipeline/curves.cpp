// Finds creases and junctions, and plans the network of curves at the spacing of the sites. If the
// caller gives sites, these decide which creases the network keeps.
#include "remesh/pipeline/curves.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/clean/carry.h"
#include "remesh/curves/crease_chains.h"
#include "remesh/curves/select_creases.h"
#include "remesh/pipeline/cleaned_input.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/sites/cell_measures.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/sampling.h"
#include "remesh/sites/site_dual.h"

namespace remesh::detail {
namespace {

// Creases are sought at the spacing of at least this many sites, so that small parts keep theirs.
constexpr std::size_t least_scale = 300;
// In spacings. Cells would have to bend around shorter junctions.
constexpr double least_junction = 2;
// In spacings: as if the sites were so far apart, creases of wraps are too close to each other.
// Thin walls are what is wrapped most, and two creases along one force narrow faces between them.
constexpr double scale_of_wraps = 2;
// In spacings: given sites this near to a curve are put onto it if sites are relaxed.
constexpr double on_curve = 0.1;
// In spacings: shorter spokes of poles are no seams of the result, as they are close to each other.
constexpr double spoke_length = 2.5;

// Adds marks to others.
void add_marks(std::span<const std::uint8_t> more, std::vector<std::uint8_t>& marks) {
    for (std::size_t e = 0; e < more.size(); ++e) marks[e] |= more[e];
}

// Sets the creases.
void find_all_creases(const CleanedInput& cleaned, double spacing, const RemeshOptions& options,
                      FoundCurves& found) {
    const Surface& surface = cleaned.surface;
    if (options.features == Features::Off && options.feature_edges.empty() &&
        options.face_labels.empty()) {
        return;
    }
    found.is_crease.assign(surface.num_edges(), 0);
    found.is_given = found.is_crease;
    if (options.features != Features::Off) {
        found.is_crease = cleaned.finer != nullptr ? cleaned.creases
                                                   : find_own_creases(cleaned, spacing, options);
    }
    if (!options.feature_edges.empty()) {
        add_marks(carry_edges(options.feature_edges, cleaned.given,
                              {surface.mesh.view(), cleaned.face_origin}, surface),
                  found.is_given);
    }
    if (!options.face_labels.empty()) {
        add_marks(find_label_borders(options.face_labels, cleaned.face_origin, surface),
                  found.is_given);
    }
    add_marks(found.is_given, found.is_crease);
}

// Vertices all of whose edges are seams, such as the pole of a sphere, where each face has its own
// coordinates: without these edges faces there differ by what one of them is wide. Where each face
// is a chart of its own, neighbours are such vertices, too: an edge at one of them is a spoke.
std::vector<bool> find_poles(const Surface& surface, std::span<const std::uint8_t> is_seam) {
    std::vector<bool> is_pole(surface.num_vertices(), true);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        if (is_seam[e] == 0) is_pole[surface.tail(h)] = is_pole[surface.head(h)] = false;
    }
    return is_pole;
}

// \param found  its creases are known.
void find_seams(const CleanedInput& cleaned, double spacing, const RemeshOptions& options,
                FoundCurves& found) {
    const Surface& surface = cleaned.surface;
    found.is_seam = carry_edges(options.texture_seams, cleaned.given,
                                {surface.mesh.view(), cleaned.face_origin}, surface);
    for (Index e = 0; e < surface.num_edges(); ++e) {  // What cleaning has cut is boundary.
        if (surface.twin[surface.edge_half[e]] == no_index) found.is_seam[e] = 0;
    }
    found.is_wide = found.is_seam;
    const std::vector<bool> is_pole = find_poles(surface, found.is_seam);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        const bool is_at_pole = is_pole[surface.tail(h)] != is_pole[surface.head(h)];
        if (is_at_pole && surface.length[e] < spoke_length * spacing) found.is_wide[e] = 0;
    }
    const Progress progress = cleaned_progress(options);
    Poller poller(progress);
    prune_seams(surface, found.is_crease, spacing, found.is_wide, Ticker(poller));
}

GivenNetwork plan_with_given(const CleanedInput& cleaned, std::vector<std::uint8_t> is_crease,
                             double spacing, const RemeshOptions& options) {
    const Progress progress = cleaned_progress(options);
    const Surface& surface = cleaned.surface;
    const GivenNetworkOptions network{.spacing = spacing,
                                      .tolerance = is_relaxed(options) ? on_curve : site_rounding,
                                      .num_threads = options.num_threads,
                                      .progress = progress};
    std::vector<SurfacePoint> sites = given_sites(cleaned, surface, *options.sites);
    // Relaxation parts sites at one position.
    if (!is_relaxed(options)) sites = take(sites, distinct_points(surface, sites));
    GivenNetwork given = plan_given_network(surface, is_crease, sites, network);
    if (given.has_boundary || options.boundary != Boundary::Keep) return given;
    move_to_boundary(PreparedSurface(surface, spacing, options.num_threads, progress), spacing,
                     options.num_threads, progress, sites);
    return plan_given_network(surface, std::move(is_crease), sites, network);
}

void count_plan(const NetworkPlan& plan, RemeshResult& result) {
    const auto count = [&](const auto& is_counted) {
        return static_cast<Index>(std::ranges::count_if(plan.network.curves, is_counted));
    };
    FeatureCounts& counts = result.features;
    counts.curves = count([](const Curve& curve) { return !curve.is_locked; });
    counts.nodes = static_cast<Index>(plan.network.nodes.size());
    counts.length = plan.length;
    counts.dropped_length = plan.dropped_length;
    counts.samples_for_all = plan.sites_for_all;
    result.junctions.samples_for_all = plan.sites_for_junctions;
    if (plan.network.curves.empty()) return;
    result.junctions.apart_edges -= static_cast<Index>(plan.junctions.edges.size());
    result.junctions.curves = count([](const Curve& curve) { return curve.is_junction(); });
}

// Of the network's edges which are creases, and which are seams: an edge may be both.
void count_seams(const Surface& surface, const NetworkPlan& plan, const FoundCurves& found,
                 FeatureCounts& counts) {
    const std::vector<bool> is_pole = find_poles(surface, found.is_seam);
    std::vector<std::uint8_t> is_kept(surface.num_edges(), 0);
    for (const Curve& curve : plan.network.curves) {
        for (const Index h : curve.sides.front().half_edges) is_kept[surface.edge[h]] = 1;
    }
    counts.length = counts.dropped_length = counts.seam_length = counts.dropped_seam_length = 0;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const double length = surface.length[e];
        if (!found.is_crease.empty() && found.is_crease[e] != 0) {
            (is_kept[e] != 0 ? counts.length : counts.dropped_length) += length;
        }
        const Index h = surface.edge_half[e];
        const bool is_at_pole = is_pole[surface.tail(h)] != is_pole[surface.head(h)];
        if (found.is_seam[e] == 0 || (is_kept[e] == 0 && is_at_pole)) continue;
        (is_kept[e] != 0 ? counts.seam_length : counts.dropped_seam_length) += length;
    }
}

}  // namespace

std::vector<std::uint8_t> find_own_creases(const CleanedInput& cleaned, double spacing,
                                           const RemeshOptions& options) {
    if (options.features == Features::Off) return {};
    const Surface& surface = cleaned.surface;
    const Progress progress = cleaned_progress(options);
    return find_creases(surface, {.angle = options.feature_angle,
                                  .spacing = std::min(spacing, mean_spacing(surface, least_scale)),
                                  .is_automatic = options.features == Features::Auto,
                                  .num_threads = options.num_threads,
                                  .progress = progress});
}

FoundCurves find_curves(const CleanedInput& cleaned, double spacing, const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Clean, result);
    FoundCurves found;
    found.junctions = find_junctions(cleaned.surface, cleaned.vertex_origin);
    found.junctions.in_result = options.junctions;
    result.junctions.edges = static_cast<Index>(found.junctions.edges.size());
    if (options.sites || options.boundary != Boundary::Keep) {
        found.junctions = {};
    } else if (options.junctions == Junctions::Apart) {
        drop_short_junctions(cleaned.surface, least_junction * spacing, found.junctions);
    }
    find_all_creases(cleaned, spacing, options, found);
    return found;
}

bool may_leave_out(const FoundCurves& found, CloseCreases close, const RemeshOptions& options) {
    return has_creases(found.is_crease) && options.features == Features::Auto && !options.sites &&
           close != CloseCreases::Stay;
}

void choose_curves(const CleanedInput& cleaned, double spacing, CloseCreases close,
                   const SizeField* sizes, const StageContext& context, FoundCurves& found) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Clean, result);
    if (may_leave_out(found, close, options)) {
        // Lengths scale with the spacing.
        const double scale = options.wrap ? scale_of_wraps : 1;
        UnitAt length_at;
        if (sizes != nullptr) {
            length_at = [&](const SurfacePoint& point) { return scale * sizes->at(point); };
        }
        found.is_close = found.is_crease;
        found.strips = select_creases(cleaned.surface, scale * spacing, length_at,
                                      close == CloseCreases::GoOrRefine ? options.num_samples : 0,
                                      found.is_given, options.num_threads,
                                      cleaned_progress(options), found.is_crease);
        for (Index e = 0; e < found.is_crease.size(); ++e) found.is_close[e] ^= found.is_crease[e];
    }
    if (!options.texture_seams.empty()) find_seams(cleaned, spacing, options, found);
}

std::unique_ptr<const CurvePlan> plan_curves(const CleanedInput& cleaned, const FoundCurves& found,
                                             const KeptCurves& kept, double spacing,
                                             const SizeField* sizes, const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Clean, result);
    result.junctions.apart_edges = result.junctions.edges;
    result.features = {};
    for (Index e = 0; e < found.is_crease.size(); ++e) {
        if (kept.is_crease[e] != 0) continue;
        const double length = cleaned.surface.length[e];
        if (found.is_crease[e] != 0) result.features.dropped_length += length;
        if (!found.is_close.empty() && found.is_close[e] != 0) {
            result.features.close_length += length;
        }
    }
    const double left_out = result.features.dropped_length;
    JunctionSet junctions = kept.has_junctions ? found.junctions : JunctionSet{};
    const bool has_seams = kept.has_seams && !found.is_seam.empty();
    if (!found.is_seam.empty()) count_seams(cleaned.surface, {}, found, result.features);
    std::vector<std::uint8_t> is_crease = kept.is_crease;
    is_crease.resize(cleaned.surface.num_edges(), 0);
    if (has_seams) add_marks(found.is_wide, is_crease);
    auto plan = std::make_unique<CurvePlan>();
    if (options.sites) {
        GivenNetwork given = plan_with_given(cleaned, std::move(is_crease), spacing, options);
        result.features.uncarried_curves = given.dropped_curves;
        plan->network = std::move(given.plan);
        plan->given = std::move(given);
    } else {
        plan->network = plan_network(cleaned.surface, std::move(is_crease), options.num_samples,
                                     std::move(junctions), options.num_threads,
                                     cleaned_progress(options), sizes, cleaned.locked);
    }
    count_plan(plan->network, result);
    result.features.dropped_length += left_out;
    if (!found.is_seam.empty()) {
        count_seams(cleaned.surface, plan->network, found, result.features);
    }
    return plan;
}

}  // namespace remesh::detail
