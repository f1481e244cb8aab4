#include "attributes.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "declined.h"
#include "help.h"
#include "mesh_paths.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/system_file.h"
#include "remesh/transfer/transfer.h"

namespace cli {
namespace {

constexpr const char* any_labels = "*";

std::vector<std::string> split(const std::string& names) {
    std::vector<std::string> result;
    for (std::size_t begin = 0; begin <= names.size();) {
        const std::size_t end = std::min(names.find(',', begin), names.size());
        if (end > begin) result.push_back(names.substr(begin, end - begin));
        begin = end + 1;
    }
    return result;
}

std::vector<remesh::Attribute> labels_of(const remesh::MeshAttributes& attributes) {
    std::vector<remesh::Attribute> labels;
    for (const remesh::Attribute& attribute : attributes.of_faces) {
        if (remesh::is_label(attribute)) {
            labels.push_back({.name = attribute.name, .type = attribute.type});
        }
    }
    return labels;
}

// The name of the labels to keep: materials if there are any, else the only ones.
std::string name_of_labels(const std::string& wanted, const std::string& input,
                           const std::vector<remesh::Attribute>& labels) {
    if (wanted != any_labels) return wanted;
    if (labels.empty()) {
        throw agvd::InvalidOption(input +
                                  " has no labels of faces, which --keep-labels needs: a face "
                                  "property of PLY of an integer type, or materials (usemtl), "
                                  "groups (g) or objects (o) of OBJ; leave out --keep-labels");
    }
    if (remesh::find_attribute(labels, "material") != nullptr) return "material";
    if (labels.size() == 1) return labels.front().name;
    throw agvd::InvalidOption(input +
                              " has several labels of faces; choose with --keep-labels=NAME: " +
                              remesh::names_of(labels));
}

void keep_named(const std::vector<std::string>& names, const std::filesystem::path& input,
                remesh::MeshAttributes& attributes) {
    std::vector<remesh::Attribute> all;
    for (const auto* kind : {&attributes.of_vertices, &attributes.of_faces}) {
        for (const remesh::Attribute& attribute : *kind) all.push_back({.name = attribute.name});
    }
    if (attributes.normals) all.push_back({.name = "normals"});
    if (!attributes.texture.empty()) all.push_back({.name = remesh::TextureCoordinates::name});
    const auto is_named = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const std::string& name : names) {
        static_cast<void>(remesh::require_attribute(
            all, name, "--transfer: " + input.string() + " has no property"));
    }
    for (auto* kind : {&attributes.of_vertices, &attributes.of_faces}) {
        std::erase_if(*kind, [&](const auto& attribute) { return !is_named(attribute.name); });
    }
    if (!is_named("normals")) attributes.normals.reset();
    if (!is_named(remesh::TextureCoordinates::name)) attributes.texture = {};
    if (!is_named("material")) attributes.materials = {};
    attributes.declined.clear();
}

std::vector<std::string> names_in(const remesh::MeshAttributes& attributes) {
    std::vector<std::string> names;
    for (const auto& attribute : attributes.of_vertices)
        names.push_back("vertex " + attribute.name);
    if (attributes.normals) names.emplace_back("vertex normals");
    for (const auto& attribute : attributes.of_faces) names.push_back("face " + attribute.name);
    if (!attributes.texture.empty()) {
        names.push_back(std::string("corner ") + remesh::TextureCoordinates::name);
    }
    return names;
}

// Names of files beside the input as they are seen from the output's folder.
void move_material_files(const std::filesystem::path& input, const std::filesystem::path& output,
                         std::vector<std::string>& files) {
    namespace fs = std::filesystem;
    for (std::string& file : files) {
        const fs::path path = fs::absolute(input).parent_path() / remesh::path_of(file);
        std::error_code error;
        const bool is_there = fs::exists(path, error);
        const fs::path seen = fs::proximate(path, fs::absolute(output).parent_path(), error);
        if (is_there && !error) file = seen.generic_string();
    }
}

}  // namespace

void add_attribute_options(CLI::App& app, AttributeArguments& arguments) {
    start_group(app, heading::attributes);
    app.add_option("--transfer", arguments.transfer,
                   "What the output gets of the input's colours, labels, texture coordinates and "
                   "other properties of vertices and faces: all, none, or names such as "
                   "quality,material,texcoord. Seams of texture coordinates that it gets become "
                   "chains of edges")
        ->type_name("all|none|NAMES")
        ->capture_default_str();
    add_file(app, "--map", arguments.map,
             "Write where each output vertex lies on the input: lines FACE B0 B1 B2")
        ->type_name("FILE");
    start_group(app, heading::curves);
    app.add_flag(std::string("--keep-labels{") + any_labels + "}", arguments.keep_labels,
                 "Borders between faces with different labels or materials become chains of "
                 "edges; --keep-labels=NAME: those of this property")
        ->type_name("NAME");
}

bool wants_attributes(const AttributeArguments& arguments) {
    return arguments.transfer != "none" || !arguments.keep_labels.empty();
}

void check_no_label(const AttributeArguments& arguments,
                    const std::vector<std::filesystem::path>& outputs) {
    if (arguments.keep_labels != any_labels) return;
    for (const std::filesystem::path& output : outputs) {
        if (remesh::is_known_mesh_format({output, ""})) continue;
        throw agvd::InvalidOption("'" + output.string() +
                                  "' has no extension of a mesh; if it names labels, write "
                                  "--keep-labels=" +
                                  output.string());
    }
}

std::vector<agvd::Index> labels_to_keep(const AttributeArguments& arguments,
                                        const std::filesystem::path& input,
                                        const remesh::MeshAttributes& attributes) {
    if (arguments.keep_labels.empty()) return {};
    const std::vector<remesh::Attribute> labels = labels_of(attributes);
    const std::string name = name_of_labels(arguments.keep_labels, input.string(), labels);
    const std::string complaint = "--keep-labels: " + input.string() + " has no labels of faces";
    static_cast<void>(remesh::require_attribute(labels, name, complaint));
    return remesh::face_labels_of(remesh::require_attribute(attributes.of_faces, name, complaint));
}

remesh::AttributeReport select_attributes(const AttributeArguments& arguments,
                                          const std::filesystem::path& input,
                                          const remesh::MeshPath& output,
                                          remesh::MeshAttributes& attributes, Console& console) {
    if (arguments.transfer == "none") attributes = {.unit = attributes.unit};
    if (arguments.transfer != "all" && arguments.transfer != "none") {
        keep_named(split(arguments.transfer), input, attributes);
    }
    decline_unwritable(output, attributes);
    const std::string unit = remesh::describe_unit(output, attributes.unit);
    if (!unit.empty()) console.warn(unit);
    move_material_files(input, output.path, attributes.material_files);
    for (const std::string& text : describe(attributes.declined)) console.warn(text);
    return {names_in(attributes), attributes.declined, arguments.map.string()};
}

bool needs_map(const AttributeArguments& arguments, const remesh::MeshAttributes& attributes) {
    return !arguments.map.empty() || !attributes.empty();
}

remesh::MeshAttributes carry_attributes(const AttributeArguments& arguments,
                                        const remesh::MeshFile& input,
                                        const remesh::RemeshResult& result, int num_threads,
                                        const agvd::Progress& progress,
                                        std::vector<remesh::FileContent>& files) {
    if (!needs_map(arguments, input.attributes)) return input.attributes;
    const remesh::InputMap map =
        remesh::map_to_input(input.mesh.view(), result.mesh.view(), result.sites,
                             {.with_faces = !input.attributes.of_faces.empty(),
                              .num_threads = num_threads,
                              .progress = progress});
    if (!arguments.map.empty()) {
        files.push_back({arguments.map, remesh::format_map(input, map.vertices)});
    }
    remesh::MeshAttributes carried = remesh::transfer_attributes(
        input, result.mesh.view(), map, {.num_threads = num_threads, .progress = progress});
    remesh::keep_attributes(input.attributes, result.kept.vertices, result.kept.faces, carried);
    return carried;
}

}  // namespace cli
