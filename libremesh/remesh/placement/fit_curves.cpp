#include "remesh/placement/placement.h"

#include <algorithm>

namespace remesh {
namespace {

// Gauss-Seidel sweeps: each leaves a quarter of the error at most.
constexpr int num_sweeps = 30;
// Longest offset, as a share of the distance along the curve to the nearer neighbour.
constexpr double longest_offset = 0.25;

// A chain's vertices on their curve: with both ends, or, if it is closed, with the first one
// repeated at the end.
struct Chain {
    std::vector<double> along;
    std::vector<Vec3> at;
};

Chain chain_of(const Surface& surface, const Curve& curve, const CurveSites& sites, Index first,
               Index last) {
    Chain chain;
    if (!curve.is_closed()) chain.along.push_back(0);
    chain.along.insert(chain.along.end(), sites.along.begin() + first, sites.along.begin() + last);
    chain.along.push_back(curve.is_closed() ? chain.along.front() + curve.length()
                                            : curve.length());
    for (const double along : chain.along) {
        chain.at.push_back(position(surface.mesh.view(), point_on_curve(curve, along)));
    }
    return chain;
}

// What the curve between two vertices of the chain adds to the right side of each: the integral of
// the vector from chain to curve, weighted by the vertex's linear hat function.
std::array<Vec3, 2> pulls(const Surface& surface, const Curve& curve, const Chain& chain,
                          std::size_t i) {
    const double begin = chain.along[i], end = chain.along[i + 1];
    // Lengths along the curve: of both, and of the curve's own vertices between them.
    std::vector<double> stops{begin};
    for (const double turn : {0.0, curve.is_closed() ? curve.length() : 0.0}) {
        for (const double up_to : curve.up_to) {
            const double stop = up_to + turn;
            if (stop > stops.back() && stop < end) stops.push_back(stop);
        }
    }
    stops.push_back(end);
    const auto off_chain = [&](double along) {
        const double share = (along - begin) / (end - begin);
        const Vec3 on_chain = (1 - share) * chain.at[i] + share * chain.at[i + 1];
        return Vec3(position(surface.mesh.view(), point_on_curve(curve, along)) - on_chain);
    };
    std::array<Vec3, 2> result{Vec3::Zero(), Vec3::Zero()};
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
        // Simpson's rule is exact: both factors are linear.
        const double width = stops[k + 1] - stops[k], middle = stops[k] + width / 2;
        for (const auto& [at, weight] :
             {std::pair(stops[k], width / 6), {middle, 4 * width / 6}, {stops[k + 1], width / 6}}) {
            const double share = (at - begin) / (end - begin);
            const Vec3 off = weight * off_chain(at);
            result[0] += (1 - share) * off;
            result[1] += share * off;
        }
    }
    return result;
}

void fit(const Surface& surface, const Curve& curve, const Chain& chain, std::span<Vec3> offsets) {
    const std::size_t num_intervals = chain.along.size() - 1;
    // Of all vertices of the chain; the ends of an open one stay.
    std::vector<Vec3> right(chain.along.size(), Vec3::Zero()), moves = right;
    const std::size_t first = curve.is_closed() ? 0 : 1;
    for (std::size_t i = 0; i < num_intervals; ++i) {
        const std::array<Vec3, 2> pull = pulls(surface, curve, chain, i);
        right[i] += pull[0];
        right[curve.is_closed() ? (i + 1) % num_intervals : i + 1] += pull[1];
    }
    const auto before = [&](std::size_t i) { return i == 0 ? num_intervals - 1 : i - 1; };
    const auto width = [&](std::size_t i) { return chain.along[i + 1] - chain.along[i]; };
    for (int sweep = 0; sweep < num_sweeps; ++sweep) {
        for (std::size_t i = first; i < num_intervals; ++i) {
            const double w = width(before(i)), v = width(i);
            const Vec3 sum = w * moves[before(i)] + v * moves[i + 1];
            moves[i] = (6 * right[i] - sum) / (2 * (w + v));
            if (i == 0) moves.back() = moves[0];
        }
    }
    for (std::size_t i = first; i < num_intervals; ++i) {
        const double most = longest_offset * std::min(width(before(i)), width(i));
        Vec3& offset = offsets[i - first] = moves[i];
        if (offset.norm() > most) offset *= most / offset.norm();
    }
}

}  // namespace

std::vector<Vec3> fit_curves(const Surface& surface, const CurveNetwork& network,
                             const CurveSites& sites, Boundary boundary) {
    std::vector<Vec3> offsets(sites.num_groups(), Vec3::Zero());
    for (std::size_t c = 0; c < network.curves.size(); ++c) {
        const Curve& curve = network.curves[c];
        const Index first = sites.first_of_curve[c], last = sites.first_of_curve[c + 1];
        const bool is_free = curve.sides.size() == 1 && boundary == Boundary::Free;
        if (first == last || !(curve.is_crease() || is_free)) continue;
        fit(surface, curve, chain_of(surface, curve, sites, first, last),
            std::span(offsets).subspan(first, last - first));
    }
    return offsets;
}

}  // namespace remesh
