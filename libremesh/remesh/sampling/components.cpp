#include "remesh/sampling/components.h"

#include "agvd/core/poller.h"

namespace remesh::detail {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Surface;

// #F: the number of each face's component.
std::vector<Index> label_faces(const Surface& surface, agvd::Ticker& ticker,
                               Index& num_components) {
    std::vector<Index> label(surface.num_faces(), no_index);
    std::vector<Index> stack;
    for (Index seed = 0; seed < label.size(); ++seed) {
        if (label[seed] != no_index) continue;
        label[seed] = num_components;
        stack.push_back(seed);
        while (!stack.empty()) {
            ticker.tick();
            const Index face = stack.back();
            stack.pop_back();
            for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                if (surface.twin[h] == no_index) continue;
                const Index other = Surface::face(surface.twin[h]);
                if (label[other] != no_index) continue;
                label[other] = num_components;
                stack.push_back(other);
            }
        }
        ++num_components;
    }
    return label;
}

}  // namespace

std::vector<Component> find_components(const Surface& surface, const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    agvd::Ticker ticker(poller);
    Index num_components = 0;
    const std::vector<Index> label = label_faces(surface, ticker, num_components);
    std::vector<Component> components(num_components);
    for (Index f = 0; f < label.size(); ++f) {
        ticker.tick();
        Component& component = components[label[f]];
        const double before = component.faces.empty() ? 0 : component.area();
        const double doubled_area = surface.length_of(3 * f) * surface.apex[3 * f].y();
        component.faces.push_back(f);
        component.area_up_to.push_back(before + doubled_area / 2);
        ++component.euler;
    }
    agvd::for_each_ticked(surface.edge_half, ticker,
                          [&](Index h) { --components[label[Surface::face(h)]].euler; });
    agvd::for_each_ticked(surface.outgoing, ticker, [&](Index h) {
        if (h != no_index) ++components[label[Surface::face(h)]].euler;
    });
    for (const std::vector<Index>& loop : agvd::boundary_loops(surface)) {
        ++components[label[Surface::face(loop[0])]].boundary_loops;
    }
    return components;
}

}  // namespace remesh::detail
