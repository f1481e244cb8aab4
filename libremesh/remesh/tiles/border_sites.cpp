#include "remesh/tiles/border_sites.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace remesh {
namespace {

// In spacings: sites this near to a vertex lie at it.
constexpr double snap_to_vertex = 1e-3;

class BorderSiteFinder {
public:
    BorderSiteFinder(const Surface& surface, double spacing)
        : surface_(surface), spacing_(spacing), at_vertex_(surface.num_vertices(), no_index) {}

    void add_curve(const Curve& curve, std::span<const double> along) {
        for (const std::size_t end : {std::size_t{0}, curve.num_edges()}) {
            if (!curve.is_closed()) add_at_vertex(curve.vertex(surface_, end));
        }
        for (const double at : along) add_on_curve(curve, at);
    }

    BorderSites finish(std::span<const std::uint8_t> is_border) {
        // Sites at a vertex belong to all edges of borders there.
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            if (is_border[e] == 0) continue;
            const Index h = surface_.edge_half[e];
            for (const auto& [vertex, share] :
                 {std::pair(surface_.tail(h), 0.0), {surface_.head(h), 1.0}}) {
                const Index number = at_vertex_[vertex];
                if (number != no_index) made_.sites.push_back({e, share, number});
            }
        }
        std::ranges::sort(made_.sites, {},
                          [](const BorderSite& site) { return std::pair(site.edge, site.share); });
        return std::move(made_);
    }

private:
    void add_at_vertex(Index vertex) {
        if (at_vertex_[vertex] == no_index) at_vertex_[vertex] = made_.num_sites++;
    }

    void add_on_curve(const Curve& curve, double at) {
        if (curve.is_closed()) at -= curve.length() * std::floor(at / curve.length());
        const auto after = std::upper_bound(curve.up_to.begin(), curve.up_to.end(), at);
        const auto last = static_cast<std::ptrdiff_t>(curve.num_edges()) - 1;
        const auto i = static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(after - curve.up_to.begin() - 1, 0, last));
        const double from_begin = at - curve.up_to[i], to_end = curve.up_to[i + 1] - at;
        const double snap = snap_to_vertex * spacing_;
        if (from_begin < snap || to_end < snap) {
            add_at_vertex(curve.vertex(surface_, from_begin < to_end ? i : i + 1));
            return;
        }
        const Index e = surface_.edge[curve.sides.front().half_edges[i]];
        const double share = share_before(at, curve.up_to[i], curve.up_to[i + 1]);
        const bool is_along = surface_.tail(surface_.edge_half[e]) == curve.vertex(surface_, i);
        made_.sites.push_back({e, is_along ? share : 1 - share, made_.num_sites++});
    }

    const Surface& surface_;
    const double spacing_;
    std::vector<Index> at_vertex_;  // #V: the number of its site.
    BorderSites made_;
};

}  // namespace

BorderSites border_sites(const Surface& surface, std::span<const std::uint8_t> is_border,
                         const CurveNetwork& network, std::span<const std::vector<double>> along,
                         double spacing) {
    BorderSiteFinder finder(surface, spacing);
    for (Index c = 0; c < network.curves.size(); ++c) {
        const Index h = network.curves[c].sides.front().half_edges.front();
        if (is_border[surface.edge[h]] != 0) finder.add_curve(network.curves[c], along[c]);
    }
    return finder.finish(is_border);
}

}  // namespace remesh
