// The reader of diagrams, and the comparison of what it returns, as in `agvd compare`.
#include "remesh/meshfile/diagram_file.h"

#include "agvd/core/error.h"
#include "memory_file.h"
#include "paper/compare_diagrams.h"

namespace {

using agvd::Index;
using agvd::no_index;
using fuzz::require;

void check_sizes(const remesh::DiagramFile& file) {
    const agvd::Diagram& d = file.diagram;
    const bool are_points = file.points.site.empty() && file.shapes.empty();
    require((!are_points || d.num_sites == file.sites.size()) &&
                d.cell_area.size() == d.num_sites && d.cell_euler.size() == d.num_sites,
            "each site has its cell");
    require(d.nearest_site.size() == file.mesh.positions.size() &&
                d.nearest_distance.size() == d.nearest_site.size(),
            "each vertex has its label");
    require(d.edge_points.size() == d.edges.size() + 1 && d.edge_points.back() == d.points.size() &&
                d.point_distance.size() == d.points.size(),
            "each edge has its points");
    require(d.vertex_offsets.size() == d.vertices.size() + 1 &&
                d.vertex_offsets.back() == d.vertex_ends.size() &&
                d.vertex_sites.size() == d.vertex_ends.size() &&
                d.vertex_distance.size() == d.vertices.size(),
            "each Voronoi vertex has its ends");
}

void check_indices(const remesh::DiagramFile& file) {
    const agvd::Diagram& d = file.diagram;
    const auto is_site = [&](agvd::SiteId s) { return !s.is_valid() || s.value() < d.num_sites; };
    for (const agvd::SiteId s : d.nearest_site) require(is_site(s), "labels are in range");
    for (const agvd::SiteId s : d.vertex_sites) require(is_site(s), "cells are in range");
    for (const auto* points : {&file.sites, &d.points, &d.vertices}) {
        for (const agvd::SurfacePoint& p : *points) {
            require(p.face.value() < file.mesh.triangles.size(), "faces are in range");
        }
    }
    for (const agvd::VoronoiEdge& e : d.edges) {
        require(is_site(e.left) && is_site(e.right), "sides are in range");
        for (const Index v : {e.tail, e.head}) {
            require(v == no_index || v < d.vertices.size(), "ends are in range");
        }
    }
    for (const agvd::EdgeEnd& end : d.vertex_ends) {
        require(end.edge < d.edges.size(), "edges are in range");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::MemoryFile bytes(data, size);
    try {
        const remesh::DiagramFile file = remesh::read_diagram(bytes.path());
        check_sizes(file);
        check_indices(file);
        const agvd::Surface surface = agvd::build_surface(file.mesh.view());
        (void)agvd::compare_diagrams(
            surface, file.diagram, file.diagram,
            {.spacing = 1, .max_loop_points = 16, .area_samples = 20, .num_threads = 1});
    } catch (const agvd::IoError&) {
    } catch (const agvd::InvalidInput&) {
    }
    return 0;
}
