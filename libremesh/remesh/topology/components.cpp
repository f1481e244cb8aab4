// Finds connected components by union-find over faces. Chunks of faces are united in parallel, each
// on its own; the pairs across chunks follow on one thread. The root of a set is its lowest face,
// so that components are numbered by lowest face for any number of threads.
#include "remesh/topology/components.h"

#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/mesh/face_area.h"

namespace remesh::detail {

using agvd::Index;
using agvd::no_index;
using agvd::Surface;

namespace {

constexpr Index grain = 1 << 14;  // Faces, half-edges or vertices.

// The lowest face that hangs together with each, or one on the way there: roots are their own.
class FaceSets {
public:
    explicit FaceSets(Index num_faces) : parent_(num_faces) {}

    // Joins what hangs together within a chunk; nobody else knows its faces yet.
    // \param outside  gets half-edges to faces of lower chunks.
    void join_chunk(std::span<const Index> twin, Index begin, Index end,
                    std::vector<Index>& outside) {
        for (Index f = begin; f < end; ++f) {
            parent_[f] = f;
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                if (twin[h] >= h) continue;  // Seen from the other side, or no_index.
                if (Surface::face(twin[h]) >= begin) {
                    unite(f, Surface::face(twin[h]));
                } else {
                    outside.push_back(h);
                }
            }
        }
    }
    void unite(Index a, Index b) {
        if (parent_[a] == parent_[b]) return;
        a = halved_root(a);
        b = halved_root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    [[nodiscard]] bool is_root(Index face) const { return parent_[face] == face; }
    [[nodiscard]] Index root(Index face) const {
        while (parent_[face] != face) face = parent_[face];
        return face;
    }

private:
    Index halved_root(Index face) {
        while (parent_[face] != face) face = parent_[face] = parent_[parent_[face]];
        return face;
    }

    std::vector<Index> parent_;
};

}  // namespace

FaceLabels label_components(std::span<const Index> twin, int num_threads, agvd::Poller& poller) {
    const auto num_faces = static_cast<Index>(twin.size() / 3);
    FaceSets sets(num_faces);
    std::vector<std::vector<Index>> outside(agvd::num_chunks(num_faces, grain));
    const auto join = [&](Index chunk, Index begin, Index end) {
        sets.join_chunk(twin, begin, end, outside[chunk]);
    };
    agvd::parallel_chunks(num_faces, grain, num_threads, join, poller);
    agvd::Ticker ticker(poller);
    for (const std::vector<Index>& half_edges : outside) {
        for (const Index h : half_edges) {
            ticker.tick();
            sets.unite(Surface::face(h), Surface::face(twin[h]));
        }
    }
    FaceLabels labels{std::vector<Index>(num_faces), 0};
    poller.poll();
    for (Index f = 0; f < num_faces; ++f) {
        if (sets.is_root(f)) labels.of_face[f] = labels.count++;
    }
    poller.poll();
    const auto label = [&](Index, Index begin, Index end) {
        for (Index f = begin; f < end; ++f) {
            if (!sets.is_root(f)) labels.of_face[f] = labels.of_face[sets.root(f)];
        }
    };
    agvd::parallel_chunks(num_faces, grain, num_threads, label, poller);
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

std::vector<Component> find_components(const Surface& surface, int num_threads,
                                       const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    const FaceLabels labels = label_components(surface.twin, num_threads, poller);
    const std::vector<Index>& label = labels.of_face;
    std::vector<Component> components(labels.count);
    std::vector<double> area(surface.num_faces());
    poller.poll();
    const std::function<int&(Index)> euler_of_component = [&](Index i) -> int& {
        return components[i].euler;
    };
    const auto count_faces = [&](Index, Index begin, Index end) {
        ComponentTally euler(euler_of_component);
        for (Index f = begin; f < end; ++f) {
            area[f] = agvd::face_area(surface, f);
            int num_edges = 0;  // An edge counts at its lower half-edge; no_index is higher.
            for (Index h = 3 * f; h < 3 * f + 3; ++h) num_edges += surface.twin[h] > h ? 1 : 0;
            euler.add(label[f], 1 - num_edges);
        }
    };
    agvd::parallel_chunks(surface.num_faces(), grain, num_threads, count_faces, poller);
    const auto count_vertices = [&](Index, Index begin, Index end) {
        ComponentTally euler(euler_of_component);
        for (Index v = begin; v < end; ++v) {
            const Index h = surface.outgoing[v];
            if (h != no_index) euler.add(label[Surface::face(h)], 1);
        }
    };
    agvd::parallel_chunks(surface.num_vertices(), grain, num_threads, count_vertices, poller);
    std::vector<Index> num_faces(labels.count, 0);
    for (const Index component : label) ++num_faces[component];
    poller.poll();
    for (Index i = 0; i < labels.count; ++i) {
        components[i].faces.reserve(num_faces[i]);
        components[i].area_up_to.reserve(num_faces[i]);
    }
    agvd::Ticker ticker(poller);
    std::vector<double> sum(labels.count, 0);
    for (Index f = 0; f < label.size(); ++f) {
        ticker.tick();
        sum[label[f]] += area[f];
        components[label[f]].faces.push_back(f);
        components[label[f]].area_up_to.push_back(sum[label[f]]);
    }
    for (const std::vector<Index>& loop : agvd::boundary_loops(surface)) {
        ++components[label[Surface::face(loop[0])]].boundary_loops;
    }
    return components;
}

}  // namespace remesh::detail
