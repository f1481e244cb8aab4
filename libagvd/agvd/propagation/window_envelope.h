//! \file
//! The lower envelope of the windows of one half-edge: disjoint windows in order along it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "agvd/propagation/window.h"

namespace agvd {

//! Appends to `out` the envelope of `envelope` and one more window. Where both give the same
//! distance up to rounding, the envelope keeps its own.
//!
//! \param least_width  pieces narrower than this are dropped; far below any width that matters.
//! Cost: O(windows).
void insert_window(std::span<const Window> envelope, const Window& window, double least_width,
                   std::vector<Window>& out);

//! One window in place of two that touch, if it stays within the error: its outermost rays are
//! theirs, so that its beam holds both beams, and its distances lie below theirs by at most the
//! error it adds. The difference to either is monotone over its interval, since the directions
//! agree at the outer end and nowhere else; so the three end points bound it.
//!
//! \param max_error  relative to the least distance over the interval.
[[nodiscard]] std::optional<Window> merge_windows(const Window& left, const Window& right,
                                                  double max_error);

}  // namespace agvd
