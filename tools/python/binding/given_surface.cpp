#include "binding/given_surface.h"

#include "remesh/clean/carry.h"

namespace python {

using agvd::Index;
using agvd::SurfacePoint;

namespace {

remesh::CleanResult clean(const agvd::MeshView& mesh, remesh::CleanOptions cleaning,
                          PythonProgress& progress) {
    cleaning.progress = progress.of("clean");
    return remesh::clean_input(mesh, cleaning);
}

}  // namespace

GivenSurface::GivenSurface(const agvd::MeshView& mesh, remesh::CleanOptions cleaning,
                           PythonProgress& progress)
    : mesh_(mesh),
      clean_(clean(mesh, cleaning, progress)),
      surface_(
          agvd::build_surface(clean_.mesh.view(), cleaning.num_threads, progress.of("clean"))) {}

std::vector<SurfacePoint> GivenSurface::to_surface(const std::vector<SurfacePoint>& points) const {
    return remesh::to_cleaned(points, mesh_, clean_);
}

std::vector<SurfacePoint> GivenSurface::to_given(const std::vector<SurfacePoint>& points) const {
    return remesh::to_original(points, mesh_, clean_);
}

std::vector<Index> GivenSurface::vertices_of_least(std::span<const double> value) const {
    std::vector<Index> result(mesh_.positions.size(), agvd::no_index);
    for (std::size_t f = 0; f < clean_.mesh.triangles.size(); ++f) {
        for (const Index given : mesh_.triangles[clean_.face_origin[f]]) {
            for (const Index cleaned : clean_.mesh.triangles[f]) {
                if (clean_.mesh.positions[cleaned] != mesh_.positions[given]) continue;
                Index& best = result[given];
                if (best == agvd::no_index || value[cleaned] < value[best]) best = cleaned;
            }
        }
    }
    return result;
}

}  // namespace python
