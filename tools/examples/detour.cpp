// example-detour: the shortest ways past barriers, which are edges that no path crosses. The
// surface is cut open along them; paths bend at their ends, as at any corner of a boundary.
#include <algorithm>
#include <cstdio>

#include "agvd/agvd.h"
#include "examples/example.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/mesh_file.h"

namespace {

using agvd::Index;

constexpr const char* usage =
    "usage: example-detour MESH BARRIERS POINTS OUT.obj\n"
    "Writes the shortest path between each pair of points, and prints its length, its length\n"
    "without the barriers, and whether it is locally shortest.\n"
    "  BARRIERS  two vertices of an edge on each line\n"
    "  POINTS    a point on each line: `v VERTEX`, `f FACE B0 B1 B2` or `p X Y Z`; two lines in a\n"
    "            row are a pair\n";

// #E: 1 for edges that are named by their ends.
std::vector<std::uint8_t> mark_edges(const agvd::Surface& surface,
                                     const std::vector<std::array<Index, 2>>& ends) {
    std::vector<std::uint64_t> wanted;
    wanted.reserve(ends.size());
    for (const auto& [a, b] : ends) wanted.push_back(agvd::edge_key(a, b));
    wanted = agvd::distinct(std::move(wanted));
    std::vector<std::uint8_t> is_marked;
    for (const Index h : surface.edge_half) {
        const std::uint64_t key = agvd::edge_key(surface.tail(h), surface.head(h));
        is_marked.push_back(std::binary_search(wanted.begin(), wanted.end(), key) ? 1 : 0);
    }
    if (std::count(is_marked.begin(), is_marked.end(), 1) != std::ssize(wanted)) {
        throw agvd::InvalidInput("a barrier is no edge of the mesh; name the two ends of an edge");
    }
    return is_marked;
}

void find_detours(const example::Arguments& arguments) {
    const agvd::Surface whole = agvd::build_surface(remesh::read_mesh(arguments[0]).mesh.view());
    const agvd::Surface open =
        agvd::cut_along(whole, mark_edges(whole, remesh::read_edges(arguments[1]))).surface;
    // Faces keep their numbers in the cut, and so points stay where they are.
    const auto points =
        remesh::read_sites(arguments[2], whole.mesh.view(), {}, remesh::Repeats::Allowed).sites;
    if (points.size() % 2 != 0) {
        throw agvd::InvalidInput(arguments[2] + ": the last pair lacks its second point; add it");
    }
    std::vector<agvd::PointPair> pairs;
    for (std::size_t i = 0; i < points.size(); i += 2) pairs.push_back({points[i], points[i + 1]});
    const auto paths = agvd::shortest_paths(open, pairs);
    const auto free_paths = agvd::shortest_paths(whole, pairs);
    std::vector<example::Line> lines;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        std::printf("pair %zu: %.8f, without barriers %.8f, %s\n", i, paths[i].length,
                    free_paths[i].length,
                    paths[i].is_locally_shortest ? "locally shortest" : "not locally shortest");
        example::Line& line = lines.emplace_back();
        for (const agvd::SurfacePoint& point : paths[i].points) {
            line.push_back(agvd::position(open.mesh.view(), point));
        }
    }
    example::write_lines(arguments[3], lines);
}

}  // namespace

int main(int argc, char** argv) { return example::run(argc, argv, usage, 4, 4, find_detours); }
