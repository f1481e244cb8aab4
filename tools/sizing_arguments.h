//! \file
//! Command-line options of `remesh` that say how many vertices the result has, and where.
#pragma once

#include <filesystem>
#include <string>

#include "arguments.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/sites/sizing.h"

namespace CLI {
class Option;
}

namespace cli {

//! The length of the edges on faces with a label.
struct LabelLength {
    std::string name;   //!< Of the face property.
    std::string value;  //!< The label; "*": all faces that have no length otherwise.
    Amount length;      //!< Mesh units, or percent of the diagonal.
};

//! The length of the edges at what a file names.
struct PlaceLength {
    std::string file;  //!< As --sites takes it.
    Amount length;     //!< Mesh units, or percent of the diagonal, as the radius.
    std::optional<Amount> radius;
};

struct SizingArguments {
    bool is_adaptive = false;
    agvd::Index num_faces = 0;  //!< 0: not given.
    //! Mesh units, or percent of the diagonal.
    std::optional<Amount> edge, max_distance, min_edge, max_edge, longest_edge;
    double min_angle = 0, max_angle = 180;   //!< Degrees.
    std::string target_lengths;              //!< Name of a vertex property, or a .sol file.
    std::string densities;                   //!< Name of a vertex property; both empty: none.
    std::vector<LabelLength> label_lengths;  //!< Empty: none.
    std::vector<PlaceLength> places;         //!< Empty: none.
    std::optional<double> gradation;
    //! --samples: if it is not given, target lengths give the number.
    const CLI::Option* samples = nullptr;
};

//! Adds an option that takes a length in mesh units, or in percent of the diagonal.
CLI::Option* add_length(CLI::App& app, const std::string& flag, const std::string& help,
                        std::optional<Amount>& length);

//! In mesh units. Cost: O(#F) for a percentage.
[[nodiscard]] double length_of(const Amount& length, const agvd::MeshView& mesh);

//! Adds --adaptive, --sizing, --density, --edge-length-of, --size-at, --faces, --edge-length,
//! --max-distance,
//! --min-edge, --max-edge, --gradation, --min-angle, --max-angle and --longest-edge, after
//! --samples and --sites.
void add_sizing_options(CLI::App& app, SizingArguments& arguments);

//! Whether an option other than --sizing says how fine the result is.
[[nodiscard]] bool has_count(const SizingArguments& arguments);

//! Whether the input must be read with its attributes.
[[nodiscard]] bool wants_attributes(const SizingArguments& arguments);

//! The options for a mesh. Cost: O(#F) for the diagonal.
//! \param path  of the mesh, for errors.
//! \throw agvd::InvalidOption  it has no property of that name, whose text lists those it has; or no
//!        such label.
//! \throw agvd::IoError, agvd::InvalidInput, agvd::Cancelled  as remesh::read_lengths, which reads a
//!        .sol file, and remesh::read_sites, which reads files of places.
[[nodiscard]] remesh::Sizing sizing_for(const SizingArguments& arguments,
                                        const std::filesystem::path& path,
                                        const remesh::MeshFile& mesh,
                                        const agvd::Progress& progress = {});

//! Angles and edges of all triangles. Cost: O(#F) for the diagonal.
[[nodiscard]] remesh::ShapeBounds bounds_for(const SizingArguments& arguments,
                                             const agvd::MeshView& mesh);

}  // namespace cli
