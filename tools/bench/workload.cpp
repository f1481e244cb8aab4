#include "bench/workload.h"

#include <algorithm>
#include <charconv>

#include "agvd/core/error.h"
#include "agvd/core/random.h"
#include "bench/torus.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/sites/sites.h"

namespace bench {
namespace {

using namespace agvd;

Surface subdivided_once(const Surface& surface, double jitter) {
    TriangleMesh fine{surface.mesh.positions, {}};
    const Index first = surface.num_vertices();  // The vertex on edge e is first + e.
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        const double at = 0.5 + jitter * (2 * random_unit(first, 0, e) - 1);
        fine.positions.push_back((1 - at) * fine.positions[surface.tail(h)] +
                                 at * fine.positions[surface.head(h)]);
    }
    for (Index f = 0; f < surface.num_faces(); ++f) {
        const auto& [a, b, c] = surface.mesh.triangles[f];
        const Index ab = first + surface.edge[3 * f];
        const Index bc = first + surface.edge[3 * f + 1];
        const Index ca = first + surface.edge[3 * f + 2];
        fine.triangles.insert(fine.triangles.end(),
                              {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return build_surface(fine.view());
}

std::vector<SurfacePoint> random_vertices(const Surface& surface, Index count, std::uint64_t seed) {
    std::vector<Index> vertices;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (surface.outgoing[v] != no_index) vertices.push_back(v);
    }
    if (count > vertices.size()) {
        throw ConstraintUnmet(std::to_string(count) + " sites are more than the " +
                              std::to_string(vertices.size()) +
                              " vertices of the mesh; use fewer --sites, or --place faces");
    }
    std::vector<SurfacePoint> sites(count);
    for (Index i = 0; i < count; ++i) {  // The first steps of a shuffle.
        const auto rest = static_cast<double>(vertices.size() - i);
        std::swap(vertices[i], vertices[i + static_cast<Index>(random_unit(seed, 0, i) * rest)]);
        sites[i] = point_at(surface, vertices[i]);
    }
    return sites;
}

const std::string torus_prefix = "torus:";

bool is_torus(const std::string& name) { return name.starts_with(torus_prefix); }

TriangleMesh named_torus(const std::string& name) {
    Index faces = 0;
    const char* end = name.data() + name.size();
    const auto read = std::from_chars(name.data() + torus_prefix.size(), end, faces);
    if (read.ec != std::errc() || read.ptr != end) {
        throw InvalidOption(name + " is no torus; use torus:FACES, such as torus:1000000");
    }
    return bumpy_torus(faces);
}

}  // namespace

Surface subdivided(Surface surface, Index min_faces, double jitter) {
    while (surface.num_faces() < min_faces) surface = subdivided_once(surface, jitter);
    return surface;
}

Surface load(const std::filesystem::path& path, Index min_faces) {
    const TriangleMesh mesh = is_torus(path) ? named_torus(path) : remesh::read_mesh(path).mesh;
    return subdivided(build_surface(mesh.view()), min_faces);
}

Index nearest_corner(const Surface& surface, const SurfacePoint& point) {
    const auto& b = point.barycentric;
    const auto corner = static_cast<std::size_t>(std::max_element(b.begin(), b.end()) - b.begin());
    return surface.mesh.triangles[point.face.value()][corner];
}

std::vector<SurfacePoint> random_sites(const Surface& surface, Index count, Place place,
                                       std::uint64_t seed) {
    if (place == Place::Vertices) return random_vertices(surface, count, seed);
    return remesh::sample_sites(surface,
                                {.num_samples = count, .init = remesh::Init::Random, .seed = seed});
}

}  // namespace bench
