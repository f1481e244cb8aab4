#include "remesh/features/curve_sites.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "agvd/mesh/point_faces.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::no_index;

constexpr std::array sides{Side::Left, Side::Right};

// Closed curves begin off the vertices.
double start_of(const Curve& curve) { return curve.is_closed() ? curve.up_to[1] / 2 : 0; }

// The nodes' copies: ascending vertices of the cut surface by node.
std::vector<std::vector<Index>> copies_of_nodes(const CurveNetwork& network,
                                                const CutSurface& cut) {
    std::vector<std::vector<Index>> copies(network.nodes.size());
    for (std::size_t i = 0; i < network.nodes.size(); ++i) copies[i] = {network.nodes[i]};
    for (Index v = cut.num_original; v < cut.original.size(); ++v) {
        const auto node =
            std::lower_bound(network.nodes.begin(), network.nodes.end(), cut.original[v]);
        if (node == network.nodes.end() || *node != cut.original[v]) continue;
        copies[static_cast<std::size_t>(node - network.nodes.begin())].push_back(v);
    }
    return copies;
}

}  // namespace

std::vector<Index> curve_intervals(const CurveNetwork& network, double spacing) {
    std::map<std::pair<Index, Index>, int> num_between;  // Curves by their ends.
    for (const Curve& curve : network.curves) ++num_between[std::minmax(curve.begin, curve.end)];
    std::vector<Index> intervals;
    for (const Curve& curve : network.curves) {
        const bool is_alone = num_between[std::minmax(curve.begin, curve.end)] == 1;
        const double fewest = curve.begin == curve.end ? 3 : is_alone ? 1 : 2;
        intervals.push_back(
            static_cast<Index>(std::max(fewest, std::round(curve.length() / spacing))));
    }
    return intervals;
}

std::size_t num_curve_sites(const CurveNetwork& network, std::span<const Index> intervals) {
    std::size_t count = network.nodes.size();
    for (std::size_t c = 0; c < intervals.size(); ++c) {
        count += intervals[c] - (network.curves[c].is_closed() ? 0 : 1);
    }
    return count;
}

CurveSites place_curve_sites(const CurveNetwork& network, const CutSurface& cut,
                             std::span<const Index> intervals) {
    CurveSites result;
    result.first_copy.push_back(0);
    const auto end_group = [&](double along) {
        result.along.push_back(along);
        result.first_copy.push_back(static_cast<Index>(result.sites.size()));
    };
    for (const std::vector<Index>& copies : copies_of_nodes(network, cut)) {
        for (const Index v : copies) result.sites.push_back(agvd::point_at(cut.surface, v));
        end_group(0);
    }
    result.first_of_curve.push_back(result.num_groups());
    for (std::size_t c = 0; c < network.curves.size(); ++c) {
        const Curve& curve = network.curves[c];
        for (Index i = curve.is_closed() ? 0 : 1; i < intervals[c]; ++i) {
            const double along = start_of(curve) + curve.length() * i / intervals[c];
            for (const Side side : sides) {
                if (curve.has(side)) {
                    result.sites.push_back(point_on_curve(curve, along, side));
                }
            }
            end_group(along);
        }
        result.first_of_curve.push_back(result.num_groups());
    }
    return result;
}

void move_along(const Curve& curve, Index group, double along, CurveSites& sites) {
    Index copy = sites.first_copy[group];
    sites.along[group] = along;
    for (const Side side : sides) {
        if (curve.has(side)) sites.sites[copy++] = point_on_curve(curve, along, side);
    }
}

std::vector<DirectedEdge> ends_of(std::span<const ChainEdge> chain) {
    std::vector<DirectedEdge> ends;
    for (const ChainEdge& edge : chain) ends.emplace_back(edge.from, edge.to);
    return ends;
}

std::vector<ChainEdge> chain_edges(const CurveNetwork& network, const CutSurface& cut,
                                   const CurveSites& sites) {
    std::vector<Index> site_at(cut.surface.num_vertices(), no_index);  // Copies of nodes.
    const std::vector<std::vector<Index>> copies = copies_of_nodes(network, cut);
    Index next = 0;
    for (const std::vector<Index>& node : copies) {
        for (const Index v : node) site_at[v] = next++;
    }
    std::vector<ChainEdge> edges;
    for (Index c = 0; c < network.curves.size(); ++c) {
        const Curve& curve = network.curves[c];
        Index copy = 0;
        for (const Side side : sides) {
            if (!curve.has(side)) continue;
            std::vector<Index> chain;
            if (!curve.is_closed()) chain.push_back(site_at[curve.vertex(cut.surface, 0, side)]);
            for (Index g = sites.first_of_curve[c]; g < sites.first_of_curve[c + 1]; ++g) {
                chain.push_back(sites.first_copy[g] + copy);
            }
            chain.push_back(curve.is_closed()
                                ? chain.front()
                                : site_at[curve.vertex(cut.surface, curve.num_edges(), side)]);
            for (Index i = 0; i + 1 < chain.size(); ++i) {
                ChainEdge edge{chain[i], chain[i + 1], c, i, side};
                if (side == Side::Right) std::swap(edge.from, edge.to);
                edges.push_back(edge);
            }
            ++copy;
        }
    }
    return edges;
}

}  // namespace remesh
