//! \file
//! A diagram as it stands in pictures: cells in colours, and on them bisectors, lines of equal
//! distance and sites.
#pragma once

#include <array>
#include <span>
#include <string>

#include "agvd/diagram/cut_cells.h"
#include "page/page_mesh.h"

namespace render {

//! What is drawn. Views: the caller keeps the arrays.
struct DiagramDrawing {
    const agvd::CutCells& cells;
    const page::Polylines& bisectors;
    const page::Polylines& isolines;
    std::span<const agvd::Vec3> sites;
    const page::Polylines& site_lines;
    std::array<double, 3> degrees{};  //!< See View.
};

//! As PNG.
[[nodiscard]] std::string png_of(const DiagramDrawing& drawing);

//! As SVG: the cells are a picture in it, all else are curves, cut where the surface hides them.
[[nodiscard]] std::string svg_of(const DiagramDrawing& drawing);

}  // namespace render
