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
#include "remesh/curves/walk.h"
#include "remesh/sites/shares.h"
#include "remesh/sites/site_dual.h"
#include "remesh/sites/size_field.h"

namespace remesh {
namespace detail {
namespace {

// Steps between two measurements of the cells.
constexpr int steps_per_sweep = 10;
// With this many vertices for each site, measurements of cells are meaningful.
constexpr std::size_t vertices_per_cell = 2;
// Distance error of a propagation that only has to tell which sites are neighbours.
constexpr double neighbour_error = 1e-2;
// Relaxation would do harm if more than this share of the triangles face against the surface, or of
// the sites are in no triangle.
constexpr double hopeless_share = 0.1;

}  // namespace

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
      steps_planned_(options.steps * num_levels) {
    if (options.progress) progress_ = [this](double) { return options_.progress(fraction()); };
}

void Levels::run(Relaxation& relaxation, const DistanceBounds* labels,
                 std::span<const ChainEdge> chain) {
    const auto num_sites = static_cast<Index>(relaxation.sites().size());
    RelaxLevel& level = levels_.emplace_back();
    level.num_sites = num_sites;
    level.energy.push_back(relaxation.energy().energy);
    if (options_.sizes != nullptr && labels != nullptr) {
        relaxation.set_density(nullptr, lengths_at(options_.sizes, relaxation.sites()));
    }
    if (labels != nullptr) look(relaxation, *labels);
    double last = relaxation.objective();
    for (int step = 1; step <= options_.steps; ++step) {
        relaxation.step();
        level.energy.push_back(relaxation.energy().energy);
        ++steps_done_;
        poll(options_.progress, fraction());
        if (options_.goes_on && !options_.goes_on(level)) break;
        if (step % steps_per_sweep != 0 || step == options_.steps) continue;
        if (last - relaxation.objective() < options_.tolerance * last) break;
        sweep(relaxation, chain);
        last = relaxation.objective();
    }
}

DistanceBounds Levels::label(std::span<const SurfacePoint> sites) const {
    return label_vertices(prepared_, sites, options_.num_threads, progress_);
}

SiteTriangles Levels::triangulate(const DistanceBounds& labels, std::span<const SurfacePoint> sites,
                                  std::span<const ChainEdge> chain, Narrow narrow) const {
    const std::vector<SurfacePoint> on_base = prepared_.base.to_intrinsic(sites);
    std::optional<CellComplex> cells;
    if (!gives_cells(sites.size())) {
        const Propagation propagation = propagate(surface_, prepared_.layout, on_base,
                                                  {.max_error = neighbour_error,
                                                   .num_threads = options_.num_threads,
                                                   .progress = progress_});
        cells = build_cell_complex(surface_, on_base, propagation,
                                   {.num_threads = options_.num_threads, .progress = progress_});
    }
    // Labels of few vertices are rough: these cells stay as they are.
    SiteTriangles result = triangulate_sites(surface_, labels, cells ? &*cells : nullptr, on_base,
                                             ends_of(chain), cells ? Narrow::Leave : narrow);
    std::erase_if(result.triangles, [&](const Triangle& t) {
        return std::max({t[0], t[1], t[2]}) >= sites.size();
    });
    return result;
}

double Levels::fraction() const {
    return static_cast<double>(steps_done_) / std::max(steps_planned_, 1);
}

bool Levels::gives_cells(std::size_t num_sites) const {
    return surface_.num_vertices() >= vertices_per_cell * num_sites;
}

void Levels::look(Relaxation& relaxation, const DistanceBounds& labels) const {
    const auto num_sites = static_cast<Index>(relaxation.sites().size());
    if (!gives_cells(num_sites)) return;
    const CellMeasures cells =
        measure_cells(prepared_, labels, num_sites, options_.num_threads, progress_);
    relaxation.set_density(&cells, lengths_at(options_.sizes, relaxation.sites()));
}

// Labels and measures the surface again.
void Levels::sweep(Relaxation& relaxation, std::span<const ChainEdge> chain) {
    if (!gives_cells(relaxation.sites().size())) return;
    const DistanceBounds labels = label(relaxation.sites());
    if (relaxation.num_flaws() > 0) {
        relaxation.repair(triangulate(labels, relaxation.sites(), chain, Narrow::Leave).triangles);
    }
    look(relaxation, labels);
}

}  // namespace detail

namespace {

using detail::is_hopeless;
using detail::Levels;
using detail::Narrow;
using detail::Relaxation;

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

// Sites that are fixed, or on the boundary already, stay.
void move_inner_to_boundary(const PreparedSurface& surface, const RelaxOptions& options,
                            const Progress& progress, std::vector<SurfacePoint>& sites) {
    const std::vector<SurfacePoint> before = sites;
    detail::move_to_boundary(surface, mean_spacing(surface.input(), sites.size()),
                             options.num_threads, progress, sites);
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const bool is_fixed = !options.is_fixed.empty() && options.is_fixed[i] != 0;
        if (is_fixed || detail::boundary_half_edge(surface.input(), before[i])) {
            sites[i] = before[i];
        }
    }
}

}  // namespace

RelaxResult relax_sites(const PreparedSurface& surface, std::vector<SurfacePoint> sites,
                        const RelaxOptions& options) {
    check_options(options, sites.size());
    check_sites(surface.input(), sites);
    Levels levels(surface, options, 1);
    if (options.steps == 0 || sites.empty()) return {std::move(sites), {}};
    detail::even_out(surface, sites, options.is_fixed, options.num_threads, levels.progress(),
                     options.sizes);
    if (options.boundary == Boundary::Keep) {
        move_inner_to_boundary(surface, options, levels.progress(), sites);
    }
    const DistanceBounds labels = levels.label(sites);
    std::vector<Triangle> triangles =
        levels.triangulate(labels, sites, {}, Narrow::Simplify).triangles;
    Relaxation relaxation(surface.input(), {sites, std::move(triangles)}, options.is_fixed,
                          options.num_threads, levels.progress());
    if (is_hopeless(relaxation)) return {std::move(sites), {}};
    levels.run(relaxation, &labels);
    return {is_hopeless(relaxation) ? sites : relaxation.sites(), levels.levels()};
}

}  // namespace remesh
