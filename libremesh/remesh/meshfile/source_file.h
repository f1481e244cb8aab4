//! \file
//! A file's bytes, and errors that name the place in it. Private to the readers and writers.
#pragma once

#include <filesystem>

#include "agvd/core/progress.h"
#include "remesh/meshfile/text.h"

namespace remesh {

struct SourceFile {
    std::filesystem::path path;
    std::string bytes;
    bool is_binary = false;        //!< Errors name bytes instead of lines.
    bool is_lenient = false;       //!< See ReadOptions.
    bool with_attributes = false;  //!< See ReadOptions.
    Ticker ticker = {};            //!< Of the call that reads it; readers tick copies.

    //! "mesh.off: line 12: ". Lines are counted here and not while reading, so that valid files
    //! cost nothing.
    [[nodiscard]] std::string place(std::size_t offset) const;

    //! Throws IoError: the bytes are no file of this format.
    template <typename... Parts>
    [[noreturn]] void fail_malformed(std::size_t offset, Parts... parts) const {
        throw IoError(place(offset) + joined(parts...));
    }
    //! Throws IoError: the file is damaged; the remedy is a new export.
    template <typename... Parts>
    [[noreturn]] void fail_damaged(std::size_t offset, Parts... parts) const {
        fail_malformed(offset, parts..., "; export the file again");
    }
    //! Throws InvalidInput: the format is right, the mesh is not.
    template <typename... Parts>
    [[noreturn]] void fail_unusable(std::size_t offset, Parts... parts) const {
        throw InvalidInput(place(offset) + joined(parts...));
    }

    //! Checks the bytes after the last element that the header announces: whole elements throw
    //! IoError unless is_lenient.
    //! \return a warning of them, or of a few stray bytes; empty if there are none (in a text: only
    //!        blanks).
    //! \param num_more  whole elements for which there is room; in a text lines are counted
    //!        instead.
    [[nodiscard]] std::string judge_rest(std::size_t offset, const std::string& kind,
                                         std::uint64_t num_announced,
                                         std::uint64_t num_more = 0) const;
};

//! A text in UTF-16 becomes UTF-8.
//! \throw IoError  cannot be read, or is empty; names the system's reason. Or it does not
//!        end: a device after 16 MB, a pipe or a terminal after 2 GB.
//! \throw Cancelled  the poller asked for it, also while waiting for a pipe.
[[nodiscard]] SourceFile load_file(const std::filesystem::path& path, Poller& poller);

//! The same for bytes that were read before.
//! \param path  for texts.
//! \throw IoError  there are none.
[[nodiscard]] SourceFile take_bytes(const std::filesystem::path& path, std::string bytes,
                                    Poller& poller);

//! With ASCII letters in lower case, whatever the locale.
[[nodiscard]] std::string in_lower_case(std::string_view text);

//! The text in quotes, cut to a readable length, with unprintable bytes shown as '?'.
[[nodiscard]] std::string in_quotes(std::string_view text);

//! "a%20b" means "a b".
[[nodiscard]] std::string without_escapes(std::string_view text);

// The paths that name streams of the process. These are used through their descriptors: to open
// them again would fail for sockets, and would replace a file instead of writing on.

[[nodiscard]] inline bool is_standard_input(const std::filesystem::path& path) {
    return path == "/dev/stdin";
}
[[nodiscard]] inline bool is_standard_output(const std::filesystem::path& path) {
    return path == "/dev/stdout";
}

}  // namespace remesh
