//! \file
//! Files that need not fit into memory. Private to the jobs on tiles.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "remesh/meshfile/text.h"

namespace remesh {

//! A regular file in the address space: what is not read takes no memory.
class MappedFile {
public:
    //! \throw IoError  it cannot be read, or is empty.
    explicit MappedFile(const std::filesystem::path& path) {
        const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
        struct stat status {};
        if (file >= 0 && ::fstat(file, &status) == 0 && S_ISREG(status.st_mode)) {
            size_ = static_cast<std::size_t>(status.st_size);
            if (size_ > 0) data_ = ::mmap(nullptr, size_, PROT_READ, MAP_SHARED, file, 0);
        }
        const int reason = errno;
        if (file >= 0) ::close(file);
        if (data_ == MAP_FAILED) {
            throw IoError(joined(path.string(), ": cannot be read: ",
                                 file < 0 || size_ > 0 ? std::generic_category().message(reason)
                                                       : "it is empty, or no regular file",
                                 "; name a binary PLY or STL file"));
        }
    }
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    ~MappedFile() { ::munmap(data_, size_); }

    [[nodiscard]] const char* begin() const { return static_cast<const char*>(data_); }
    [[nodiscard]] std::size_t size() const { return size_; }

private:
    void* data_ = MAP_FAILED;
    std::size_t size_ = 0;
};

}  // namespace remesh
