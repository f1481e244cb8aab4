#include "region.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "help.h"
#include "mesh_paths.h"
#include "remesh/transfer/transfer.h"

namespace cli {

void add_region_options(CLI::App& app, RegionArguments& arguments) {
    start_group(app, heading::regions);
    app.add_option("--region", arguments.region,
                   "Face property of IN, such as of PLY: faces where it is not 0 are remeshed, all "
                   "others stay as they are. --samples and lengths count in the region")
        ->type_name("NAME")
        ->excludes(app.get_option("--sites"))
        ->excludes(app.get_option("--drop-components"))
        ->excludes(app.get_option("--weld"))
        ->excludes(app.get_option("--wrap"))
        ->excludes(app.get_option("--fill-holes"));
    add_file(app, "--lock", arguments.lock,
             "Vertices that stay where they are: lines of one vertex, counted from 0")
        ->type_name("FILE")
        ->excludes(app.get_option("--sites"));
    start_group(app, heading::curves);
    app.add_flag("--lock-boundary", arguments.lock_boundary,
                 "Edges of the boundary stay as they are: none is split, none moves")
        ->excludes(app.get_option("--sites"));
}

std::vector<std::uint8_t> region_for(const RegionArguments& arguments,
                                     const std::filesystem::path& path,
                                     const remesh::MeshFile& mesh) {
    if (arguments.region.empty()) return {};
    const remesh::Attribute& property =
        remesh::require_attribute(mesh.attributes.of_faces, arguments.region,
                                  "--region: " + path.string() + " has no property of faces");
    std::vector<std::uint8_t> region;
    region.reserve(property.values.size());
    for (const double value : property.values) region.push_back(value != 0 ? 1 : 0);
    if (std::find(region.begin(), region.end(), 1) == region.end()) {
        throw agvd::InvalidOption(
            "--region: '" + arguments.region + "' is 0 for all faces of " + path.string() +
            "; give the faces to remesh another value, or leave out --region");
    }
    return region;
}

std::size_t num_vertices_in(const std::vector<std::uint8_t>& region, const agvd::MeshView& mesh) {
    if (region.empty()) return mesh.positions.size();
    std::vector<bool> is_inside(mesh.positions.size(), false);
    for (std::size_t f = 0; f < region.size(); ++f) {
        if (region[f] == 0) continue;
        for (const agvd::Index v : mesh.triangles[f]) is_inside[v] = true;
    }
    return static_cast<std::size_t>(std::count(is_inside.begin(), is_inside.end(), true));
}

}  // namespace cli
