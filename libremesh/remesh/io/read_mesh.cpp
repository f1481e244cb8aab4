#include "remesh/io/read_mesh.h"

#include "remesh/io/formats.h"

namespace remesh {

MeshFile read_mesh(const std::filesystem::path& path, const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    poller.poll();
    const MeshFormat& format = require_format(path);
    return format.read(load_file(path, poller));
}

}  // namespace remesh
