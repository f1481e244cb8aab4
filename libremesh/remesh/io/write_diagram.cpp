// Formats a diagram as VTK PolyData, OBJ lines or PLY (docs/io.md, "Diagrams"). The first two hold
// the Voronoi edges as polylines; PLY also holds the cleaned mesh, nearest sites and distances, and
// all that read_diagram() needs to give every bit back.
#include "remesh/io/write_diagram.h"

#include <string>

#include "agvd/core/error.h"
#include "remesh/io/atomic_file.h"
#include "remesh/io/byte_order.h"
#include "remesh/io/formats.h"
#include "remesh/io/text_format.h"
#include "remesh/io/vtp_writer.h"

namespace remesh {
namespace {

using agvd::Diagram;
using agvd::Index;
using agvd::SiteId;
using agvd::Surface;

// In files -1 stands for a missing id.
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

std::string format_vtp_lines(const Surface& surface, const Diagram& diagram, agvd::Ticker ticker) {
    const std::size_t num_points = diagram.points.size();
    const std::size_t num_lines = diagram.edges.size();
    VtpWriter writer({.points = num_points, .lines = num_lines});
    writer.begin_section("PointData", " Scalars=\"distance\"");
    writer.add_array<double>("distance", "Float64", 1, num_points, ticker,
                             [&](std::size_t p) { return std::array{diagram.point_distance[p]}; });
    writer.end_section();
    writer.begin_section("CellData");
    writer.add_array<std::int32_t>("site_left", "Int32", 1, num_lines, ticker, [&](std::size_t e) {
        return std::array{site_number(diagram.edges[e].left)};
    });
    writer.add_array<std::int32_t>("site_right", "Int32", 1, num_lines, ticker, [&](std::size_t e) {
        return std::array{site_number(diagram.edges[e].right)};
    });
    writer.end_section();
    writer.begin_section("Points");
    writer.add_array<double>("Points", "Float64", 3, num_points, ticker, [&](std::size_t p) {
        return position(surface.mesh.view(), diagram.points[p]);
    });
    writer.end_section();
    writer.begin_section("Lines");
    std::vector<std::size_t> ends;
    writer.add_array<std::int64_t>(
        "connectivity", "Int64", 1, num_lines, ticker, [&](std::size_t e) {
            std::vector<Index> points = polyline(diagram, static_cast<Index>(e), 0);
            ends.push_back((ends.empty() ? 0 : ends.back()) + points.size());
            return points;
        });
    writer.add_array<std::int64_t>("offsets", "Int64", 1, num_lines, ticker,
                                   [&](std::size_t e) { return std::array{ends[e]}; });
    writer.end_section();
    return std::move(writer).finish();
}

std::string format_obj_lines(const Surface& surface, const Diagram& diagram, agvd::Ticker ticker) {
    std::string bytes = "# Voronoi edges; before each its left and right site (-1: outside)\n";
    for (const agvd::SurfacePoint& point : diagram.points) {
        ticker.tick(4);
        append_line(bytes, "v ", position(surface.mesh.view(), point));
    }
    for (Index e = 0; e < num_edges(diagram); ++e) {
        const agvd::VoronoiEdge& edge = diagram.edges[e];
        ticker.tick(4);
        append_line(bytes, "# sites ", std::array{site_number(edge.left), site_number(edge.right)});
        append_line(bytes, "l ", polyline(diagram, e, 1));
    }
    return bytes;
}

void append_point(std::string& bytes, const agvd::SurfacePoint& point) {
    append(bytes, point.face.value());
    for (const double b : point.barycentric) append(bytes, b);
}

template <typename Items, typename NumberOf>
void append_list(std::string& bytes, const Items& items, const NumberOf& number_of) {
    append(bytes, static_cast<std::uint32_t>(items.size()));
    for (const auto& item : items) append(bytes, number_of(item));
}

std::string ply_header(const Surface& surface, const Diagram& diagram) {
    const auto element = [](const char* name, std::size_t count) {
        return std::string("element ") + name + ' ' + std::to_string(count) + '\n';
    };
    const std::string point =
        "property int face\nproperty double b0\nproperty double b1\nproperty double b2\n";
    return "ply\nformat binary_little_endian 1.0\n"
           "comment geodesic Voronoi diagram; -1 stands for none\n"
           "comment vertex: site whose cell holds it, and geodesic distance from that\n" +
           element("vertex", surface.num_vertices()) +
           "property double x\nproperty double y\nproperty double z\n"
           "property int site\nproperty double distance\n" +
           element("face", surface.num_faces()) +
           "property list uchar int vertex_indices\n"
           "comment points lie in a face at barycentric coordinates of its corners\n" +
           element("site", diagram.num_sites) + point +
           "property double cell_area\nproperty int cell_euler\n"
           "comment points of the voronoi edges in turn\n" +
           element("curve_point", diagram.points.size()) + point + "property double distance\n" +
           "comment tail and head: voronoi vertices, -1 for a closed curve\n" +
           element("voronoi_edge", diagram.edges.size()) +
           "property int site_left\nproperty int site_right\nproperty int tail\n"
           "property int head\nproperty int num_points\n"
           "comment ends, counter-clockwise: 2 * edge, + 1 for its head; sites: the cells after "
           "them\n" +
           element("voronoi_vertex", diagram.vertices.size()) + point +
           "property double distance\nproperty list uint int ends\n"
           "property list uint int sites\nend_header\n";
}

std::string format_ply_diagram(const Surface& surface, std::span<const agvd::SurfacePoint> sites,
                               const Diagram& diagram, agvd::Ticker ticker) {
    std::string bytes = ply_header(surface, diagram);
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        ticker.tick();
        for (const double coordinate : surface.mesh.positions[v]) append(bytes, coordinate);
        append(bytes, site_number(diagram.nearest_site[v]));
        append(bytes, diagram.nearest_distance[v]);
    }
    for (const agvd::Triangle& t : surface.mesh.triangles) {
        ticker.tick();
        append(bytes, std::uint8_t{3});
        for (const Index v : t) append(bytes, v);
    }
    for (Index s = 0; s < diagram.num_sites; ++s) {
        append_point(bytes, sites[s]);
        append(bytes, diagram.cell_area[s]);
        append(bytes, std::int32_t{diagram.cell_euler[s]});
    }
    for (std::size_t p = 0; p < diagram.points.size(); ++p) {
        ticker.tick();
        append_point(bytes, diagram.points[p]);
        append(bytes, diagram.point_distance[p]);
    }
    for (Index e = 0; e < num_edges(diagram); ++e) {
        ticker.tick();
        const auto& [left, right, tail, head] = diagram.edges[e];
        append(bytes, site_number(left));
        append(bytes, site_number(right));
        append(bytes, tail);  // no_index has the bits of -1.
        append(bytes, head);
        append(bytes, diagram.edge_points[e + 1] - diagram.edge_points[e]);
    }
    for (std::size_t v = 0; v < diagram.vertices.size(); ++v) {
        ticker.tick();
        append_point(bytes, diagram.vertices[v]);
        append(bytes, diagram.vertex_distance[v]);
        const Index begin = diagram.vertex_offsets[v];
        const Index degree = diagram.vertex_offsets[v + 1] - begin;
        append_list(bytes, std::span(diagram.vertex_ends).subspan(begin, degree),
                    [](const agvd::EdgeEnd& end) { return 2 * end.edge + (end.is_tail ? 0 : 1); });
        append_list(bytes, std::span(diagram.vertex_sites).subspan(begin, degree), site_number);
    }
    return bytes;
}

}  // namespace

std::string format_diagram(const std::filesystem::path& path, const Surface& surface,
                           std::span<const agvd::SurfacePoint> sites, const Diagram& diagram,
                           const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    const agvd::Ticker ticker(poller);
    const std::string extension = lower_extension(path);
    if (extension == ".vtp") return format_vtp_lines(surface, diagram, ticker);
    if (extension == ".obj") return format_obj_lines(surface, diagram, ticker);
    if (extension == ".ply") return format_ply_diagram(surface, sites, diagram, ticker);
    throw agvd::IoError(path.string() + ": unknown extension " +
                        in_quotes(path.extension().string()) + "; use .vtp, .obj or .ply");
}

void write_diagram(const std::filesystem::path& path, const Surface& surface,
                   std::span<const agvd::SurfacePoint> sites, const Diagram& diagram,
                   const agvd::Progress& progress) {
    write_file_atomically(path, format_diagram(path, surface, sites, diagram, progress), progress);
}

bool is_known_diagram_extension(const std::filesystem::path& path) {
    const std::string extension = lower_extension(path);
    return extension == ".vtp" || extension == ".obj" || extension == ".ply";
}

}  // namespace remesh
