#include "remesh/relax/relax_sites.h"

#include <algorithm>
#include <optional>
#include <string>

#include "agvd/core/poller.h"
#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "agvd/propagation/site_placement.h"
#include "remesh/dual/build_dual.h"
#include "remesh/relax/even_out.h"
#include "remesh/relax/relaxation.h"
#include "remesh/relax/subdivide.h"
#include "remesh/relax/walk.h"
#include "remesh/sampling/components.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;
using detail::Relaxation;

// Steps from one measuring of the cells to the next.
constexpr int steps_per_sweep = 10;
// Labels tell who neighbours whom where there are so many vertices for each site.
constexpr std::size_t vertices_per_site = 8;
// What is measured of cells means something where there are so many.
constexpr std::size_t vertices_per_cell = 2;
// Flaws of a triangulation, as a share of the sites, that are worth a propagation.
constexpr double most_flaws = 2e-3;
// Where more than this share of the triangles face against the surface, or of the sites are in no
// triangle, relaxation would do harm.
constexpr double hopeless_share = 0.1;
// Distance error of a propagation that only has to tell who neighbours whom.
constexpr double neighbour_error = 1e-2;
// A coarse start needs this many sites of each component: with fewer, middles are no triangulation.
constexpr std::size_t least_coarse_sites = 32;
// More coarse sites than a quarter, as some pairs may lack a middle.
constexpr double coarse_margin = 1.002;

void check_options(const RelaxOptions& options, std::size_t num_sites) {
    if (options.steps < 0) {
        throw agvd::InvalidOption("the number of relaxation steps is negative; use 0 or more");
    }
    if (!(options.tolerance >= 0)) {
        throw agvd::InvalidOption("the tolerance of relaxation is negative; use 0 or more");
    }
    if (options.num_threads < 0) {
        throw agvd::InvalidOption("the number of threads is negative; use 0 for all cores");
    }
    if (!options.is_fixed.empty() && options.is_fixed.size() != num_sites) {
        throw agvd::InvalidOption("is_fixed has " + std::to_string(options.is_fixed.size()) +
                                  " entries for " + std::to_string(num_sites) + " sites");
    }
}

bool gives_neighbours(const Surface& surface, std::size_t num_sites) {
    return surface.num_vertices() >= vertices_per_site * num_sites;
}

// By labels; exactly where faces are too large for those.
std::vector<agvd::Triangle> triangulate(const PreparedSurface& prepared,
                                        const agvd::DistanceBounds& labels,
                                        std::span<const SurfacePoint> sites, int num_threads,
                                        const agvd::Progress& progress) {
    const Surface& surface = prepared.base.surface();
    if (gives_neighbours(surface, sites.size())) return detail::label_triangles(surface, labels);
    const std::vector<SurfacePoint> on_base = prepared.base.to_intrinsic(sites);
    const agvd::Propagation propagation = agvd::propagate(
        surface, prepared.layout, on_base,
        {.max_error = neighbour_error, .num_threads = num_threads, .progress = progress});
    return build_dual(surface,
                      agvd::build_diagram(surface, on_base, propagation,
                                          {.num_threads = num_threads, .progress = progress}),
                      progress);
}

// Triangles as large as the features of the surface: what is even on them is not on the surface.
bool is_hopeless(const Relaxation& relaxation) {
    const auto& cells = relaxation.energy().cells;
    const auto lonely = static_cast<double>(
        std::count_if(cells.begin(), cells.end(), [](const auto& cell) { return cell.area == 0; }));
    const auto turned = static_cast<double>(relaxation.num_turned());
    return turned > hopeless_share * static_cast<double>(relaxation.triangles().size()) ||
           lonely > hopeless_share * static_cast<double>(cells.size());
}

class Levels {
public:
    Levels(const PreparedSurface& prepared, const RelaxOptions& options, int num_levels)
        : prepared_(prepared),
          surface_(prepared.base.surface()),
          options_(options),
          steps_planned_(options.steps * num_levels) {
        if (options.progress) progress_ = [this](double) { return options_.progress(fraction()); };
    }
    Levels(const Levels&) = delete;
    Levels& operator=(const Levels&) = delete;

    // For all that a step is made of: tells how many steps are done.
    [[nodiscard]] const agvd::Progress& progress() const { return progress_; }

    // \param labels   of the sites; null: the relaxation knows its weights.
    // \param corners  boundary vertices that sites go to: of the spacing that these sites have.
    void run(Relaxation& relaxation, const agvd::DistanceBounds* labels,
             std::span<const Index> corners) {
        const auto num_sites = static_cast<Index>(relaxation.sites().size());
        RelaxLevel& level = result_.levels.emplace_back();
        level.num_sites = num_sites;
        level.energy.push_back(relaxation.energy().energy);
        if (labels != nullptr) look(relaxation, *labels, corners);
        double last = relaxation.objective();
        for (int step = 1; step <= options_.steps; ++step) {
            relaxation.step();
            level.energy.push_back(relaxation.energy().energy);
            ++steps_done_;
            agvd::poll(options_.progress, fraction());
            if (step % steps_per_sweep != 0 || step == options_.steps) continue;
            if (last - relaxation.objective() < options_.tolerance * last) break;
            sweep(relaxation, corners);
            last = relaxation.objective();
        }
    }

    [[nodiscard]] agvd::DistanceBounds label(std::span<const SurfacePoint> sites) const {
        return detail::label_vertices(prepared_, sites, options_.num_threads, progress_);
    }

    RelaxResult finish(std::vector<SurfacePoint> sites) {
        result_.sites = std::move(sites);
        return std::move(result_);
    }

private:
    [[nodiscard]] double fraction() const {
        return static_cast<double>(steps_done_) / std::max(steps_planned_, 1);
    }

    [[nodiscard]] bool gives_cells(Index num_sites) const {
        return surface_.num_vertices() >= vertices_per_cell * num_sites;
    }

    void look(Relaxation& relaxation, const agvd::DistanceBounds& labels,
              std::span<const Index> corners) const {
        const auto num_sites = static_cast<Index>(relaxation.sites().size());
        if (!gives_cells(num_sites)) return;
        if (options_.boundary == Boundary::Keep) {
            relaxation.move_to_boundary(
                detail::boundary_places(prepared_.base, labels, num_sites, corners));
        }
        relaxation.set_density(
            detail::measure_cells(prepared_, labels, num_sites, options_.num_threads, progress_));
    }

    // Looks at the surface again.
    void sweep(Relaxation& relaxation, std::span<const Index> corners) {
        const auto num_sites = static_cast<Index>(relaxation.sites().size());
        if (!gives_cells(num_sites)) return;
        const agvd::DistanceBounds labels = label(relaxation.sites());
        const Index flaws = relaxation.num_flaws();
        const bool is_cheap = gives_neighbours(surface_, num_sites);
        const bool is_worth_it =
            num_mended_ < result_.levels.size() && flaws > most_flaws * num_sites;
        if (flaws > 0 && (is_cheap || is_worth_it)) {
            if (!is_cheap) num_mended_ = result_.levels.size();
            relaxation.mend(triangulate(prepared_, labels, relaxation.sites(), options_.num_threads,
                                        progress_));
        }
        look(relaxation, labels, corners);
    }

    const PreparedSurface& prepared_;
    const Surface& surface_;  // Of its base.
    const RelaxOptions& options_;
    agvd::Progress progress_;
    int steps_planned_;
    int steps_done_ = 0;
    std::size_t num_mended_ = 0;  // Levels up to the last one that has paid for a propagation.
    RelaxResult result_;
};

// How many sites to begin with so that they and the middles between them are `count`; nothing if
// these would be too few.
std::optional<Index> coarse_count(const Surface& surface, Index count,
                                  const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    const Index num_components = detail::label_components(surface.twin, agvd::Ticker(poller)).count;
    double euler = static_cast<double>(surface.num_faces()) - surface.num_edges();
    for (const Index h : surface.outgoing) euler += h != agvd::no_index ? 1 : 0;
    // V + E, with E = 3 V - 3 chi; edges on the boundary are a little fewer.
    const double coarse = coarse_margin * (count + 3 * euler) / 4 + 1;
    if (coarse < static_cast<double>(least_coarse_sites * num_components)) return std::nullopt;
    const auto result = static_cast<Index>(coarse);
    if (result > count || !gives_neighbours(surface, result)) return std::nullopt;
    return result;
}

}  // namespace

RelaxResult relax_sites(const PreparedSurface& surface, std::vector<SurfacePoint> sites,
                        const RelaxOptions& options) {
    check_options(options, sites.size());
    agvd::check_sites(surface.input(), sites);
    Levels levels(surface, options, 1);
    if (options.steps == 0 || sites.empty()) return levels.finish(std::move(sites));
    detail::even_out(surface, sites, options.is_fixed, options.num_threads, levels.progress());
    const agvd::DistanceBounds labels = levels.label(sites);
    Relaxation relaxation(
        surface.input(), sites,
        triangulate(surface, labels, sites, options.num_threads, levels.progress()),
        options.is_fixed, {}, options.num_threads, levels.progress());
    if (is_hopeless(relaxation)) return levels.finish(std::move(sites));
    levels.run(relaxation, &labels, options.corners);
    if (is_hopeless(relaxation)) return levels.finish(std::move(sites));
    return levels.finish(relaxation.sites());
}

RelaxResult sample_relaxed_sites(const PreparedSurface& surface, const SamplingOptions& sampling,
                                 const RelaxOptions& options) {
    check_options(options, 0);
    const Surface& input = surface.input();
    const auto one_after_the_other = [&] {
        return relax_sites(surface, sample_sites(input, sampling), options);
    };
    const std::optional<Index> coarse = coarse_count(surface.base.surface(), sampling.num_samples,
                                                     agvd::within(options.progress, 0, 0));
    if (!coarse || options.steps == 0) return one_after_the_other();
    SamplingOptions first = sampling;
    first.num_samples = *coarse;
    Levels levels(surface, options, 2);
    first.progress = levels.progress();
    std::vector<SurfacePoint> sites = sample_sites(input, first);
    agvd::DistanceBounds labels = levels.label(sites);
    Relaxation relaxation(input, std::move(sites),
                          detail::label_triangles(surface.base.surface(), labels), {}, {},
                          options.num_threads, levels.progress());
    if (is_hopeless(relaxation)) return one_after_the_other();
    levels.run(relaxation, &labels, {});
    if (is_hopeless(relaxation)) return one_after_the_other();

    labels = levels.label(relaxation.sites());
    std::optional<detail::TriangulatedSites> fine =
        detail::subdivide(input, relaxation.sites(), relaxation.weights(),
                          detail::label_dual(surface.base, labels), sampling.num_samples);
    if (!fine) return one_after_the_other();
    Relaxation last(input, std::move(fine->sites), std::move(fine->triangles), {},
                    std::move(fine->weights), options.num_threads, levels.progress());
    levels.run(last, nullptr, options.corners);
    if (is_hopeless(last)) return one_after_the_other();
    return levels.finish(last.sites());
}

}  // namespace remesh
