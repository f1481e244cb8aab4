//! \file
//! The connected components of a surface, with the data that sampling needs of each.
#pragma once

#include <span>

#include "agvd/core/poller.h"
#include "agvd/mesh/surface.h"

namespace agvd {

struct Component {
    std::vector<Index> faces;        //!< Ascending.
    std::vector<double> area_up_to;  //!< Per face of `faces`: total area up to and with it.
    int euler = 0;                   //!< V - E + F.
    int boundary_loops = 0;

    [[nodiscard]] double area() const { return area_up_to.back(); }
    [[nodiscard]] int genus() const { return (2 - euler - boundary_loops) / 2; }
};

//! Which faces are connected through edges.
struct FaceLabels {
    std::vector<Index> of_face;  //!< #F: numbers from 0, by lowest face.
    Index count = 0;             //!< Of components.
};

//! \param twin         as Surface has it.
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
//! Cost: O(#F); what joins chunks of faces is done on one thread, little where neighbours have near
//! numbers.
[[nodiscard]] FaceLabels label_components(std::span<const Index> twin, int num_threads,
                                          Poller& poller);

//! V - E + F of each component. Vertices without faces do not count.
//!
//! \param twin, outgoing  as Connectivity has them.
//! \param labels          of label_components(twin).
//! \param num_threads     >= 0; 0: all cores. The result is the same for any number.
//! Cost: O(#F).
[[nodiscard]] std::vector<int> euler_of_components(std::span<const Index> twin,
                                                   std::span<const Index> outgoing,
                                                   const FaceLabels& labels, int num_threads,
                                                   Poller& poller);

//! Total length of a component's edges with a single face. Cost: O(faces).
[[nodiscard]] double boundary_length(const Surface& surface, const Component& component);

//! V - E + F of the whole surface; isolated vertices do not count. Cost: O(#V).
[[nodiscard]] double euler_of(const Surface& surface);

//! Sorted by lowest face. Linear time, since connectivity is given (analyze_topology derives it
//! from indices).
//!
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
[[nodiscard]] std::vector<Component> find_components(const Surface& surface, int num_threads = 0,
                                                     const Progress& progress = {});

}  // namespace agvd
