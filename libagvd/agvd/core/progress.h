//! \file
//! The progress callback that every stage polls.
#pragma once

#include <functional>

#include "agvd/core/error.h"

namespace agvd {

//! Gets the finished fraction in [0, 1] on the thread that called the stage; false stops the stage.
//! It is called every millisecond or so of work (see Ticker) and should take below a microsecond.
using Progress = std::function<bool(double)>;

//! \throw Cancelled if there is a callback and it returns false.
inline void poll(const Progress& progress, double fraction) {
    if (progress && !progress(fraction)) throw Cancelled();
}

//! The callback for a part of the work, from one fraction to another. It keeps a reference to the
//! given one.
[[nodiscard]] inline Progress within(const Progress& progress, double begin, double end) {
    if (!progress) return {};
    return [&progress, begin, end](double x) { return progress(begin + x * (end - begin)); };
}

}  // namespace agvd
