//! \file
//! The lower envelope of the windows of one half-edge: disjoint windows in order along it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "agvd/propagation/window/window.h"

namespace agvd {

//! Whether windows are disjoint and in order, and none is empty. For assertions.
[[nodiscard]] bool is_envelope(std::span<const Window> windows);

//! Makes two overlapping windows disjoint, if one cut suffices, as it nearly always does where
//! windows come in order. If nothing is left of the second one, it ends where it begins.
[[nodiscard]] bool cut_where_they_change(Window& last, Window& next);

//! Adds a window to an envelope: disjoint windows, in order. Where two windows tie, the one that is
//! served stays, else the one that came first.
//!
//! \param scratch  any content; reused memory.
//! Cost: O(windows that end behind its begin): constant for windows that come in order.
void insert_window(const Window& window, std::vector<Window>& scratch,
                   std::vector<Window>& envelope);

//! Replaces two windows that touch by one, if that stays within the error. Its outermost rays are
//! theirs and meet in its image; its distances lie below theirs by at most the error that is added,
//! which the values at the ends of the intervals bound, since the differences are monotone.
//! \param max_error  relative to the least distance over the interval.
[[nodiscard]] std::optional<Window> merge_windows(const Window& left, const Window& right,
                                                  double max_error);

}  // namespace agvd
