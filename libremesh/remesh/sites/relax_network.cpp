// Sites of curves move along these, inner ones inside patches of the cut surface. A coarse level
// has half the intervals and a quarter of the inner sites. The rim of each patch must be the
// intervals of its curves, or it is triangulated in another way.
#include "remesh/sites/relax_network.h"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <set>

#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/clean/space_order.h"
#include "remesh/curves/glue.h"
#include "remesh/curves/walk.h"
#include "remesh/dual/reduce_vertices.h"
#include "remesh/sites/levels.h"
#include "remesh/sites/sampling.h"
#include "remesh/sites/site_dual.h"

namespace remesh {
namespace {

using detail::Narrow;
using detail::Relaxation;

// Least number of inner sites of a coarse start.
constexpr double least_coarse_inner_sites = 32;
// Least number of coarse sites for each unit that Euler characteristics lie below 0. With fewer,
// they have more than 8 neighbours on average, and their triangles do not resemble the surface.
constexpr double least_sites_for_euler = 3;
// Least distance of inner sites from curves, in spacings.
constexpr double least_distance = 0.4;

// Half of each curve's intervals, but no fewer than a triangulation needs.
std::vector<Index> coarse_intervals(const NetworkPlan& plan) {
    const std::vector<Index> fewest = fewest_intervals(plan.network);
    std::vector<Index> result;
    for (std::size_t c = 0; c < plan.intervals.size(); ++c) {
        const Index half = (plan.intervals[c] + 1) / 2;
        result.push_back(std::min(plan.intervals[c], std::max(half, fewest[c])));
    }
    return result;
}

// Maps the sites of a coarse level to those of the fine one.
struct Refinement {
    const NetworkPlan& plan;
    const CurveSites& coarse;
    const CurveSites& fine;

    // The number of a coarse site in the fine level.
    [[nodiscard]] Index number(Index site) const {
        if (site >= coarse.sites.size()) {
            return site + static_cast<Index>(fine.sites.size() - coarse.sites.size());
        }
        const auto group = static_cast<Index>(
            std::upper_bound(coarse.first_copy.begin(), coarse.first_copy.end(), site) -
            coarse.first_copy.begin() - 1);
        return fine.first_copy[fine_group(group)] + site - coarse.first_copy[group];
    }

    // The fine site in the middle of an interval; no_index if there is none.
    [[nodiscard]] Index middle(const ChainEdge& edge) const {
        const Index begin = fine_index(edge.curve, edge.interval);
        if (fine_index(edge.curve, edge.interval + 1) - begin < 2) return no_index;
        return fine.first_copy[fine_site(edge.curve, begin + 1)] + edge.side;
    }

    // The index of the k-th vertex of the coarse curve among the vertices of the fine one.
    [[nodiscard]] Index fine_index(Index curve, Index k) const {
        const std::vector<Index>& first = coarse.first_of_curve;
        const std::uint64_t intervals = plan.intervals[curve];
        return static_cast<Index>(k * intervals /
                                  (first[curve + 1] - first[curve] + num_before(curve)));
    }
    // Vertices at the start of a curve that are no sites of its own: its first node.
    [[nodiscard]] Index num_before(Index curve) const {
        return plan.network.curves[curve].is_closed() ? 0 : 1;
    }
    // The fine group of such an index.
    [[nodiscard]] Index fine_site(Index curve, Index index) const {
        return fine.first_of_curve[curve] + index - num_before(curve);
    }
    [[nodiscard]] Index fine_group(Index group) const {
        if (group < coarse.num_nodes()) return group;
        const auto curve = static_cast<Index>(
            std::upper_bound(coarse.first_of_curve.begin(), coarse.first_of_curve.end(), group) -
            coarse.first_of_curve.begin() - 1);
        const Index index = group - coarse.first_of_curve[curve] + num_before(curve);
        return fine_site(curve, fine_index(curve, index));
    }
};

// Finds the middles of a coarse level's triangulation for the fine level. On curves they are sites
// of the fine level. Strips narrower than the spacing get no other middles.
struct MiddleFinder {
    using Pair = std::pair<Index, Index>;

    const NetworkPlan& plan;
    std::span<const ChainEdge> chain;
    std::span<const SurfacePoint> sites;
    const SizeField* sizes;
    std::set<Pair> is_chain = {};
    std::map<Pair, detail::Middle> by_pair = {};

    void run(const Refinement& refinement, detail::SiteDual& dual) {
        for (const ChainEdge& edge : chain) is_chain.insert(std::minmax({edge.from, edge.to}));
        for (const Triangle& t : dual.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Pair pair = std::minmax({t[k], t[(k + 1) % 3]});
                if (!by_pair.contains(pair)) by_pair[pair] = middle_of(pair);
            }
        }
        for (const detail::Middle& m : dual.middles) {
            const auto found = by_pair.find({m.low, m.high});
            if (found != by_pair.end() && !is_at_rim(m.point)) found->second = m;
        }
        for (const Triangle& t : dual.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                drop_if_narrow(t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
            }
        }
        for (const ChainEdge& edge : chain) take_site(edge, refinement);
        dual.middles.clear();
        for (const auto& [pair, middle] : by_pair) dual.middles.push_back(middle);
    }

    [[nodiscard]] const Surface& surface() const { return plan.cut.surface(); }
    [[nodiscard]] Vec3 at(Index site) const { return position(surface().mesh.view(), sites[site]); }

    // Whether a point lies at a vertex of the rim: there may be a site of a curve.
    [[nodiscard]] bool is_at_rim(const SurfacePoint& point) const {
        const auto v = vertex_of(surface(), point);
        return v && surface().is_boundary_vertex(*v);
    }

    // The middle of an edge for which labels give none.
    [[nodiscard]] detail::Middle middle_of(const Pair& pair) const {
        const Vec3 way = at(pair.second) - at(pair.first);
        return {pair.first, pair.second, way.norm(),
                detail::walk_straight(surface(), sites[pair.first], way / 2).end};
    }

    // Drops the middle of edge (a, b) if it is too near to a curve on the side of c.
    void drop_if_narrow(Index a, Index b, Index c) {
        const Pair pair = std::minmax({a, b});
        const auto found = by_pair.find(pair);
        if (found == by_pair.end() || is_chain.contains(pair)) return;
        const Vec3 middle = position(surface().mesh.view(), found->second.point);
        for (const Index end : {a, b}) {
            if (!is_chain.contains(std::minmax({end, c}))) continue;
            const double apart = distance_to_segment(middle, at(end), at(c));
            const double unit = sizes != nullptr ? sizes->at(found->second.point) : 1;
            if (apart >= least_distance * plan.spacing * unit) continue;
            by_pair.erase(found);
            return;
        }
    }

    // Makes the fine site in the middle of an interval its middle. An interval without one is not
    // divided.
    void take_site(const ChainEdge& edge, const Refinement& refinement) {
        const auto found = by_pair.find(std::minmax({edge.from, edge.to}));
        if (found == by_pair.end()) return;
        const Index site = refinement.middle(edge);
        if (site == no_index) {
            by_pair.erase(found);
        } else {
            found->second.site = site;
        }
    }
};

// The plan with locked edges divided as other curves are, where they are longer than the spacing;
// none if no edge is. The energy of relaxation is that of triangles. Those at a rim edge of many
// spacings reach far beyond the cells there, and sites would move onto the edge.
std::optional<NetworkPlan> divide_locked(const NetworkPlan& plan, const SizeField* sizes) {
    const Surface& surface = plan.cut.surface();
    const UnitAt unit_at = length_function(sizes);
    CurveNetwork network = plan.network;
    for (Curve& curve : network.curves) curve.is_locked = false;
    const std::vector<Index> fewest = fewest_intervals(network);
    const std::vector<Index> intervals = curve_intervals(surface, network, plan.spacing, unit_at);
    const auto along = even_positions(surface, network, plan.spacing, intervals, unit_at);
    std::optional<NetworkPlan> divided;
    for (std::size_t c = 0; c < intervals.size(); ++c) {
        if (!plan.network.curves[c].is_locked || intervals[c] == fewest[c]) continue;
        if (!divided) divided = plan;
        divided->network.curves[c].is_locked = false;
        divided->intervals[c] = intervals[c];
        divided->along[c] = along[c];
    }
    return divided;
}

// Puts the sites that divide locked edges apart.
NetworkSites undivide_locked(const NetworkPlan& plan, const NetworkPlan& divided,
                             const NetworkSites& made) {
    NetworkSites result;
    result.levels = made.levels;
    result.narrow_points = made.narrow_points;
    const CurveSites& curves = made.curves;
    std::vector<std::vector<double>> along(plan.network.curves.size());
    std::vector<std::uint8_t> divides(made.sites.size(), 0);
    for (std::size_t c = 0; c < along.size(); ++c) {
        const Index first = curves.first_of_curve[c], last = curves.first_of_curve[c + 1];
        if (plan.network.curves[c].is_locked) {
            std::fill(divides.begin() + curves.first_copy[first],
                      divides.begin() + curves.first_copy[last], 1);
        } else {
            along[c].assign(curves.along.begin() + first, curves.along.begin() + last);
        }
    }
    result.curves = curve_sites_at(plan.network, plan.cut, along);
    std::vector<Index> order;
    for (const int value : {0, 1}) {
        for (Index i = 0; i < made.sites.size(); ++i) {
            if (divides[i] != value) continue;
            order.push_back(i);
            (value == 0 ? result.sites : result.dividing).push_back(made.sites[i]);
        }
    }
    const std::vector<Index> place = places_in(order);
    for (const ChainEdge& edge : chain_edges(divided.network, divided.cut, curves)) {
        result.divided_chain.emplace_back(place[edge.from], place[edge.to]);
    }
    return result;
}

class NetworkSampler {
public:
    NetworkSampler(const PreparedSurface& surface, const NetworkPlan& plan, CurveSites fine,
                   const RelaxOptions& options, int num_levels)
        : surface_(surface),
          plan_(plan),
          options_(options),
          levels_(surface, options_, num_levels),
          fine_(std::move(fine)) {}

    NetworkSites run_given(std::span<const SurfacePoint> inner) {
        std::vector<SurfacePoint> sites = fine_.sites;
        sites.insert(sites.end(), inner.begin(), inner.end());
        if (options_.steps == 0) return {fine_, std::move(sites), {}, {}};
        return finish(*start(fine_, std::move(sites)));
    }

    NetworkSites run(const SamplingOptions& sampling, Index num_inner) {
        num_inner_ = num_inner;
        sampling_ = sampling;
        is_even_ = sampling.init == Init::BlueNoise;
        if (options_.steps == 0) return {fine_, sample(fine_, num_inner_, plan_.spacing), {}, {}};
        std::unique_ptr<Relaxation> last = start_coarse();
        const std::vector<ChainEdge> chain = chain_edges(plan_.network, plan_.cut, fine_);
        if (last) {
            levels_.run(*last, nullptr, chain);
        } else {
            last = start(fine_, sample(fine_, num_inner_, plan_.spacing));
            const std::vector<SurfacePoint>& sites = last->sites();
            take_narrow(
                fine_, sites,
                levels_.triangulate(levels_.label(sites), sites, chain, Narrow::Leave).narrow);
        }
        return finish(*last);
    }

private:
    // Keeps the places of inner sites.
    void take_narrow(const CurveSites& curves, const std::vector<SurfacePoint>& sites,
                     std::span<const Index> narrow) {
        narrow_points_.clear();
        for (const Index i : narrow) {
            if (i >= curves.sites.size()) narrow_points_.push_back(sites[i]);
        }
    }

    [[nodiscard]] NetworkSites finish(const Relaxation& last) {
        return {last.curves()->sites(), last.sites(), levels_.levels(), std::move(narrow_points_)};
    }

    std::vector<SurfacePoint> sample(const CurveSites& curves, Index num_inner, double spacing) {
        std::vector<SurfacePoint> sites = curves.sites;
        const auto inner =
            sample_inner_sites(plan_.cut.surface(), curves.sites, num_inner, spacing, sampling_);
        for (const Index i : order_of(inner)) sites.push_back(inner[i]);
        return sites;
    }

    // Sorts the inner sites, which follow those of curves, in space, and the triangles by their
    // sites.
    void sort_in_space(std::size_t num_copies, detail::TriangulatedSites& level) const {
        std::vector<Index> order(num_copies);
        std::iota(order.begin(), order.end(), Index{0});
        for (const Index i : order_of(std::span(level.sites).subspan(num_copies))) {
            order.push_back(static_cast<Index>(num_copies) + i);
        }
        level.sites = take(level.sites, order);
        level.weights = take(level.weights, order);
        level.triangles = rename_vertices(level.triangles, places_in(order));
        std::ranges::sort(level.triangles, {}, [](const Triangle& t) {
            return std::pair(std::min({t[0], t[1], t[2]}), t);
        });
    }
    // In this order a step finds what it reads of neighbours in the cache.
    [[nodiscard]] std::vector<Index> order_of(std::span<const SurfacePoint> sites) const {
        std::vector<Vec3> positions;
        positions.reserve(sites.size());
        for (const SurfacePoint& site : sites) {
            positions.push_back(position(plan_.cut.surface().mesh.view(), site));
        }
        return detail::order_in_space(positions);
    }

    std::unique_ptr<Relaxation> make_relaxation(detail::TriangulatedSites sites,
                                                const CurveSites& curves) {
        auto relaxation = std::make_unique<Relaxation>(surface_.input(), std::move(sites),
                                                       std::vector<std::uint8_t>{},
                                                       options_.num_threads, levels_.progress());
        relaxation->hold(plan_.network, curves);
        return relaxation;
    }

    // Relaxes a level from scratch.
    std::unique_ptr<Relaxation> start(const CurveSites& curves, std::vector<SurfacePoint> sites) {
        const std::vector<ChainEdge> chain = chain_edges(plan_.network, plan_.cut, curves);
        if (!is_even_) {
            std::vector<std::uint8_t> is_fixed(sites.size(), 0);
            std::fill_n(is_fixed.begin(), curves.sites.size(), 1);
            detail::even_out(surface_, sites, is_fixed, options_.num_threads, levels_.progress(),
                             options_.sizes);
        }
        const DistanceBounds labels = levels_.label(sites);
        std::vector<Triangle> triangles =
            levels_.triangulate(labels, sites, chain, Narrow::Simplify).triangles;
        auto relaxation = make_relaxation({std::move(sites), std::move(triangles)}, curves);
        levels_.run(*relaxation, &labels, chain);
        return relaxation;
    }

    // Relaxes a coarse level and divides it; null if it would have too few sites.
    std::unique_ptr<Relaxation> start_coarse() {
        const std::vector<Index> intervals = coarse_intervals(plan_);
        const CurveSites coarse =
            curve_sites_at(plan_.network, plan_.cut,
                           even_positions(plan_.cut.surface(), plan_.network, plan_.spacing,
                                          intervals, length_function(options_.sizes)));
        double euler = 0, handles = 0;
        for (const Component& component : find_components(plan_.cut.surface())) {
            euler += component.euler;
            handles += std::max(-component.euler, 0);
        }
        const double wanted =
            (num_inner_ - static_cast<double>(coarse.sites.size()) + 3 * euler) / 4 + 1;
        if (wanted < least_coarse_inner_sites) return nullptr;
        const auto num_inner = static_cast<Index>(wanted);
        const std::size_t num_sites = coarse.sites.size() + num_inner;
        if (static_cast<double>(num_sites) < least_sites_for_euler * handles) return nullptr;
        const auto first = start(coarse, sample(coarse, num_inner, 2 * plan_.spacing));
        return divide(*first, first->curves()->sites());
    }

    std::unique_ptr<Relaxation> divide(const Relaxation& first, const CurveSites& coarse) {
        const std::vector<ChainEdge> chain = chain_edges(plan_.network, plan_.cut, coarse);
        const Refinement refinement{plan_, coarse, fine_};
        const DistanceBounds labels = levels_.label(first.sites());
        detail::SiteTriangles by_labels =
            levels_.triangulate(labels, first.sites(), chain, Narrow::Simplify);
        take_narrow(coarse, first.sites(), by_labels.narrow);
        detail::SiteDual dual{std::move(by_labels.triangles),
                              detail::label_middles(surface_.base, labels)};
        MiddleFinder{plan_, chain, first.sites(), options_.sizes}.run(refinement, dual);
        // The sites in the order of the fine level. New curve sites have no triangle yet.
        std::vector<SurfacePoint> sites = fine_.sites;
        std::vector<double> weights(fine_.sites.size(), 1);
        for (Index i = 0; i < first.sites().size(); ++i) {
            if (i < coarse.sites.size()) {
                weights[refinement.number(i)] = first.weights()[i];
            } else {
                sites.push_back(first.sites()[i]);
                weights.push_back(first.weights()[i]);
            }
        }
        for (Triangle& t : dual.triangles) {
            for (Index& i : t) i = refinement.number(i);
        }
        for (detail::Middle& m : dual.middles) {
            const std::pair<Index, Index> pair =
                std::minmax({refinement.number(m.low), refinement.number(m.high)});
            m.low = pair.first;
            m.high = pair.second;
            if (m.site != no_index) weights[m.site] = (weights[m.low] + weights[m.high]) / 2;
        }
        std::ranges::sort(dual.middles, {},
                          [](const detail::Middle& m) { return std::pair(m.low, m.high); });
        const auto count = static_cast<Index>(fine_.sites.size()) + num_inner_;
        std::optional<detail::TriangulatedSites> divided = detail::subdivide(
            plan_.cut.surface(), sites, weights, dual, count, lengths_at(options_.sizes, sites));
        if (!divided) return nullptr;
        sort_in_space(fine_.sites.size(), *divided);
        return make_relaxation(*std::move(divided), fine_);
    }

    const PreparedSurface& surface_;
    const NetworkPlan& plan_;
    SamplingOptions sampling_;
    const RelaxOptions& options_;
    detail::Levels levels_;
    const CurveSites fine_;
    Index num_inner_ = 0;
    bool is_even_ = false;  // The sites are spread evenly before relaxation.
    std::vector<SurfacePoint> narrow_points_;
};

}  // namespace

NetworkSites sample_network_sites(const PreparedSurface& surface, const NetworkPlan& plan,
                                  const SamplingOptions& sampling, const RelaxOptions& options) {
    CurveSites curves = curve_sites_at(plan.network, plan.cut, plan.along);
    const Index num_inner = sampling.num_samples - num_result_vertices(plan.network, curves);
    if (options.steps > 0) {
        if (const auto divided = divide_locked(plan, options.sizes)) {
            curves = curve_sites_at(divided->network, divided->cut, divided->along);
            NetworkSampler sampler(surface, *divided, std::move(curves), options, 2);
            return undivide_locked(plan, *divided, sampler.run(sampling, num_inner));
        }
    }
    return NetworkSampler(surface, plan, std::move(curves), options, 2).run(sampling, num_inner);
}

NetworkSites relax_network_sites(const PreparedSurface& surface, const NetworkPlan& plan,
                                 CurveSites curves, std::span<const SurfacePoint> inner,
                                 const RelaxOptions& options) {
    return NetworkSampler(surface, plan, std::move(curves), options, 1).run_given(inner);
}

}  // namespace remesh
