//! \file
//! The baseline of the paper's Ref. 37 ([meng2023] Sec. 6.4.4): exact labels of the vertices,
//! joined by straight segments.
#pragma once

#include "agvd/diagram/diagram.h"

namespace agvd {

//! In a face whose corners have two labels a segment joins the crossings of its edges: where the
//! distances of both ends, if they grew by the length of the edge, would be equal. With three
//! labels the middle of three crossings is joined with each. Each segment is a Voronoi edge, and so
//! is each part of the boundary in a cell. Areas and Euler characteristics are left empty.
//!
//! \param exact  of the window engine with max_error 0; only its vertices matter.
[[nodiscard]] Diagram vertex_label_diagram(const Surface& surface, std::size_t num_sites,
                                           const Propagation& exact);

}  // namespace agvd
