// `along` is a position in mesh units, `count` the same in spacings, which count more where the
// curve turns much.
#include "remesh/curves/curve_sites.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "agvd/mesh/surface_points.h"

namespace remesh {
namespace {

// Sites are closer where a curve turns by more than most_turn (radians) over a spacing, but at most
// by the factor most_rate.
constexpr double most_turn = std::numbers::pi / 6;
constexpr double most_rate = 2;

// How many times closer sites are around a position, by the turn of the curve over a spacing:
// twice the angle between chords.
double rate_at(const Surface& surface, const Curve& curve, double along, double spacing) {
    const auto at = [&](double at_length) {
        const double inside =
            curve.is_closed() ? at_length : std::clamp(at_length, 0.0, curve.length());
        return position(surface.mesh.view(), point_on_curve(curve, inside));
    };
    const double reach = std::min(spacing / 2, curve.length() / 4);
    const Vec3 here = at(along);
    const double angle = angle_between(here - at(along - reach), at(along + reach) - here);
    const double turn = 2 * angle * spacing / (2 * reach);
    return std::clamp(turn / most_turn, 1.0, most_rate);
}

// Where a curve has how many spacings behind it; linear in between.
struct CurveMeasure {
    std::vector<double> position, count;  // From the beginning to the end of the curve.
};

// With a unit that is not the same everywhere, edges are divided into parts of half a spacing.
CurveMeasure measure_curve(const Surface& surface, const Curve& curve, double spacing,
                           const UnitAt& unit_at) {
    if (!unit_at) return {curve.up_to, spacings_along(surface, curve, spacing)};
    CurveMeasure result{{0}, {0}};
    // Asked for at ascending positions; the unit is looked up four times for each spacing.
    double last = 0, until = 0;
    const auto spacing_at = [&](double along) {
        if (last == 0 || along >= until) {
            last = spacing * unit_at(point_on_curve(curve, along));
            until = along + last / 4;
        }
        return last;
    };
    for (std::size_t i = 0; i < curve.num_edges(); ++i) {
        const double end = curve.up_to[i + 1];
        for (double begin = curve.up_to[i]; begin < end;) {
            const double step = spacing_at(begin + (end - begin) * 1e-3) / 2;
            const double next = end - begin < 1.5 * step ? end : begin + step;
            const double local = spacing_at((begin + next) / 2);
            const double rate = rate_at(surface, curve, (begin + next) / 2, local);
            result.position.push_back(next);
            result.count.push_back(result.count.back() + rate * (next - begin) / local);
            begin = next;
        }
    }
    return result;
}

// The position with `count` spacings before it. On a closed curve it may lie in the second turn.
double position_at(const CurveMeasure& measure, double count) {
    const double whole = measure.count.back();
    if (count > whole) return measure.position.back() + position_at(measure, count - whole);
    const std::vector<double>& spacings = measure.count;
    const auto after = std::upper_bound(spacings.begin() + 1, spacings.end() - 1, count);
    const auto i = static_cast<std::size_t>(after - spacings.begin()) - 1;
    const double share = share_before(count, spacings[i], spacings[i + 1]);
    return measure.position[i] + share * (measure.position[i + 1] - measure.position[i]);
}

// The first site of a closed curve lies off its vertices.
double start_of(const Curve& curve, const CurveMeasure& measure) {
    return curve.is_closed() ? measure.count[1] / 2 : 0;
}

// By node: its copies, which are vertices of the cut surface.
std::vector<std::vector<Index>> copies_of_nodes(const CurveNetwork& network,
                                                const CutSurface& cut) {
    std::vector<std::vector<Index>> copies(network.nodes.size());
    for (std::size_t i = 0; i < network.nodes.size(); ++i) copies[i] = {network.nodes[i]};
    for (const auto& [vertex, node] : network.copies) copies[node].push_back(vertex);
    for (Index v = cut.num_original; v < cut.original.size(); ++v) {
        const Index node = node_at(network, cut.original[v]);
        if (node != no_index) copies[node].push_back(v);
    }
    return copies;
}

// Adds the sites of a network group by group.
class SitePlacer {
public:
    explicit SitePlacer(CurveSites& sites) : sites_(sites) { sites_.first_copy.push_back(0); }

    // \param sheet  equal for copies that become one vertex even where sheets stay apart.
    void add_copy(const SurfacePoint& point, Index sheet) {
        sheets_.push_back(sheet);
        sites_.sites.push_back(point);
    }
    void end_group(double along) {
        const std::vector<Index> order = distinct(sheets_);
        for (const Index sheet : sheets_) {
            const auto at = std::lower_bound(order.begin(), order.end(), sheet);
            sites_.vertex.push_back(sites_.num_vertices + static_cast<Index>(at - order.begin()));
        }
        sites_.num_vertices += static_cast<Index>(order.size());
        sheets_.clear();
        sites_.along.push_back(along);
        sites_.first_copy.push_back(static_cast<Index>(sites_.sites.size()));
    }

private:
    CurveSites& sites_;
    std::vector<Index> sheets_;  // Of the current group.
};

}  // namespace

std::vector<double> spacings_along(const Surface& surface, const Curve& curve, double spacing) {
    std::vector<double> result{0};
    for (std::size_t i = 0; i < curve.num_edges(); ++i) {
        const double length = curve.up_to[i + 1] - curve.up_to[i];
        const double rate = rate_at(surface, curve, curve.up_to[i] + length / 2, spacing);
        result.push_back(result.back() + rate * length / spacing);
    }
    return result;
}

std::vector<Index> fewest_intervals(const CurveNetwork& network) {
    std::map<std::pair<Index, Index>, int> num_between;  // Number of curves, by their ends.
    std::vector<int> num_ends(network.nodes.size(), 0);  // Number of ends of curves, by node.
    for (const Curve& curve : network.curves) {
        ++num_between[std::minmax(curve.begin, curve.end)];
        if (curve.is_closed()) continue;
        ++num_ends[curve.begin];
        ++num_ends[curve.end];
    }
    std::vector<Index> intervals;
    for (const Curve& curve : network.curves) {
        if (curve.is_locked) {
            intervals.push_back(1);
            continue;
        }
        if (curve.begin == curve.end) {
            intervals.push_back(3);
            continue;
        }
        const bool is_alone = num_between[std::minmax(curve.begin, curve.end)] == 1;
        const bool is_slit = num_ends[curve.begin] == 1 && num_ends[curve.end] == 1;
        intervals.push_back(is_alone && !is_slit && !curve.is_junction() ? 1 : 2);
    }
    return intervals;
}

std::vector<Index> curve_intervals(const Surface& surface, const CurveNetwork& network,
                                   double spacing, const UnitAt& unit_at) {
    std::vector<Index> intervals = fewest_intervals(network);
    for (std::size_t c = 0; c < intervals.size(); ++c) {
        if (network.curves[c].is_locked) continue;
        const double spacings =
            measure_curve(surface, network.curves[c], spacing, unit_at).count.back();
        intervals[c] = std::max(intervals[c], static_cast<Index>(std::round(spacings)));
    }
    return intervals;
}

std::size_t num_curve_vertices(const CurveNetwork& network, std::span<const Index> intervals) {
    std::size_t count = network.nodes.size() + (network.is_welded() ? 0 : network.copies.size());
    for (std::size_t c = 0; c < intervals.size(); ++c) {
        const Curve& curve = network.curves[c];
        const std::size_t num_sites = intervals[c] - (curve.is_closed() ? 0 : 1);
        count += num_sites * (network.is_welded() ? 1 : curve.num_sheets);
    }
    return count;
}

Index num_junction_vertices(const CurveNetwork& network, const CurveSites& sites) {
    std::vector<bool> is_on_junction(sites.num_groups(), false);
    for (std::size_t c = 0; c < network.curves.size(); ++c) {
        const Curve& curve = network.curves[c];
        if (!curve.is_junction()) continue;
        if (!curve.is_closed()) is_on_junction[curve.begin] = is_on_junction[curve.end] = true;
        std::fill(is_on_junction.begin() + sites.first_of_curve[c],
                  is_on_junction.begin() + sites.first_of_curve[c + 1], true);
    }
    std::vector<Index> vertices;
    for (Index g = 0; g < sites.num_groups(); ++g) {
        for (Index i = sites.first_copy[g]; is_on_junction[g] && i < sites.first_copy[g + 1]; ++i) {
            vertices.push_back(network.is_welded() ? g : sites.vertex[i]);
        }
    }
    return static_cast<Index>(distinct(std::move(vertices)).size());
}

std::vector<std::vector<double>> even_positions(const Surface& surface, const CurveNetwork& network,
                                                double spacing, std::span<const Index> intervals,
                                                const UnitAt& unit_at) {
    std::vector<std::vector<double>> along;
    for (std::size_t c = 0; c < network.curves.size(); ++c) {
        const Curve& curve = network.curves[c];
        std::vector<double>& positions = along.emplace_back();
        if (curve.is_locked) continue;
        const CurveMeasure measure = measure_curve(surface, curve, spacing, unit_at);
        for (Index i = curve.is_closed() ? 0 : 1; i < intervals[c]; ++i) {
            const double count = start_of(curve, measure) + measure.count.back() * i / intervals[c];
            positions.push_back(position_at(measure, count));
        }
    }
    return along;
}

std::vector<Index> intervals_between(const CurveNetwork& network,
                                     std::span<const std::vector<double>> along) {
    std::vector<Index> intervals;
    for (std::size_t c = 0; c < along.size(); ++c) {
        const Index num_ends = network.curves[c].is_closed() ? 0 : 1;
        intervals.push_back(static_cast<Index>(along[c].size()) + num_ends);
    }
    return intervals;
}

CurveSites curve_sites_at(const CurveNetwork& network, const CutSurface& cut,
                          std::span<const std::vector<double>> along) {
    CurveSites result;
    SitePlacer placer(result);
    for (const std::vector<Index>& copies : copies_of_nodes(network, cut)) {
        for (const Index v : copies) {
            placer.add_copy(point_at(cut.surface(), v), cut.original[v]);
        }
        placer.end_group(0);
    }
    result.first_of_curve.push_back(result.num_groups());
    for (std::size_t c = 0; c < network.curves.size(); ++c) {
        const Curve& curve = network.curves[c];
        for (const double position : along[c]) {
            for (std::size_t side = 0; side < curve.sides.size(); ++side) {
                placer.add_copy(point_on_curve(curve, position, side), curve.sides[side].sheet);
            }
            placer.end_group(position);
        }
        result.first_of_curve.push_back(result.num_groups());
    }
    return result;
}

void move_along(const Curve& curve, Index group, double along, CurveSites& sites) {
    sites.along[group] = along;
    for (std::size_t side = 0; side < curve.sides.size(); ++side) {
        sites.sites[sites.first_copy[group] + side] = point_on_curve(curve, along, side);
    }
}

std::vector<Index> groups_of_copies(const CurveSites& sites) {
    std::vector<Index> groups;
    for (Index g = 0; g < sites.num_groups(); ++g) groups.resize(sites.first_copy[g + 1], g);
    return groups;
}

std::vector<DirectedEdge> ends_of(std::span<const ChainEdge> chain) {
    std::vector<DirectedEdge> ends;
    for (const ChainEdge& edge : chain) ends.emplace_back(edge.from, edge.to);
    return ends;
}

std::vector<ChainEdge> chain_edges(const CurveNetwork& network, const CutSurface& cut,
                                   const CurveSites& sites) {
    std::vector<Index> site_at(cut.surface().num_vertices(), no_index);  // Copies of nodes.
    const std::vector<std::vector<Index>> copies = copies_of_nodes(network, cut);
    Index next = 0;
    for (const std::vector<Index>& node : copies) {
        for (const Index v : node) site_at[v] = next++;
    }
    std::vector<ChainEdge> edges;
    for (Index c = 0; c < network.curves.size(); ++c) {
        const Curve& curve = network.curves[c];
        for (Index side = 0; side < curve.sides.size(); ++side) {
            std::vector<Index> chain;
            if (!curve.is_closed()) chain.push_back(site_at[curve.vertex(cut.surface(), 0, side)]);
            for (Index g = sites.first_of_curve[c]; g < sites.first_of_curve[c + 1]; ++g) {
                chain.push_back(sites.first_copy[g] + side);
            }
            chain.push_back(curve.is_closed()
                                ? chain.front()
                                : site_at[curve.vertex(cut.surface(), curve.num_edges(), side)]);
            for (Index i = 0; i + 1 < chain.size(); ++i) {
                ChainEdge edge{chain[i], chain[i + 1], c, i, side};
                if (!curve.sides[side].runs_along) std::swap(edge.from, edge.to);
                edges.push_back(edge);
            }
        }
    }
    return edges;
}

}  // namespace remesh
