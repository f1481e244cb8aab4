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

//! \param twin  as in agvd::Surface. Cost: O(#F).
[[nodiscard]] FaceLabels label_components(std::span<const agvd::Index> twin,
                                          agvd::Ticker ticker = {});

//! Total length of a component's edges with a single face. Cost: O(faces).
[[nodiscard]] double boundary_length(const agvd::Surface& surface, const Component& component);

//! V - E + F of the whole surface; isolated vertices do not count. Cost: O(#V).
[[nodiscard]] double euler_of(const agvd::Surface& surface);

//! Sorted by lowest face. Linear time, since connectivity is given (analyze_topology derives it
//! from indices).
[[nodiscard]] std::vector<Component> find_components(const agvd::Surface& surface,
                                                     const agvd::Progress& progress = {});

}  // namespace remesh::detail
