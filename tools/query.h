//! \file
//! What the subcommands of `agvd` share: input, sites, outputs; and how each is added.
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "agvd/mesh/surface.h"
#include "agvd/propagation/propagate.h"
#include "arguments.h"
#include "expected_stages.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/lines_file.h"

namespace cli {

//! Options that every subcommand with a mesh has.
struct QueryArguments : DiagramArguments {
    std::vector<std::filesystem::path> outputs;
    bool ascii = false;  //!< PLY is written as text.
};

//! A subcommand. Its arguments live as long as `run`.
struct Query {
    CLI::App* command;
    std::function<void()> run;
};

//! `agvd diagram`. \param command_line  which its page tells: see page::to_shell.
[[nodiscard]] Query add_diagram(CLI::App& app, const std::string& command_line);
//! `agvd distance`.
[[nodiscard]] Query add_distance(CLI::App& app);
//! `agvd path`.
[[nodiscard]] Query add_path(CLI::App& app);
//! `agvd isolines`.
[[nodiscard]] Query add_isolines(CLI::App& app);
//! `agvd compare`.
[[nodiscard]] Query add_compare(CLI::App& app);

//! \param run  the subcommand on a console of its own.
template <typename Arguments>
[[nodiscard]] Query make_query(CLI::App* command, std::shared_ptr<Arguments> arguments,
                               void (*run)(const Arguments&, Console&)) {
    return {command, [arguments = std::move(arguments), run] {
                Console console(arguments->common, limit_of(*arguments));
                console.run([&] { run(*arguments, console); });
            }};
}

//! Checks a length in mesh units.
//! \param name  of the length, in the text.
//! \return what is wrong; an empty text: nothing.
[[nodiscard]] std::string check_length(const char* name, const std::string& text);

//! Adds -o, which may be repeated, and --ascii. \return the first, for those that require it.
CLI::Option* add_outputs(CLI::App& app, QueryArguments& arguments);

//! Checks -o before the long work.
//! \param inputs  files besides IN that must not be overwritten; may be empty paths.
//! \param check_extension  throws what no format is known for.
void check_outputs(const QueryArguments& arguments,
                   std::initializer_list<std::filesystem::path> inputs,
                   void (*check_extension)(const std::filesystem::path&));

//! The input as it was read, and what it was cleaned to.
struct OpenedInput {
    remesh::MeshFile file;
    remesh::CleanResult clean;
    agvd::Surface surface;                    //!< Of clean.mesh, cut along the barriers.
    std::optional<agvd::Surface> whole = {};  //!< Without barriers, if there are any.
};

//! Adds --barriers.
void add_barriers(CLI::App& app, DiagramArguments& arguments);

//! Adds --edge-lengths.
void add_edge_lengths(CLI::App& app, DiagramArguments& arguments);

//! Reads, cleans and connects IN, and cuts it along --barriers. With --edge-lengths nothing is
//! cleaned.
//! \throw agvd::InvalidOption  there are lengths and no --sites.
//! \param stages  what is expected, by the number of faces.
//! \param attributes  whether the file has them.
[[nodiscard]] OpenedInput open_input(
    const DiagramArguments& arguments, Console& console,
    const std::function<std::vector<ExpectedStage>(std::size_t num_faces)>& stages,
    WithAttributes attributes = WithAttributes::No);

//! The sites of --sites, or sampled ones; those on barriers on all sides.
[[nodiscard]] agvd::SurfaceSites sites_on(const OpenedInput& input,
                                          const DiagramArguments& arguments, Console& console);

//! Distances with relays in some faces.
[[nodiscard]] agvd::Propagation propagate_on(const OpenedInput& input,
                                             const DiagramArguments& arguments,
                                             const agvd::SurfaceSites& sites,
                                             std::vector<agvd::Index> relay_faces,
                                             Console& console);

//! The points of a file, on the cleaned mesh.
[[nodiscard]] std::vector<agvd::SurfacePoint> points_on(const OpenedInput& input,
                                                        const std::filesystem::path& path,
                                                        Console& console);

//! Writes all files, or none, PLY as --ascii asks for, and lists them.
void write_files(const QueryArguments& arguments, std::vector<remesh::FileContent> files,
                 Console& console);

//! Writes the lines to all outputs, or to none.
void write_lines(const QueryArguments& arguments, const remesh::Lines& lines, Console& console);

}  // namespace cli
