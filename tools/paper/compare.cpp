// Measures diagrams against CGAL's exact distances. One exact search from all sites answers the
// random samples and the vertices. The questions of all approximations to one site are collected,
// so that each site is searched once: the distances at the points of its bisectors, and of the
// samples that an approximation gives to it although another site is nearest.
#include "paper/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "paper/oracle.h"

namespace agvd {
namespace {

// Sites tie where their exact distances differ by less than this share of them.
constexpr double tie = 1e-9;

// Collects questions to the oracle, so that each site is asked once for everybody.
class Questions {
public:
    explicit Questions(std::size_t num_sites) : targets_(num_sites) {}

    struct Ticket {
        Index site;
        Index place;
    };
    Ticket ask(SiteId site, const SurfacePoint& target) {
        std::vector<SurfacePoint>& targets = targets_[site.value()];
        targets.push_back(target);
        return {site.value(), static_cast<Index>(targets.size() - 1)};
    }
    void answer(const Surface& surface, std::span<const SurfacePoint> sites, int num_threads) {
        answers_ = exact_distances(surface, sites, targets_, num_threads);
    }
    [[nodiscard]] double operator[](Ticket ticket) const {
        return answers_[ticket.site][ticket.place];
    }

private:
    std::vector<std::vector<SurfacePoint>> targets_;
    std::vector<std::vector<double>> answers_;
};

// What one approximation waits for.
struct Open {
    struct Bisector {
        Questions::Ticket left, right;
    };
    struct Label {
        Questions::Ticket ours;
        double nearest;
    };
    std::vector<Bisector> bisectors;
    std::vector<Label> doubtful_labels;
    Index wrong_labels = 0;
};

void ask_bisectors(const Surface& surface, const Diagram& diagram, Questions& questions,
                   Open& open) {
    for (const BisectorSample& sample : bisector_samples(surface, diagram)) {
        open.bisectors.push_back(
            {questions.ask(sample.left, sample.point), questions.ask(sample.right, sample.point)});
    }
}

void ask_labels(const Surface& surface, const Approximation& approximation,
                std::span<const SurfacePoint> samples, const NearestSites& exact,
                Questions& questions, Open& open) {
    const IntrinsicTriangulation* base = approximation.base;
    const Surface& asked = base ? base->surface() : surface;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const SurfacePoint point = base ? base->to_intrinsic(samples[i]) : samples[i];
        const SiteId ours = point_label(asked, approximation.propagation, point).site;
        if (ours == exact.site[i]) continue;
        if (ours.is_valid() && exact.site[i].is_valid()) {
            open.doubtful_labels.push_back({questions.ask(ours, samples[i]), exact.distance[i]});
        } else {
            ++open.wrong_labels;
        }
    }
}

BisectorError measure_bisectors(const Questions& exact, const Open& open, double cell_radius) {
    std::vector<double> errors;
    for (const auto& [left, right] : open.bisectors) {
        errors.push_back(std::abs(exact[left] - exact[right]) / cell_radius);
    }
    return summarize(std::move(errors));
}

double relative_excess(double ours, double exact) {
    if (ours == exact) return 0;
    if (std::isinf(ours) || exact == 0) return infinity;
    return std::isinf(exact) ? -infinity : (ours - exact) / exact;
}

void measure_distances(std::span<const Index> vertices, std::span<const double> exact,
                       const Propagation& propagation, DiagramError& error) {
    if (vertices.empty()) return;
    error.min_relative_distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const double excess = relative_excess(propagation.vertex_distance[vertices[i]], exact[i]);
        error.min_relative_distance = std::min(error.min_relative_distance, excess);
        error.mean_relative_distance += excess / static_cast<double>(vertices.size());
    }
}

}  // namespace

std::vector<DiagramError> compare_with_exact(const Surface& surface,
                                             std::span<const SurfacePoint> sites,
                                             std::span<const Approximation> approximations,
                                             const CompareOptions& options) {
    // Samples first, then the vertices, so that one search answers both.
    std::vector<SurfacePoint> targets = uniform_points(surface, options.area_samples, options.seed);
    const std::size_t num_samples = targets.size();
    std::vector<Index> vertices;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        const Index h = surface.outgoing[v];
        if (h == no_index) continue;
        vertices.push_back(v);
        targets.push_back({FaceId(Surface::face(h)), {0, 0, 0}});
        targets.back().barycentric[h % 3] = 1;
    }
    const NearestSites exact = exact_nearest_sites(surface, sites, targets, options.num_threads);

    Questions questions(sites.size());
    std::vector<Open> open(approximations.size());
    for (std::size_t i = 0; i < approximations.size(); ++i) {
        ask_bisectors(surface, approximations[i].diagram, questions, open[i]);
        ask_labels(surface, approximations[i], std::span(targets).first(num_samples), exact,
                   questions, open[i]);
    }
    questions.answer(surface, sites, options.num_threads);

    const double cell_radius = mean_cell_radius(surface, sites.size());
    std::vector<DiagramError> errors(approximations.size());
    for (std::size_t i = 0; i < approximations.size(); ++i) {
        errors[i].bisectors = measure_bisectors(questions, open[i], cell_radius);
        for (const auto& [ours, nearest] : open[i].doubtful_labels) {
            open[i].wrong_labels += questions[ours] > nearest * (1 + tie);
        }
        errors[i].wrong_label_area = open[i].wrong_labels / static_cast<double>(num_samples);
        measure_distances(vertices, std::span(exact.distance).subspan(num_samples),
                          approximations[i].propagation, errors[i]);
    }
    return errors;
}

}  // namespace agvd
