//! \file
//! Writes files atomically: a file appears whole under its name, or not at all.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "agvd/core/progress.h"
#include "remesh/names.h"

namespace remesh {

//! Writes `bytes` to a temporary file in the target's folder and renames it over the target, which
//! does not change until then.
//!
//! A symbolic link is kept: what it points to is replaced. An existing file keeps its permission
//! bits (and its owner, if the system allows it); its other hard links keep the old content. A
//! target that is not a regular file (/dev/null, a pipe) is written to directly, and so is
//! /dev/stdout, whatever it is. There is no fsync: after a power failure the file may be the old
//! one.
//!
//! The temporary file is removed on every failure. Signals: it exists only during this call, and a
//! signal whose handler returns (such as one that sets a flag for the progress callbacks) does not
//! disturb it. Only a signal that ends the process at once (SIGKILL; SIGINT or SIGTERM without a
//! handler) can leave a `.remesh-PID-N.tmp` behind; the target is whole even then.
//! \throw IoError  naming the path and the system's reason.
//! \throw Cancelled  the progress callback returned false: the target is unchanged, the
//!        temporary file is removed. A pipe may have received a part.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes,
                           const Progress& progress = {});

//! The path and the content of a file to be written.
struct FileContent {
    std::filesystem::path path;
    std::string bytes;
};

//! The same for files that belong together: all are written before the first is renamed, pipes and
//! devices first. So a full disk, or a device that accepts nothing, leaves all old files unchanged.
void write_files_atomically(std::span<const FileContent> files, const Progress& progress = {});

//! Checks before a long computation that write_file_atomically can begin: creates and removes the
//! temporary file.
//! \throw IoError  as above.
void require_writable(const std::filesystem::path& path);

}  // namespace remesh
