#include "remesh/sites/shares.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace remesh {
namespace {

// With fewer sites than so many times those that its topology needs, a part looks like another one.
constexpr Index times_minimum = 4;
// Share of all sites that large parts may give to small ones.
constexpr double most_given_away = 0.25;

Index minimum_of(const Component& c) { return minimum_samples(c.genus(), c.boundary_loops); }

// Simpson's rule: the length is smooth along an edge, at the scale of itself.
double local_length(const Surface& surface, Index h, const SizeField* sizes) {
    const double length = surface.length_of(h);
    if (sizes == nullptr) return length;
    SurfacePoint point{FaceId(Surface::face(h)), {0, 0, 0}};
    const auto rate = [&](double along) {
        point.barycentric[h % 3] = 1 - along;
        point.barycentric[Surface::next(h) % 3] = along;
        return 1 / sizes->at(point);
    };
    const double coarse = rate(0) + rate(1), middle = rate(0.5);
    if (length * middle < 1) return length * (coarse + 4 * middle) / 6;
    const auto parts = static_cast<int>(std::min(2 * std::ceil(length / sizes->least()), 1000.0));
    double sum = 0;
    for (int i = 0; i < parts; ++i) sum += rate((i + 0.5) / parts);
    return length * sum / parts;
}

// Gives parts that have less than they want from what others have beyond that, at most a quarter of
// all; if that is not enough, equal shares of what they lack.
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
    const auto gets = detail::apportion(lacking, given), gives = detail::apportion(spare, given);
    for (std::size_t i = 0; i < quota.size(); ++i) quota[i] = quota[i] + gets[i] - gives[i];
}

}  // namespace

Index minimum_samples(int genus, int boundary_loops) {
    if (boundary_loops == 0) {
        if (genus == 2) return 10;  // The only orientable surface above the bound.
        return static_cast<Index>(std::ceil((7 + std::sqrt(1.0 + 48.0 * genus)) / 2));
    }
    // E <= V (V - 1) / 2 with all vertices on the boundary; each loop has three vertices of its
    // own.
    const double euler = 2.0 - 2.0 * genus - boundary_loops;
    const double bound = std::ceil((5 + std::sqrt(25 - 24 * euler)) / 2);
    return std::max(static_cast<Index>(bound), static_cast<Index>(3 * boundary_loops));
}

Index minimum_samples(const Topology& topology) {
    Index needed = 0;
    for (const ComponentTopology& c : topology.components) {
        needed += minimum_samples(c.genus, c.boundary_loops);
    }
    return needed;
}

namespace detail {

void set_areas(std::vector<Component>& components, std::span<const double> area_of_face) {
    for (Component& component : components) {
        double area = 0;
        for (std::size_t i = 0; i < component.faces.size(); ++i) {
            area += area_of_face[component.faces[i]];
            component.area_up_to[i] = area;
        }
    }
}

std::vector<Component> sized_components(const Surface& surface, const SizeField* sizes,
                                        const Progress& progress) {
    std::vector<Component> components = find_components(surface, progress);
    if (sizes != nullptr) set_areas(components, sizes->area_of_face());
    return components;
}

double sized_boundary_length(const Surface& surface, const Component& component,
                             const SizeField* sizes) {
    double length = 0;
    for (const Index f : component.faces) {
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            if (surface.twin[h] == no_index) length += local_length(surface, h, sizes);
        }
    }
    return length;
}

// A mesh with N vertices, boundary length L and spacing h has 2 N - L / h triangles, each of area
// sqrt(3) / 4 h^2.
double spacing_of(double num_vertices, double area) {
    return std::sqrt(2 * area / (std::numbers::sqrt3 * num_vertices));
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

std::uint64_t needed_samples(const std::vector<Component>& components) {
    std::uint64_t needed = 0;
    for (const Component& c : components) needed += minimum_of(c);
    return needed;
}

std::vector<Index> share_out(const std::vector<Component>& components, Index num_samples) {
    double area = 0;
    for (const Component& c : components) area += c.area();
    const double spacing = spacing_of(num_samples, area);
    std::vector<double> vertices;
    for (const Component& c : components) vertices.push_back(inner_sites(c.area(), 0, spacing));
    const std::uint64_t needed = needed_samples(components);
    if (num_samples < needed) return apportion(vertices, num_samples);
    std::vector<Index> quota = apportion(vertices, num_samples - static_cast<Index>(needed));
    std::vector<Index> wanted;
    for (Index i = 0; i < components.size(); ++i) {
        quota[i] += minimum_of(components[i]);
        wanted.push_back(times_minimum * minimum_of(components[i]));
    }
    if (components.size() > 1) lift_small(wanted, quota);
    return quota;
}

std::vector<Index> share_out_inner(const Surface& surface, const std::vector<Component>& components,
                                   Index count, double spacing, const SizeField* sizes) {
    std::vector<double> lacking;
    std::vector<Index> wanted;
    for (const Component& c : components) {
        const double length = sized_boundary_length(surface, c, sizes);
        lacking.push_back(std::max(inner_sites(c.area(), length, spacing), 0.0));
        wanted.push_back(c.boundary_loops == 0 ? times_minimum * minimum_of(c) : 0);
    }
    if (std::all_of(lacking.begin(), lacking.end(), [](double n) { return n == 0; })) {
        for (Index i = 0; i < components.size(); ++i) lacking[i] = components[i].area();
    }
    std::vector<Index> quota = apportion(lacking, count);
    if (components.size() > 1) lift_small(wanted, quota);
    return quota;
}

}  // namespace detail
}  // namespace remesh
