//! \file
//! Which part of the labels holds the place of a site.
#pragma once

#include "agvd/diagram/cell_set.h"
#include "agvd/diagram/edge_labels.h"
#include "agvd/diagram/stage_input.h"

namespace agvd {

//! \return the node (see intervals.h) of the site's cell that holds the site; no_index: its place
//!         belongs to another cell, or is an inner point.
[[nodiscard]] Index holder_of(const StageInput& input, const EdgeLabels& labels, Index site);

//! The sites that are inner points.
[[nodiscard]] CellSet inner_sites(const EdgeLabels& labels, Index num_sites);

//! Whether the place of a site belongs to another cell.
//! \param inner_sites  inner_sites().
[[nodiscard]] bool is_displaced(const StageInput& input, const EdgeLabels& labels,
                                const CellSet& inner_sites, Index site);

//! All sites whose place belongs to another cell. Islands that are absorbed change nothing of it.
//! Cost: O(#sites + inner points) quick steps.
[[nodiscard]] CellSet find_displaced(const StageInput& input, const EdgeLabels& labels);

}  // namespace agvd
