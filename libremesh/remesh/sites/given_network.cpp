// Finds the network, puts each site near one of its edges onto that edge, and tests for each curve
// whether its sites carry it. Dropping a crease changes the network, so this is repeated until
// nothing is dropped. A place is a length along a curve, in mesh units.
#include "remesh/sites/given_network.h"

#include <algorithm>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"

namespace remesh {
namespace {

constexpr double longest_gap = 4;  // In spacings.

// The place of a site on the edges of a network.
struct EdgePlace {
    Index edge = no_index;       // no_index: on no edge.
    double share = 0;            // Of the edge, from the tail of its half-edge.
    Index vertex = no_index;     // The nearer end of the edge.
    double vertex_distance = 0;  // From that vertex to the site.
};

EdgePlace find_edge_place(const Surface& surface, const std::vector<std::uint8_t>& is_network,
                          const SurfacePoint& site, double tolerance) {
    const auto& p = surface.mesh.positions;
    const Vec3 at = position(surface.mesh.view(), site);
    EdgePlace place;
    double nearest = tolerance;
    const auto look_at = [&](Index e) {
        if (is_network[e] == 0) return;
        const Index tail = surface.tail(surface.edge_half[e]);
        const Index head = surface.head(surface.edge_half[e]);
        const double apart = distance_to_segment(at, p[tail], p[head]);
        if (apart > nearest || (apart == nearest && place.edge != no_index)) return;
        nearest = apart;
        const Vec3 along = p[head] - p[tail];
        const double share = (at - p[tail]).dot(along) / along.squaredNorm();
        const Index end = share < 0.5 ? tail : head;
        place = {e, std::clamp(share, 0.0, 1.0), end, (at - p[end]).norm()};
    };
    for (const Index v : surface.mesh.triangles[site.face.value()]) {
        for_each_outgoing(surface, v, [&](Index h) {
            look_at(surface.edge[h]);
            look_at(surface.edge[Surface::previous(h)]);
        });
    }
    return place;
}

// Finds the sites on the curves of a network and drops creases that they do not carry.
class Carrier {
public:
    Carrier(const Surface& surface, std::vector<std::uint8_t> is_crease,
            std::span<const SurfacePoint> sites, const GivenNetworkOptions& options)
        : surface_(surface),
          is_crease_(std::move(is_crease)),
          sites_(sites),
          spacing_(options.spacing),
          tolerance_(options.tolerance * options.spacing) {}

    // Drops creases until all that are left are carried. \return the number dropped.
    Index drop_uncarried() {
        for (Index num_dropped = 0;;) {
            find();
            const std::vector<Index> fewest = fewest_intervals(network_);
            const Index dropped_before = num_dropped;
            bool is_boundary_carried = true;
            std::vector<bool> is_carried;
            for (Index c = 0; c < network_.curves.size(); ++c) {
                is_carried.push_back(carries(c, fewest[c]));
                if (!is_carried[c] && !network_.curves[c].is_crease()) is_boundary_carried = false;
            }
            for (Index c = 0; c < network_.curves.size(); ++c) {
                const Curve& curve = network_.curves[c];
                if (!curve.is_crease() || (is_carried[c] && is_boundary_carried)) continue;
                for (const Index h : curve.sides[0].half_edges) is_crease_[surface_.edge[h]] = 0;
                ++num_dropped;
            }
            if (num_dropped == dropped_before) return num_dropped;
        }
    }

    void drop_share(double share) { drop_shortest(surface_, network_, share, is_crease_); }

    [[nodiscard]] const CurveNetwork& network() const { return network_; }
    [[nodiscard]] const std::vector<std::uint8_t>& is_crease() const { return is_crease_; }
    [[nodiscard]] bool has_creases() const {
        return std::any_of(is_crease_.begin(), is_crease_.end(), [](auto c) { return c != 0; });
    }
    [[nodiscard]] std::vector<std::vector<double>> along() const {
        std::vector<std::vector<double>> result;
        for (const std::vector<Stop>& stops : stops_) {
            std::vector<double>& places = result.emplace_back();
            for (const Stop& stop : stops) places.push_back(stop.first);
        }
        return result;
    }

    // The sites at nodes, then those of each curve.
    [[nodiscard]] std::vector<Index> network_sites() const {
        std::vector<Index> result = at_node_;
        for (const std::vector<Stop>& stops : stops_) {
            for (const Stop& stop : stops) result.push_back(stop.second);
        }
        return result;
    }
    [[nodiscard]] std::vector<Index> inner_sites() const {
        std::vector<Index> inner;
        for (Index s = 0; s < sites_.size(); ++s) {
            if (is_on_network_[s] == 0) inner.push_back(s);
        }
        return inner;
    }

private:
    using Stop = std::pair<double, Index>;  // Place on its curve, site.
    struct OnCurve {
        Index curve = no_index;
        std::size_t edge = 0;
    };

    // Finds the network and the sites on it.
    void find() {
        network_ = find_network(surface_, is_crease_, spacing_);
        find_places();
        const std::vector<OnCurve> on_curve = curves_of_edges();
        is_on_network_.assign(sites_.size(), 0);
        stops_.assign(network_.curves.size(), {});
        take_nodes();
        for (Index s = 0; s < sites_.size(); ++s) {
            if (is_on_network_[s] != 0 || places_[s].edge == no_index) continue;
            const auto [c, i] = on_curve[places_[s].edge];
            const Curve& curve = network_.curves[c];
            const double place = along(curve, i, places_[s]);
            const double from_end = std::min(place, curve.length() - place);
            const bool is_at_node = !curve.is_closed() && from_end < site_rounding * spacing_;
            if (!is_at_node) stops_[c].emplace_back(place, s);
            // A site at the place of a node is left out, as the node has a site already.
            is_on_network_[s] =
                !is_at_node || places_[s].vertex_distance < site_rounding * spacing_ ? 1 : 0;
        }
        for (std::vector<Stop>& stops : stops_) {
            std::sort(stops.begin(), stops.end());
            const auto is_same = [&](const Stop& a, const Stop& b) {
                return b.first - a.first < site_rounding * spacing_;
            };
            stops.erase(std::unique(stops.begin(), stops.end(), is_same), stops.end());
        }
    }

    // Repeated for each network: a site at a vertex lies on several edges, and is put onto the
    // first of these that belongs to the network.
    void find_places() {
        std::vector<std::uint8_t> is_network = is_crease_;
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            if (surface_.twin[surface_.edge_half[e]] == no_index) is_network[e] = 1;
        }
        places_.clear();
        for (const SurfacePoint& site : sites_) {
            places_.push_back(find_edge_place(surface_, is_network, site, tolerance_));
        }
    }

    [[nodiscard]] std::vector<OnCurve> curves_of_edges() const {
        std::vector<OnCurve> on_curve(surface_.num_edges());
        for (Index c = 0; c < network_.curves.size(); ++c) {
            const Curve& curve = network_.curves[c];
            for (std::size_t i = 0; i < curve.num_edges(); ++i) {
                on_curve[surface_.edge[curve.sides[0].half_edges[i]]] = {c, i};
            }
        }
        return on_curve;
    }

    // Each node takes its nearest site within the tolerance.
    void take_nodes() {
        at_node_.assign(network_.nodes.size(), no_index);
        for (Index s = 0; s < sites_.size(); ++s) {
            const EdgePlace& place = places_[s];
            if (place.edge == no_index || place.vertex_distance > tolerance_) continue;
            const auto node =
                std::lower_bound(network_.nodes.begin(), network_.nodes.end(), place.vertex);
            if (node == network_.nodes.end() || *node != place.vertex) continue;
            Index& taken = at_node_[static_cast<std::size_t>(node - network_.nodes.begin())];
            if (taken == no_index || place.vertex_distance < places_[taken].vertex_distance) {
                taken = s;
            }
        }
        for (const Index s : at_node_) {
            if (s != no_index) is_on_network_[s] = 1;
        }
    }

    // The place of a site on its curve. At a vertex it is the same for both edges there; at the
    // first vertex of a closed curve it is 0.
    [[nodiscard]] double along(const Curve& curve, std::size_t i, const EdgePlace& place) const {
        const Index before = curve.vertex(surface_, i);
        double share = place.share;
        if (surface_.tail(surface_.edge_half[place.edge]) != before) share = 1 - share;
        if (place.vertex_distance < site_rounding * spacing_)
            share = place.vertex == before ? 0 : 1;
        const double result = curve.up_to[i] + share * (curve.up_to[i + 1] - curve.up_to[i]);
        return curve.is_closed() && result == curve.length() ? 0 : result;
    }

    [[nodiscard]] bool carries(Index c, Index fewest) const {
        const Curve& curve = network_.curves[c];
        std::vector<double> stops;
        for (const Stop& stop : stops_[c]) stops.push_back(stop.first);
        if (curve.is_closed()) {
            if (stops.size() < fewest) return false;
            stops.push_back(stops.front() + curve.length());
        } else {
            if (at_node_[curve.begin] == no_index || at_node_[curve.end] == no_index) return false;
            if (stops.size() + 1 < fewest) return false;
            stops.insert(stops.begin(), 0);
            stops.push_back(curve.length());
        }
        for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
            if (stops[i + 1] - stops[i] > longest_gap * spacing_) return false;
        }
        return true;
    }

    const Surface& surface_;
    std::vector<std::uint8_t> is_crease_;  // #E
    std::span<const SurfacePoint> sites_;
    const double spacing_, tolerance_;
    std::vector<EdgePlace> places_;  // #sites
    CurveNetwork network_;
    std::vector<std::vector<Stop>> stops_;     // By curve: the sites between its ends, ascending.
    std::vector<Index> at_node_;               // By node: its site, or no_index.
    std::vector<std::uint8_t> is_on_network_;  // #sites
};

}  // namespace

GivenNetwork plan_given_network(const Surface& surface, std::vector<std::uint8_t> is_crease,
                                std::span<const SurfacePoint> sites,
                                const GivenNetworkOptions& options) {
    GivenNetwork result;
    const double length_at_first = length_of(surface, is_crease);
    Carrier carrier(surface, std::move(is_crease), sites, options);
    result.dropped_curves = carrier.drop_uncarried();
    if (options.drop_share > 0) {
        carrier.drop_share(options.drop_share);
        (void)carrier.drop_uncarried();
    }
    result.plan.length = length_of(surface, carrier.is_crease());
    result.plan.dropped_length = length_at_first - result.plan.length;
    if (!carrier.has_creases()) return result;
    NetworkPlan& plan = result.plan;
    plan.network = carrier.network();
    plan.cut = cut_surface(surface, carrier.is_crease(), options.num_threads, options.progress);
    plan.spacing = options.spacing;
    plan.along = carrier.along();
    plan.intervals = intervals_between(plan.network, plan.along);
    result.curves = curve_sites_at(plan.network, plan.cut, plan.along);
    result.of_group = carrier.network_sites();
    result.of_inner = carrier.inner_sites();
    result.inner = points_of(sites, result.of_inner);
    return result;
}

}  // namespace remesh
