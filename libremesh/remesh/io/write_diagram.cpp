#include "remesh/io/write_diagram.h"

#include <string>

#include "agvd/core/error.h"
#include "remesh/io/atomic_file.h"
#include "remesh/io/byte_order.h"
#include "remesh/io/formats.h"
#include "remesh/io/text_format.h"

namespace remesh {
namespace {

using agvd::Diagram;
using agvd::Index;
using agvd::SiteId;
using agvd::Surface;

// In files, where an id can be missing, -1 says so.
std::int32_t site_number(SiteId site) {
    return site.is_valid() ? static_cast<std::int32_t>(site.value()) : -1;
}

// The points of an edge's polyline, counted from `first`; a closed curve comes back to its first.
std::vector<Index> polyline(const Diagram& diagram, Index edge, Index first) {
    std::vector<Index> points;
    const Index begin = diagram.edge_points[edge];
    const Index end = diagram.edge_points[edge + 1];
    for (Index p = begin; p < end; ++p) points.push_back(first + p);
    if (diagram.edges[edge].tail == agvd::no_index) points.push_back(first + begin);
    return points;
}

Index num_edges(const Diagram& diagram) { return static_cast<Index>(diagram.edges.size()); }

// A named array of as many lines as there are items; row_of(i) gives the numbers of line i.
template <typename RowOf>
void append_array(std::string& bytes, const char* attributes, std::size_t num_lines,
                  const RowOf& row_of) {
    bytes += std::string("<DataArray format=\"ascii\" ") + attributes + ">\n";
    for (std::size_t i = 0; i < num_lines; ++i) append_line(bytes, "", row_of(i));
    bytes += "</DataArray>\n";
}

std::string format_vtp(const Surface& surface, const Diagram& diagram) {
    const std::size_t num_points = diagram.points.size();
    const std::size_t num_lines = diagram.edges.size();
    std::string bytes =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n"
        "<Piece NumberOfPoints=\"" +
        std::to_string(num_points) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
        std::to_string(num_lines) +
        "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<PointData Scalars=\"distance\">\n";
    append_array(bytes, "type=\"Float64\" Name=\"distance\"", num_points,
                 [&](std::size_t p) { return std::array{diagram.point_distance[p]}; });
    bytes += "</PointData>\n<CellData>\n";
    append_array(bytes, "type=\"Int32\" Name=\"site_left\"", num_lines,
                 [&](std::size_t e) { return std::array{site_number(diagram.edges[e].left)}; });
    append_array(bytes, "type=\"Int32\" Name=\"site_right\"", num_lines,
                 [&](std::size_t e) { return std::array{site_number(diagram.edges[e].right)}; });
    bytes += "</CellData>\n<Points>\n";
    append_array(bytes, "type=\"Float64\" NumberOfComponents=\"3\"", num_points,
                 [&](std::size_t p) { return position(surface.mesh.view(), diagram.points[p]); });
    bytes += "</Points>\n<Lines>\n";
    std::vector<std::size_t> ends;
    append_array(bytes, "type=\"Int64\" Name=\"connectivity\"", num_lines, [&](std::size_t e) {
        std::vector<Index> points = polyline(diagram, static_cast<Index>(e), 0);
        ends.push_back((ends.empty() ? 0 : ends.back()) + points.size());
        return points;
    });
    append_array(bytes, "type=\"Int64\" Name=\"offsets\"", num_lines,
                 [&](std::size_t e) { return std::array{ends[e]}; });
    return bytes + "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string format_obj_lines(const Surface& surface, const Diagram& diagram) {
    std::string bytes = "# Voronoi edges; before each its left and right site (-1: outside)\n";
    for (const agvd::SurfacePoint& point : diagram.points) {
        append_line(bytes, "v ", position(surface.mesh.view(), point));
    }
    for (Index e = 0; e < num_edges(diagram); ++e) {
        const agvd::VoronoiEdge& edge = diagram.edges[e];
        append_line(bytes, "# sites ", std::array{site_number(edge.left), site_number(edge.right)});
        append_line(bytes, "l ", polyline(diagram, e, 1));
    }
    return bytes;
}

std::string format_labels(const Surface& surface, const agvd::Propagation& propagation) {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\n"
        "comment site: nearest site (-1: none reaches); distance: geodesic, to that site\n"
        "element vertex " +
        std::to_string(surface.num_vertices()) +
        "\nproperty double x\nproperty double y\nproperty double z\n"
        "property int site\nproperty double distance\n"
        "element face " +
        std::to_string(surface.num_faces()) +
        "\nproperty list uchar int vertex_indices\nend_header\n";
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        for (const double coordinate : surface.mesh.positions[v]) append(bytes, coordinate);
        append(bytes, site_number(propagation.vertex_site[v]));
        append(bytes, propagation.vertex_distance[v]);
    }
    for (const agvd::Triangle& t : surface.mesh.triangles) {
        append(bytes, std::uint8_t{3});
        for (const Index v : t) append(bytes, v);
    }
    return bytes;
}

}  // namespace

void write_diagram(const std::filesystem::path& path, const Surface& surface,
                   const agvd::Propagation& propagation, const Diagram& diagram) {
    const std::string extension = lower_extension(path);
    if (extension == ".vtp") {
        write_file_atomically(path, format_vtp(surface, diagram));
    } else if (extension == ".obj") {
        write_file_atomically(path, format_obj_lines(surface, diagram));
    } else if (extension == ".ply") {
        write_file_atomically(path, format_labels(surface, propagation));
    } else {
        throw agvd::IoError(path.string() + ": unknown extension; use .vtp, .obj or .ply");
    }
}

bool is_known_diagram_extension(const std::filesystem::path& path) {
    const std::string extension = lower_extension(path);
    return extension == ".vtp" || extension == ".obj" || extension == ".ply";
}

}  // namespace remesh
