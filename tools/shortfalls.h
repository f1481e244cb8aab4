//! \file
//! What the result of remesh() falls short of: warnings, and errors with --strict. The program and
//! the Python module have these texts, which name the options of the program.
#pragma once

#include <string>
#include <vector>

#include "remesh/pipeline/remesh.h"

namespace cli {

//! What the result is too coarse to show, and how many samples would do; empty: nothing.
[[nodiscard]] std::string coarseness_text(const remesh::RemeshResult& result);

//! A warning of creases of that length, in mesh units, which tiles do not keep.
[[nodiscard]] std::string creases_of_tiles_text(double length);

//! A warning of a slit of that length, in mesh units.
[[nodiscard]] std::string welded_slit_text(double length);
//! A warning of so many of CleanResult::loose_vertices.
[[nodiscard]] std::string loose_vertices_text(agvd::Index count);

//! \return warnings of slits longer than the spacing that were welded, of self-intersections that the input does not have, of sheets that should be
//!         welded but could not be, of sheets that --wrap gave two sides, of lost seams of texture
//!         coordinates, and of bounds of the edges that give way to the number of vertices.
//! \param options  as passed to remesh().
//! \param strict   value of --strict.
//! \throw agvd::ConstraintUnmet  with --strict: the result has more self-intersections than the
//!        input, or is too coarse for creases, walls or components.
[[nodiscard]] std::vector<std::string> shortfalls_of(const remesh::RemeshResult& result,
                                                     const remesh::RemeshOptions& options,
                                                     bool strict);

}  // namespace cli
