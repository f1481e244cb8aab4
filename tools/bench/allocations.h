//! \file
//! How much memory the program has asked for, by its own operator new; in the programs that link
//! allocations.cpp.
#pragma once

#include <cstddef>

namespace bench {

//! The peak of bytes allocated by `new` since construction, beyond those allocated then. Counts all
//! threads. Only one object may exist at a time.
class PeakBytes {
public:
    PeakBytes();
    [[nodiscard]] std::size_t bytes() const;

private:
    std::size_t before_;
};

}  // namespace bench
