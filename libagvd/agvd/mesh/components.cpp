// Finds connected components by union-find over faces. Chunks of faces are united in parallel, each
// on its own; the pairs across chunks follow on one thread. The root of a set is its lowest face,
// so that components are numbered by lowest face for any number of threads.
#include "agvd/mesh/components.h"

#include <atomic>

#include "agvd/core/parallel.h"
#include "agvd/core/union_find.h"
#include "agvd/mesh/face_area.h"

namespace agvd {

namespace {

// Adds to numbers of components, on several threads at once. Numbers of one component that come in
// a row are added in one go: most surfaces have one component only.
class ComponentTally {
public:
    explicit ComponentTally(std::vector<int>& numbers) : numbers_(numbers) {}
    ComponentTally(const ComponentTally&) = delete;
    ComponentTally& operator=(const ComponentTally&) = delete;
    ~ComponentTally() { flush(); }

    void add(Index component, int value) {
        if (component != component_) {
            flush();
            component_ = component;
        }
        sum_ += value;
    }

private:
    void flush() {
        if (sum_ == 0) return;
        std::atomic_ref(numbers_[component_]).fetch_add(sum_, std::memory_order_relaxed);
        sum_ = 0;
    }

    std::vector<int>& numbers_;
    Index component_ = no_index;
    int sum_ = 0;
};

}  // namespace

FaceLabels label_components(std::span<const Index> twin, int num_threads, Poller& poller) {
    const auto num_faces = static_cast<Index>(twin.size() / 3);
    UnionFind sets(num_faces);
    std::vector<std::vector<Index>> outside(num_chunks(num_faces, pass_grain));
    // A chunk unites its own faces only, which no other chunk reads.
    const auto join = [&](Index chunk, Index begin, Index end) {
        for (Index h = 3 * begin; h < 3 * end; ++h) {
            if (twin[h] >= h) continue;  // Its twin's turn, or no_index.
            if (Surface::face(twin[h]) >= begin) {
                sets.unite(Surface::face(h), Surface::face(twin[h]));
            } else {
                outside[chunk].push_back(h);
            }
        }
    };
    parallel_chunks(num_faces, pass_grain, num_threads, join, poller);
    Ticker ticker(poller);
    for (const std::vector<Index>& half_edges : outside) {
        for (const Index h : half_edges) {
            ticker.tick();
            sets.unite(Surface::face(h), Surface::face(twin[h]));
        }
    }
    FaceLabels labels{std::vector<Index>(num_faces), 0};
    poller.poll();
    const UnionFind& done = sets;
    for (Index f = 0; f < num_faces; ++f) {
        if (done.is_root(f)) labels.of_face[f] = labels.count++;
    }
    poller.poll();
    const auto label = [&](Index, Index begin, Index end) {
        for (Index f = begin; f < end; ++f) {
            if (const Index root = done.root(f); root != f)
                labels.of_face[f] = labels.of_face[root];
        }
    };
    parallel_chunks(num_faces, pass_grain, num_threads, label, poller);
    return labels;
}

std::vector<int> euler_of_components(std::span<const Index> twin, std::span<const Index> outgoing,
                                     const FaceLabels& labels, int num_threads, Poller& poller) {
    std::vector<int> euler(labels.count, 0);
    const auto count_faces = [&](Index, Index begin, Index end) {
        ComponentTally tally(euler);
        for (Index f = begin; f < end; ++f) {
            int num_edges = 0;  // An edge counts at its lower half-edge; no_index is higher.
            for (Index h = 3 * f; h < 3 * f + 3; ++h) num_edges += twin[h] > h ? 1 : 0;
            tally.add(labels.of_face[f], 1 - num_edges);
        }
    };
    parallel_chunks(static_cast<Index>(labels.of_face.size()), pass_grain, num_threads, count_faces,
                    poller);
    const auto count_vertices = [&](Index, Index begin, Index end) {
        ComponentTally tally(euler);
        for (Index v = begin; v < end; ++v) {
            if (outgoing[v] != no_index) tally.add(labels.of_face[Surface::face(outgoing[v])], 1);
        }
    };
    parallel_chunks(static_cast<Index>(outgoing.size()), pass_grain, num_threads, count_vertices,
                    poller);
    return euler;
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
                                       const Progress& progress) {
    Poller poller(progress);
    const FaceLabels labels = label_components(surface.twin, num_threads, poller);
    const std::vector<Index>& label = labels.of_face;
    std::vector<Component> components(labels.count);
    std::vector<double> area(surface.num_faces());
    poller.poll();
    const auto measure = [&](Index, Index begin, Index end) {
        for (Index f = begin; f < end; ++f) area[f] = face_area(surface, f);
    };
    parallel_chunks(surface.num_faces(), pass_grain, num_threads, measure, poller);
    const std::vector<int> euler =
        euler_of_components(surface.twin, surface.outgoing, labels, num_threads, poller);
    std::vector<Index> num_faces(labels.count, 0);
    for (const Index component : label) ++num_faces[component];
    poller.poll();
    for (Index i = 0; i < labels.count; ++i) {
        components[i].euler = euler[i];
        components[i].faces.reserve(num_faces[i]);
        components[i].area_up_to.reserve(num_faces[i]);
    }
    Ticker ticker(poller);
    std::vector<double> sum(labels.count, 0);
    for (Index f = 0; f < label.size(); ++f) {
        ticker.tick();
        sum[label[f]] += area[f];
        components[label[f]].faces.push_back(f);
        components[label[f]].area_up_to.push_back(sum[label[f]]);
    }
    for (const std::vector<Index>& loop : boundary_loops(surface)) {
        ++components[label[Surface::face(loop[0])]].boundary_loops;
    }
    return components;
}

}  // namespace agvd
