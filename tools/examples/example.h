//! \file
//! What the examples share: a main() with usage and errors, numbers of the command line, and files.
//! All else in an example is what the libraries install.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "agvd/core/types.h"

namespace example {

//! The words behind the name of the program.
using Arguments = std::vector<std::string>;

//! main() of an example: runs the job, and turns what it throws into a text on stderr.
//! \param usage  printed on standard output for `--help`, on stderr if the number of arguments is
//!               another.
//! \return 0; 1: the job threw; 2: wrong usage.
[[nodiscard]] int run(int argc, const char* const* argv, const char* usage, std::size_t fewest,
                      std::size_t most, const std::function<void(const Arguments&)>& job);

//! The number that a text is.
//! \param name  of the argument, for the error.
//! \throw agvd::InvalidOption  it is none, or not in [least, most].
[[nodiscard]] double number(const std::string& text, const std::string& name, double least,
                            double most = 1e9);

//! Writes the bytes of a file.
//! \throw agvd::IoError  the file cannot be written.
void write_file(const std::filesystem::path& path, const std::string& bytes);

//! Points in space, each joined to the next.
using Line = std::vector<agvd::Vec3>;

//! Writes `v` and `l` lines of OBJ, which `render-mesh --overlay` draws.
//! \throw agvd::IoError  as write_file.
void write_lines(const std::filesystem::path& path, const std::vector<Line>& lines);

//! In the unit of the points.
[[nodiscard]] double length_of(const Line& line);

}  // namespace example
