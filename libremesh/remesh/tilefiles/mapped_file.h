//! \file
//! Files that need not fit into memory. Private to the jobs on tiles.
#pragma once

#include <cstddef>
#include <filesystem>

namespace remesh {

//! A regular file in the address space: what is not read takes no memory.
class MappedFile {
public:
    //! \throw IoError  it cannot be read, or is empty.
    explicit MappedFile(const std::filesystem::path& path);
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    ~MappedFile();

    [[nodiscard]] const char* begin() const { return static_cast<const char*>(data_); }
    [[nodiscard]] std::size_t size() const { return size_; }

private:
    //! Sets what it finds of data_ and size_. \return errno, if data_ stays empty.
    int map(const std::filesystem::path& path);

    void* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace remesh
