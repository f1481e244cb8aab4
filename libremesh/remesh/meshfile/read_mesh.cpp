#include "remesh/meshfile/read_mesh.h"

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/gzip.h"

namespace remesh {

MeshFile read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
    Poller poller(options.progress);
    poller.poll();
    const MeshFormat& format = require_format({path, options.format});
    SourceFile file = load_file(path, poller);
    file.is_lenient = options.is_lenient;
    file.with_attributes = options.with_attributes;
    if (is_gzip(file.bytes)) unpack_gzip(file);
    return format.read(std::move(file));
}

MeshFile read_mesh(const std::filesystem::path& path, const Progress& progress) {
    return read_mesh(path, ReadOptions{.progress = progress});
}

}  // namespace remesh
