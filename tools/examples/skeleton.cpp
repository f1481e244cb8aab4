// example-skeleton: the skeleton of a tree-like shape ([lazarus1999]). Lines of equal distance from
// a root run around its branches; their centroids are the nodes. The shortest path from a ring to
// the root crosses the next ring on the way there: its parent.
#include <algorithm>
#include <cstdio>

#include "agvd/agvd.h"
#include "examples/example.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/mesh_file.h"

namespace {

using agvd::Index;
using agvd::Vec3;

constexpr const char* usage =
    "usage: example-skeleton MESH ROOT STEP SKELETON.obj\n"
    "Takes the closed lines at distances STEP, 2 STEP, ... from the root, writes a line from the\n"
    "centroid of each to that of its parent, and prints how many there are.\n"
    "  ROOT  points whose nearest one counts: `v VERTEX`, `f FACE B0 B1 B2` or `p X Y Z` on each\n"
    "        line\n";

// Polylines stray from the lines by at most this share of STEP.
constexpr double chord_tolerance = 1e-3;

// Of the surface that a closed line spans, seen along its normal. That of the curve itself lies
// nearer to the side where the line is more bent.
Vec3 centroid_of(const example::Line& ring) {
    const auto doubled_area = [&](std::size_t i) {
        return Vec3((ring[i - 1] - ring[0]).cross(ring[i] - ring[0]));
    };
    Vec3 normal = Vec3::Zero(), sum = Vec3::Zero();
    for (std::size_t i = 1; i < ring.size(); ++i) normal += doubled_area(i);
    for (std::size_t i = 1; i < ring.size(); ++i) {
        sum += doubled_area(i).dot(normal) * (ring[0] + ring[i - 1] + ring[i]) / 3;
    }
    return sum / normal.squaredNorm();
}

double distance_to(const example::Line& line, const Vec3& point) {
    double distance = agvd::infinity;
    for (std::size_t i = 1; i < line.size(); ++i) {
        distance = std::min(distance, agvd::distance_to_segment(point, line[i - 1], line[i]));
    }
    return distance;
}

// The point of a path after so much of its length.
Vec3 point_after(const agvd::MeshView& mesh, const agvd::GeodesicPath& path, double length) {
    Vec3 from = agvd::position(mesh, path.points[0]);
    for (const agvd::SurfacePoint& point : path.points) {
        const Vec3 to = agvd::position(mesh, point);
        const double piece = (to - from).norm();
        if (piece > 0 && length <= piece) return from + length / piece * (to - from);
        length -= piece;
        from = to;
    }
    return from;
}

void find_skeleton(const example::Arguments& arguments) {
    const agvd::Surface surface = agvd::build_surface(remesh::read_mesh(arguments[0]).mesh.view());
    const agvd::MeshView mesh = surface.mesh;
    const auto root = remesh::read_sites(arguments[1], mesh).sites;
    const double step = example::number(arguments[2], "STEP", 1e-9);

    const agvd::Propagation field =
        agvd::propagate(surface, root, {.max_error = 0, .relay_faces = agvd::all_faces(surface)});
    const auto levels = agvd::levels_every(field, step);
    const agvd::Isolines isolines = agvd::build_isolines(surface, field, levels);
    const auto drawn = agvd::draw_isolines(surface, isolines, chord_tolerance * step);
    std::vector<example::Line> rings(isolines.lines.size());
    std::vector<agvd::SurfacePoint> starts;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        for (Index p = drawn.offsets[i]; p < drawn.offsets[i + 1]; ++p) {
            rings[i].push_back(agvd::position(mesh, drawn.points[p]));
        }
        starts.push_back(drawn.points[drawn.offsets[i]]);
    }
    const auto paths = agvd::paths_to_sites(surface, root, field, starts);
    std::vector<example::Line> skeleton;
    std::size_t num_rings = 0;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        if (!isolines.lines[i].is_closed) continue;
        ++num_rings;
        const Vec3 crossing = point_after(mesh, paths[i].path, step);
        std::size_t parent = i;
        double least = agvd::infinity;
        for (std::size_t j = 0; j < rings.size(); ++j) {
            if (isolines.lines[j].level + 1 != isolines.lines[i].level) continue;
            const double distance = distance_to(rings[j], crossing);
            if (distance >= least) continue;
            least = distance;
            parent = j;
        }
        if (parent == i || !isolines.lines[parent].is_closed) continue;  // The root, or a rim.
        skeleton.push_back({centroid_of(rings[parent]), centroid_of(rings[i])});
    }
    std::printf("%zu rings, %zu joined to a parent\n", num_rings, skeleton.size());
    example::write_lines(arguments[3], skeleton);
}

}  // namespace

int main(int argc, char** argv) { return example::run(argc, argv, usage, 4, 4, find_skeleton); }
