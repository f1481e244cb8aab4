//! \file
//! What each stage of a run did, for --verbose.
#pragma once

#include <string>

#include "remesh/pipeline/remesh.h"

namespace cli {

//! A line for each stage with its time, that of all its runs, and what it did; no last line end.
//! All but the times is the same for the same input and options.
//! \param num_faces  of the input.
[[nodiscard]] std::string stage_details(const remesh::RemeshResult& result, std::size_t num_faces);

}  // namespace cli
