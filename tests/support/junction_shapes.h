//! \file
//! Meshes with edges of more than two faces, by formula.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "agvd/mesh/mesh.h"

namespace shapes {

struct JunctionShape {
    std::string name;
    agvd::TriangleMesh mesh;
    //! Where more than two faces meet; the ends are corners, or where junctions meet.
    std::vector<std::pair<agvd::Vec3, agvd::Vec3>> lines;
    agvd::Index num_faces = 3;   //!< At each edge there.
    agvd::Index num_sheets = 2;  //!< Of them: copies of each of its edges once cleaned.
    agvd::Index num_edges = 0;   //!< With more than two faces.
};

//! Three half-planes: two of them are one sheet.
[[nodiscard]] JunctionShape tee();
//! Pages around an axis, evenly.
[[nodiscard]] JunctionShape pages(agvd::Index count);
//! Two cubes, four faces at the edge that they share.
[[nodiscard]] JunctionShape cubes_with_an_edge();
//! Two cubes with one wall between them.
[[nodiscard]] JunctionShape cubes_with_a_wall();
//! A square pipe, open at both ends, stands on a plate.
[[nodiscard]] JunctionShape pipe_on_plate();
//! A wall in the middle of a plate that grows wider upward: no junction turns by 45 degrees at its
//! ends.
[[nodiscard]] JunctionShape fan_on_plate();
//! Three planes at right angles: six junctions meet in a point.
[[nodiscard]] JunctionShape three_planes();
//! All of these.
[[nodiscard]] std::vector<JunctionShape> straight_junctions();

//! A round pipe on a round plate: the junction is closed.
//! \param sides  of the circle of radius 1.
[[nodiscard]] agvd::TriangleMesh round_pipe_on_plate(agvd::Index sides);
//! A flat wall with three lobes, closed by a cap of this height on one side, of 1 on the other:
//! three sheets with one smooth rim.
//! \param sides  of the rim.
[[nodiscard]] agvd::TriangleMesh three_lobes(agvd::Index sides, double height);
//! Three pages around a circle, each the next one after a turn: one sheet comes thrice.
[[nodiscard]] agvd::TriangleMesh twisted_pages(agvd::Index sides);
//! Four pages around the z axis from -1 to 1, flattest in other pairs above the origin than below:
//! all of them are one sheet, which meets itself.
[[nodiscard]] agvd::TriangleMesh pages_that_change_partners(agvd::Index n);
//! Two cones that share their apex and nothing else.
[[nodiscard]] agvd::TriangleMesh cones_at_a_point(agvd::Index sides);

}  // namespace shapes
