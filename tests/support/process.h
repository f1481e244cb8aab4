//! \file
//! Runs one of our programs as a process.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace process {

struct Outcome {
    int exit_code = -1;          //!< 128 + signal if a signal killed it.
    bool killed = false;         //!< True: it did not exit by itself.
    std::string out, err;        //!< All it wrote.
    std::size_t peak_bytes = 0;  //!< The most memory that it had at a time.
};

struct Options {
    std::filesystem::path out = {};  //!< Where stdout goes instead of Outcome::out.
    unsigned short columns = 0;      //!< If not 0, stderr is a terminal of this width.
    int signal = 0;                  //!< Sent, if not 0, ...
    std::string after = {};          //!< ... once stderr holds this text.
};

//! \param command  path of the program and its arguments.
[[nodiscard]] Outcome run(const std::vector<std::string>& command, const Options& options = {});

}  // namespace process
