//! \file
//! The connected components of a surface, with the data that sampling needs of each.
#pragma once

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

//! V - E + F of each component. Vertices without faces do not count.
//!
//! \param twin, outgoing  as agvd::Connectivity has them.
//! \param labels          of label_components(twin).
//! \param num_threads     >= 0; 0: all cores. The result is the same for any number.
//! Cost: O(#F).
[[nodiscard]] std::vector<int> euler_of_components(std::span<const agvd::Index> twin,
                                                   std::span<const agvd::Index> outgoing,
                                                   const FaceLabels& labels, int num_threads,
                                                   agvd::Poller& poller);

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
