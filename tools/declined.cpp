#include "declined.h"

#include <map>
#include <set>

#include "remesh/meshfile/mesh_file.h"

namespace cli {
namespace {

// Labels of faces that OBJ holds with their names, as remove_unwritable calls them.
std::set<std::string> labels_of_obj(const remesh::MeshAttributes& attributes) {
    std::set<std::string> names;
    for (const char* name : {"material", "group", "object"}) {
        const auto* const found = remesh::find_attribute(attributes.of_faces, name);
        if (found != nullptr && !found->names.empty()) names.insert(std::string("face ") + name);
    }
    return names;
}

}  // namespace

std::vector<std::string> describe(const std::vector<remesh::DeclinedAttribute>& declined) {
    std::map<std::string, std::string> names;
    for (const remesh::DeclinedAttribute& one : declined) {
        std::string& list = names[one.reason];
        list += (list.empty() ? "" : ", ") + one.name;
    }
    std::vector<std::string> texts;
    for (const auto& [reason, list] : names) texts.push_back(list + ": " + reason);
    return texts;
}

void decline_unwritable(const remesh::MeshPath& output, remesh::MeshAttributes& attributes) {
    const std::string files = "." + remesh::mesh_format(output) + " files";
    const bool has_texture = !attributes.texture.empty();
    const bool has_seams = !attributes.texture.seams.empty();
    const std::set<std::string> known_to_obj = labels_of_obj(attributes);
    for (const std::string& name : remesh::remove_unwritable(output, attributes)) {
        const bool is_texture =
            has_texture && name == std::string("corner ") + remesh::TextureCoordinates::name;
        attributes.declined.push_back(
            {name, files + " have no place for " +
                       (is_texture && has_seams ? "texture coordinates with seams" : "it") +
                       "; write " +
                       (name.starts_with("material ") ? ".glb"
                        : known_to_obj.contains(name) ? ".obj"
                                                      : ".ply") +
                       " to keep it"});
    }
}

}  // namespace cli
