//! \file
//! Small meshes and points on them out of bytes.
#pragma once

#include "agvd/mesh/mesh.h"
#include "bytes.h"

namespace fuzz {

//! A shape by formula or a soup of triangles, of 1 to some 160 faces, of which the bytes then move
//! vertices, also to NaN, infinity and onto each other, and change corners, also to vertices that
//! do not exist. Bytes that end after the shape leave it as it is.
[[nodiscard]] agvd::TriangleMesh small_mesh(Bytes& bytes);

//! A point at a vertex, on an edge, inside a face or close to one of these.
[[nodiscard]] agvd::SurfacePoint point_on(Bytes& bytes, std::size_t num_faces);

}  // namespace fuzz
