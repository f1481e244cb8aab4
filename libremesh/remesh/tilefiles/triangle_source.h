//! \file
//! The triangles of a file that need not fit into memory. Private to the jobs on tiles.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "agvd/core/types.h"
#include "remesh/names.h"

namespace remesh {

//! Reads binary PLY and binary STL one triangle after the other. The file is mapped: what was read
//! may leave the memory again.
class TriangleSource {
public:
    //! \throw IoError  it cannot be read, is truncated, or has another format.
    explicit TriangleSource(const std::filesystem::path& path);
    TriangleSource(const TriangleSource&) = delete;
    TriangleSource& operator=(const TriangleSource&) = delete;
    ~TriangleSource();

    [[nodiscard]] std::uint64_t num_faces() const;
    [[nodiscard]] std::uint64_t num_bytes() const;
    //! Begins again.
    void rewind();
    //! The corners of the next triangle.
    //! \return false: there are no more.
    //! \throw IoError       the file ends within it.
    //! \throw InvalidInput  a corner is not finite or there is no such vertex; the face has more
    //!        than three corners. The text names the face.
    [[nodiscard]] bool next(std::array<Vec3, 3>& corners);

private:
    struct File;
    std::unique_ptr<File> file_;
};

}  // namespace remesh
