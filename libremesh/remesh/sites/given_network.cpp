// Dropping a crease changes the network, so this is repeated until nothing is dropped. A position
// is a length along a curve, mesh units.
#include <algorithm>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface.h"
#include "remesh/sites/network_plan.h"

namespace remesh {
namespace {

constexpr double longest_gap = 4;  // In spacings.

// Where a site lies on the edges of a network.
struct NearestEdge {
    Index edge = no_index;       // no_index: on no edge.
    double share = 0;            // Of the edge, from the tail of its half-edge.
    Index vertex = no_index;     // The nearer end of the edge.
    double vertex_distance = 0;  // From that vertex to the site.
};

NearestEdge find_nearest_edge(const Surface& surface, const std::vector<std::uint8_t>& is_network,
                              const SurfacePoint& site, double tolerance) {
    const auto& p = surface.mesh.positions;
    const Vec3 at = position(surface.mesh.view(), site);
    NearestEdge on_edge;
    double nearest = tolerance;
    const auto look_at = [&](Index e) {
        if (is_network[e] == 0) return;
        const Index tail = surface.tail(surface.edge_half[e]);
        const Index head = surface.head(surface.edge_half[e]);
        const double apart = distance_to_segment(at, p[tail], p[head]);
        if (apart > nearest || (apart == nearest && on_edge.edge != no_index)) return;
        nearest = apart;
        const Vec3 along = p[head] - p[tail];
        const double share = (at - p[tail]).dot(along) / along.squaredNorm();
        const Index end = share < 0.5 ? tail : head;
        on_edge = {e, std::clamp(share, 0.0, 1.0), end, (at - p[end]).norm()};
    };
    for (const Index v : surface.mesh.triangles[site.face.value()]) {
        for_each_outgoing(surface, v, [&](Index h) {
            look_at(surface.edge[h]);
            look_at(surface.edge[Surface::previous(h)]);
        });
    }
    return on_edge;
}

using Stop = std::pair<double, Index>;  // Position on its curve, site.

struct OnCurve {
    Index curve = no_index;
    std::size_t edge = 0;
};

// Finds the sites on the curves of a network and drops creases that they do not carry.
struct Carrier {
    const Surface& surface;
    std::vector<std::uint8_t> is_crease;  // #E
    std::span<const SurfacePoint> sites;
    const double spacing, tolerance;  // Mesh units.
    CurveNetwork network = {};
    std::vector<std::vector<Stop>> stops = {};     // By curve: sites between its ends, ascending.
    std::vector<Index> at_node = {};               // By node: its site, or no_index.
    std::vector<std::uint8_t> is_on_network = {};  // #sites
    std::vector<NearestEdge> nearest = {};         // #sites
    bool has_boundary = true;                      // It is carried.

    // Drops creases until all that are left are carried. \return the number dropped.
    Index drop_uncarried() {
        for (Index num_dropped = 0;;) {
            find();
            const std::vector<Index> fewest = fewest_intervals(network);
            const Index dropped_before = num_dropped;
            has_boundary = true;
            std::vector<bool> is_carried;
            for (Index c = 0; c < network.curves.size(); ++c) {
                is_carried.push_back(carries(c, fewest[c]));
                if (!is_carried[c] && !network.curves[c].is_crease()) has_boundary = false;
            }
            for (Index c = 0; c < network.curves.size(); ++c) {
                const Curve& curve = network.curves[c];
                if (!curve.is_crease() || (is_carried[c] && has_boundary)) continue;
                for (const Index h : curve.sides[0].half_edges) is_crease[surface.edge[h]] = 0;
                ++num_dropped;
            }
            if (num_dropped == dropped_before) return num_dropped;
        }
    }

    // Finds the network and the sites on it.
    void find() {
        network = find_network(surface, is_crease, spacing);
        find_nearest_edges();
        const std::vector<OnCurve> on_curve = curves_of_edges();
        is_on_network.assign(sites.size(), 0);
        stops.assign(network.curves.size(), {});
        take_nodes();
        for (Index s = 0; s < sites.size(); ++s) {
            if (is_on_network[s] != 0 || nearest[s].edge == no_index) continue;
            const auto [c, i] = on_curve[nearest[s].edge];
            const Curve& curve = network.curves[c];
            const double position = along(curve, i, nearest[s]);
            const double from_end = std::min(position, curve.length() - position);
            const bool is_at_node = !curve.is_closed() && from_end < site_rounding * spacing;
            if (!is_at_node) stops[c].emplace_back(position, s);
            // A site at a node is left out, as the node has a site already.
            is_on_network[s] =
                !is_at_node || nearest[s].vertex_distance < site_rounding * spacing ? 1 : 0;
        }
        for (std::vector<Stop>& of_curve : stops) {
            std::sort(of_curve.begin(), of_curve.end());
            const auto is_same = [&](const Stop& a, const Stop& b) {
                return b.first - a.first < site_rounding * spacing;
            };
            of_curve.erase(std::unique(of_curve.begin(), of_curve.end(), is_same), of_curve.end());
        }
    }

    // A site at a vertex lies on several edges: it goes onto the first of the network.
    void find_nearest_edges() {
        std::vector<std::uint8_t> is_network = is_crease;
        for (Index e = 0; e < surface.num_edges(); ++e) {
            if (surface.twin[surface.edge_half[e]] == no_index) is_network[e] = 1;
        }
        nearest.clear();
        for (const SurfacePoint& site : sites) {
            nearest.push_back(find_nearest_edge(surface, is_network, site, tolerance));
        }
    }

    [[nodiscard]] std::vector<OnCurve> curves_of_edges() const {
        std::vector<OnCurve> on_curve(surface.num_edges());
        for (Index c = 0; c < network.curves.size(); ++c) {
            const Curve& curve = network.curves[c];
            for (std::size_t i = 0; i < curve.num_edges(); ++i) {
                on_curve[surface.edge[curve.sides[0].half_edges[i]]] = {c, i};
            }
        }
        return on_curve;
    }

    // Each node takes its nearest site within the tolerance.
    void take_nodes() {
        at_node.assign(network.nodes.size(), no_index);
        for (Index s = 0; s < sites.size(); ++s) {
            const NearestEdge& on_edge = nearest[s];
            if (on_edge.edge == no_index || on_edge.vertex_distance > tolerance) continue;
            const Index node = node_at(network, on_edge.vertex);
            if (node == no_index) continue;
            Index& taken = at_node[node];
            if (taken == no_index || on_edge.vertex_distance < nearest[taken].vertex_distance) {
                taken = s;
            }
        }
        for (const Index s : at_node) {
            if (s != no_index) is_on_network[s] = 1;
        }
    }

    // The position of a site on its curve. At a vertex it is the same for both edges there; at the
    // first vertex of a closed curve it is 0.
    [[nodiscard]] double along(const Curve& curve, std::size_t i,
                               const NearestEdge& on_edge) const {
        const Index before = curve.vertex(surface, i);
        double share = on_edge.share;
        if (surface.tail(surface.edge_half[on_edge.edge]) != before) share = 1 - share;
        if (on_edge.vertex_distance < site_rounding * spacing)
            share = on_edge.vertex == before ? 0 : 1;
        const double result = curve.up_to[i] + share * (curve.up_to[i + 1] - curve.up_to[i]);
        return curve.is_closed() && result == curve.length() ? 0 : result;
    }

    [[nodiscard]] bool carries(Index c, Index fewest) const {
        const Curve& curve = network.curves[c];
        std::vector<double> at;
        for (const Stop& stop : stops[c]) at.push_back(stop.first);
        if (curve.is_closed()) {
            if (at.size() < fewest) return false;
            at.push_back(at.front() + curve.length());
        } else {
            if (at_node[curve.begin] == no_index || at_node[curve.end] == no_index) return false;
            if (at.size() + 1 < fewest) return false;
            at.insert(at.begin(), 0);
            at.push_back(curve.length());
        }
        if (!curve.is_crease()) return true;
        const auto is_gap = [&](double a, double b) { return b - a > longest_gap * spacing; };
        return std::ranges::adjacent_find(at, is_gap) == at.end();
    }
};

}  // namespace

GivenNetwork plan_given_network(const Surface& surface, std::vector<std::uint8_t> is_crease,
                                std::span<const SurfacePoint> sites,
                                const GivenNetworkOptions& options) {
    GivenNetwork result;
    const double length_at_first = length_of(surface, is_crease);
    Carrier carrier{surface, std::move(is_crease), sites, options.spacing,
                    options.tolerance * options.spacing};
    result.dropped_curves = carrier.drop_uncarried();
    NetworkPlan& plan = result.plan;
    plan.length = length_of(surface, carrier.is_crease);
    plan.dropped_length = length_at_first - plan.length;
    result.has_boundary = carrier.has_boundary;
    if (!result.has_boundary) {
        carrier.network = {};
        carrier.at_node.clear();
        carrier.stops.clear();
        carrier.is_on_network.assign(sites.size(), 0);
    }
    std::vector<Index> of_group = carrier.at_node;
    for (const std::vector<Stop>& of_curve : carrier.stops) {
        std::vector<double>& along = plan.along.emplace_back();
        for (const auto& [position, site] : of_curve) {
            along.push_back(position);
            of_group.push_back(site);
        }
    }
    plan.network = std::move(carrier.network);
    plan.cut = cut_surface(surface, carrier.is_crease, options.num_threads, options.progress);
    plan.spacing = options.spacing;
    plan.intervals = intervals_between(plan.network, plan.along);
    result.curves = curve_sites_at(plan.network, plan.cut, plan.along);
    for (const Index group : groups_of_copies(result.curves)) {
        result.number.push_back(of_group[group]);
    }
    for (Index s = 0; s < sites.size(); ++s) {
        if (carrier.is_on_network[s] != 0) continue;
        result.inner.push_back(sites[s]);
        result.number.push_back(s);
    }
    return result;
}

}  // namespace remesh
