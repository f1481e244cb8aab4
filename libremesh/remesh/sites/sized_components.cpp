#include "remesh/sites/sized_components.h"

#include <algorithm>

namespace remesh::detail {
namespace {

// Simpson's rule: the length is smooth along an edge, at the scale of itself.
double length_of(const Surface& surface, Index h, const SizeField& sizes) {
    SurfacePoint point{FaceId(Surface::face(h)), {0, 0, 0}};
    const auto rate = [&](double along) {
        point.barycentric[h % 3] = 1 - along;
        point.barycentric[Surface::next(h) % 3] = along;
        return 1 / sizes.at(point);
    };
    const double length = surface.length_of(h);
    const double coarse = rate(0) + rate(1), middle = rate(0.5);
    if (length * middle < 1) return length * (coarse + 4 * middle) / 6;
    const auto parts = static_cast<int>(std::min(2 * std::ceil(length / sizes.least()), 1000.0));
    double sum = 0;
    for (int i = 0; i < parts; ++i) sum += rate((i + 0.5) / parts);
    return length * sum / parts;
}

}  // namespace

std::vector<Component> sized_components(const Surface& surface, const SizeField* sizes,
                                        const Progress& progress) {
    std::vector<Component> components = find_components(surface, progress);
    if (sizes == nullptr) return components;
    for (Component& component : components) {
        double area = 0;
        for (std::size_t i = 0; i < component.faces.size(); ++i) {
            area += sizes->area_of_face()[component.faces[i]];
            component.area_up_to[i] = area;
        }
    }
    return components;
}

double sized_length(const Surface& surface, std::span<const Index> half_edges,
                    const SizeField* sizes) {
    double length = 0;
    for (const Index h : half_edges) {
        length += sizes != nullptr ? length_of(surface, h, *sizes) : surface.length_of(h);
    }
    return length;
}

double sized_boundary_length(const Surface& surface, const Component& component,
                             const SizeField* sizes) {
    if (sizes == nullptr) return boundary_length(surface, component);
    double length = 0;
    for (const Index f : component.faces) {
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            if (surface.twin[h] == no_index) length += length_of(surface, h, *sizes);
        }
    }
    return length;
}

}  // namespace remesh::detail
