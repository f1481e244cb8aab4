//! \file
//! The arcs of bisectors in files of diagrams. Private to these.
#pragma once

#include <initializer_list>
#include <span>
#include <string>

#include "agvd/diagram/diagram.h"
#include "remesh/meshfile/vtk_output.h"

namespace remesh {

//! Of the element `arc` of a PLY file, in their order: the first six are whole numbers.
inline constexpr std::initializer_list<const char*> arc_properties = {
    "edge",         "face",         "kind",        "first_point",   "site_left",     "site_right",
    "focus_left_x", "focus_left_y", "weight_left", "focus_right_x", "focus_right_y", "weight_right",
    "begin_x",      "begin_y",      "end_x",       "end_y"};

//! The lines of a PLY header for the element `arc`.
[[nodiscard]] std::string arc_header(const Diagram& diagram);

//! Appends the element's bytes, little endian.
void append_arcs(std::string& bytes, const Diagram& diagram, Ticker& ticker);

//! Adds focus_left, weight_left, focus_right, weight_right of the cells of a VTP file: foci in
//! space; 0 where there are none.
//! \param cells  null for those that are no arcs.
void append_foci(VtpWriter& writer, const Surface& surface,
                 std::span<const BisectorArc* const> cells, Ticker& ticker);

}  // namespace remesh
