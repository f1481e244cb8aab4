// example-medial: the medial axis of a region of a surface: the points with several nearest points
// on the region's boundary ([blum1967]), by distances inside the region. It is what remains of the
// bisectors of sites on the boundary without those between neighbours, which run to the boundary.
#include <algorithm>
#include <cstdio>

#include "agvd/agvd.h"
#include "examples/example.h"
#include "remesh/meshfile/mesh_file.h"

namespace {

using agvd::Index;

constexpr const char* usage =
    "usage: example-medial MESH AXIS.obj [K [PROPERTY]]\n"
    "Writes the medial axis of the faces whose PROPERTY is not 0, or of all, as lines. The sites\n"
    "are the vertices of the boundary. Prints the length of the axis and the largest distance\n"
    "from the boundary.\n"
    "  K  sites at most so many vertices apart on the boundary are neighbours (default: 1); more\n"
    "     drops branches to small corners of the boundary\n";

// A boundary vertex of the region, and where it stands.
struct Place {
    Index loop = 0, at = 0, loop_size = 0;

    bool is_neighbour(const Place& other, Index most) const {
        if (loop != other.loop) return false;
        const Index apart = at > other.at ? at - other.at : other.at - at;
        return std::min(apart, loop_size - apart) <= most;
    }
};

// The mesh cut open along the borders of the region; faces keep their numbers.
agvd::Surface cut_out(const agvd::Surface& surface, const std::vector<bool>& is_inside) {
    std::vector<std::uint8_t> is_cut;
    for (const Index h : surface.edge_half) {
        const Index other = surface.twin[h];
        is_cut.push_back(other == agvd::no_index || is_inside[h / 3] != is_inside[other / 3]);
    }
    return agvd::cut_along(surface, is_cut).surface;
}

void find_axis(const example::Arguments& arguments) {
    const remesh::MeshFile file =
        remesh::read_mesh(arguments[0], remesh::ReadOptions{.with_attributes = true});
    std::vector<bool> is_inside(file.mesh.triangles.size(), true);
    if (arguments.size() > 3) {
        const auto* const property = remesh::find_attribute(file.attributes.of_faces, arguments[3]);
        if (property == nullptr) {
            throw agvd::InvalidInput(arguments[0] + ": faces have no property " + arguments[3]);
        }
        std::transform(property->values.begin(), property->values.end(), is_inside.begin(),
                       [](double value) { return value != 0; });
    }
    const auto most_apart =
        static_cast<Index>(arguments.size() > 2 ? example::number(arguments[2], "K", 1) : 1);

    const agvd::Surface surface = cut_out(agvd::build_surface(file.mesh.view()), is_inside);
    std::vector<agvd::SurfacePoint> sites;
    std::vector<Place> places;
    const auto loops = agvd::boundary_loops(surface);
    for (Index loop = 0; loop < loops.size(); ++loop) {
        if (!is_inside[agvd::Surface::face(loops[loop][0])]) continue;
        const auto size = static_cast<Index>(loops[loop].size());
        for (Index at = 0; at < size; ++at) {
            sites.push_back(agvd::point_at(surface, surface.tail(loops[loop][at])));
            places.push_back({loop, at, size});
        }
    }
    if (sites.empty()) throw agvd::InvalidInput(arguments[0] + ": the region has no boundary");

    const agvd::Diagram diagram =
        agvd::build_diagram(surface, sites, agvd::propagate(surface, sites, {.max_error = 0}));
    std::vector<example::Line> axis;
    double length = 0, radius = 0;
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const auto& [left, right, tail, head] = diagram.edges[e];
        if (!right.is_valid() ||
            places[left.value()].is_neighbour(places[right.value()], most_apart)) {
            continue;
        }
        axis.emplace_back();
        for (Index p = diagram.edge_points[e]; p < diagram.edge_points[e + 1]; ++p) {
            axis.back().push_back(agvd::position(surface.mesh.view(), diagram.points[p]));
            radius = std::max(radius, diagram.point_distance[p]);
        }
        length += example::length_of(axis.back());
    }
    std::printf("length of the axis %.6f, largest distance %.6f\n", length, radius);
    example::write_lines(arguments[1], axis);
}

}  // namespace

int main(int argc, char** argv) { return example::run(argc, argv, usage, 2, 4, find_axis); }
