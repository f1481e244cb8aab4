#include "remesh/topology/components.h"

namespace remesh::detail {

using agvd::Index;
using agvd::no_index;
using agvd::Surface;

FaceLabels label_components(std::span<const Index> twin, agvd::Ticker ticker) {
    FaceLabels labels{std::vector<Index>(twin.size() / 3, no_index), 0};
    std::vector<Index>& label = labels.of_face;
    std::vector<Index> stack;
    for (Index seed = 0; seed < label.size(); ++seed) {
        if (label[seed] != no_index) continue;
        label[seed] = labels.count;
        stack.push_back(seed);
        while (!stack.empty()) {
            ticker.tick();
            const Index face = stack.back();
            stack.pop_back();
            for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                if (twin[h] == no_index) continue;
                const Index other = Surface::face(twin[h]);
                if (label[other] != no_index) continue;
                label[other] = labels.count;
                stack.push_back(other);
            }
        }
        ++labels.count;
    }
    return labels;
}

double boundary_length(const Surface& surface, const Component& component) {
    double length = 0;
    for (const Index f : component.faces) {
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            if (surface.twin[h] == no_index) length += surface.length_of(h);
        }
    }
    return length;
}

double euler_of(const Surface& surface) {
    double euler = static_cast<double>(surface.num_faces()) - surface.num_edges();
    for (const Index h : surface.outgoing) euler += h != no_index ? 1 : 0;
    return euler;
}

std::vector<Component> find_components(const Surface& surface, const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    agvd::Ticker ticker(poller);
    const auto [label, count] = label_components(surface.twin, ticker);
    std::vector<Component> components(count);
    std::vector<Index> num_faces(count, 0);
    for (const Index component : label) ++num_faces[component];
    for (Index i = 0; i < count; ++i) {
        components[i].faces.reserve(num_faces[i]);
        components[i].area_up_to.reserve(num_faces[i]);
    }
    for (Index f = 0; f < label.size(); ++f) {
        ticker.tick();
        Component& component = components[label[f]];
        const double before = component.faces.empty() ? 0 : component.area();
        const double doubled_area = surface.length_of(3 * f) * surface.apex_of(3 * f).y();
        component.faces.push_back(f);
        component.area_up_to.push_back(before + doubled_area / 2);
        ++component.euler;
    }
    for (Index h = 0; h < surface.twin.size(); ++h) {
        ticker.tick();
        // An edge counts at its lower half-edge; no_index is higher.
        if (surface.twin[h] > h) --components[label[Surface::face(h)]].euler;
    }
    agvd::for_each_ticked(surface.outgoing, ticker, [&](Index h) {
        if (h != no_index) ++components[label[Surface::face(h)]].euler;
    });
    for (const std::vector<Index>& loop : agvd::boundary_loops(surface)) {
        ++components[label[Surface::face(loop[0])]].boundary_loops;
    }
    return components;
}

}  // namespace remesh::detail
