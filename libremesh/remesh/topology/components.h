//! \file
//! The connected components of a surface, with the data that sampling needs of each.
#pragma once

#include <atomic>
#include <functional>
#include <span>

#include "agvd/core/poller.h"
#include "agvd/mesh/surface.h"

namespace remesh::detail {

struct Component {
    std::vector<agvd::Index> faces;  //!< Ascending.
    std::vector<double> area_up_to;  //!< Per face of `faces`: total area up to and with it.
    int euler = 0;                   //!< V - E + F.
    int boundary_loops = 0;

    [[nodiscard]] double area() const { return area_up_to.back(); }
    [[nodiscard]] int genus() const { return (2 - euler - boundary_loops) / 2; }
};

//! Which faces are connected through edges.
struct FaceLabels {
    std::vector<agvd::Index> of_face;  //!< #F: numbers from 0, by lowest face.
    agvd::Index count = 0;             //!< Of components.
};

//! \param twin         as agvd::Surface has it.
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
//! Cost: O(#F); what joins chunks of faces is done on one thread, little where neighbours have near
//! numbers.
[[nodiscard]] FaceLabels label_components(std::span<const agvd::Index> twin, int num_threads,
                                          agvd::Poller& poller);

//! Adds to integers of components, for several threads at once. A run of one component is added in
//! one go: most surfaces have one only.
class ComponentTally {
public:
    //! \param number_of  gives the component's number, an int&; outlives this.
    explicit ComponentTally(const std::function<int&(agvd::Index)>& number_of)
        : number_of_(number_of) {}
    ComponentTally(const ComponentTally&) = delete;
    ComponentTally& operator=(const ComponentTally&) = delete;
    ~ComponentTally() { flush(); }

    void add(agvd::Index component, int value) {
        if (component != component_) {
            flush();
            component_ = component;
        }
        sum_ += value;
    }

private:
    void flush() {
        if (sum_ == 0) return;
        std::atomic_ref(number_of_(component_)).fetch_add(sum_, std::memory_order_relaxed);
        sum_ = 0;
    }

    const std::function<int&(agvd::Index)>& number_of_;
    agvd::Index component_ = agvd::no_index;
    int sum_ = 0;
};

//! Total length of a component's edges with a single face. Cost: O(faces).
[[nodiscard]] double boundary_length(const agvd::Surface& surface, const Component& component);

//! V - E + F of the whole surface; isolated vertices do not count. Cost: O(#V).
[[nodiscard]] double euler_of(const agvd::Surface& surface);

//! Sorted by lowest face. Linear time, since connectivity is given (analyze_topology derives it
//! from indices).
//!
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
[[nodiscard]] std::vector<Component> find_components(const agvd::Surface& surface,
                                                     int num_threads = 0,
                                                     const agvd::Progress& progress = {});

}  // namespace remesh::detail
