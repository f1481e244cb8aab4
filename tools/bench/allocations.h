//! \file
//! How much memory the program has asked for, by its own operator new; in the programs that link
//! allocations.cpp.
#pragma once

#include <cstddef>

namespace bench {

//! Most bytes that `new` had handed out at once since this was made, beyond those of then. Counts
//! all threads; one at a time.
class PeakBytes {
public:
    PeakBytes();
    [[nodiscard]] std::size_t bytes() const;

private:
    std::size_t before_;
};

}  // namespace bench
