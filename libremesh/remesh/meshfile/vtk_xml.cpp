// VTK's XML files: PolyData (.vtp) and UnstructuredGrid (.vtu). The pieces of a file become one
// mesh, piece after piece (format: The VTK User's Guide, "VTK File Formats", "XML File Formats").
// Appended data may hold any bytes: XML is read up to the '_' that begins them.

#include "remesh/meshfile/byte_source.h"
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/text_scanner.h"
#include "remesh/meshfile/vtk_data.h"
#include "remesh/meshfile/xml_reader.h"

namespace remesh {
namespace {

// What a tag says.
struct VtkXmlElement {
    std::size_t tag = 0;  // In the file.
    std::map<std::string, std::string, std::less<>> values = {};

    // Empty: it is missing.
    std::string operator[](std::string_view name) const {
        const auto found = values.find(name);
        return found == values.end() ? "" : found->second;
    }
};

VtkXmlElement element_of(const XmlTag& tag) {
    VtkXmlElement element{.tag = tag.begin};
    for (const XmlAttribute& one : tag.attributes) {
        if (one.space.empty()) element.values.emplace(one.name, one.value);
    }
    return element;
}

// A DataArray: where it stands and how it is encoded.
struct VtkXmlArray : VtkXmlElement {
    std::string section;             // "Points", "Polys", "PointData", ...
    std::size_t begin = 0, end = 0;  // Of the text between its tags.

    [[nodiscard]] std::string name() const { return (*this)["Name"]; }
    // Points often have no name.
    [[nodiscard]] std::string shown() const {
        return "array " + (name().empty() ? "" : in_quotes(name()) + " ") + "of " + section;
    }
};

struct VtkXmlPiece : VtkXmlElement {
    std::map<std::string, VtkXmlElement, std::less<>> sections = {};
    std::vector<VtkXmlArray> arrays = {};
};

struct VtkXmlFile {
    bool is_grid = false;  // UnstructuredGrid, else PolyData.
    std::endian order = std::endian::little;
    std::size_t header_size = 4;  // Bytes of a count before an array.
    std::string compressor = {};  // Empty: none.
    std::vector<VtkXmlPiece> pieces = {};
    bool is_appended_raw = false;    // Else base64.
    std::size_t appended_begin = 0;  // Behind the '_'; 0: there is none.
};

class VtkXmlParser : public XmlVisitor {
public:
    explicit VtkXmlParser(const SourceFile& file) : file_(file) {}

    bool begin(const XmlTag& tag) override {
        const std::size_t depth = tag.depth;
        if (depth == 0) {
            read_root(tag);
        } else if (depth == 1) {
            is_in_mesh_ = tag.name == kind_;
            if (tag.name == "AppendedData") return read_appended(tag);
        } else if (depth == 2 && is_in_mesh_) {
            is_in_piece_ = tag.name == "Piece";
            if (is_in_piece_) result_.pieces.push_back({element_of(tag)});
        } else if (!is_in_mesh_ || !is_in_piece_) {
            return true;
        } else if (depth == 3) {
            section_ = tag.name;
            result_.pieces.back().sections.insert_or_assign(section_, element_of(tag));
        } else if (depth == 4) {
            result_.pieces.back().arrays.push_back({element_of(tag), section_, tag.end, tag.end});
        } else if (depth == 5) {
            end_text(tag.begin);
        }
        return true;
    }

    void end(std::size_t depth, std::size_t at, std::size_t behind) override {
        if (!is_in_mesh_ || !is_in_piece_) return;
        if (depth == 4) end_text(at);
        if (depth == 5) skip_key(behind);
    }

    VtkXmlFile finish() && {
        if (kind_.empty()) file_.fail_damaged(0, "there is no element VTKFile");
        return std::move(result_);
    }

private:
    // The numbers of an array stand before or behind the keys of VTK's pipeline in it.
    void end_text(std::size_t end) {
        VtkXmlArray& array = result_.pieces.back().arrays.back();
        if (array.end != array.begin) return;
        if (file_.bytes.find_first_not_of(" \t\r\n", array.begin) < end) array.end = end;
    }
    void skip_key(std::size_t behind) {
        VtkXmlArray& array = result_.pieces.back().arrays.back();
        if (array.end == array.begin) array.begin = array.end = behind;
    }

    void read_root(const XmlTag& tag) {
        if (tag.name != "VTKFile") {
            file_.fail_malformed(tag.begin, "the file begins with the element ",
                                 in_quotes(tag.name), " instead of VTKFile; check its extension");
        }
        const VtkXmlElement root = element_of(tag);
        kind_ = root["type"];
        result_.is_grid = kind_ == "UnstructuredGrid";
        if (kind_ != "PolyData" && !result_.is_grid) {
            file_.fail_malformed(tag.begin, "the file holds ", in_quotes(kind_),
                                 ", not PolyData or UnstructuredGrid; extract its surface (in "
                                 "ParaView: Extract Surface) and save that as one file");
        }
        // Either the usual value, which may be left out, or the other one.
        const auto is_other = [&](const char* name, const char* usual, const char* other) {
            const std::string value = root[name];
            if (value.empty() || value == usual || value == other) return value == other;
            file_.fail_damaged(tag.begin, "unknown ", name, " ", in_quotes(value));
        };
        if (is_other("byte_order", "LittleEndian", "BigEndian")) result_.order = std::endian::big;
        if (is_other("header_type", "UInt32", "UInt64")) result_.header_size = 8;
        result_.compressor = root["compressor"];
    }

    // \return false, as nothing behind it is XML.
    bool read_appended(const XmlTag& tag) {
        const std::string encoding = element_of(tag)["encoding"];
        result_.is_appended_raw = encoding == "raw";
        if (!result_.is_appended_raw && encoding != "base64") {
            file_.fail_damaged(tag.begin, "unknown encoding ", in_quotes(encoding),
                               " of AppendedData");
        }
        const std::size_t mark = file_.bytes.find_first_not_of(" \t\r\n", tag.end);
        if (mark == std::string::npos || file_.bytes[mark] != '_') {
            file_.fail_damaged(tag.end, "AppendedData do not begin with '_'");
        }
        result_.appended_begin = mark + 1;
        return false;
    }

    const SourceFile& file_;
    VtkXmlFile result_;
    std::string kind_, section_;
    bool is_in_mesh_ = false, is_in_piece_ = false;
};

// Decodes arrays.
class VtkXmlArrays {
public:
    // \param file, xml  outlive this.
    VtkXmlArrays(const SourceFile& file, const VtkXmlFile& xml)
        : file_(file), xml_(xml), ticker_(file.ticker) {}

    // The numbers of an array. Memory follows the bytes that are there.
    VtkArray read(const VtkXmlArray& array) {
        VtkArray result{
            .name = array.name(), .type = find_vtk_xml_type(array["type"]), .offset = array.tag};
        if (result.type == nullptr) {
            file_.fail_malformed(array.tag, array.shown(), " has the type ",
                                 in_quotes(array["type"]),
                                 ", which is not supported; export the file without it");
        }
        result.num_components = static_cast<std::size_t>(
            count(array, "NumberOfComponents", "NumberOfComponents").value_or(1));
        const std::string format = array["format"];
        if (format.empty() || format == "ascii") {
            TextScanner scan(file_, array.begin, {.comment = '<'});
            while (scan.find_word() && scan.offset() < array.end) {
                ticker_.tick(2);
                result.values.push_back(scan.number("a number"));
            }
        } else if (format == "binary") {
            ByteSource source(
                std::string_view(file_.bytes).substr(array.begin, array.end - array.begin), true);
            // Some writers leave out the count of an empty array.
            if (!source.is_at_end()) read_bytes(array, source, result);
        } else if (format == "appended") {
            ByteSource source = appended(array);
            read_bytes(array, source, result);
        } else {
            fail(array, "unknown format ", in_quotes(format));
        }
        return result;
    }

    // A count that an attribute gives; nothing if it is empty.
    std::optional<std::uint64_t> count(const VtkXmlElement& element, const std::string& name,
                                       const std::string& what) const {
        const std::string text = element[name];
        if (text.empty()) return std::nullopt;
        if (const auto value = as_whole<std::uint64_t>(text)) return value;
        file_.fail_damaged(element.tag, what, " is ", in_quotes(text),
                           " and no whole number from 0");
    }

    template <typename... Parts>
    [[noreturn]] void fail(const VtkXmlArray& array, Parts... parts) const {
        file_.fail_damaged(array.tag, array.shown(), ": ", parts...);
    }

    Ticker& ticker() { return ticker_; }

private:
    ByteSource appended(const VtkXmlArray& array) const {
        const auto at = count(array, "offset", "the offset of an array");
        if (!at) fail(array, "its data are appended, but it has no offset");
        if (xml_.appended_begin == 0) {
            fail(array, "its data are appended, but there are no such data");
        }
        if (*at > file_.bytes.size() - xml_.appended_begin) {
            fail(array, "its data begin at byte ", *at,
                 " of the appended ones, behind the end of the file");
        }
        const auto begin = xml_.appended_begin + static_cast<std::size_t>(*at);
        return {std::string_view(file_.bytes).substr(begin), !xml_.is_appended_raw};
    }

    std::string_view take(const VtkXmlArray& array, ByteSource& source, std::uint64_t size) {
        const auto bytes = source.take(size, buffer_, ticker_);
        if (!bytes) fail(array, "the file ends within it, or it is not base64");
        return *bytes;
    }

    std::uint64_t take_count(const VtkXmlArray& array, ByteSource& source) {
        const char* const bytes = take(array, source, xml_.header_size).data();
        return xml_.header_size == 8 ? load<std::uint64_t>(bytes, xml_.order)
                                     : load<std::uint32_t>(bytes, xml_.order);
    }

    // The first count is that of bytes, or of compressed blocks.
    void read_bytes(const VtkXmlArray& array, ByteSource& source, VtkArray& result) {
        const std::uint64_t first = take_count(array, source);
        const bool is_packed = !xml_.compressor.empty();
        const std::string unpacked = is_packed ? unpack(array, source, first) : "";
        const std::string_view bytes = is_packed ? unpacked : take(array, source, first);
        if (array["format"] == "binary" && !source.is_at_end()) {
            fail(array, "it has more data than it announces");
        }
        if (bytes.size() % result.type->size != 0) {
            fail(array, "its ", bytes.size(), " bytes are not a whole number of ", array["type"]);
        }
        result.read(bytes, xml_.order, ticker_);
    }

    // Blocks of one size, but for a last one that may be smaller (0: it is not), and before them
    // the size that each is compressed to.
    std::string unpack(const VtkXmlArray& array, ByteSource& source, std::uint64_t num_blocks) {
        if (xml_.compressor != "vtkZLibDataCompressor") {
            file_.fail_malformed(array.tag, "the arrays are compressed by ",
                                 in_quotes(xml_.compressor),
                                 ", which is not supported; save the file with zlib, or without "
                                 "compression");
        }
        if (!knows_gzip()) {
            file_.fail_malformed(array.tag,
                                 "the arrays are compressed, and this program was built without "
                                 "zlib; save the file without compression");
        }
        const std::uint64_t block_size = take_count(array, source);
        const std::uint64_t last_size = take_count(array, source);
        std::vector<std::uint64_t> packed_sizes;
        for (std::uint64_t b = 0; b < num_blocks; ++b) {
            ticker_.tick();
            packed_sizes.push_back(take_count(array, source));
        }
        std::string bytes;
        for (std::uint64_t b = 0; b < num_blocks; ++b) {
            const bool is_partial = b + 1 == num_blocks && last_size != 0;
            const std::string_view packed = take(array, source, packed_sizes[b]);
            if (!append_unpacked(packed, DeflatedIn::Zlib, is_partial ? last_size : block_size,
                                 ticker_, bytes)) {
                fail(array, "block ", b, " of its compressed data is damaged");
            }
        }
        return bytes;
    }

    const SourceFile& file_;
    const VtkXmlFile& xml_;
    Ticker ticker_;
    std::string buffer_;
};

class VtpReader {
public:
    explicit VtpReader(const SourceFile& file)
        : file_(file), xml_(parse(file)), arrays_(file, xml_) {}

    VtkData read() {
        for (const VtkXmlPiece& piece : xml_.pieces) read_piece(piece);
        return std::move(data_);
    }

private:
    using Count = std::optional<std::uint64_t>;

    static VtkXmlFile parse(const SourceFile& file) {
        VtkXmlParser parser(file);
        read_xml(file, parser);
        return std::move(parser).finish();
    }

    void read_piece(const VtkXmlPiece& piece) {
        const std::uint64_t num_points = read_points(piece);
        std::uint64_t num_cells = 0;
        const auto read = [&](const std::string& section, VtkCell type) {
            num_cells += read_cells(piece, section, type, num_points);
        };
        if (xml_.is_grid) {
            read("Cells", VtkCell{0});
        } else {
            read("Verts", VtkCell::Vertices);
            read("Lines", VtkCell::Lines);
            read("Polys", VtkCell::Polygon);
            read("Strips", VtkCell::Strip);
        }
        num_points_ += num_points;
        if (!file_.with_attributes || (num_points == 0 && num_cells == 0)) return;
        add_data(read_data(piece, "PointData", num_points), "vertex ", data_.of_points);
        add_data(read_data(piece, "CellData", num_cells), "face ", data_.of_cells);
        has_data_ = true;
    }

    static const VtkXmlArray* find(const VtkXmlPiece& piece, std::string_view section,
                                   std::string_view name) {
        for (const VtkXmlArray& array : piece.arrays) {
            if (array.section == section && (name.empty() || array.name() == name)) return &array;
        }
        return nullptr;
    }

    // \return how many points the piece has.
    std::uint64_t read_points(const VtkXmlPiece& piece) {
        const Count announced = arrays_.count(piece, "NumberOfPoints", "NumberOfPoints");
        const VtkXmlArray* const found = find(piece, "Points", "");
        if (found == nullptr) {
            if (announced.value_or(0) == 0) return 0;
            file_.fail_damaged(piece.tag, "NumberOfPoints is ", *announced,
                               ", but the piece has no array of Points");
        }
        VtkArray points = arrays_.read(*found);
        if (points.num_components != 3) arrays_.fail(*found, "it has not three coordinates each");
        require_count(*found, points, announced);
        const std::uint64_t count = points.values.size() / 3;
        if (data_.points) {
            append(points, *data_.points);
        } else {
            data_.points = std::move(points);
        }
        return count;
    }

    void require_count(const VtkXmlArray& found, const VtkArray& array,
                       const Count& announced) const {
        const std::size_t size = array.values.size(), width = array.num_components;
        const bool is_whole = width != 0 && size % width == 0;
        if (is_whole && (!announced || size / width == *announced)) return;
        arrays_.fail(found, "it has ", size, " numbers for ", announced.value_or(0),
                     " elements with ", width, " each");
    }

    // \return how many cells the section has.
    std::uint64_t read_cells(const VtkXmlPiece& piece, const std::string& section, VtkCell type,
                             std::uint64_t num_points) {
        const Count announced = arrays_.count(piece, "NumberOf" + section, section);
        const VtkXmlArray* const corners = find(piece, section, "connectivity");
        const VtkXmlArray* const ends = find(piece, section, "offsets");
        const VtkXmlArray* const types = xml_.is_grid ? find(piece, section, "types") : nullptr;
        if (corners == nullptr || ends == nullptr || (xml_.is_grid && types == nullptr)) {
            if (announced.value_or(0) == 0) return 0;
            file_.fail_damaged(piece.tag, "there are ", *announced, " cells (", section,
                               "), but not the arrays that make them");
        }
        VtkCells cells{.corners = arrays_.read(*corners), .ends = {}, .types = {type}};
        const VtkArray offsets = arrays_.read(*ends);
        require_count(*ends, offsets, announced);
        cells.ends = ends_of_cells(offsets, cells.corners.values.size(), file_);
        if (types != nullptr) {
            const VtkArray numbers = arrays_.read(*types);
            require_count(*types, numbers, cells.ends.size());
            cells.types = types_of_cells(numbers);
        }
        require_points(*corners, cells.corners, num_points);
        const std::uint64_t count = cells.ends.size();
        if (count > 0) data_.cells.push_back(std::move(cells));
        return count;
    }

    // Corners count from the first point of their piece.
    void require_points(const VtkXmlArray& found, VtkArray& corners, std::uint64_t num_points) {
        for (double& corner : corners.values) {
            arrays_.ticker().tick();
            if (!(corner >= 0 && corner < static_cast<double>(num_points))) {
                const std::string number = std::to_string(corner);
                file_.fail_unusable(
                    found.tag, found.shown(), " names point ", number.substr(0, number.find('.')),
                    ", but the piece has only ", num_points,
                    " points, counted from 0; correct the cell, or export the file again");
            }
            corner += static_cast<double>(num_points_);
        }
    }

    std::vector<VtkArray> read_data(const VtkXmlPiece& piece, std::string_view section,
                                    std::uint64_t count) {
        const bool is_of_points = section == "PointData";
        const auto names = piece.sections.find(section);
        std::vector<VtkArray> result;
        for (const VtkXmlArray& array : piece.arrays) {
            if (array.section != section) continue;
            const std::string name = (is_of_points ? "vertex " : "face ") + array.name();
            const VtkType* const type = find_vtk_xml_type(array["type"]);
            const auto is = [&](const char* role) {
                return !array.name().empty() && array.name() == names->second[role];
            };
            if (type == nullptr) {
                decline(name, "arrays of this type are not carried over");
            } else if (is("Normals") && is_of_points) {
                data_.normals = type->type;
            } else if (is("Normals")) {
                decline(name, "normals of faces are not carried over");
            } else if (is_of_points && is("TCoords")) {
                decline(name, "texture coordinates are not carried over");
            } else {
                result.push_back(arrays_.read(array));
                require_count(array, result.back(), count);
            }
        }
        return result;
    }

    // Appends the arrays of a further piece. What not all pieces have is declined.
    void add_data(std::vector<VtkArray> arrays, const std::string& kind,
                  std::vector<VtkArray>& whole) {
        if (!has_data_) {
            whole = std::move(arrays);
            return;
        }
        constexpr const char* reason = "not all pieces have it";
        std::map<std::string, VtkArray> of_name;
        for (VtkArray& array : arrays) of_name.try_emplace(array.name, std::move(array));
        std::erase_if(whole, [&](VtkArray& array) {
            const auto part = of_name.extract(array.name);
            const bool is_same = !part.empty() && part.mapped().type == array.type &&
                                 part.mapped().num_components == array.num_components;
            if (is_same) {
                append(part.mapped(), array);
            } else {
                decline(kind + array.name, reason);
            }
            return !is_same;
        });
        for (const auto& [name, array] : of_name) decline(kind + name, reason);
    }

    static void append(const VtkArray& part, VtkArray& whole) {
        whole.values.insert(whole.values.end(), part.values.begin(), part.values.end());
    }

    void decline(const std::string& name, const char* reason) {
        if (std::ranges::find(data_.declined, name, &DeclinedAttribute::name) ==
            data_.declined.end()) {
            data_.declined.push_back({name, reason});
        }
    }

    const SourceFile& file_;
    VtkXmlFile xml_;
    VtkXmlArrays arrays_;
    VtkData data_;
    std::uint64_t num_points_ = 0;  // Of the pieces before.
    bool has_data_ = false;         // Of points and cells, likewise.
};

}  // namespace

VtkData read_vtk_xml(const SourceFile& file) { return VtpReader(file).read(); }

MeshFile read_vtp(SourceFile file) { return make_mesh(read_vtk_xml(file), file); }

}  // namespace remesh
