//! \file
//! The terminal in which a program runs.
#pragma once

#include <cstddef>

namespace cli {

//! Columns of the terminal that a file descriptor is; 0: it is none, or does not tell.
[[nodiscard]] std::size_t terminal_width(int file);

}  // namespace cli
