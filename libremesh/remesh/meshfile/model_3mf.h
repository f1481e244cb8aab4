//! \file
//! A model part of a 3MF file, before its objects are put together. Private to the reader.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "agvd/core/types.h"
#include "remesh/meshfile/source_file.h"

namespace remesh {

//! An object placed somewhere: an item of the build, or a component of another object.
struct Placement3mf {
    std::string part;  //!< That holds the object; empty: the one where this stands.
    std::uint64_t object = 0;
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    bool is_moved = false;  //!< Else the transform changes nothing.
    std::size_t tag = 0;    //!< In the text of the part.
};

struct Object3mf {
    std::string name;
    bool is_surface = true;  //!< Else it supports others while they are printed, or the like.
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;    //!< Their corners are in range.
    std::vector<Index> materials = {};  //!< By triangle, with attributes: of Model3mf::names.
    std::vector<Placement3mf> components = {};
};

struct Model3mf {
    std::map<std::uint64_t, Object3mf> objects;
    std::vector<Placement3mf> items;
    std::string unit = "millimeter";
    std::vector<std::string> names = {""};   //!< Of materials; the first: none.
    std::vector<std::string> colors = {""};  //!< Of each, as in the file: #RRGGBB or #RRGGBBAA.
    bool has_lattice = false;                //!< Beams, which are not read.
    bool has_texture = false;                //!< Properties of triangles that are not read.
    bool has_gradients = false;              //!< Triangles whose corners have different colours.
};

//! \throw IoError  no model, or one that needs an extension that is not known.
//! \throw InvalidInput  a coordinate is not finite, a corner is out of range.
//! \throw Cancelled
[[nodiscard]] Model3mf parse_3mf_model(const SourceFile& part);

}  // namespace remesh
