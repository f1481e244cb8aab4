//! \file
//! What must hold for every input.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace fuzz {

//! Ends the program where it does not hold: libFuzzer keeps the input.
inline void require(bool holds, const char* what) {
    if (holds) return;
    (void)std::fprintf(stderr, "broken promise: %s\n", what);
    std::abort();
}

}  // namespace fuzz
