//! \file
//! All or nothing: a file appears whole under its name, or not at all.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "agvd/core/progress.h"

namespace remesh {

//! Writes `bytes` to a temporary file in the target's folder and renames it over the target, which
//! until then stays as it was.
//!
//! A symbolic link is kept: what it points to is replaced. An existing file keeps its permission
//! bits (and its owner, where the system lets us); its other hard links keep the old content. What
//! is no regular file (/dev/null, a pipe) is written to directly. There is no fsync: after a power
//! failure the file may be the old one.
//!
//! The temporary is removed on every failure. Signals: nothing is on disk but during this call, and
//! a signal whose handler returns (such as one that sets a flag for the progress callbacks) does
//! not disturb it. Only a signal that ends the process at once (SIGKILL; SIGINT or SIGTERM without
//! a handler) can leave a `.remesh-PID-N.tmp` behind; the target is whole even then.
//! \throw agvd::IoError  naming the path and the system's reason.
//! \throw agvd::Cancelled  the progress callback returned false: the target is as it was, the
//!        temporary is gone. A pipe may have got a part.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes,
                           const agvd::Progress& progress = {});

//! What a file is to hold.
struct FileContent {
    std::filesystem::path path;
    std::string bytes;
};

//! The same for files that belong together: all are written before the first is renamed, pipes and
//! devices first. So a full disk, or a device that takes nothing, leaves all old files as they
//! were.
void write_files_atomically(std::span<const FileContent> files,
                            const agvd::Progress& progress = {});

//! Finds out before a long computation whether write_file_atomically can begin: creates and removes
//! the temporary file.
//! \throw agvd::IoError  as above.
void require_writable(const std::filesystem::path& path);

}  // namespace remesh
