// Reads the elements of write_diagram's .agvd one after the other; each is checked against the
// counts of the elements that it refers to. An index out of range, or a count that does not fit, is
// an error that names the place in the file.
#include "remesh/meshfile/read_diagram.h"

#include <cmath>
#include <map>
#include <set>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/gzip.h"
#include "remesh/meshfile/ply_values.h"

namespace remesh {
namespace {

// The elements of the file that make the diagram; each is read once the mesh is known.
template <typename Values>
class DiagramReader {
public:
    DiagramReader(const SourceFile& file, const PlyHeader& header, DiagramFile& out)
        : file_(file), ticker_(file.ticker), values_(file, header), out_(out) {
        for (const PlyElement& element : header.elements) {
            // Without properties it has no bytes, so that its count may be anything.
            if (!element.properties.empty()) count_.try_emplace(element.name, element.count);
        }
        count_["face"] = out.mesh.triangles.size();  // Other polygons were dropped.
    }

    void read(const PlyHeader& header) {
        for (const char* name : {"site", "curve_point", "voronoi_edge", "voronoi_vertex"}) {
            if (!count_.contains(name)) {
                file_.fail_malformed(
                    0, std::string("the file has no element ") + name +
                           ", so that it holds no diagram; write one with `agvd diagram MESH -o "
                           "FILE.agvd`");
            }
            if (count_.at(name) >= no_index) fail("there are more than 2^32 - 2 elements");
        }
        out_.diagram.edge_points = out_.diagram.vertex_offsets = {0};
        std::set<std::string> names;
        for (const PlyElement& element : header.elements) {
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
        diagram.num_sites = static_cast<Index>(out_.sites.size());
        if (diagram.edge_points.back() != diagram.points.size()) {
            fail("the Voronoi edges do not have all curve points");
        }
    }

private:
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
        } else if (element.name == "curve_point") {
            read_row(element, i, {"face", "b0", "b1", "b2", "distance"}, {});
            diagram.points.push_back(point());
            diagram.point_distance.push_back(row_[4]);
        } else if (element.name == "voronoi_edge") {
            read_edge(element, i);
        } else if (element.name == "voronoi_vertex") {
            read_vertex(element, i);
        } else {
            skip_element(values_, element, i, file_);
        }
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
            const Index edge = index(std::floor(end / 2), "voronoi_edge");
            diagram.vertex_ends.push_back({edge, std::fmod(end, 2) == 0});
        }
        for (const double label : lists_[1]) diagram.vertex_sites.push_back(site(label));
        diagram.vertex_offsets.push_back(static_cast<Index>(diagram.vertex_ends.size()));
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
            file_.fail_malformed(0, "element " + element.name +
                                        " lacks properties of a diagram; write one with `agvd "
                                        "diagram MESH -o FILE.agvd`");
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
            fail(std::string("the file names a ") + element + " that does not exist");
        }
        return static_cast<Index>(number);
    }

    [[noreturn]] void fail(const std::string& text) const {
        file_.fail_unusable(
            start_, text + "; the file is damaged: write the diagram again with `agvd diagram`");
    }

    const SourceFile& file_;
    Ticker ticker_;
    Values values_;
    DiagramFile& out_;
    std::map<std::string, std::uint64_t> count_;  // Of each element, as announced.
    std::size_t start_ = 0;                       // Of the item being read.
    std::vector<double> row_;                     // Numbers of it: 32-bit integers fit.
    std::vector<std::vector<double>> lists_;
};

}  // namespace

DiagramFile read_diagram(const std::filesystem::path& path, const Progress& progress) {
    Poller poller(progress);
    SourceFile file = load_file(path, poller);
    if (is_gzip(file.bytes)) unpack_gzip(file);
    DiagramFile result{.mesh = read_ply(file).mesh, .sites = {}, .diagram = {}};
    const PlyHeader header = read_ply_header(file);
    file.is_binary = header.byte_order.has_value();
    if (file.is_binary) {
        DiagramReader<BinaryValues>(file, header, result).read(header);
    } else {
        DiagramReader<AsciiValues>(file, header, result).read(header);
    }
    return result;
}

}  // namespace remesh
