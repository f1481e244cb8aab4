//! \file
//! The memory of the machine and of this process.
#pragma once

#include <cstddef>

namespace cli {

//! Bytes that the machine has, or fewer where a control group allows no more. 0: unknown.
[[nodiscard]] std::size_t machine_memory();

//! Bytes of the process in memory, pages of files that it maps included. 0: unknown.
//! Cost: some microseconds.
[[nodiscard]] std::size_t resident_memory();

//! The most bytes that the process has had in memory so far. 0: unknown.
[[nodiscard]] std::size_t peak_memory();

//! Makes the heap return large arrays to the system at once. Call it before other threads run.
void tune_heap();

//! Returns what is free to the system, if it is more than this.
void return_free_memory(std::size_t more_than);

}  // namespace cli
