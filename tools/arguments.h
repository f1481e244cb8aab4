//! \file
//! Command-line options shared by `remesh` and `agvd diagram`: mesh, sites, propagation.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "agvd/propagation/propagate.h"
#include "cli.h"
#include "remesh/clean/clean_input.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/sites/sites.h"

namespace CLI {
class Option;
}

namespace cli {

//! Values of the options; all are in their documented range once run() calls the job.
struct DiagramArguments {
    std::filesystem::path input;
    std::string from;                    //!< Its format; empty: by the extension.
    std::filesystem::path sites;         //!< Empty: sample.
    std::filesystem::path barriers;      //!< Edges that no path crosses; empty: none.
    std::filesystem::path edge_lengths;  //!< In place of positions; empty: none.
    remesh::CleanOptions cleaning;
    remesh::SamplingOptions sampling;
    double sample_percent = 0;  //!< Of the input's vertices; 0: sampling.num_samples counts.
    agvd::PropagationOptions propagation;
    std::size_t memory_limit = 0;  //!< Bytes; 0: the machine's memory is unknown.
    bool force = false;
    bool is_lenient = false;
    CommonOptions common;
};

//! Every engine by its name on the command line.
[[nodiscard]] std::map<std::string, agvd::Engine> engines_by_name();

//! A number, or a percentage: 12, 1e4, .5, 20%.
struct Amount {
    double value = 0;
    bool is_percent = false;
};
//! Nothing unless the text is such a number, finite and above 0.
[[nodiscard]] std::optional<Amount> parse_amount(std::string_view text);

//! Whether the text is a value of --samples.
[[nodiscard]] bool is_number_of_samples(const std::string& text);

//! The number of sites for a mesh, or a part of one.
//! \param num_vertices  of which a percentage is taken, at least 1.
//! \throw agvd::InvalidOption  it gives too many.
[[nodiscard]] agvd::Index num_samples_for(const Amount& samples, std::size_t num_vertices);
[[nodiscard]] agvd::Index num_samples_for(const DiagramArguments& arguments,
                                          std::size_t num_vertices);

//! A whole number: 12, 1e4. Nothing unless the text is one, of 0 or more and below no_index.
[[nodiscard]] std::optional<agvd::Index> parse_count(std::string_view text);

//! Adds an option whose value is a whole number above 0. \param count  outlives `app`.
CLI::Option* add_count(CLI::App& app, const std::string& flag, const std::string& help,
                       agvd::Index& count);

//! Adds IN, --from, --keep-slits, --samples, --init, --seed, --sites, --engine, --max-error,
//! --steiner-points,
//! --lambda,
//! --memory-limit, --force, --lenient and the common options.
void add_diagram_options(CLI::App& app, DiagramArguments& arguments);

//! The same for exact distances by the window engine: without the options of engines, and
//! --max-error has the default 0.
void add_query_options(CLI::App& app, DiagramArguments& arguments);

//! Values by the names that name_of gives them.
template <typename T>
[[nodiscard]] std::map<std::string, T> by_name(std::initializer_list<T> values,
                                               const char* (*name_of)(T)) {
    std::map<std::string, T> result;
    for (const T value : values) result[name_of(value)] = value;
    return result;
}

//! The keys.
template <typename T>
[[nodiscard]] std::vector<std::string> names_of(const std::map<std::string, T>& by_name) {
    std::vector<std::string> names;
    names.reserve(by_name.size());
    for (const auto& [name, value] : by_name) names.push_back(name);
    return names;
}

//! An option whose value is one of a few names.
struct Choice {
    std::string flag;
    std::vector<std::string> names;
    std::string default_name;
    std::string help;
};
//! \param take  called with the name given.
CLI::Option* add_choice(CLI::App& app, const Choice& choice,
                        const std::function<void(const std::string& name)>& take);

//! The limit for a Console.
[[nodiscard]] MemoryLimit limit_of(const DiagramArguments& arguments);

enum class WithAttributes { No, Yes };

//! Reads IN; the file must fit into the memory allowed.
//! \throw OutOfMemory  it does not.
//! \param attributes  whether to read them as well.
[[nodiscard]] remesh::MeshFile read_input(const DiagramArguments& arguments, Console& console,
                                          WithAttributes attributes = WithAttributes::No);

//! Reads --sites: points of the mesh as it was read. Its warnings are told.
[[nodiscard]] remesh::SitesFile read_given_sites(const DiagramArguments& arguments,
                                                 const remesh::MeshFile& mesh, Console& console);

//! For what takes points only.
//! \param num_shapes  lines and regions among the sites.
//! \param what        takes them, as the text begins.
//! \throw agvd::InvalidInput  points belong to sites, or start at a distance above 0, or there are
//!                            lines or regions.
void require_plain_points(const std::filesystem::path& path, const agvd::SitePoints& points,
                          std::size_t num_shapes, const char* what);

//! Reads points of the mesh as it was read: a file of sites in which places may repeat.
[[nodiscard]] std::vector<agvd::SurfacePoint> read_points(const std::filesystem::path& path,
                                                          const remesh::MeshFile& mesh,
                                                          Console& console);

//! "FILE: N vertices, M faces", for the log.
[[nodiscard]] std::string describe(const std::filesystem::path& path, const agvd::MeshView& mesh);

}  // namespace cli
