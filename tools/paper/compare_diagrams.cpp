// Compares two diagrams by the measure of [meng2023] Sec. 6.2, by the area that lies in different
// cells (at random points), and by the Hausdorff distance of the bisectors (at points one spacing
// apart). Loops of a cell are matched nearest first. Exact distances from the two sites of a
// bisector come from the window engine, which runs on a patch around each site.
//
// Notation: a loop of a cell is a closed polyline; F is the sum of Fréchet distances (Eq. 8), and
// delta = 1 - exp(-F / unit / c^2) (Eq. 9), where the unit is the mean cell radius.
#include "paper/compare_diagrams.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"
#include "agvd/diagram/diagram.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface_points.h"
#include "paper/cell_at.h"
#include "paper/frechet.h"
#include "paper/site_distances.h"

namespace agvd {
namespace {

constexpr Index least_loop_points = 8;

void check(const Surface& surface, const Diagram& a, const Diagram& b,
           const DiagramCompareOptions& options) {
    if (!(options.spacing > 0) || !(options.c > 0) || options.area_samples < 1 ||
        options.max_loop_points < least_loop_points) {
        throw InvalidOption(
            "an option of the comparison is out of range; use a spacing and c above 0, at least 1 "
            "area "
            "sample and at least 8 points for each loop");
    }
    if (a.num_sites != b.num_sites) {
        throw InvalidInput("the diagrams have " + std::to_string(a.num_sites) + " and " +
                           std::to_string(b.num_sites) +
                           " sites; compare diagrams of the same sites");
    }
    for (const Diagram* diagram : {&a, &b}) {
        if (diagram->nearest_site.size() == surface.num_vertices()) continue;
        throw InvalidInput(
            "the diagram has labels for " + std::to_string(diagram->nearest_site.size()) +
            " vertices, but the surface has " + std::to_string(surface.num_vertices()) +
            "; use the surface that the diagram was built on");
    }
}

// Loops of one cell in both diagrams.
class LoopMatcher {
public:
    LoopMatcher(std::span<const std::vector<Vec3>> a, std::span<const std::vector<Vec3>> b,
                double spacing, Index max_points, Ticker ticker)
        : a_(a), b_(b), spacing_(spacing), max_points_(max_points), ticker_(ticker) {}

    void add_to(FrechetError& error) const {
        struct Pair {
            double distance;
            Index a, b;
        };
        std::vector<Pair> pairs;
        for (Index i = 0; i < a_.size(); ++i) {
            for (Index j = 0; j < b_.size(); ++j) {
                pairs.push_back({distance(a_[i], b_[j]), i, j});
            }
        }
        std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
            return std::tie(x.distance, x.a, x.b) < std::tie(y.distance, y.a, y.b);
        });
        std::vector<bool> a_done(a_.size(), false), b_done(b_.size(), false);
        const auto charge = [&](double amount) {
            error.sum += amount;
            error.largest = std::max(error.largest, amount);
        };
        for (const Pair& pair : pairs) {
            if (a_done[pair.a] || b_done[pair.b]) continue;
            a_done[pair.a] = b_done[pair.b] = true;
            charge(pair.distance);
            ++error.matched_loops;
        }
        const auto charge_rest = [&](const auto& loops, const std::vector<bool>& done) {
            for (std::size_t i = 0; i < loops.size(); ++i) {
                if (done[i]) continue;
                charge(diameter(loops[i]));
                ++error.unmatched_loops;
            }
        };
        charge_rest(a_, a_done);
        charge_rest(b_, b_done);
    }

private:
    [[nodiscard]] Index num_points(double length) const {
        const double wanted = std::ceil(length / spacing_);
        return wanted < max_points_ ? std::max(least_loop_points, static_cast<Index>(wanted))
                                    : max_points_;
    }

    [[nodiscard]] double distance(std::span<const Vec3> a, std::span<const Vec3> b) const {
        const Index count = num_points(std::max(closed_length(a), closed_length(b)));
        return closed_frechet_distance(resampled(a, count),
                                       resampled(b, count, nearest_on_loop(b, a[0])), ticker_);
    }

    [[nodiscard]] double diameter(std::span<const Vec3> loop) const {
        const auto points = resampled(loop, num_points(closed_length(loop)));
        double farthest_sq = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            ticker_.tick(1 + i / 8);
            for (std::size_t j = 0; j < i; ++j) {
                farthest_sq = std::max(farthest_sq, (points[i] - points[j]).squaredNorm());
            }
        }
        return std::sqrt(farthest_sq);
    }

    std::span<const std::vector<Vec3>> a_, b_;
    double spacing_;
    Index max_points_;
    mutable Ticker ticker_;
};

FrechetError frechet_error(const Surface& surface, const Diagram& a, const Diagram& b,
                           double cell_radius, const DiagramCompareOptions& options,
                           Poller& poller) {
    const LoopCurves curves_a = loop_curves(surface, a, Ticker(poller));
    const LoopCurves curves_b = loop_curves(surface, b, Ticker(poller));
    const auto loops_of = [](const LoopCurves& curves, Index site) {
        const Index begin = curves.cell_loops[site];
        return std::span(curves.loops).subspan(begin, curves.cell_loops[site + 1] - begin);
    };
    const double spacing = options.spacing * cell_radius;
    std::vector<FrechetError> cells(a.num_sites);
    const auto match = [&](Index, Index s, Index) {
        LoopMatcher(loops_of(curves_a, s), loops_of(curves_b, s), spacing, options.max_loop_points,
                    Ticker(poller))
            .add_to(cells[s]);
    };
    parallel_chunks(a.num_sites, 1, options.num_threads, match, poller);
    FrechetError error{.unit = cell_radius, .spacing = spacing};
    for (const FrechetError& cell : cells) {
        error.sum += cell.sum;
        error.largest = std::max(error.largest, cell.largest);
        error.matched_loops += cell.matched_loops;
        error.unmatched_loops += cell.unmatched_loops;
    }
    error.delta = -std::expm1(-error.sum / error.unit / (options.c * options.c));
    return error;
}

double wrong_label_area(const Surface& surface, const Diagram& a, const Diagram& b,
                        const DiagramCompareOptions& options, Ticker ticker) {
    const CellLocator in_a(surface, a), in_b(surface, b);
    const auto samples = uniform_points(surface, options.area_samples, options.seed);
    const auto wrong = std::count_if(samples.begin(), samples.end(), [&](const SurfacePoint& p) {
        ticker.tick(8);
        return in_a(p) != in_b(p);
    });
    return static_cast<double>(wrong) / static_cast<double>(samples.size());
}

// The bisectors' pieces as triangles without width, which ClosestPointTree takes.
TriangleMesh network(const Surface& surface, const Diagram& diagram) {
    TriangleMesh pieces;
    for (const SurfacePoint& point : diagram.points) {
        pieces.positions.push_back(position(surface.mesh.view(), point));
    }
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        if (!diagram.edges[e].right.is_valid()) continue;
        const Index begin = diagram.edge_points[e];
        const Index end = diagram.edge_points[e + 1];
        for (Index i = begin; i + 1 < end; ++i) pieces.triangles.push_back({i, i + 1, i + 1});
        if (diagram.edges[e].tail == no_index) {
            pieces.triangles.push_back({end - 1, begin, begin});
        }
    }
    return pieces;
}

// Farthest that a piece of `from` lies from `to`; pieces are measured at points one spacing apart.
double directed_hausdorff(const TriangleMesh& from, const TriangleMesh& to, double spacing,
                          Poller& poller) {
    const Progress progress = poller.progress();
    const ClosestPointTree tree(to.view(), progress);
    Ticker ticker(poller);
    double farthest_sq = 0;
    for (const Triangle& piece : from.triangles) {
        const Vec3& a = from.positions[piece[0]];
        const Vec3 along = from.positions[piece[1]] - a;
        const auto steps = static_cast<Index>(std::max(1.0, std::ceil(along.norm() / spacing)));
        for (Index i = 0; i <= steps; ++i) {
            ticker.tick(16);
            const Vec3 point = a + static_cast<double>(i) / steps * along;
            farthest_sq = std::max(farthest_sq, tree.query(point).distance_sq);
        }
    }
    return std::sqrt(farthest_sq);
}

double hausdorff(const Surface& surface, const Diagram& a, const Diagram& b, double spacing,
                 Poller& poller) {
    const TriangleMesh of_a = network(surface, a);
    const TriangleMesh of_b = network(surface, b);
    if (of_a.triangles.empty() && of_b.triangles.empty()) return 0;
    if (of_a.triangles.empty() || of_b.triangles.empty()) return infinity;
    return std::max(directed_hausdorff(of_a, of_b, spacing, poller),
                    directed_hausdorff(of_b, of_a, spacing, poller));
}

}  // namespace

LoopCurves loop_curves(const Surface& surface, const Diagram& diagram, Ticker ticker) {
    const Cells cells = build_cells(diagram, ticker);
    LoopCurves curves{cells.cell_loops, {}};
    for (std::size_t l = 0; l + 1 < cells.loop_edges.size(); ++l) {
        std::vector<Vec3>& loop = curves.loops.emplace_back();
        for (Index i = cells.loop_edges[l]; i < cells.loop_edges[l + 1]; ++i) {
            ticker.tick(2);
            const auto [edge, reversed] = cells.edges[i];
            const Index begin = diagram.edge_points[edge];
            const Index count = diagram.edge_points[edge + 1] - begin;
            // The last point of an open edge is the first of the next one.
            const bool is_closed = diagram.edges[edge].tail == no_index;
            for (Index k = 0; k < count - (is_closed ? 0 : 1); ++k) {
                const Index at = begin + (reversed ? count - 1 - k : k);
                loop.push_back(position(surface.mesh.view(), diagram.points[at]));
            }
        }
    }
    return curves;
}

DiagramDifference compare_diagrams(const Surface& surface, const Diagram& a, const Diagram& b,
                                   const DiagramCompareOptions& options) {
    check(surface, a, b, options);
    Poller poller(options.progress);
    DiagramDifference difference;
    difference.cell_radius = mean_cell_radius(surface, a.num_sites);
    difference.frechet = frechet_error(surface, a, b, difference.cell_radius, options, poller);
    poller.tell(0.5);
    difference.wrong_label_area = wrong_label_area(surface, a, b, options, Ticker(poller));
    difference.hausdorff = hausdorff(surface, a, b, difference.frechet.spacing, poller);
    return difference;
}

std::vector<BisectorError> exact_bisector_errors(const Surface& surface,
                                                 std::span<const SurfacePoint> sites,
                                                 std::span<const Diagram* const> diagrams,
                                                 const BisectorErrorOptions& options) {
    if (options.max_points < 1) throw InvalidOption("max_points is 0; use 1 or more");
    std::vector<std::vector<SiteId>> parts_of(diagrams[0]->num_sites);  // Points, and shapes.
    for (Index i = 0; i < sites.size(); ++i) {
        parts_of[options.points.site_of(i)].push_back(SiteId(i));
    }
    for (std::size_t i = 0; i < options.shapes.size(); ++i) {
        parts_of[options.shapes[i].site].push_back(SiteId(static_cast<Index>(sites.size() + i)));
    }
    // The parts of the left and of the right site of each sample in turn.
    std::vector<SiteDistanceQuery> queries;
    std::vector<std::size_t> ends;      // Of the queries of each side of a sample.
    std::vector<std::size_t> begin{0};  // Of each diagram's sides.
    for (const Diagram* diagram : diagrams) {
        poll(options.progress, 0);
        const auto samples = bisector_samples(surface, *diagram);
        const std::size_t step = (samples.size() + options.max_points - 1) / options.max_points;
        for (std::size_t i = 0; i < samples.size(); i += step) {
            const auto& [point, left, right, distance] = samples[i];
            for (const SiteId site : {left, right}) {
                for (const SiteId p : parts_of[site.value()]) {
                    queries.push_back({p, point, distance});
                }
                ends.push_back(queries.size());
            }
        }
        begin.push_back(ends.size());
    }
    const std::vector<double> exact = site_distances(surface, sites, options.shapes, queries,
                                                     options.num_threads, options.progress);
    const auto least = [&](std::size_t side) {
        double distance = infinity;
        for (std::size_t q = side == 0 ? 0 : ends[side - 1]; q < ends[side]; ++q) {
            const std::vector<double>& start = options.points.start;
            const Index part = queries[q].site.value();
            const double from = part < start.size() ? start[part] : 0;
            distance = std::min(distance, from + exact[q]);
        }
        return distance;
    };
    const double cell_radius = mean_cell_radius(surface, diagrams[0]->num_sites);
    std::vector<BisectorError> result;
    for (std::size_t d = 0; d < diagrams.size(); ++d) {
        std::vector<double> errors;
        for (std::size_t side = begin[d]; side < begin[d + 1]; side += 2) {
            const double left = least(side), right = least(side + 1);
            const bool is_reached = left < infinity && right < infinity;
            errors.push_back(is_reached ? std::abs(left - right) / cell_radius : infinity);
        }
        result.push_back(summarize(std::move(errors)));
    }
    return result;
}

}  // namespace agvd
