#include <remesh/remesh.h>

#include <cstdio>
#include <fstream>

// files IN OUT PLAIN: remeshes IN. OUT gets its colours, labels and other properties as well.
int main(int, char** argv) try {
    const remesh::MeshFile input =
        remesh::read_mesh(argv[1], remesh::ReadOptions{.with_attributes = true});
    for (const std::string& warning : input.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
    const auto result = remesh::remesh(input.mesh, {.num_samples = 1000});

    // The mesh alone: the file appears whole or not at all.
    remesh::write_mesh(argv[3], result.mesh);

    // With all that the format can hold.
    const remesh::InputMap map =
        remesh::map_to_input(input.mesh, result.mesh, result.sites, {.with_faces = true});
    const remesh::MeshAttributes carried = remesh::transfer_attributes(input, result.mesh, map);
    std::ofstream(argv[2], std::ios::binary) << remesh::format_mesh(argv[2], result.mesh, carried);
    return 0;
} catch (const agvd::Error& error) {             // IoError: a file; InvalidInput: a mesh; ...
    std::fprintf(stderr, "%s\n", error.what());  // What is wrong, where, and the remedy.
    return 1;
}
