// Formats a diagram (docs/io.md, "Diagrams"): VTK PolyData of surface, edges and sites, OBJ lines,
// or a mesh whose vertices have labels and distances. The format .agvd is such a PLY with further
// elements: all that read_diagram() needs to give every bit back.
#include "remesh/meshfile/write_diagram.h"

#include <algorithm>
#include <string>

#include "agvd/core/error.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/byte_order.h"
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/gzip.h"
#include "remesh/meshfile/text_format.h"
#include "remesh/meshfile/vtp_writer.h"

namespace remesh {
namespace {

// What is written. Refers to the caller's arrays.
struct DrawnDiagram {
    const Surface& surface;
    std::span<const SurfacePoint> sites;
    const Diagram& diagram;

    [[nodiscard]] Vec3 position(const SurfacePoint& point) const {
        return agvd::position(surface.mesh.view(), point);
    }
};

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
    if (diagram.edges[edge].tail == no_index) points.push_back(first + begin);
    return points;
}

Index num_edges(const Diagram& diagram) { return static_cast<Index>(diagram.edges.size()); }

// Points of a file: those of the mesh, of the sites, and of the edges.
struct LabelledPoints {
    std::vector<Vec3> positions;
    std::vector<std::int32_t> sites;
    std::vector<double> distances;

    void add(const Vec3& position, SiteId site, double distance) {
        positions.push_back(position);
        sites.push_back(site_number(site));
        distances.push_back(distance);
    }
};

LabelledPoints labelled_points(const DrawnDiagram& drawn, Ticker& ticker) {
    const Diagram& diagram = drawn.diagram;
    LabelledPoints points;
    for (Index v = 0; v < drawn.surface.num_vertices(); ++v) {
        ticker.tick();
        points.add(drawn.surface.mesh.positions[v], diagram.nearest_site[v],
                   diagram.nearest_distance[v]);
    }
    for (Index s = 0; s < diagram.num_sites; ++s) {
        points.add(drawn.position(drawn.sites[s]), SiteId(s), 0);
    }
    for (Index e = 0; e < num_edges(diagram); ++e) {
        for (Index p = diagram.edge_points[e]; p < diagram.edge_points[e + 1]; ++p) {
            ticker.tick();
            points.add(drawn.position(diagram.points[p]), diagram.edges[e].left,
                       diagram.point_distance[p]);
        }
    }
    return points;
}

// The sides of all cells of the file: sites, edges, faces.
std::vector<std::int32_t> sides_of_cells(const DrawnDiagram& drawn, SiteId VoronoiEdge::*side) {
    std::vector<std::int32_t> numbers(drawn.diagram.num_sites, -1);
    for (const VoronoiEdge& edge : drawn.diagram.edges) {
        numbers.push_back(site_number(edge.*side));
    }
    numbers.resize(numbers.size() + drawn.surface.num_faces(), -1);
    return numbers;
}

std::string format_vtp_diagram(const DrawnDiagram& drawn, Ticker ticker) {
    const Index first_site = drawn.surface.num_vertices(), num_sites = drawn.diagram.num_sites;
    const LabelledPoints points = labelled_points(drawn, ticker);
    VtpWriter writer({.points = points.positions.size(),
                      .verts = num_sites,
                      .lines = drawn.diagram.edges.size(),
                      .polys = drawn.surface.num_faces()});
    const auto add_numbers = [&]<typename T>(const char* name, const char* type,
                                             const std::vector<T>& numbers) {
        writer.add_array<T>(name, type, 1, numbers.size(), ticker,
                            [&](std::size_t i) { return std::array{numbers[i]}; });
    };
    writer.begin_section("PointData", " Scalars=\"distance\"");
    add_numbers("site", "Int32", points.sites);
    add_numbers("distance", "Float64", points.distances);
    writer.end_section();
    writer.begin_section("CellData");
    add_numbers("site_left", "Int32", sides_of_cells(drawn, &VoronoiEdge::left));
    add_numbers("site_right", "Int32", sides_of_cells(drawn, &VoronoiEdge::right));
    writer.end_section();
    writer.begin_section("Points");
    writer.add_array<double>("Points", "Float64", 3, points.positions.size(), ticker,
                             [&](std::size_t p) { return points.positions[p]; });
    writer.end_section();
    writer.add_cells("Verts", num_sites, ticker,
                     [&](std::size_t s) { return std::array{first_site + s}; });
    writer.add_cells("Lines", drawn.diagram.edges.size(), ticker, [&](std::size_t e) {
        return polyline(drawn.diagram, static_cast<Index>(e), first_site + num_sites);
    });
    writer.add_cells("Polys", drawn.surface.num_faces(), ticker,
                     [&](std::size_t f) { return drawn.surface.mesh.triangles[f]; });
    return std::move(writer).finish();
}

std::string format_obj_lines(const DrawnDiagram& drawn, Ticker ticker) {
    const Diagram& diagram = drawn.diagram;
    std::string bytes = "# Voronoi edges; before each its left and right site (-1: outside)\n";
    for (const SurfacePoint& point : diagram.points) {
        ticker.tick(4);
        append_line(bytes, "v ", drawn.position(point));
    }
    for (Index e = 0; e < num_edges(diagram); ++e) {
        const VoronoiEdge& edge = diagram.edges[e];
        ticker.tick(4);
        append_line(bytes, "# sites ", std::array{site_number(edge.left), site_number(edge.right)});
        append_line(bytes, "l ", polyline(diagram, e, 1));
    }
    return bytes;
}

// The vertices' labels and distances.
MeshAttributes labels_of(const Diagram& diagram) {
    Attribute site{.name = "site", .type = NumberType::Int32};
    for (const SiteId s : diagram.nearest_site) site.values.push_back(site_number(s));
    return {
        .of_vertices = {std::move(site), {.name = "distance", .values = diagram.nearest_distance}}};
}

std::string format_ply_mesh(const DrawnDiagram& drawn, Ticker ticker) {
    return format_ply(drawn.surface.mesh.view(), labels_of(drawn.diagram), ticker);
}

void append_point(std::string& bytes, const SurfacePoint& point) {
    append(bytes, point.face.value());
    for (const double b : point.barycentric) append(bytes, b);
}

template <typename Items, typename NumberOf>
void append_list(std::string& bytes, const Items& items, const NumberOf& number_of) {
    append(bytes, static_cast<std::uint32_t>(items.size()));
    for (const auto& item : items) append(bytes, number_of(item));
}

// Of the elements behind vertices and faces.
std::string diagram_header(const Diagram& diagram) {
    const auto element = [](const char* name, std::size_t count) {
        return std::string("element ") + name + ' ' + std::to_string(count) + '\n';
    };
    const std::string point =
        "property int face\nproperty double b0\nproperty double b1\nproperty double b2\n";
    return "comment geodesic Voronoi diagram; -1 stands for none\n"
           "comment vertex: site whose cell holds it, and geodesic distance from that\n"
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
           "property list uint int sites\n";
}

std::string format_whole_diagram(const DrawnDiagram& drawn, Ticker ticker) {
    const Diagram& diagram = drawn.diagram;
    std::string bytes = format_ply_mesh(drawn, ticker);
    bytes.insert(bytes.find("end_header\n"), diagram_header(diagram));
    for (Index s = 0; s < diagram.num_sites; ++s) {
        append_point(bytes, drawn.sites[s]);
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
                    [](const EdgeEnd& end) { return 2 * end.edge + (end.is_tail ? 0 : 1); });
        append_list(bytes, std::span(diagram.vertex_sites).subspan(begin, degree), site_number);
    }
    return bytes;
}

struct DiagramFormat {
    std::string_view extension;
    std::string (*format)(const DrawnDiagram&, Ticker);
};
constexpr DiagramFormat diagram_formats[] = {{".vtp", format_vtp_diagram},
                                             {".ply", format_ply_mesh},
                                             {".obj", format_obj_lines},
                                             {".agvd", format_whole_diagram}};

const DiagramFormat& require_diagram_format(const std::filesystem::path& path) {
    const std::string extension = lower_extension(is_compressed({path}) ? path.stem() : path);
    for (const DiagramFormat& format : diagram_formats) {
        if (extension == format.extension) return format;
    }
    throw IoError(path.string() + ": unknown extension " + in_quotes(path.extension().string()) +
                  "; use .vtp, .ply, .obj or .agvd");
}

}  // namespace

std::string format_diagram(const std::filesystem::path& path, const Surface& surface,
                           std::span<const SurfacePoint> sites, const Diagram& diagram,
                           const Progress& progress) {
    Poller poller(progress);
    const Ticker ticker(poller);
    std::string bytes = require_diagram_format(path).format({surface, sites, diagram}, ticker);
    return is_compressed({path}) ? pack_gzip(bytes, ticker) : bytes;
}

void write_diagram(const std::filesystem::path& path, const Surface& surface,
                   std::span<const SurfacePoint> sites, const Diagram& diagram,
                   const Progress& progress) {
    write_file_atomically(path, format_diagram(path, surface, sites, diagram, progress), progress);
}

void check_diagram_extension(const std::filesystem::path& path) {
    static_cast<void>(require_diagram_format(path));
}

}  // namespace remesh
