// The spacing is found by bisection. If the curves alone need too many sites, a tenth of the
// creases is dropped at a time.
#include "remesh/sites/network_plan.h"

#include <algorithm>
#include <cmath>

#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface.h"
#include "remesh/curves/curve_sites.h"
#include "remesh/sites/shares.h"

namespace remesh {
namespace {

constexpr int num_halvings = 24;
// Share of the creases that is dropped at a time if sites are too few.
constexpr double drop_at_once = 0.1;

// Finds the least spacing that needs at most a number of sites.
struct SpacingSearch {
    struct Patch {
        double area = 0, boundary_length = 0;
    };

    const Surface& surface;
    const CurveNetwork& network;
    const UnitAt unit_at;
    std::vector<Patch> patches = {};
    bool has_guards = true;

    [[nodiscard]] std::vector<std::vector<double>> positions_at(double spacing) const {
        std::vector<std::vector<double>> along =
            even_positions(surface, network, spacing,
                           curve_intervals(surface, network, spacing, unit_at), unit_at);
        if (has_guards) guard_corners(surface, network, along);
        return along;
    }

    [[nodiscard]] double num_sites_at(double spacing) const {
        auto count = static_cast<double>(
            num_curve_vertices(network, intervals_between(network, positions_at(spacing))));
        for (const Patch& p : patches) {
            count += std::max(detail::inner_sites(p.area, p.boundary_length, spacing), 0.0);
        }
        return count;
    }

    double run(double num_sites) {
        double area = 0, length = 0;
        for (const Patch& p : patches) {
            area += p.area;
            length += p.boundary_length;
        }
        double low = std::sqrt(area / num_sites) / 4, high = length + std::sqrt(area);
        has_guards = num_sites_at(high) <= num_sites;
        for (int i = 0; i < num_halvings; ++i) {
            const double middle = (low + high) / 2;
            (num_sites_at(middle) > num_sites ? low : high) = middle;
        }
        return high;
    }
};

// Cuts the surface along the network of a plan and spreads the sites.
void divide(const Surface& surface, const std::vector<std::uint8_t>& is_crease, Index num_vertices,
            const SizeField* sizes, int num_threads, const Progress& progress, NetworkPlan& plan) {
    plan.cut = cut_surface(surface, edges_to_cut(plan.junctions, is_crease), num_threads, progress);
    SpacingSearch search{surface, plan.network, length_function(sizes)};
    for (const Component& component :
         detail::sized_components(plan.cut.surface(), sizes, progress)) {
        search.patches.push_back({component.area(), detail::sized_boundary_length(
                                                        plan.cut.surface(), component, sizes)});
    }
    plan.spacing = search.run(num_vertices);
    plan.along = search.positions_at(plan.spacing);
    plan.intervals = intervals_between(plan.network, plan.along);
    plan.length = length_of(surface, is_crease);
}

// Unmarks creases on junctions, which are curves already.
void leave_out(const JunctionSet& junctions, std::vector<std::uint8_t>& is_crease) {
    for (const std::vector<Index>& copies : junctions.edges) {
        for (const Index e : copies) is_crease[e] = 0;
    }
}

bool is_free_crease(const Curve& curve) { return curve.is_crease() && !curve.is_locked; }

// Marks locked edges inside the surface as creases.
void mark_locked(const Surface& surface, const LockedElements& locked,
                 std::vector<std::uint8_t>& is_crease) {
    for (Index e = 0; e < locked.is_edge.size(); ++e) {
        if (locked.is_edge[e] != 0 && surface.twin[surface.edge_half[e]] != no_index) {
            is_crease[e] = 1;
        }
    }
}

Index fewest_vertices(const CurveNetwork& network) {
    return static_cast<Index>(num_curve_vertices(network, fewest_intervals(network)));
}

// Drops the shortest creases of a network: this share of their number, rounded up.
void drop_shortest(const Surface& surface, const CurveNetwork& network, double share,
                   std::vector<std::uint8_t>& is_crease) {
    std::vector<std::pair<double, Index>> order;
    for (Index c = 0; c < network.curves.size(); ++c) {
        if (is_free_crease(network.curves[c])) order.emplace_back(network.curves[c].length(), c);
    }
    std::sort(order.begin(), order.end());
    order.resize(static_cast<std::size_t>(std::ceil(share * static_cast<double>(order.size()))));
    for (const auto& [length, c] : order) {
        for (const Index h : network.curves[c].sides[0].half_edges) is_crease[surface.edge[h]] = 0;
    }
}

}  // namespace

Index fewest_network_vertices(const Surface& surface, std::vector<std::uint8_t> is_crease,
                              double spacing, const JunctionSet& junctions,
                              const LockedElements& locked) {
    mark_locked(surface, locked, is_crease);
    leave_out(junctions, is_crease);
    return fewest_vertices(find_network(surface, is_crease, spacing, junctions, locked));
}

double length_of(const Surface& surface, std::span<const std::uint8_t> is_crease) {
    double length = 0;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (is_crease[e] != 0) length += surface.length[e];
    }
    return length;
}

NetworkPlan plan_network(const Surface& surface, std::vector<std::uint8_t> is_crease,
                         Index num_vertices, JunctionSet junctions, int num_threads,
                         const Progress& progress, const SizeField* sizes, LockedElements locked) {
    const double spacing =
        detail::spacing_of(num_vertices, sizes != nullptr ? sizes->area() : surface_area(surface));
    double coarser = 1;  // At this many spacings corners are found.
    const double mean = detail::spacing_of(num_vertices, surface_area(surface));
    const MeshBox box = box_of(surface.mesh.view());
    NetworkPlan plan;
    plan.junctions = std::move(junctions);
    plan.locked = std::move(locked);
    mark_locked(surface, plan.locked, is_crease);
    const auto find = [&] {
        plan.network = find_network(surface, is_crease, coarser * spacing, plan.junctions,
                                    plan.locked, length_function(sizes));
        const Index needed = fewest_vertices(plan.network);
        if (plan.sites_for_all == 0) plan.sites_for_all = needed;
        return needed;
    };
    if (!plan.junctions.empty()) {
        plan.sites_for_junctions =
            fewest_network_vertices(surface, std::vector<std::uint8_t>(surface.num_edges(), 0),
                                    mean, plan.junctions, plan.locked);
        if (plan.sites_for_junctions > num_vertices) plan.junctions = {};
        leave_out(plan.junctions, is_crease);
    }
    const double length_at_first = length_of(surface, is_crease);
    for (;;) {
        const Index needed = find();
        if (needed <= num_vertices) {
            divide(surface, is_crease, num_vertices, sizes, num_threads, progress, plan);
            plan.dropped_length = length_at_first - plan.length;
            return plan;
        }
        if (std::ranges::any_of(plan.network.curves, is_free_crease)) {
            drop_shortest(surface, plan.network, drop_at_once, is_crease);
        } else if (coarser * mean < (box.high - box.low).norm()) {
            coarser *= 2;
        } else {
            break;
        }
    }
    NetworkPlan none;
    none.sites_for_boundary = fewest_vertices(plan.network);
    none.sites_for_all = plan.sites_for_all;
    none.sites_for_junctions = plan.sites_for_junctions;
    return none;
}

}  // namespace remesh
