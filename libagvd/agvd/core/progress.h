//! \file
//! The progress callback every stage polls.
#pragma once

#include <functional>

#include "agvd/core/error.h"

namespace agvd {

//! Gets the finished fraction in [0, 1] on the thread that called the stage; false stops the stage.
using Progress = std::function<bool(double)>;

//! \throw Cancelled if there is a callback and it returns false.
inline void poll(const Progress& progress, double fraction) {
    if (progress && !progress(fraction)) throw Cancelled();
}

}  // namespace agvd
