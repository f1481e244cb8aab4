#include "remesh/io/read_mesh.h"

#include "remesh/io/formats.h"

namespace remesh {

MeshFile read_mesh(const std::filesystem::path& path) {
    const MeshFormat& format = require_format(path);
    return format.read(load_file(path));
}

}  // namespace remesh
