// Legacy VTK, ascii and binary (big endian): POLYDATA and UNSTRUCTURED_GRID with points, cells, and
// arrays of both as attributes (format: The VTK User's Guide, "VTK File Formats"; since version 5
// cells are two arrays, OFFSETS and CONNECTIVITY). Written is version 3.0, which all programs read:
// binary POLYDATA with coordinates in double.

#include <utility>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/text_scanner.h"
#include "remesh/meshfile/vtk_output.h"

namespace remesh {
namespace {

class LegacyVtkReader {
public:
    explicit LegacyVtkReader(SourceFile& file)
        : file_(file), scan_(file, 0, {}), ticker_(file.ticker) {}

    VtkData read() {
        read_head();
        while (scan_.find_word()) {
            start_ = scan_.offset();
            read_section(in_lower_case(scan_.word()));
        }
        assign_types();
        for (VtkCells& group : groups_) {
            if (!group.ends.empty()) data_.cells.push_back(std::move(group));
        }
        return std::move(data_);
    }

private:
    // Its place in `groups`.
    static constexpr std::size_t grid = 4;
    enum class Of { Nothing, Points, Cells };

    template <typename... Parts>
    [[noreturn]] void fail(Parts... parts) const {
        file_.fail_damaged(start_, parts...);
    }

    void read_head() {
        if (!scan_.take("# vtk DataFile Version ")) {
            file_.fail_malformed(start_,
                                 "this is not a legacy VTK file, as it does not begin with '# vtk "
                                 "DataFile Version'; check its extension");
        }
        version_ = scan_.number("a version");
        scan_.skip_line();
        scan_.skip_line();  // The title.
        start_ = scan_.offset();
        const std::string encoding = scan_.find_word() ? in_lower_case(scan_.word()) : "";
        if (encoding != "ascii" && encoding != "binary") {
            fail("expected ASCII or BINARY, found ", in_quotes(encoding));
        }
        file_.is_binary = encoding == "binary";
        expect("dataset");
        start_ = scan_.offset();
        const std::string kind = name("a kind of data");
        if (in_lower_case(kind) != "polydata" && in_lower_case(kind) != "unstructured_grid") {
            file_.fail_malformed(start_, "the file holds ", in_quotes(kind),
                                 ", not POLYDATA or UNSTRUCTURED_GRID; extract its surface (in "
                                 "ParaView: Extract Surface) and save that");
        }
    }

    void expect(const char* keyword) {
        if (!scan_.find_word()) scan_.fail_expecting(keyword);
        start_ = scan_.offset();
        const std::string word(scan_.word());
        if (in_lower_case(word) == keyword) return;
        fail("expected ", keyword, ", found ", in_quotes(word));
    }

    void read_section(const std::string& keyword) {
        constexpr std::array groups = {"vertices", "lines", "polygons", "triangle_strips", "cells"};
        const auto* const group = std::ranges::find(groups, keyword);
        if (keyword == "points") {
            const std::uint64_t count = number_of("points");
            data_.points = array("points", type_name(), count, 3);
        } else if (group != groups.end()) {
            read_cells(static_cast<std::size_t>(group - groups.begin()));
        } else if (keyword == "cell_types") {
            types_ = array("CELL_TYPES", *find_vtk_type("int"), number_of("types"), 1);
        } else if (keyword == "point_data" || keyword == "cell_data") {
            of_ = keyword == "point_data" ? Of::Points : Of::Cells;
            num_elements_ = number_of("elements");
        } else if (keyword == "metadata") {
            skip_to_empty_line();
        } else if (keyword == "field") {
            read_field();
        } else {
            read_array(keyword);
        }
    }

    // Arrays of points or cells.
    void read_array(const std::string& keyword) {
        constexpr std::pair<const char*, std::uint64_t> widths[] = {
            {"scalars", 0},      {"color_scalars", 0},
            {"lookup_table", 4}, {"texture_coordinates", 0},
            {"vectors", 3},      {"normals", 3},
            {"tensors", 9},      {"global_ids", 1},
            {"pedigree_ids", 1}};
        const auto* const known =
            std::ranges::find(widths, keyword, &std::pair<const char*, std::uint64_t>::first);
        if (known == std::end(widths)) fail("unknown keyword ", in_quotes(keyword));
        const std::string title = name("a name");
        std::uint64_t components = known->second;
        // Colours of text are numbers from 0 to 1.
        const VtkType& color_type = *find_vtk_type(file_.is_binary ? "unsigned_char" : "float");
        if (keyword == "lookup_table") {
            array("", color_type, number_of("colours"), components);
            return;
        }
        if (keyword == "color_scalars") {
            VtkArray colors = array(title, color_type, num_elements_, number_of("components"));
            if (!file_.is_binary) {
                for (double& value : colors.values) value = std::round(255 * value);
                colors.type = find_vtk_type("unsigned_char");
            }
            return keep(std::move(colors));
        }
        if (keyword == "texture_coordinates") components = number_of("components");
        const VtkType& type = type_name();
        if (keyword == "scalars") {
            components = scan_.has_word() ? number_of("components") : 1;
            expect("lookup_table");
            scan_.word();
        }
        VtkArray values = array(title, type, num_elements_, components);
        if (keyword == "normals") {
            if (of_ == Of::Points) data_.normals = type.type;
            if (of_ == Of::Cells) decline(title, "normals of faces are not carried over");
        } else if (keyword != "texture_coordinates") {
            keep(std::move(values));
        } else if (of_ == Of::Points && (components == 2 || components == 3)) {
            data_.texture = std::move(values);
        } else {
            decline(title, "only two or three texture coordinates of points are carried over");
        }
    }

    void read_field() {
        name("a name");
        for (std::uint64_t left = number_of("arrays"); left > 0; --left) {
            ticker_.tick();
            if (!scan_.find_word()) scan_.fail_expecting("an array");
            start_ = scan_.offset();
            if (in_lower_case(scan_.word()) == "metadata") {
                skip_to_empty_line();
                ++left;
                continue;
            }
            scan_.go_to(start_);
            const std::string title = name("a name");
            const std::uint64_t components = number_of("components");
            const std::uint64_t count = number_of("elements");
            const VtkType& type = type_name();
            VtkArray values = array(title, type, count, components);
            if (of_ == Of::Nothing) continue;  // Of the whole file, such as a time.
            if (count != num_elements_) {
                fail("array ", in_quotes(title), " has ", count, " values for ", num_elements_,
                     " elements");
            }
            keep(std::move(values));
        }
    }

    void keep(VtkArray values) {
        if (of_ == Of::Nothing) fail("an array comes before POINT_DATA or CELL_DATA");
        (of_ == Of::Points ? data_.of_points : data_.of_cells).push_back(std::move(values));
    }
    void decline(const std::string& title, const char* reason) {
        data_.declined.push_back({(of_ == Of::Points ? "vertex " : "face ") + title, reason});
    }

    void read_cells(std::size_t group) {
        constexpr std::array types = {VtkCell::Vertices, VtkCell::Lines, VtkCell::Polygon,
                                      VtkCell::Strip, VtkCell{0}};
        VtkCells& cells = groups_[group];
        if (!cells.ends.empty()) fail("the same kind of cells comes twice");
        cells.types = {types[group]};
        const std::uint64_t count = number_of("cells"), size = number_of("numbers");
        if (version_ >= 5) {
            read_offset_cells(count, size, cells);
        } else {
            read_counted_cells(count, size, cells);
        }
    }

    // Each cell is the number of its corners and these.
    void read_counted_cells(std::uint64_t count, std::uint64_t size, VtkCells& cells) {
        cells.corners = array("cells", *find_vtk_type("int"), size, 1);
        std::vector<double>& values = cells.corners.values;
        std::size_t to = 0, from = 0;
        for (std::uint64_t c = 0; c < count; ++c) {
            ticker_.tick();
            const double corners = from < values.size() ? values[from] : -1;
            if (!(corners >= 0 && corners == std::floor(corners) &&
                  corners < static_cast<double>(values.size() - from))) {
                fail("cell ", c, " of ", count, " does not fit into the ", size,
                     " numbers that are announced");
            }
            ++from;
            for (auto k = static_cast<std::size_t>(corners); k > 0; --k)
                values[to++] = values[from++];
            cells.ends.push_back(to);
        }
        if (from != values.size()) {
            fail("the cells have fewer numbers than the ", size, " that are announced");
        }
        values.resize(to);
    }

    // One array of where cells begin, one of their corners.
    void read_offset_cells(std::uint64_t count, std::uint64_t size, VtkCells& cells) {
        expect("offsets");
        const VtkType& offset_type = type_name();
        VtkArray offsets = array("OFFSETS", offset_type, count, 1);
        expect("connectivity");
        const VtkType& type = type_name();
        cells.corners = array("CONNECTIVITY", type, size, 1);
        if (count > 0) {
            if (offsets.values[0] != 0) {
                fail("the offset of the first cell is not 0, so that they are not in order");
            }
            offsets.values.erase(offsets.values.begin());
        }
        cells.ends = ends_of_cells(offsets, cells.corners.values.size(), file_);
    }

    // Gives the cells of a grid their types, wherever these stand in the file.
    void assign_types() {
        VtkCells& cells = groups_[grid];
        const std::size_t count = types_ ? types_->values.size() : 0;
        if (count != cells.ends.size()) {
            fail("CELL_TYPES has ", count, " types for ", cells.ends.size(), " cells");
        }
        if (types_) cells.types = types_of_cells(*types_);
    }

    std::string name(const char* what) {
        if (!scan_.has_word()) scan_.fail_expecting(what);
        return without_escapes(scan_.word());
    }

    const VtkType& type_name() {
        const std::size_t start = scan_.offset();
        const std::string word = name("a type of numbers");
        const VtkType* const type = find_vtk_type(in_lower_case(word));
        if (type != nullptr) return *type;
        file_.fail_malformed(start, "arrays of type ", in_quotes(word),
                             " are not supported; export the file without them");
    }

    std::uint64_t number_of(const char* what) {
        return scan_.count(std::string("the number of ") + what);
    }

    // The numbers that follow the current line.
    VtkArray array(std::string title, const VtkType& type, std::uint64_t count,
                   std::uint64_t components) {
        scan_.skip_line();
        VtkArray result{.name = std::move(title),
                        .type = &type,
                        .num_components = static_cast<std::size_t>(components),
                        .offset = scan_.offset()};
        const std::string_view left = std::string_view(file_.bytes).substr(scan_.offset());
        // A number of a text takes a byte, and there are blanks between them.
        const std::size_t room = file_.is_binary ? left.size() / type.size : (left.size() + 1) / 2;
        if (count != 0 && components > room / count) {
            file_.fail_malformed(start_, "the file ends before the ", count, " elements of ",
                                 in_quotes(result.name),
                                 "; it is truncated: export the file again");
        }
        const std::size_t total = static_cast<std::size_t>(count * components);
        if (file_.is_binary) {
            result.read(left.substr(0, total * type.size), std::endian::big, ticker_);
            scan_.go_to(scan_.offset() + total * type.size);
            return result;
        }
        result.values.reserve(total);
        for (std::size_t i = 0; i < total; ++i) {
            ticker_.tick(2);
            if (!scan_.find_word()) {
                scan_.fail_malformed("the file ends within ", in_quotes(result.name),
                                     "; it is truncated: export the file again");
            }
            result.values.push_back(scan_.number("a number"));
        }
        return result;
    }

    void skip_to_empty_line() {
        scan_.skip_line();
        while (scan_.has_word()) scan_.skip_line();
    }

    SourceFile& file_;
    TextScanner scan_;
    Ticker ticker_;
    std::size_t start_ = 0;  // Of the current section.
    double version_ = 0;
    VtkData data_;
    std::array<VtkCells, 5> groups_;
    std::optional<VtkArray> types_;
    Of of_ = Of::Nothing;
    std::uint64_t num_elements_ = 0;  // Points or cells, as the data announce them.
};

constexpr std::endian vtk_order = std::endian::big;

// A blank would end a name.
std::string encoded(const std::string& name) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string text;
    for (const char c : name) {
        const auto code = static_cast<unsigned char>(c);
        if (c > ' ' && c != '%' && c != '"') {
            text += c;
        } else {
            text.append({'%', digits[code / 16], digits[code % 16]});
        }
    }
    return text;
}

void append_attributes(const char* section, const std::vector<Attribute>& attributes,
                       std::size_t count, Ticker& ticker, std::string& bytes) {
    const std::vector<VtkOutputArray> arrays = arrays_of(attributes);
    if (arrays.empty()) return;
    bytes += section;
    bytes += "FIELD FieldData " + std::to_string(arrays.size()) + '\n';
    for (const VtkOutputArray& array : arrays) {
        bytes += joined(encoded(array.name), " ", array.parts.size(), " ", count, " ",
                        vtk_type_of(array.type).name, "\n");
        append_values(array, count, vtk_order, ticker, bytes);
        bytes += '\n';
    }
}

}  // namespace

MeshFile read_vtk(SourceFile file) {
    VtkData data = LegacyVtkReader(file).read();
    return make_mesh(std::move(data), file);
}

std::string format_vtk(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    const std::size_t num_points = mesh.positions.size(), num_faces = mesh.triangles.size();
    if (num_points > INT32_MAX || num_faces > INT32_MAX / 4) {
        throw InvalidInput("the mesh is too large for a legacy VTK file; write .ply");
    }
    std::string bytes = "# vtk DataFile Version 3.0\nremesh\nBINARY\nDATASET POLYDATA\nPOINTS " +
                        std::to_string(num_points) + " double\n";
    for (const Vec3& p : mesh.positions) {
        ticker.tick();
        for (const double x : p) append(bytes, x, vtk_order);
    }
    bytes += "\nPOLYGONS " + std::to_string(num_faces) + ' ' + std::to_string(4 * num_faces) + '\n';
    for (const Triangle& triangle : mesh.triangles) {
        ticker.tick();
        append(bytes, std::int32_t{3}, vtk_order);
        for (const Index v : triangle) append(bytes, static_cast<std::int32_t>(v), vtk_order);
    }
    bytes += '\n';
    std::string of_points = "POINT_DATA " + std::to_string(num_points) + '\n';
    if (attributes.normals) {
        bytes += of_points + "NORMALS normals float\n";
        of_points.clear();
        for (const Vec3& normal : vertex_normals(mesh)) {
            for (const double x : normal) append(bytes, static_cast<float>(x), vtk_order);
        }
        bytes += '\n';
    }
    if (const auto texture = coordinates_of_vertices(mesh, attributes.texture); !texture.empty()) {
        const NumberType type = attributes.texture.type == NumberType::Float32
                                    ? NumberType::Float32
                                    : NumberType::Float64;
        bytes += of_points + "TEXTURE_COORDINATES " + TextureCoordinates::name + " 2 " +
                 vtk_type_of(type).name + '\n';
        of_points.clear();
        for (const Vec2& p : texture) {
            for (const double x : p) append_number(bytes, type, x, vtk_order);
        }
        bytes += '\n';
    }
    append_attributes(of_points.c_str(), attributes.of_vertices, num_points, ticker, bytes);
    const std::string of_cells = "CELL_DATA " + std::to_string(num_faces) + '\n';
    append_attributes(of_cells.c_str(), attributes.of_faces, num_faces, ticker, bytes);
    return bytes;
}

}  // namespace remesh
