#include "remesh/io/write_diagram.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>
#include <string>

#include "agvd/core/error.h"
#include "remesh/io/atomic_file.h"

namespace remesh {
namespace {

using agvd::Diagram;
using agvd::Index;
using agvd::SiteId;
using agvd::Surface;
using agvd::Vec3;

// In files, where an id can be missing, -1 says so.
std::int32_t site_number(SiteId site) {
    return site.is_valid() ? static_cast<std::int32_t>(site.value()) : -1;
}

// Text of any number: shortest decimals that read back to the same double.
template <typename Number>
void put(std::string& out, Number value, char end) {
    char buffer[32];
    out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
    out += end;
}

void put(std::string& out, const Vec3& p) {
    put(out, p.x(), ' ');
    put(out, p.y(), ' ');
    put(out, p.z(), '\n');
}

// The machine is little-endian, as is the file.
template <typename Number>
void put_bytes(std::string& out, Number value) {
    static_assert(std::endian::native == std::endian::little);
    char buffer[sizeof value];
    std::memcpy(buffer, &value, sizeof value);
    out.append(buffer, sizeof value);
}

// Calls visit(point) for the polyline of an edge; a closed curve comes back to its first point.
template <typename Visit>
void for_each_point(const Diagram& diagram, Index edge, const Visit& visit) {
    const Index begin = diagram.edge_points[edge];
    const Index end = diagram.edge_points[edge + 1];
    for (Index p = begin; p < end; ++p) visit(p);
    if (diagram.edges[edge].tail == agvd::no_index && begin < end) visit(begin);
}

Index num_edges(const Diagram& diagram) { return static_cast<Index>(diagram.edges.size()); }

template <typename Values>
void put_array(std::string& out, const char* attributes, const Values& values) {
    out += std::string("<DataArray format=\"ascii\" ") + attributes + ">\n";
    values();
    out += "</DataArray>\n";
}

std::string vtp_bytes(const Surface& surface, const Diagram& diagram) {
    std::string out =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n"
        "<Piece NumberOfPoints=\"" +
        std::to_string(diagram.points.size()) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
        std::to_string(diagram.edges.size()) +
        "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<PointData Scalars=\"distance\">\n";
    put_array(out, "type=\"Float64\" Name=\"distance\"", [&] {
        for (const double d : diagram.point_distance) put(out, d, '\n');
    });
    out += "</PointData>\n<CellData>\n";
    put_array(out, "type=\"Int32\" Name=\"site_left\"", [&] {
        for (const agvd::VoronoiEdge& e : diagram.edges) put(out, site_number(e.left), '\n');
    });
    put_array(out, "type=\"Int32\" Name=\"site_right\"", [&] {
        for (const agvd::VoronoiEdge& e : diagram.edges) put(out, site_number(e.right), '\n');
    });
    out += "</CellData>\n<Points>\n";
    put_array(out, "type=\"Float64\" NumberOfComponents=\"3\"", [&] {
        for (const auto& point : diagram.points) put(out, position(surface.mesh.view(), point));
    });
    out += "</Points>\n<Lines>\n";
    std::string offsets;
    std::size_t offset = 0;
    put_array(out, "type=\"Int64\" Name=\"connectivity\"", [&] {
        for (Index e = 0; e < num_edges(diagram); ++e) {
            for_each_point(diagram, e, [&](Index p) {
                put(out, p, ' ');
                ++offset;
            });
            out += '\n';
            put(offsets, offset, '\n');
        }
    });
    put_array(out, "type=\"Int64\" Name=\"offsets\"", [&] { out += offsets; });
    return out + "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string obj_bytes(const Surface& surface, const Diagram& diagram) {
    std::string out = "# Voronoi edges; before each its left and right site (-1: outside)\n";
    for (const agvd::SurfacePoint& point : diagram.points) {
        out += "v ";
        put(out, position(surface.mesh.view(), point));
    }
    for (Index e = 0; e < num_edges(diagram); ++e) {
        out += "# sites ";
        put(out, site_number(diagram.edges[e].left), ' ');
        put(out, site_number(diagram.edges[e].right), '\n');
        out += "l";
        for_each_point(diagram, e, [&](Index p) {
            out += ' ';
            out += std::to_string(p + 1);
        });
        out += '\n';
    }
    return out;
}

std::string ply_bytes(const Surface& surface, const agvd::Propagation& propagation) {
    std::string out =
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
        for (const double coordinate : surface.mesh.positions[v]) put_bytes(out, coordinate);
        put_bytes(out, site_number(propagation.vertex_site[v]));
        put_bytes(out, propagation.vertex_distance[v]);
    }
    for (const agvd::Triangle& t : surface.mesh.triangles) {
        out += '\3';
        for (const Index v : t) put_bytes(out, v);
    }
    return out;
}

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

}  // namespace

void write_diagram(const std::filesystem::path& path, const Surface& surface,
                   const agvd::Propagation& propagation, const Diagram& diagram) {
    const std::string extension = lower_extension(path);
    if (extension == ".vtp") {
        write_file_atomically(path, vtp_bytes(surface, diagram));
    } else if (extension == ".obj") {
        write_file_atomically(path, obj_bytes(surface, diagram));
    } else if (extension == ".ply") {
        write_file_atomically(path, ply_bytes(surface, propagation));
    } else {
        throw agvd::IoError(path.string() + ": unknown extension; use .vtp, .obj or .ply");
    }
}

bool is_known_diagram_extension(const std::filesystem::path& path) {
    const std::string extension = lower_extension(path);
    return extension == ".vtp" || extension == ".obj" || extension == ".ply";
}

}  // namespace remesh
