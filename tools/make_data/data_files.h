//! \file
//! The meshes of data/, each made by formula.
#pragma once

#include <string>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "remesh/meshfile/mesh_file.h"

namespace make_data {

//! An organic closed surface of genus 4 whose face sizes vary by far more than 10.
[[nodiscard]] agvd::TriangleMesh organic();
//! A mechanical bracket with sharp edges and through holes.
[[nodiscard]] agvd::TriangleMesh part();
//! A wavy open vase without a bottom: genus 0, two boundary loops.
[[nodiscard]] agvd::TriangleMesh shell();
//! A closed plate whose thickness is 0.2 % of its longer side.
[[nodiscard]] agvd::TriangleMesh plate();
//! Four closed components whose sizes span 1 : 1000.
[[nodiscard]] agvd::TriangleMesh parts();
//! A closed surface with many slivers, but no degenerate face.
[[nodiscard]] agvd::TriangleMesh slivers();

//! A torus of radii 1 and .4 around y.
[[nodiscard]] agvd::TriangleMesh ring();
//! Its texture coordinates: turns around the axis, and around the tube. Both jump from 1 to 0.
[[nodiscard]] std::vector<remesh::CornerCoordinates> ring_texture();

struct DataFile {
    const char* name;  //!< In data/; the extension gives the format.
    agvd::TriangleMesh (*make)();
    std::vector<remesh::CornerCoordinates> (*texture)() = nullptr;  //!< Null: it has none.
};
//! The bytes of the file.
[[nodiscard]] std::string format(const DataFile& file);
[[nodiscard]] const std::vector<DataFile>& data_files();

}  // namespace make_data
