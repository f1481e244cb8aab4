#include "remesh/sites/shares.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "remesh/sites/minimum_samples.h"

namespace remesh::detail {

namespace {

// With fewer sites than so many times those that its topology needs, a part looks like another one.
constexpr Index times_minimum = 4;
// Share of all sites that large parts may give to small ones.
constexpr double most_given_away = 0.25;

}  // namespace

// A mesh with N vertices, boundary length L and spacing h has 2 N - L / h triangles, each of area
// sqrt(3) / 4 h^2.
double spacing_of(double num_vertices, double area, double boundary_length) {
    const double half = boundary_length / (4 * num_vertices);
    return half + std::sqrt(half * half + 2 * area / (std::numbers::sqrt3 * num_vertices));
}

double inner_sites(double area, double boundary_length, double spacing) {
    return 2 / std::numbers::sqrt3 * area / (spacing * spacing) - boundary_length / (2 * spacing);
}

std::vector<Index> apportion(std::span<const double> weights, Index total) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<Index> result;
    result.reserve(weights.size());
    Index given = 0;
    std::vector<std::pair<double, Index>> remainder;  // (minus remainder, index)
    for (const double weight : weights) {
        const double share = total * (1 - 1e-12) * (weight / sum);  // Sum <= total.
        const auto whole = static_cast<Index>(share);
        remainder.emplace_back(whole - share, static_cast<Index>(result.size()));
        result.push_back(whole);
        given += whole;
    }
    std::sort(remainder.begin(), remainder.end());
    for (std::size_t i = 0; given < total; ++given, ++i) {
        ++result[remainder[i % remainder.size()].second];
    }
    return result;
}

Index recognisable_samples(const Component& component) {
    return times_minimum * minimum_samples(component.genus(), component.boundary_loops);
}

void lift_small(std::span<const Index> wanted, std::vector<Index>& quota) {
    std::vector<double> lacking, spare;
    double all_lacking = 0, all_spare = 0, all = 0;
    for (std::size_t i = 0; i < quota.size(); ++i) {
        lacking.push_back(wanted[i] > quota[i] ? wanted[i] - quota[i] : 0);
        spare.push_back(quota[i] > wanted[i] ? quota[i] - wanted[i] : 0);
        all_lacking += lacking.back();
        all_spare += spare.back();
        all += quota[i];
    }
    const auto given =
        static_cast<Index>(std::min({all_lacking, all_spare, most_given_away * all}));
    if (given == 0) return;
    const std::vector<Index> gets = apportion(lacking, given), gives = apportion(spare, given);
    for (std::size_t i = 0; i < quota.size(); ++i) quota[i] = quota[i] + gets[i] - gives[i];
}

std::uint64_t needed_samples(const std::vector<Component>& components) {
    std::uint64_t needed = 0;
    for (const Component& c : components) needed += minimum_samples(c.genus(), c.boundary_loops);
    return needed;
}

std::vector<Index> share_out(const std::vector<Component>& components,
                             std::span<const double> boundary_length, Index num_samples) {
    double area = 0, length = 0;
    for (Index i = 0; i < components.size(); ++i) {
        area += components[i].area();
        length += boundary_length[i];
    }
    const double spacing = spacing_of(num_samples, area, length);
    std::vector<double> vertices;
    for (Index i = 0; i < components.size(); ++i) {
        vertices.push_back(2 / std::numbers::sqrt3 * components[i].area() / (spacing * spacing) +
                           boundary_length[i] / (2 * spacing));
    }
    const std::uint64_t needed = needed_samples(components);
    if (num_samples < needed) return apportion(vertices, num_samples);
    std::vector<Index> quota = apportion(vertices, num_samples - static_cast<Index>(needed));
    for (Index i = 0; i < components.size(); ++i) {
        quota[i] += minimum_samples(components[i].genus(), components[i].boundary_loops);
    }
    if (components.size() > 1) {
        std::vector<Index> wanted;
        wanted.reserve(components.size());
        for (const Component& c : components) wanted.push_back(recognisable_samples(c));
        lift_small(wanted, quota);
    }
    return quota;
}

}  // namespace remesh::detail
