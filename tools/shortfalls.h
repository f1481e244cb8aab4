//! \file
//! What the result of `remesh` falls short of: warnings, and errors with --strict.
#pragma once

#include "cli.h"
#include "remesh/io/mesh_file.h"
#include "remesh/pipeline/remesh.h"

namespace cli {

//! Warns of self-intersections that the input does not have, of sheets that should be welded but
//! could not be, and of bounds of the edges that give way to the number of vertices.
//! \param options  as passed to remesh().
//! \param strict   value of --strict.
//! \throw agvd::ConstraintUnmet  with --strict: the result has more self-intersections than the
//!        input, or is too coarse for creases, walls or components.
void warn_of_shortfalls(const remesh::RemeshResult& result, const remesh::RemeshOptions& options,
                        bool strict, Console& console);

//! Warns of a shape that suffers in the single precision of the target's format.
void warn_of_rounding(const remesh::MeshPath& target, const agvd::MeshView& mesh,
                      const agvd::Progress& progress, Console& console);

}  // namespace cli
