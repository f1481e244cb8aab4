//! \file
//! Meshes and sites to measure on.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"

namespace bench {

//! Every face split in four until there are at least `min_faces`. The new vertices lie on the old
//! edges, off their middles by up to `jitter` of the length (below 1/2): the same surface, but not
//! a regular grid; a larger jitter gives worse faces.
[[nodiscard]] agvd::Surface subdivided(agvd::Surface surface, agvd::Index min_faces,
                                       double jitter = 0.1);

//! Reads a mesh, or makes bumpy_torus(FACES) where the path is "torus:FACES", and subdivides it.
//! \throw agvd::IoError, agvd::InvalidInput, agvd::InvalidOption  FACES is too small or no number.
[[nodiscard]] agvd::Surface load(const std::filesystem::path& path, agvd::Index min_faces);

//! The vertex at which a point lies, or the corner of its face with the largest coordinate.
[[nodiscard]] agvd::Index nearest_corner(const agvd::Surface& surface,
                                         const agvd::SurfacePoint& point);

enum class Place { Vertices, Faces };

//! Distinct random vertices, or points uniform by area in face interiors.
//! \throw agvd::ConstraintUnmet  there are fewer vertices than `count`, or `count` is too small to
//!        give each component its sites (remesh::sample_sites).
[[nodiscard]] std::vector<agvd::SurfacePoint> random_sites(const agvd::Surface& surface,
                                                           agvd::Index count, Place place,
                                                           std::uint64_t seed);

}  // namespace bench
