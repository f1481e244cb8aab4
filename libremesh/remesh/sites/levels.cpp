// A level takes steps on the triangulation of the sites, and labels the vertices anew after every
// ten. Sampled sites start with a quarter of their number. A start whose triangulation does not
// resemble the surface is sampled at once, or not relaxed.
#include "remesh/sites/levels.h"

#include <algorithm>
#include <memory>
#include <string>

#include "agvd/core/parallel.h"
#include "agvd/core/progress.h"
#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "agvd/propagation/propagate.h"
#include "remesh/curves/glue.h"
#include "remesh/dual/build_dual.h"
#include "remesh/sites/shares.h"
#include "remesh/sites/site_dual.h"
#include "remesh/sites/size_field.h"

namespace remesh {
namespace detail {
namespace {

// Steps between two measurements of the cells.
constexpr int steps_per_sweep = 10;
// With this many vertices for each site, labels tell which sites are neighbours.
constexpr std::size_t vertices_per_site = 8;
// With this many vertices for each site, measurements of cells are meaningful.
constexpr std::size_t vertices_per_cell = 2;
// Flaws of a triangulation, as a share of the sites, above which a propagation pays.
constexpr double most_flaws = 2e-3;
// Relaxation would do harm if more than this share of the triangles face against the surface, or of
// the sites are in no triangle.
constexpr double hopeless_share = 0.1;
// Distance error of a propagation that only has to tell which sites are neighbours.
constexpr double neighbour_error = 1e-2;

}  // namespace

bool gives_neighbours(const Surface& surface, std::size_t num_sites) {
    return surface.num_vertices() >= vertices_per_site * num_sites;
}

bool is_hopeless(const Relaxation& relaxation) {
    const auto& cells = relaxation.energy().cells;
    const auto lonely = static_cast<double>(
        std::count_if(cells.begin(), cells.end(), [](const auto& cell) { return cell.area == 0; }));
    const auto turned = static_cast<double>(relaxation.num_turned());
    return turned > hopeless_share * static_cast<double>(relaxation.triangles().size()) ||
           lonely > hopeless_share * static_cast<double>(cells.size());
}

Levels::Levels(const PreparedSurface& prepared, const RelaxOptions& options, int num_levels)
    : prepared_(prepared),
      surface_(prepared.base.surface()),
      options_(options),
      has_boundary_(std::find(surface_.twin.begin(), surface_.twin.end(), no_index) !=
                    surface_.twin.end()),
      steps_planned_(options.steps * num_levels) {
    if (options.progress) progress_ = [this](double) { return options_.progress(fraction()); };
}

void Levels::run(Relaxation& relaxation, const DistanceBounds* labels,
                 std::span<const Index> corners, std::span<const ChainEdge> chain) {
    const auto num_sites = static_cast<Index>(relaxation.sites().size());
    RelaxLevel& level = result_.levels.emplace_back();
    level.num_sites = num_sites;
    level.energy.push_back(relaxation.energy().energy);
    if (options_.sizes != nullptr && labels != nullptr) {
        relaxation.set_density(nullptr, lengths_at(options_.sizes, relaxation.sites()));
    }
    if (labels != nullptr) look(relaxation, *labels, corners);
    double last = relaxation.objective();
    for (int step = 1; step <= options_.steps; ++step) {
        relaxation.step();
        level.energy.push_back(relaxation.energy().energy);
        ++steps_done_;
        poll(options_.progress, fraction());
        if (options_.goes_on && !options_.goes_on(level)) break;
        if (step % steps_per_sweep != 0 || step == options_.steps) continue;
        if (last - relaxation.objective() < options_.tolerance * last) break;
        sweep(relaxation, corners, chain);
        last = relaxation.objective();
    }
}

DistanceBounds Levels::label(std::span<const SurfacePoint> sites) const {
    return label_vertices(prepared_, sites, options_.num_threads, progress_);
}

std::vector<Triangle> Levels::triangulate(const DistanceBounds& labels,
                                          std::span<const SurfacePoint> sites,
                                          std::span<const ChainEdge> chain) const {
    std::vector<Triangle> triangles;
    if (gives_neighbours(surface_, sites.size())) {
        triangles = label_triangles(surface_, labels);
    } else {
        const std::vector<SurfacePoint> on_base = prepared_.base.to_intrinsic(sites);
        const Propagation propagation = propagate(surface_, prepared_.layout, on_base,
                                                  {.max_error = neighbour_error,
                                                   .num_threads = options_.num_threads,
                                                   .progress = progress_});
        const Diagram diagram =
            build_diagram(surface_, on_base, propagation,
                          {.num_threads = options_.num_threads, .progress = progress_});
        triangles = build_dual(surface_, diagram, progress_);
    }
    if (!chain.empty()) close_rim(ends_of(chain), triangles);
    return triangles;
}

RelaxResult Levels::finish(std::vector<SurfacePoint> sites) {
    result_.sites = std::move(sites);
    return std::move(result_);
}

double Levels::fraction() const {
    return static_cast<double>(steps_done_) / std::max(steps_planned_, 1);
}

bool Levels::gives_cells(Index num_sites) const {
    return surface_.num_vertices() >= vertices_per_cell * num_sites;
}

void Levels::look(Relaxation& relaxation, const DistanceBounds& labels,
                  std::span<const Index> corners) const {
    const auto num_sites = static_cast<Index>(relaxation.sites().size());
    if (!gives_cells(num_sites)) return;
    if (has_boundary_ && options_.boundary == Boundary::Keep) {
        relaxation.move_to_boundary(boundary_points(prepared_.base, labels, num_sites, corners));
    }
    const CellMeasures cells =
        measure_cells(prepared_, labels, num_sites, options_.num_threads, progress_);
    relaxation.set_density(&cells, lengths_at(options_.sizes, relaxation.sites()));
}

// Labels and measures the surface again.
void Levels::sweep(Relaxation& relaxation, std::span<const Index> corners,
                   std::span<const ChainEdge> chain) {
    const auto num_sites = static_cast<Index>(relaxation.sites().size());
    if (!gives_cells(num_sites)) return;
    const DistanceBounds labels = label(relaxation.sites());
    const Index flaws = relaxation.num_flaws();
    const bool is_cheap = gives_neighbours(surface_, num_sites);
    // Not with curves, which hold the triangulation together: it costs more than it gains.
    const bool is_useful =
        chain.empty() && num_repaired_ < result_.levels.size() && flaws > most_flaws * num_sites;
    if (flaws > 0 && (is_cheap || is_useful)) {
        if (!is_cheap) num_repaired_ = result_.levels.size();
        relaxation.repair(triangulate(labels, relaxation.sites(), chain));
    }
    look(relaxation, labels, corners);
}

}  // namespace detail

namespace {

using detail::gives_neighbours;
using detail::is_hopeless;
using detail::Levels;
using detail::Relaxation;

// Least number of coarse sites for each component: with fewer, the middles give no triangulation.
constexpr std::size_t least_coarse_sites = 32;
// Slightly more coarse sites than a quarter, as some pairs may lack a middle.
constexpr double coarse_margin = 1.002;
// A loop of the boundary needs three sites, however short. Where this takes more than this share of
// the coarse sites, middles between them would crowd at small holes.
constexpr double most_crowded = 0.05;
constexpr double least_sites_of_loop = 3;

void check_options(const RelaxOptions& options, std::size_t num_sites) {
    if (options.steps < 0) {
        throw InvalidOption("steps is " + std::to_string(options.steps) + "; use 0 or more");
    }
    if (!(options.tolerance >= 0)) {
        throw InvalidOption("tolerance is " + std::to_string(options.tolerance) +
                            "; use 0 or more");
    }
    check_num_threads(options.num_threads);
    if (!options.is_fixed.empty() && options.is_fixed.size() != num_sites) {
        throw InvalidOption("is_fixed has " + std::to_string(options.is_fixed.size()) +
                            " entries, but there are " + std::to_string(num_sites) +
                            " sites; give one for each, or none");
    }
}

// Sites that loops of the boundary need beyond those that fit onto them at the mean spacing.
double num_crowded(const Surface& surface, Index num_sites) {
    const double spacing = mean_spacing(surface, num_sites);
    double sum = 0;
    for (const std::vector<Index>& loop : boundary_loops(surface)) {
        const double length = detail::sized_length(surface, loop, nullptr);
        sum += std::max(least_sites_of_loop - length / spacing, 0.0);
    }
    return sum;
}

// The number of coarse sites that gives `count` sites together with the middles between them;
// nothing if it is too small.
std::optional<Index> coarse_count(const Surface& surface, Index count, const Progress& progress) {
    Poller poller(progress);
    const Index num_components = label_components(surface.twin, Ticker(poller)).count;
    const double euler = euler_of(surface);
    // The sum is V + E, with E = 3 V - 3 chi; with a boundary E is slightly smaller.
    const double coarse = coarse_margin * (count + 3 * euler) / 4 + 1;
    if (coarse < static_cast<double>(least_coarse_sites * num_components)) return std::nullopt;
    const auto result = static_cast<Index>(coarse);
    if (result > count || !gives_neighbours(surface, result)) return std::nullopt;
    if (num_crowded(surface, result) > most_crowded * coarse) return std::nullopt;
    return result;
}

// Relaxes a level from scratch; null if its triangulation does not resemble the surface.
std::unique_ptr<Relaxation> start(const PreparedSurface& surface, std::vector<SurfacePoint> sites,
                                  const RelaxOptions& options, std::span<const Index> corners,
                                  Levels& levels) {
    const DistanceBounds labels = levels.label(sites);
    std::vector<Triangle> triangles = levels.triangulate(labels, sites);
    auto relaxation = std::make_unique<Relaxation>(
        surface.input(), detail::TriangulatedSites{std::move(sites), std::move(triangles)},
        options.is_fixed, options.num_threads, levels.progress());
    if (is_hopeless(*relaxation)) return nullptr;
    levels.run(*relaxation, &labels, corners);
    if (is_hopeless(*relaxation)) return nullptr;
    return relaxation;
}

}  // namespace

RelaxResult relax_sites(const PreparedSurface& surface, std::vector<SurfacePoint> sites,
                        const RelaxOptions& options) {
    check_options(options, sites.size());
    check_sites(surface.input(), sites);
    Levels levels(surface, options, 1);
    if (options.steps == 0 || sites.empty()) return levels.finish(std::move(sites));
    detail::even_out(surface, sites, options.is_fixed, options.num_threads, levels.progress(),
                     options.sizes);
    const auto relaxation = start(surface, sites, options, options.corners, levels);
    return levels.finish(relaxation ? relaxation->sites() : std::move(sites));
}

RelaxResult sample_relaxed_sites(const PreparedSurface& surface, const SamplingOptions& sampling,
                                 const RelaxOptions& options) {
    check_options(options, 0);
    const Surface& input = surface.input();
    const auto one_after_the_other = [&] {
        return relax_sites(surface, sample_sites(input, sampling), options);
    };
    const std::optional<Index> coarse =
        coarse_count(surface.base.surface(), sampling.num_samples, within(options.progress, 0, 0));
    if (!coarse || options.steps == 0) return one_after_the_other();
    SamplingOptions first = sampling;
    first.num_samples = *coarse;
    Levels levels(surface, options, 2);
    first.progress = levels.progress();
    const auto relaxation = start(surface, sample_sites(input, first), options, {}, levels);
    if (!relaxation) return one_after_the_other();

    const std::vector<SurfacePoint>& sites = relaxation->sites();
    std::optional<detail::TriangulatedSites> fine = detail::subdivide(
        input, sites, relaxation->weights(), detail::label_dual(surface.base, levels.label(sites)),
        sampling.num_samples, lengths_at(options.sizes, sites));
    if (!fine) return one_after_the_other();
    Relaxation last(input, *std::move(fine), {}, options.num_threads, levels.progress());
    levels.run(last, nullptr, options.corners);
    if (is_hopeless(last)) return one_after_the_other();
    return levels.finish(last.sites());
}

}  // namespace remesh
