// Formats of a diagram (docs/io.md, "Diagrams"). The format .agvd is a PLY with further elements:
// all that read_diagram() needs to give every bit back.
#include "remesh/meshfile/diagram_file.h"

#include <set>

#include "agvd/mesh/surface_points.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/diagram_arcs.h"
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/ply_values.h"
#include "remesh/meshfile/vtk_output.h"

namespace remesh {
namespace {

// The elements of the file that make the diagram; each is read once the mesh is known.
template <typename Values>
class DiagramReader {
public:
    DiagramReader(const SourceFile& file, const PlyHeader& header, DiagramFile& out)
        : file_(file), header_(header), ticker_(file.ticker), values_(file, header), out_(out) {}

    void read() {
        for (const PlyElement& element : header_.elements) {
            // Without properties it has no bytes, so that its count may be anything.
            if (!element.properties.empty()) count_.try_emplace(element.name, element.count);
        }
        count_["face"] = out_.mesh.triangles.size();  // Other polygons were dropped.
        for (const char* name : {"site", "curve_point", "voronoi_edge", "voronoi_vertex"}) {
            if (!count_.contains(name)) {
                file_.fail_malformed(0, "the file has no element ", name,
                                     ", so that it holds no diagram; write one with `agvd diagram "
                                     "MESH -o FILE.agvd`");
            }
            if (count_.at(name) >= no_index) fail("there are more than 2^32 - 2 elements");
        }
        out_.diagram.edge_points = out_.diagram.vertex_offsets = {0};
        std::set<std::string> names;
        for (const PlyElement& element : header_.elements) {
            if (element.properties.empty()) continue;
            const bool is_first = names.insert(element.name).second;
            for (std::uint64_t i = 0; i < element.count; ++i) {
                ticker_.tick(8);
                start_ = values_.offset();
                if (is_first) {
                    read_item(element, i);
                } else {
                    skip_element(values_, element, i, file_);
                }
            }
        }
        Diagram& diagram = out_.diagram;
        diagram.num_sites = static_cast<Index>(diagram.cell_area.size());
        if (count_.contains("site_point") || count_.contains("site_shape")) take_points();
        if (diagram.edge_points.back() != diagram.points.size()) {
            fail("the Voronoi edges do not have all curve points");
        }
        if (count_.contains("arc")) count_arcs();
    }

private:
    // Each cell has a point or a shape, or a site would have no place.
    void take_points() {
        std::vector<bool> has_place(out_.sites.size(), false);
        for (const Index site : out_.points.site) has_place[site] = true;
        for (const GivenShape& shape : out_.shapes) has_place[shape.site] = true;
        if (std::find(has_place.begin(), has_place.end(), false) != has_place.end()) {
            fail("a site has no point");
        }
        out_.sites = std::move(points_);
        SitePoints& points = out_.points;
        bool are_sites = true;
        for (Index i = 0; i < points.site.size(); ++i) {
            are_sites = are_sites && points.site[i] == i;
        }
        if (are_sites) points.site.clear();
        if (std::all_of(points.start.begin(), points.start.end(),
                        [](double start) { return start == 0; })) {
            points.start.clear();
        }
    }

    void read_item(const PlyElement& element, std::uint64_t i) {
        Diagram& diagram = out_.diagram;
        if (element.name == "vertex") {
            read_row(element, i, {"site", "distance"}, {});
            diagram.nearest_site.push_back(site(row_[0]));
            diagram.nearest_distance.push_back(row_[1]);
        } else if (element.name == "site") {
            read_row(element, i, {"face", "b0", "b1", "b2", "cell_area", "cell_euler"}, {});
            out_.sites.push_back(point());
            diagram.cell_area.push_back(row_[4]);
            if (!(std::abs(row_[5]) < INT32_MAX))
                fail("the Euler characteristic of a cell is out of range");
            diagram.cell_euler.push_back(static_cast<int>(row_[5]));
        } else if (element.name == "site_point") {
            read_row(element, i, {"face", "b0", "b1", "b2", "site", "start"}, {});
            points_.push_back(point());
            out_.points.site.push_back(index(row_[4], "site"));
            out_.points.start.push_back(row_[5]);
            if (!(row_[5] >= 0)) fail("a point starts at a distance below 0");
        } else if (element.name == "site_shape") {
            read_shape(element, i);
        } else if (element.name == "curve_point") {
            read_row(element, i, {"face", "b0", "b1", "b2", "distance"}, {});
            diagram.points.push_back(point());
            diagram.point_distance.push_back(row_[4]);
        } else if (element.name == "voronoi_edge") {
            read_edge(element, i);
        } else if (element.name == "voronoi_vertex") {
            read_vertex(element, i);
        } else if (element.name == "arc") {
            read_arc(element, i);
        } else {
            skip_element(values_, element, i, file_);
        }
    }

    void read_shape(const PlyElement& element, std::uint64_t i) {
        read_row(element, i, {"site", "start"}, {"edges", "faces"});
        GivenShape shape{.site = index(row_[0], "site"), .start = row_[1]};
        if (!(shape.start >= 0)) fail("a line or region starts at a distance below 0");
        const std::vector<double>& ends = lists_[0];
        if (ends.size() % 2 != 0) fail("an edge of a line has only one end");
        for (std::size_t k = 0; k < ends.size(); k += 2) {
            shape.edges.push_back({index(ends[k], "vertex"), index(ends[k + 1], "vertex")});
        }
        for (const double face : lists_[1]) shape.faces.push_back(index(face, "face"));
        if (shape.edges.empty() && shape.faces.empty()) fail("a line or region is empty");
        out_.shapes.push_back(std::move(shape));
    }

    void read_edge(const PlyElement& element, std::uint64_t i) {
        read_row(element, i, {"site_left", "site_right", "tail", "head", "num_points"}, {});
        Diagram& diagram = out_.diagram;
        const VoronoiEdge edge{site(row_[0]), site(row_[1]),
                               optional_index(row_[2], "voronoi_vertex"),
                               optional_index(row_[3], "voronoi_vertex")};
        if (!edge.left.is_valid()) fail("a Voronoi edge has no cell on its left");
        if ((edge.tail == no_index) != (edge.head == no_index)) {
            fail("a Voronoi edge has only one end");
        }
        diagram.edges.push_back(edge);
        const Index before = diagram.edge_points.back();
        const double least = edge.tail == no_index ? 1 : 2;
        const auto left = static_cast<double>(count_.at("curve_point")) - before;
        if (!(row_[4] >= least && row_[4] <= left))
            fail("a Voronoi edge has too few or too many points");
        diagram.edge_points.push_back(before + static_cast<Index>(row_[4]));
    }

    void read_vertex(const PlyElement& element, std::uint64_t i) {
        read_row(element, i, {"face", "b0", "b1", "b2", "distance"}, {"ends", "sites"});
        Diagram& diagram = out_.diagram;
        diagram.vertices.push_back(point());
        diagram.vertex_distance.push_back(row_[4]);
        if (lists_[0].size() != lists_[1].size())
            fail("a Voronoi vertex has different numbers of ends and sites");
        for (const double end : lists_[0]) {
            const double half = std::floor(end / 2);
            diagram.vertex_ends.push_back({index(half, "voronoi_edge"), end == 2 * half});
        }
        for (const double label : lists_[1]) diagram.vertex_sites.push_back(site(label));
        diagram.vertex_offsets.push_back(static_cast<Index>(diagram.vertex_ends.size()));
    }

    void read_arc(const PlyElement& element, std::uint64_t i) {
        read_row(element, i, arc_properties, {});
        if (!(row_[2] >= 0 && row_[2] <= static_cast<double>(ArcKind::Chord)) ||
            row_[2] != std::floor(row_[2])) {
            fail("an arc has a kind that does not exist");
        }
        const auto at = [&](std::size_t k) { return Vec2(row_[k], row_[k + 1]); };
        arc_edges_.push_back(index(row_[0], "voronoi_edge"));
        out_.diagram.arcs.push_back({FaceId(index(row_[1], "face")),
                                     static_cast<ArcKind>(row_[2]),
                                     index(row_[3], "curve_point"),
                                     {at(6), at(9)},
                                     {row_[8], row_[11]},
                                     at(12),
                                     at(14)});
    }

    // Edges have their arcs in turn, each from one of the edge's points on.
    void count_arcs() {
        Diagram& diagram = out_.diagram;
        diagram.edge_arcs.assign(1, 0);
        Index a = 0;
        for (Index e = 0; e < diagram.edges.size(); ++e) {
            Index least = diagram.edge_points[e];
            for (; a < arc_edges_.size() && arc_edges_[a] == e; ++a) {
                const Index first = diagram.arcs[a].first_point;
                if (first < least || first >= diagram.edge_points[e + 1]) {
                    fail("an arc begins beside its Voronoi edge");
                }
                least = first + 1;
            }
            diagram.edge_arcs.push_back(a);
        }
        if (a != arc_edges_.size()) fail("arcs are not in the order of the Voronoi edges");
    }

    // Fills row_ and lists_ with the properties of these names, of whatever type.
    void read_row(const PlyElement& element, std::uint64_t i,
                  std::initializer_list<const char*> numbers,
                  std::initializer_list<const char*> lists) {
        row_.assign(numbers.size(), 0);
        lists_.resize(lists.size());
        std::size_t num_found = 0;
        const auto place = [&](std::initializer_list<const char*> names, const std::string& name) {
            return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) -
                                            names.begin());
        };
        values_.begin(element, i);
        for (const PlyProperty& property : element.properties) {
            const bool is_list = property.size_type.has_value();
            const std::size_t at = place(is_list ? lists : numbers, property.name);
            if (at == (is_list ? lists : numbers).size()) {
                skip_property(values_, property, file_);
                continue;
            }
            ++num_found;
            if (!is_list) {
                row_[at] = values_.real(property.type);
                continue;
            }
            lists_[at].clear();
            for (std::int64_t k = read_length(values_, property, file_); k > 0; --k) {
                lists_[at].push_back(values_.real(property.type));
            }
        }
        values_.end();
        if (num_found != numbers.size() + lists.size()) {
            file_.fail_malformed(
                0, "element ", element.name,
                " lacks properties of a diagram; write one with `agvd diagram MESH -o FILE.agvd`");
        }
    }

    [[nodiscard]] SurfacePoint point() const {
        SurfacePoint point{FaceId(index(row_[0], "face")), {row_[1], row_[2], row_[3]}};
        constexpr double tolerance = 1e-9;
        const auto& b = point.barycentric;
        if (!(b[0] >= -tolerance && b[1] >= -tolerance && b[2] >= -tolerance &&
              std::abs(b[0] + b[1] + b[2] - 1) <= tolerance)) {
            fail("barycentric coordinates are negative or do not sum to 1");
        }
        return point;
    }

    [[nodiscard]] SiteId site(double number) const {
        return SiteId(optional_index(number, "site"));
    }
    [[nodiscard]] Index optional_index(double number, const char* element) const {
        return number == -1 ? no_index : index(number, element);
    }
    [[nodiscard]] Index index(double number, const char* element) const {
        const auto found = count_.find(element);
        if (!(number >= 0 && found != count_.end() && number < static_cast<double>(found->second) &&
              number == std::floor(number))) {
            fail("the file names a ", element, " that does not exist");
        }
        return static_cast<Index>(number);
    }

    template <typename... Parts>
    [[noreturn]] void fail(Parts... parts) const {
        file_.fail_unusable(start_, parts...,
                            "; the file is damaged: write the diagram again with `agvd diagram`");
    }

    const SourceFile& file_;
    const PlyHeader& header_;
    Ticker ticker_;
    Values values_;
    DiagramFile& out_;
    std::map<std::string, std::uint64_t> count_;  // Of each element, as announced.
    std::size_t start_ = 0;                       // Of the item being read.
    std::vector<double> row_;                     // Numbers of it: 32-bit integers fit.
    std::vector<std::vector<double>> lists_;
    std::vector<Index> arc_edges_;      // Of each arc.
    std::vector<SurfacePoint> points_;  // Of sites, where they are not the sites themselves.
};

// What is written. Refers to the caller's arrays.
struct DrawnDiagram {
    const Surface& surface;
    std::span<const SurfacePoint> sites;
    const Diagram& diagram;
    const SitePoints& points;  // What the sites stand for.
    std::span<const SiteShape> shapes;

    [[nodiscard]] double start_of(Index site) const {
        return points.start.empty() ? 0 : points.start[site];
    }
    [[nodiscard]] Vec3 position(const SurfacePoint& point) const {
        return agvd::position(surface.mesh.view(), point);
    }
};

// In files -1 stands for a missing id.
std::int32_t site_number(SiteId site) {
    return site.is_valid() ? static_cast<std::int32_t>(site.value()) : -1;
}

Index num_edges(const Diagram& diagram) { return static_cast<Index>(diagram.edges.size()); }

// The points of an edge's polyline, counted from `first`; a closed curve comes back to its first.
std::vector<Index> polyline(const Diagram& diagram, Index edge, Index first) {
    std::vector<Index> points;
    const Index begin = diagram.edge_points[edge];
    const Index end = diagram.edge_points[edge + 1];
    for (Index p = begin; p < end; ++p) points.push_back(first + p);
    if (diagram.edges[edge].tail == no_index) points.push_back(first + begin);
    return points;
}

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
    for (Index i = 0; i < drawn.sites.size(); ++i) {
        points.add(drawn.position(drawn.sites[i]), SiteId(drawn.points.site_of(i)),
                   drawn.start_of(i));
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

// A polyline of a VTP file: a Voronoi edge, or an arc of one.
struct VtpLine {
    Index edge;
    const BisectorArc* arc;  // Null for a whole edge.
    Index begin, end;        // Its points.
    bool is_closed = false;  // The edge's first point is its last one.
};

std::vector<VtpLine> vtp_lines(const Diagram& diagram) {
    std::vector<VtpLine> lines;
    for (Index e = 0; e < num_edges(diagram); ++e) {
        const std::size_t first = lines.size();
        const Index begin = diagram.edge_points[e], end = diagram.edge_points[e + 1];
        if (!diagram.edge_arcs.empty()) {
            for (Index a = diagram.edge_arcs[e]; a < diagram.edge_arcs[e + 1]; ++a) {
                const BisectorArc& arc = diagram.arcs[a];
                if (lines.size() > first) lines.back().end = arc.first_point + 1;
                lines.push_back({e, &arc, arc.first_point, end});
            }
        }
        if (lines.size() == first) lines.push_back({e, nullptr, begin, end});
        lines.back().is_closed = diagram.edges[e].tail == no_index;
    }
    return lines;
}

std::string format_vtp_diagram(const DrawnDiagram& drawn, Ticker ticker) {
    const Diagram& diagram = drawn.diagram;
    const Index first_site = drawn.surface.num_vertices();
    const auto num_sites = static_cast<Index>(drawn.sites.size());
    const LabelledPoints points = labelled_points(drawn, ticker);
    const std::vector<VtpLine> lines = vtp_lines(diagram);
    VtpWriter writer;
    // Of the cells of the file: sites, lines, faces.
    const auto add_of_lines = [&](const char* name, std::int32_t none, const auto& number_of) {
        std::vector<std::int32_t> numbers(drawn.sites.size(), none);
        for (const VtpLine& line : lines) numbers.push_back(number_of(line));
        numbers.resize(numbers.size() + drawn.surface.num_faces(), none);
        writer.add_numbers<std::int32_t>(name, "Int32", 1, numbers);
    };
    const auto side = [&](SiteId VoronoiEdge::*of_edge) {
        return [&diagram, of_edge](const VtpLine& line) {
            return site_number(diagram.edges[line.edge].*of_edge);
        };
    };
    writer.begin_section("PointData", " Scalars=\"distance\"");
    writer.add_numbers<std::int32_t>("site", "Int32", 1, points.sites);
    writer.add_numbers<double>("distance", "Float64", 1, points.distances);
    writer.end_section();
    writer.begin_section("CellData");
    add_of_lines("site_left", -1, side(&VoronoiEdge::left));
    add_of_lines("site_right", -1, side(&VoronoiEdge::right));
    if (!diagram.edge_arcs.empty()) {
        add_of_lines("edge", -1,
                     [](const VtpLine& line) { return static_cast<std::int32_t>(line.edge); });
        add_of_lines("kind", -1, [&](const VtpLine& line) {
            return line.arc == nullptr ? -1 : static_cast<std::int32_t>(line.arc->kind);
        });
        std::vector<const BisectorArc*> arcs(drawn.sites.size());
        for (const VtpLine& line : lines) arcs.push_back(line.arc);
        arcs.resize(arcs.size() + drawn.surface.num_faces());
        append_foci(writer, drawn.surface, arcs, ticker);
    }
    writer.end_section();
    writer.add_points(points.positions, ticker);
    writer.add_cells("Verts", num_sites, ticker,
                     [&](std::size_t s) { return std::array{first_site + s}; });
    std::vector<Index> polyline;
    writer.add_cells("Lines", lines.size(), ticker, [&](std::size_t i) {
        const VtpLine& line = lines[i];
        const Index first = first_site + num_sites;
        polyline.clear();
        for (Index p = line.begin; p < line.end; ++p) polyline.push_back(first + p);
        if (line.is_closed) polyline.push_back(first + diagram.edge_points[line.edge]);
        return std::span<const Index>(polyline);
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

// With the vertices' labels and distances.
std::string format_labelled_mesh(const DrawnDiagram& drawn, Ticker ticker) {
    Attribute site{.name = "site", .type = NumberType::Int32};
    for (const SiteId s : drawn.diagram.nearest_site) site.values.push_back(site_number(s));
    const Attribute distance{.name = "distance", .values = drawn.diagram.nearest_distance};
    return format_ply(drawn.surface.mesh.view(), {.of_vertices = {std::move(site), distance}},
                      ticker);
}

std::string format_ply_mesh(const DrawnDiagram& drawn, Ticker ticker) {
    std::string bytes = format_labelled_mesh(drawn, ticker);
    if (drawn.diagram.edge_arcs.empty()) return bytes;
    bytes.insert(bytes.find("end_header\n"), arc_header(drawn.diagram));
    append_arcs(bytes, drawn.diagram, ticker);
    return bytes;
}

void append_point(std::string& bytes, const SurfacePoint& point) {
    const auto& [a, b, c] = point.barycentric;
    append_all(bytes, point.face.value(), a, b, c);
}

template <typename Items, typename NumberOf>
void append_list(std::string& bytes, const Items& items, const NumberOf& number_of) {
    append(bytes, static_cast<std::uint32_t>(items.size()));
    for (const auto& item : items) append(bytes, number_of(item));
}

// A point of each site: its first one, or a corner of its first shape.
std::vector<SurfacePoint> places_of_sites(const DrawnDiagram& drawn) {
    std::vector<SurfacePoint> places(drawn.diagram.num_sites);
    for (std::size_t i = drawn.shapes.size(); i-- > 0;) {
        const SiteShape& shape = drawn.shapes[i];
        const Index h = shape.edges.empty() ? 3 * shape.faces.front()
                                            : drawn.surface.edge_half[shape.edges.front()];
        places[shape.site] = agvd::point_on(h, 0);
    }
    for (auto i = static_cast<Index>(drawn.sites.size()); i-- > 0;) {
        places[drawn.points.site_of(i)] = drawn.sites[i];
    }
    return places;
}

void append_shape(std::string& bytes, const Surface& surface, const SiteShape& shape) {
    std::vector<Index> ends;
    for (const Index edge : shape.edges) {
        const Index h = surface.edge_half[edge];
        ends.insert(ends.end(), {surface.tail(h), surface.head(h)});
    }
    const auto same = [](Index i) { return i; };
    append_all(bytes, shape.site, shape.start);
    append_list(bytes, ends, same);
    append_list(bytes, shape.faces, same);
}

// Of the elements behind vertices and faces.
// \param num_points  of sites that are not points themselves.
std::string diagram_header(const Diagram& diagram, std::size_t num_points, std::size_t num_shapes) {
    const auto element = [](const char* name, std::size_t count) {
        return std::string("element ") + name + ' ' + std::to_string(count) + '\n';
    };
    const std::string point =
        "property int face\nproperty double b0\nproperty double b1\nproperty double b2\n";
    return "comment geodesic Voronoi diagram; -1 stands for none\n"
           "comment vertex: site whose cell holds it, and geodesic distance from that\n"
           "comment points lie in a face at barycentric coordinates of its corners\n" +
           element("site", diagram.num_sites) + point +
           "property double cell_area\nproperty int cell_euler\n" +
           (num_points == 0 ? std::string()
                            : "comment points of the sites, and the distances they start with\n" +
                                  element("site_point", num_points) + point +
                                  "property int site\nproperty double start\n") +
           (num_shapes == 0
                ? std::string()
                : "comment lines: pairs of vertices, and regions, at the distance start\n" +
                      element("site_shape", num_shapes) +
                      "property int site\nproperty double start\nproperty list uint int edges\n"
                      "property list uint int faces\n") +
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
           "property list uint int sites\n" +
           (diagram.edge_arcs.empty() ? std::string() : arc_header(diagram));
}

std::string format_whole_diagram(const DrawnDiagram& drawn, Ticker ticker) {
    if (drawn.surface.has_own_lengths) {
        throw agvd::InvalidOption(
            "a .agvd file has positions only; of a mesh given by lengths write .vtp, .ply or .obj");
    }
    const Diagram& diagram = drawn.diagram;
    std::string bytes = format_labelled_mesh(drawn, ticker);
    const bool are_points =
        drawn.points.site.empty() && drawn.points.start.empty() && drawn.shapes.empty();
    const auto num_points = static_cast<Index>(are_points ? 0 : drawn.sites.size());
    bytes.insert(bytes.find("end_header\n"),
                 diagram_header(diagram, num_points, drawn.shapes.size()));
    const std::vector<SurfacePoint> places = places_of_sites(drawn);
    for (Index s = 0; s < diagram.num_sites; ++s) {
        append_point(bytes, places[s]);
        append_all(bytes, diagram.cell_area[s], std::int32_t{diagram.cell_euler[s]});
    }
    for (Index i = 0; i < num_points; ++i) {
        append_point(bytes, drawn.sites[i]);
        append_all(bytes, drawn.points.site_of(i), drawn.start_of(i));
    }
    for (const SiteShape& shape : drawn.shapes) append_shape(bytes, drawn.surface, shape);
    for (std::size_t p = 0; p < diagram.points.size(); ++p) {
        ticker.tick();
        append_point(bytes, diagram.points[p]);
        append(bytes, diagram.point_distance[p]);
    }
    for (Index e = 0; e < num_edges(diagram); ++e) {
        ticker.tick();
        const auto& [left, right, tail, head] = diagram.edges[e];
        // no_index has the bits of -1.
        append_all(bytes, site_number(left), site_number(right), tail, head,
                   diagram.edge_points[e + 1] - diagram.edge_points[e]);
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
    if (!diagram.edge_arcs.empty()) append_arcs(bytes, diagram, ticker);
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
    return require_format(diagram_formats, path, ".vtp, .ply, .obj or .agvd");
}

}  // namespace

DiagramFile read_diagram(const std::filesystem::path& path, const Progress& progress) {
    Poller poller(progress);
    SourceFile file = load_file(path, poller);
    if (is_gzip(file.bytes)) unpack_gzip(file);
    DiagramFile result{
        .mesh = read_ply(file).mesh, .sites = {}, .points = {}, .shapes = {}, .diagram = {}};
    const PlyHeader header = read_ply_header(file);
    file.is_binary = header.byte_order.has_value();
    if (file.is_binary) {
        DiagramReader<BinaryValues>(file, header, result).read();
    } else {
        DiagramReader<AsciiValues>(file, header, result).read();
    }
    return result;
}

std::string format_diagram(const std::filesystem::path& path, const Surface& surface,
                           std::span<const SurfacePoint> sites, const Diagram& diagram,
                           const Progress& progress, const SitePoints& points,
                           std::span<const SiteShape> shapes) {
    Poller poller(progress);
    const Ticker ticker(poller);
    std::string bytes =
        require_diagram_format(path).format({surface, sites, diagram, points, shapes}, ticker);
    return is_compressed({path}) ? pack_gzip(bytes, ticker) : bytes;
}

void write_diagram(const std::filesystem::path& path, const Surface& surface,
                   std::span<const SurfacePoint> sites, const Diagram& diagram,
                   const Progress& progress, const SitePoints& points,
                   std::span<const SiteShape> shapes) {
    write_file_atomically(
        path, format_diagram(path, surface, sites, diagram, progress, points, shapes), progress);
}

void check_diagram_extension(const std::filesystem::path& path) {
    static_cast<void>(require_diagram_format(path));
}

}  // namespace remesh
