//! \file
//! A file's bytes, and errors that name the place in it. Private to the readers.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "agvd/core/poller.h"

namespace remesh {

struct SourceFile {
    std::filesystem::path path;
    std::string bytes;
    bool is_binary = false;    //!< Errors name bytes instead of lines.
    agvd::Ticker ticker = {};  //!< Of the call that reads it; readers tick copies.

    //! "mesh.off: line 12: ", counted here and not while reading, which costs good files nothing.
    [[nodiscard]] std::string place(std::size_t offset) const;
    //! Throws agvd::IoError: the bytes are no file of this format.
    [[noreturn]] void fail_malformed(std::size_t offset, const std::string& text) const;
    //! Throws agvd::InvalidInput: the format is right, the mesh is not.
    [[noreturn]] void fail_unusable(std::size_t offset, const std::string& text) const;
};

//! \throw agvd::IoError  cannot be read, or is empty; names the system's reason.
//! \throw agvd::Cancelled  the poller said so, also while a pipe keeps it waiting.
[[nodiscard]] SourceFile load_file(const std::filesystem::path& path, agvd::Poller& poller);

//! The text in quotes, cut to a readable length, with unprintable bytes shown as '?'.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace remesh
