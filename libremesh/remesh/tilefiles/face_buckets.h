//! \file
//! Faces by tile, on disk. Private to the jobs on tiles.
#pragma once

#include <filesystem>
#include <vector>

#include "remesh/meshfile/point_welder.h"
#include "remesh/tilefiles/tile_file.h"

namespace remesh {

//! A mesh from faces whose corners at equal positions are one vertex.
class WeldedFaces {
public:
    void add(const std::array<Vec3, 3>& corners) {
        triangles_.push_back({welder_.index_of(corners[0]), welder_.index_of(corners[1]),
                              welder_.index_of(corners[2])});
    }
    [[nodiscard]] std::size_t size() const { return triangles_.size(); }
    //! Leaves this empty.
    [[nodiscard]] TriangleMesh take() {
        TriangleMesh mesh{std::move(welder_.points()), std::move(triangles_)};
        *this = {};
        return mesh;
    }

private:
    PointWelder welder_;
    std::vector<Triangle> triangles_;
};

//! Takes faces in any order and keeps those of each bucket in a file. The files are removed with
//! this.
class FaceBuckets {
public:
    //! \param folder  exists.
    FaceBuckets(std::filesystem::path folder, Index count);
    FaceBuckets(const FaceBuckets&) = delete;
    FaceBuckets& operator=(const FaceBuckets&) = delete;
    ~FaceBuckets();

    [[nodiscard]] Index size() const { return static_cast<Index>(waiting_.size()); }
    //! \throw IoError  the disk is full.
    void add(Index bucket, const std::array<Vec3, 3>& corners);
    //! Writes all that waits.
    void flush();
    //! The faces of a bucket, corners at equal positions as one vertex. Threads may read at once.
    [[nodiscard]] TriangleMesh read(Index bucket) const;
    //! Puts other faces in the place of those of a bucket. Threads may do so for different ones.
    void replace(Index bucket, const MeshView& mesh);

private:
    [[nodiscard]] std::filesystem::path path(Index bucket) const;
    void flush(Index bucket);

    std::filesystem::path folder_;
    std::vector<WeldedFaces> waiting_;
    std::size_t num_waiting_ = 0;
};

}  // namespace remesh
