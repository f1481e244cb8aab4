#include "page/thin_mesh.h"

#include "remesh/pipeline/remesh.h"

namespace page {

std::optional<agvd::TriangleMesh> thinned(const agvd::MeshView& mesh, int num_threads,
                                          const agvd::Progress& progress) {
    if (mesh.triangles.size() <= most_faces) return std::nullopt;
    remesh::RemeshOptions options{.num_samples = thinned_vertices,
                                  .vertex_count = remesh::VertexCount::Add,
                                  .num_threads = num_threads};
    options.progress = [&](remesh::Stage, double) { return !progress || progress(0); };
    return remesh::remesh(mesh, options).mesh;
}

}  // namespace page
