//! \file
//! Lines and regions as sites, and their distances in the plane.
#pragma once

#include "agvd/propagation/propagate.h"

namespace line_sites {

//! The unit square, n x n quads whose inner vertices are moved within the plane z = 0.
[[nodiscard]] agvd::Surface uneven_square(agvd::Index n, std::uint64_t seed);

//! A walk along edges, which may touch and cross itself.
[[nodiscard]] agvd::SiteShape random_line(const agvd::Surface& surface, agvd::Index num_edges,
                                          std::uint64_t seed);

//! A walk from face to face.
[[nodiscard]] agvd::SiteShape random_region(const agvd::Surface& surface, agvd::Index num_faces,
                                            std::uint64_t seed);

//! One site each, from a number on.
[[nodiscard]] std::vector<agvd::SiteShape> numbered(std::vector<agvd::SiteShape> shapes,
                                                    agvd::Index first = 0);

//! For 60 points: sites of several points, points that start at distances, both, and lines and a
//! region besides.
[[nodiscard]] std::vector<agvd::PropagationOptions> kinds_of_sites(const agvd::Surface& surface);

//! The distance of a point from a shape, both in the plane z = 0.
[[nodiscard]] double in_plane(const agvd::Surface& surface, const agvd::SiteShape& shape,
                              const agvd::Vec3& p);

}  // namespace line_sites
