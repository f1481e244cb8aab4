#include "make_data/data_files.h"

#include "remesh/meshfile/mesh_file.h"

namespace make_data {

const std::vector<DataFile>& data_files() {
    static const std::vector<DataFile> files{{"organic.ply", organic},
                                             {"part.off", part},
                                             {"shell.obj", shell},
                                             {"plate.stl", plate},
                                             {"parts.ply", parts},
                                             {"slivers.off", slivers},
                                             {"ring.obj", ring, ring_texture}};
    return files;
}

std::string format(const DataFile& file) {
    remesh::MeshAttributes attributes;
    if (file.texture != nullptr) attributes.texture.corners = file.texture();
    return remesh::format_mesh(file.name, file.make().view(), attributes);
}

}  // namespace make_data
