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
    Index unreached_labels = 0;  // Where only one side has a site.
};

void ask_bisectors(const Surface& surface, const Diagram& diagram, Questions& questions,
                   Open& open) {
    for (const BisectorSample& sample : bisector_samples(surface, diagram)) {
        open.bisectors.push_back(
            {questions.ask(sample.left, sample.point), questions.ask(sample.right, sample.point)});
    }
}

// Of the nearest relays at the points.
std::vector<SiteId> labels_of(const Surface& surface, const Approximation& approximation,
                              std::span<const SurfacePoint> points) {
    const IntrinsicTriangulation* base = approximation.base;
    const Surface& asked = base ? base->surface() : surface;
    std::vector<SiteId> labels;
    for (const SurfacePoint& point : points) {
        const SurfacePoint there = base ? base->to_intrinsic(point) : point;
        labels.push_back(point_label(asked, approximation.propagation, there).site);
    }
    return labels;
}

void ask_labels(std::span<const SurfacePoint> points, std::span<const SiteId> labels,
                const NearestSites& exact, Questions& questions, Open& open) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (labels[i] == exact.site[i]) continue;
        if (labels[i].is_valid() && exact.site[i].is_valid()) {
            open.doubtful_labels.push_back(
                {questions.ask(labels[i], points[i]), exact.distance[i]});
        } else {
            ++open.unreached_labels;
        }
    }
}

LabelError measure_labels(const Questions& exact, const Open& open, std::size_t num_points) {
    std::size_t num_wrong = open.unreached_labels;
    double largest = num_wrong > 0 ? infinity : 0;
    for (const auto& [ours, nearest] : open.doubtful_labels) {
        if (!(exact[ours] > nearest * (1 + tie))) continue;
        ++num_wrong;
        largest = std::max(largest, exact[ours] - nearest);
    }
    return {static_cast<double>(num_wrong) / static_cast<double>(num_points), largest};
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
        const auto samples = std::span(targets).first(num_samples);
        ask_labels(samples, labels_of(surface, approximations[i], samples), exact, questions,
                   open[i]);
    }
    questions.answer(surface, sites, options.num_threads);

    const double cell_radius = mean_cell_radius(surface, sites.size());
    std::vector<DiagramError> errors(approximations.size());
    for (std::size_t i = 0; i < approximations.size(); ++i) {
        errors[i].bisectors = measure_bisectors(questions, open[i], cell_radius);
        errors[i].wrong_label_area = measure_labels(questions, open[i], num_samples).wrong;
        measure_distances(vertices, std::span(exact.distance).subspan(num_samples),
                          approximations[i].propagation, errors[i]);
    }
    return errors;
}

std::vector<LabelError> compare_labels(const Surface& surface, std::span<const SurfacePoint> sites,
                                       std::span<const SurfacePoint> points,
                                       std::span<const std::vector<SiteId>> labels,
                                       int num_threads) {
    const NearestSites exact = exact_nearest_sites(surface, sites, points, num_threads);
    Questions questions(sites.size());
    std::vector<Open> open(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
        ask_labels(points, labels[i], exact, questions, open[i]);
    }
    questions.answer(surface, sites, num_threads);
    std::vector<LabelError> errors;
    errors.reserve(open.size());
    for (const Open& one : open) errors.push_back(measure_labels(questions, one, points.size()));
    return errors;
}

}  // namespace agvd
