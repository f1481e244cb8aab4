//! \file
//! The connected components of a surface, with what sampling needs to know of each.
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

//! Which faces hang together through edges.
struct FaceLabels {
    std::vector<agvd::Index> of_face;  //!< #F: numbers from 0, by lowest face.
    agvd::Index count = 0;             //!< Of components.
};

//! \param twin  as agvd::Surface has it. Cost: O(#F).
[[nodiscard]] FaceLabels label_components(std::span<const agvd::Index> twin,
                                          agvd::Ticker ticker = {});

//! Of a component: of its edges without a face on the other side. Cost: O(faces).
[[nodiscard]] double boundary_length(const agvd::Surface& surface, const Component& component);

//! V - E + F of the whole surface; isolated vertices do not count. Cost: O(#V).
[[nodiscard]] double euler_of(const agvd::Surface& surface);

//! By lowest face. Linear time, as connectivity is given (analyze_topology sorts it out of
//! indices).
[[nodiscard]] std::vector<Component> find_components(const agvd::Surface& surface,
                                                     const agvd::Progress& progress = {});

}  // namespace remesh::detail
