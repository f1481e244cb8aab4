// Meshes from the bytes of files, and the bytes of files from meshes.
#include "calls.h"
#include "declined.h"
#include "javascript_terms.h"
#include "mesh_message.h"
#include "options.h"
#include "run.h"

namespace npm {

Answer call_read(const Request& request) {
    Options options(request.json()["options"]);
    const std::string name = options.text("name").value_or("");
    const std::string format = options.text("format").value_or("");
    const bool is_lenient = options.flag("lenient");
    options.require_known();
    const auto bytes = request.array<char>("bytes");
    Run run({{"read", 1}});
    remesh::MeshFile file =
        remesh::read_mesh_bytes({bytes.begin(), bytes.end()}, name.empty() ? "the file" : name,
                                {.is_lenient = is_lenient,
                                 .with_attributes = true,
                                 .format = format,
                                 .progress = run.of("read")});
    for (std::string& text : cli::describe(file.attributes.declined)) {
        file.warnings.push_back(std::move(text));
    }
    Answer answer;
    answer.json["warnings"] = in_terms_of_javascript(file.warnings);
    add_mesh(std::move(file), answer);
    return answer;
}

Answer call_write(const Request& request) {
    Options options(request.json()["options"]);
    const remesh::MeshPath target{options.text("name").value_or(""),
                                  options.text("format").value_or("")};
    options.require_known();
    remesh::MeshFile file = mesh_of(request);
    Run run({{"write", 1}});
    remesh::TextureCoordinates& texture = file.attributes.texture;
    if (!texture.empty()) {
        texture.seams = remesh::find_texture_seams(file.mesh.view(), texture.corners);
    }
    cli::decline_unwritable(target, file.attributes);
    std::vector<std::string> warnings = cli::describe(file.attributes.declined);
    if (const std::string unit = remesh::describe_unit(target, file.attributes.unit);
        !unit.empty()) {
        warnings.push_back(unit);
    }
    Answer answer;
    answer.add_bytes(
        "bytes", remesh::format_mesh(target, file.mesh.view(), file.attributes, run.of("write")));
    const remesh::RoundingLoss loss = remesh::rounding_loss(target, file.mesh.view());
    if (loss.matters()) warnings.push_back(remesh::describe(loss, target));
    answer.json["warnings"] = in_terms_of_javascript(std::move(warnings));
    return answer;
}

}  // namespace npm
