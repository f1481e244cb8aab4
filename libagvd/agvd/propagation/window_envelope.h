//! \file
//! The lower envelope of the windows of one half-edge: disjoint windows in order along it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "agvd/propagation/window.h"

namespace agvd {

//! Whether windows are disjoint and in order, and none is empty. For assertions.
[[nodiscard]] bool is_envelope(std::span<const Window> windows);

//! Makes two windows that overlap disjoint, if that takes one cut, as it nearly always does where
//! windows come in order. The second ends where it begins if nothing is left of it. False if it
//! takes more; then they stay as they are.
[[nodiscard]] bool cut_where_they_change(Window& last, Window& next);

//! Adds a window to an envelope: disjoint windows, in order. Where two windows give the same
//! distance up to rounding, one that is served keeps its ground, else the one that came first.
//!
//! \param scratch  any content; reused memory.
//! Cost: O(windows that end behind its begin): constant for windows that come in order.
void insert_window(const Window& window, std::vector<Window>& scratch,
                   std::vector<Window>& envelope);

//! One window in place of two that touch, if it stays within the error: its outermost rays are
//! theirs and hold both beams, and its distances lie below theirs by at most the error it adds. The
//! difference to either is monotone over its interval, since the directions agree at the outer end
//! and nowhere else; so the ends of the intervals bound it.
//!
//! \param max_error  relative to the least distance over the interval.
[[nodiscard]] std::optional<Window> merge_windows(const Window& left, const Window& right,
                                                  double max_error);

}  // namespace agvd
