#include "given_surface.h"

#include <utility>

#include "agvd/mesh/cut_surface.h"
#include "remesh/clean/carry.h"

namespace cli {

using agvd::Index;
using agvd::SurfacePoint;

std::vector<agvd::SiteShape> carry_shapes(std::span<const remesh::GivenShape> shapes,
                                          const agvd::MeshView& mesh,
                                          const remesh::CleanedView& clean,
                                          const agvd::Surface& surface) {
    std::vector<remesh::ShapeView> views;
    for (const remesh::GivenShape& shape : shapes) views.push_back({shape.edges, shape.faces});
    std::vector<agvd::SiteShape> carried = remesh::carry_shapes(views, mesh, clean, surface);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        carried[i].site = shapes[i].site;
        carried[i].start = shapes[i].start;
    }
    return carried;
}

std::vector<Index> vertices_of_least(const agvd::MeshView& mesh, const remesh::CleanedView& clean,
                                     const agvd::Surface& surface, std::span<const double> value) {
    std::vector<Index> result(mesh.positions.size(), agvd::no_index);
    if (surface.has_own_lengths) {  // Positions tell nothing.
        for (const agvd::Triangle& t : mesh.triangles) {
            for (const Index v : t) result[v] = v;
        }
        return result;
    }
    const auto& there = surface.mesh.positions;
    const std::span<const agvd::Vec3> here = clean.welded(mesh).positions;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        const Index origin = clean.face_origin.empty() ? f : clean.face_origin[f];
        for (const Index given : mesh.triangles[origin]) {
            for (const Index cleaned : surface.mesh.triangles[f]) {
                if (there[cleaned] != here[given]) continue;
                Index& best = result[given];
                if (best == agvd::no_index || value[cleaned] < value[best]) best = cleaned;
            }
        }
    }
    return result;
}

GivenSurface::GivenSurface(const agvd::MeshView& mesh, const remesh::CleanOptions& cleaning,
                           std::span<const std::array<Index, 2>> barriers)
    : mesh_(mesh),
      clean_(remesh::clean_input(mesh, cleaning)),
      surface_(agvd::build_surface(clean_.mesh.view(), cleaning.num_threads, cleaning.progress)) {
    if (barriers.empty()) return;
    const std::vector<std::uint8_t> is_cut = remesh::carry_edges(barriers, mesh_, clean_, surface_);
    whole_ = std::move(surface_);
    surface_ = agvd::cut_along(*whole_, is_cut, cleaning.num_threads, cleaning.progress).surface;
}

GivenSurface::GivenSurface(const agvd::MeshView& mesh, std::span<const double> side_length,
                           const remesh::CleanOptions& running)
    : mesh_(mesh),
      surface_(agvd::build_surface(mesh, side_length, running.num_threads, running.progress)) {}

std::vector<SurfacePoint> GivenSurface::to_surface(const std::vector<SurfacePoint>& points) const {
    if (surface_.has_own_lengths) return points;
    return remesh::to_cleaned(points, mesh_, clean_);
}

agvd::SurfaceSites GivenSurface::to_surface(const std::vector<SurfacePoint>& points,
                                            const agvd::SitePoints& roles,
                                            const std::vector<remesh::GivenShape>& shapes) const {
    agvd::SurfaceSites sites{to_surface(points), roles,
                             carry_shapes(shapes, mesh_, clean_, surface_)};
    return whole_ ? agvd::on_all_sides(*whole_, surface_, std::move(sites)) : sites;
}

std::vector<SurfacePoint> GivenSurface::to_given(const std::vector<SurfacePoint>& points) const {
    if (surface_.has_own_lengths) return points;
    return remesh::to_original(points, mesh_, clean_);
}

}  // namespace cli
