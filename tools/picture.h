//! \file
//! The pictures of --picture, where this build can draw one.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "agvd/diagram/cut_cells.h"
#include "page/diagram_page.h"

namespace cli {

//! \throw agvd::InvalidOption  this build has no libpng.
void require_pictures();

//! Original and result beside each other, as PNG. \pre require_pictures() does not throw.
[[nodiscard]] std::string picture_of(const agvd::MeshView& original, const agvd::MeshView& result);

//! \param path  of the picture.
//! \throw agvd::InvalidOption  as require_pictures().
//! \throw agvd::IoError  its extension is neither .png nor .svg.
void check_picture(const std::filesystem::path& path);

//! The bytes of a file of that name. \param cells  of page.mesh, cut along the bisectors.
//! \pre check_picture() does not throw.
[[nodiscard]] std::string picture_of_diagram(const std::filesystem::path& path,
                                             const page::DiagramPage& page,
                                             const agvd::CutCells& cells,
                                             const std::array<double, 3>& view);

}  // namespace cli
