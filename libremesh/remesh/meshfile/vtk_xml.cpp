//! What an XML file of VTK holds, before its arrays are decoded. Private to the reader of .vtp.
//! Decodes the arrays of an XML file of VTK. Private to the reader of .vtp.
// The structure of an XML file of VTK (format: The VTK User's Guide, "VTK File Formats", "XML File
// Formats"). Appended data may hold any bytes: XML is read up to the '_' that begins them.
// VTK's XML files: PolyData (.vtp) and UnstructuredGrid (.vtu). The pieces of a file become
// one mesh, piece after piece.

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "remesh/meshfile/byte_source.h"
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/source_file.h"
#include "remesh/meshfile/text_scanner.h"
#include "remesh/meshfile/vtk_data.h"
#include "remesh/meshfile/xml_reader.h"

namespace remesh {
namespace {

//! A DataArray: where it stands and how it is encoded.
struct VtkXmlArray {
    std::string section;  //!< "Points", "Polys", "PointData", ...
    std::string name, type, format;
    std::string num_components;      //!< Empty: 1.
    std::string appended_at;         //!< Of appended data: where they begin behind the '_'.
    std::size_t tag = 0;             //!< Of its tag in the file.
    std::size_t begin = 0, end = 0;  //!< Of the text between its tags.
};

struct VtkXmlPiece {
    std::size_t tag = 0;  //!< In the file.
    std::string num_points, num_verts, num_lines, num_strips, num_polys, num_cells;
    std::string normals_of_points, texture_of_points, normals_of_cells;  //!< Names of arrays.
    std::vector<VtkXmlArray> arrays = {};
};

struct VtkXmlFile {
    bool is_grid = false;  //!< UnstructuredGrid, else PolyData.
    std::endian order = std::endian::little;
    std::size_t header_size = 4;  //!< Bytes of a count before an array.
    std::string compressor;       //!< Empty: none.
    std::vector<VtkXmlPiece> pieces;
    bool is_appended_raw = false;    //!< Else base64.
    std::size_t appended_begin = 0;  //!< Behind the '_'; 0: there is none.
};

//! \throw IoError  it is no XML, or no PolyData nor UnstructuredGrid.  \throw Cancelled
[[nodiscard]] VtkXmlFile parse_vtk_xml(const SourceFile& file);

class VtkXmlArrays {
public:
    //! Both outlive this.
    VtkXmlArrays(const SourceFile& file, const VtkXmlFile& xml)
        : file_(file), xml_(xml), ticker_(file.ticker) {}

    //! The numbers of an array. Memory follows the bytes that are there.
    //! \throw IoError  truncated, damaged, of an unknown type or encoding.
    //! \throw Cancelled
    [[nodiscard]] VtkArray read(const VtkXmlArray& array);

    //! A count that an attribute gives; nothing if it is empty.
    //! \throw IoError  it is no whole number.
    [[nodiscard]] std::optional<std::uint64_t> count(const std::string& text, const char* what,
                                                     std::size_t offset) const;

    //! Throws IoError that names the array. The remedy is added.
    [[noreturn]] void fail(const VtkXmlArray& array, const std::string& text) const;

    Ticker& ticker() { return ticker_; }

private:
    void read_text(const VtkXmlArray& array, VtkArray& result);
    void read_bytes(const VtkXmlArray& array, ByteSource source, VtkArray& result);
    [[nodiscard]] ByteSource appended(const VtkXmlArray& array) const;
    std::string unpack(const VtkXmlArray& array, ByteSource& source, std::uint64_t num_blocks);
    std::uint64_t take_count(const VtkXmlArray& array, ByteSource& source);

    const SourceFile& file_;
    const VtkXmlFile& xml_;
    Ticker ticker_;
    std::string buffer_;
};

std::string value_of(const XmlTag& tag, std::string_view name) {
    return std::string(tag.find(name).value_or(""));
}

class VtkXmlParser : public XmlVisitor {
public:
    explicit VtkXmlParser(const SourceFile& file) : file_(file) {}

    bool begin(const XmlTag& tag) override {
        const std::size_t depth = depth_++;
        if (depth == 0) {
            read_root(tag);
        } else if (depth == 1) {
            is_in_mesh_ = tag.name == kind_;
            if (tag.name == "AppendedData") return read_appended(tag);
        } else if (depth == 2 && is_in_mesh_) {
            is_in_piece_ = tag.name == "Piece";
            if (is_in_piece_) read_piece(tag);
        } else if (depth == 3 && is_in_mesh_ && is_in_piece_) {
            read_section(tag);
        } else if (depth == 4 && is_in_mesh_ && is_in_piece_) {
            read_array(tag);
        } else if (depth == 5 && is_in_mesh_ && is_in_piece_) {
            end_text(tag.begin);
        }
        return true;
    }

    void end(std::size_t at, std::size_t behind) override {
        --depth_;
        if (!is_in_mesh_ || !is_in_piece_) return;
        if (depth_ == 4) end_text(at);
        if (depth_ == 5) skip_key(behind);
    }

    VtkXmlFile finish() && {
        if (kind_.empty()) fail(0, "there is no element VTKFile");
        return std::move(result_);
    }

private:
    [[noreturn]] void fail(std::size_t offset, const std::string& text) const {
        file_.fail_malformed(offset, text + "; export the file again");
    }

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
            file_.fail_malformed(tag.begin, "the file begins with the element " +
                                                in_quotes(tag.name) +
                                                " instead of VTKFile; check its extension");
        }
        kind_ = value_of(tag, "type");
        result_.is_grid = kind_ == "UnstructuredGrid";
        if (kind_ != "PolyData" && !result_.is_grid) {
            file_.fail_malformed(tag.begin,
                                 "the file holds " + in_quotes(kind_) +
                                     ", not PolyData or UnstructuredGrid; extract its surface (in "
                                     "ParaView: Extract Surface) and save that as one file");
        }
        const std::string order = value_of(tag, "byte_order");
        if (order == "BigEndian") result_.order = std::endian::big;
        if (!order.empty() && order != "BigEndian" && order != "LittleEndian") {
            fail(tag.begin, "unknown byte_order " + in_quotes(order));
        }
        const std::string header = value_of(tag, "header_type");
        if (header == "UInt64") result_.header_size = 8;
        if (!header.empty() && header != "UInt32" && header != "UInt64") {
            fail(tag.begin, "unknown header_type " + in_quotes(header));
        }
        result_.compressor = value_of(tag, "compressor");
    }

    // \return false, as nothing behind it is XML.
    bool read_appended(const XmlTag& tag) {
        const std::string encoding = value_of(tag, "encoding");
        result_.is_appended_raw = encoding == "raw";
        if (!result_.is_appended_raw && encoding != "base64") {
            fail(tag.begin, "unknown encoding " + in_quotes(encoding) + " of AppendedData");
        }
        const std::size_t mark = file_.bytes.find_first_not_of(" \t\r\n", tag.end);
        if (mark == std::string::npos || file_.bytes[mark] != '_') {
            fail(tag.end, "AppendedData do not begin with '_'");
        }
        result_.appended_begin = mark + 1;
        return false;
    }

    void read_piece(const XmlTag& tag) {
        result_.pieces.push_back({.tag = tag.begin,
                                  .num_points = value_of(tag, "NumberOfPoints"),
                                  .num_verts = value_of(tag, "NumberOfVerts"),
                                  .num_lines = value_of(tag, "NumberOfLines"),
                                  .num_strips = value_of(tag, "NumberOfStrips"),
                                  .num_polys = value_of(tag, "NumberOfPolys"),
                                  .num_cells = value_of(tag, "NumberOfCells"),
                                  .normals_of_points = {},
                                  .texture_of_points = {},
                                  .normals_of_cells = {}});
    }

    void read_section(const XmlTag& tag) {
        section_ = tag.name;
        VtkXmlPiece& piece = result_.pieces.back();
        if (section_ == "PointData") {
            piece.normals_of_points = value_of(tag, "Normals");
            piece.texture_of_points = value_of(tag, "TCoords");
        } else if (section_ == "CellData") {
            piece.normals_of_cells = value_of(tag, "Normals");
        }
    }

    void read_array(const XmlTag& tag) {
        result_.pieces.back().arrays.push_back(
            {.section = section_,
             .name = value_of(tag, "Name"),
             .type = value_of(tag, "type"),
             .format = value_of(tag, "format"),
             .num_components = value_of(tag, "NumberOfComponents"),
             .appended_at = value_of(tag, "offset"),
             .tag = tag.begin,
             .begin = tag.end,
             .end = tag.end});
    }

    const SourceFile& file_;
    VtkXmlFile result_;
    std::string kind_, section_;
    std::size_t depth_ = 0;  // Of the element that is open.
    bool is_in_mesh_ = false, is_in_piece_ = false;
};

VtkXmlFile parse_vtk_xml(const SourceFile& file) {
    VtkXmlParser parser(file);
    read_xml(file, parser);
    return std::move(parser).finish();
}

constexpr const char* array_is_truncated = "the file ends within it, or it is no base64";

// Points often have no name.
std::string shown(const VtkXmlArray& array) {
    return "array " + (array.name.empty() ? "" : in_quotes(array.name) + " ") + "of " +
           array.section;
}

VtkArray VtkXmlArrays::read(const VtkXmlArray& array) {
    VtkArray result{.name = array.name, .type = find_vtk_xml_type(array.type), .offset = array.tag};
    if (result.type == nullptr) {
        file_.fail_malformed(array.tag, shown(array) + " has the type " + in_quotes(array.type) +
                                            ", which is not supported; export the file without it");
    }
    result.num_components = static_cast<std::size_t>(
        count(array.num_components, "NumberOfComponents", array.tag).value_or(1));
    const auto text = std::string_view(file_.bytes).substr(array.begin, array.end - array.begin);
    if (array.format.empty() || array.format == "ascii") {
        read_text(array, result);
    } else if (array.format == "binary") {
        read_bytes(array, ByteSource(text, true), result);
    } else if (array.format == "appended") {
        read_bytes(array, appended(array), result);
    } else {
        fail(array, "unknown format " + in_quotes(array.format));
    }
    return result;
}

std::optional<std::uint64_t> VtkXmlArrays::count(const std::string& text, const char* what,
                                                 std::size_t offset) const {
    if (text.empty()) return std::nullopt;
    std::uint64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc{} && last == end) return value;
    file_.fail_malformed(offset, std::string(what) + " is " + in_quotes(text) +
                                     " and no whole number from 0; export the file again");
}

void VtkXmlArrays::fail(const VtkXmlArray& array, const std::string& text) const {
    file_.fail_malformed(array.tag, shown(array) + ": " + text + "; export the file again");
}

void VtkXmlArrays::read_text(const VtkXmlArray& array, VtkArray& result) {
    TextScanner scan(file_, array.begin, {.comment = '<'});
    while (scan.find_word() && scan.offset() < array.end) {
        ticker_.tick(2);
        result.values.push_back(scan.number("a number"));
    }
}

ByteSource VtkXmlArrays::appended(const VtkXmlArray& array) const {
    const auto at = count(array.appended_at, "the offset of an array", array.tag);
    if (!at) fail(array, "its data are appended, but it has no offset");
    if (xml_.appended_begin == 0) fail(array, "its data are appended, but there are no such data");
    if (*at > file_.bytes.size() - xml_.appended_begin) {
        fail(array, "its data begin at byte " + std::to_string(*at) +
                        " of the appended ones, behind the end of the file");
    }
    const auto begin = xml_.appended_begin + static_cast<std::size_t>(*at);
    return {std::string_view(file_.bytes).substr(begin), !xml_.is_appended_raw};
}

std::uint64_t VtkXmlArrays::take_count(const VtkXmlArray& array, ByteSource& source) {
    const auto bytes = source.take(xml_.header_size, buffer_, ticker_);
    if (!bytes) fail(array, array_is_truncated);
    return xml_.header_size == 8 ? load<std::uint64_t>(bytes->data(), xml_.order)
                                 : load<std::uint32_t>(bytes->data(), xml_.order);
}

// The first count is that of bytes, or of compressed blocks.
void VtkXmlArrays::read_bytes(const VtkXmlArray& array, ByteSource source, VtkArray& result) {
    // Some writers leave out the count of an empty array.
    if (array.format == "binary" && source.is_at_end()) return;
    const std::uint64_t first = take_count(array, source);
    std::string unpacked;
    std::string_view bytes;
    if (xml_.compressor.empty()) {
        const auto taken = source.take(first, buffer_, ticker_);
        if (!taken) fail(array, array_is_truncated);
        bytes = *taken;
    } else {
        unpacked = unpack(array, source, first);
        bytes = unpacked;
    }
    if (array.format == "binary" && !source.is_at_end()) {
        fail(array, "it has more data than it announces");
    }
    const std::size_t size = result.type->size;
    if (bytes.size() % size != 0) {
        fail(array,
             "its " + std::to_string(bytes.size()) + " bytes are no whole number of " + array.type);
    }
    result.values.reserve(bytes.size() / size);
    for (std::size_t at = 0; at < bytes.size(); at += size) {
        ticker_.tick();
        result.values.push_back(result.type->load(bytes.data() + at, xml_.order));
    }
}

// Blocks of one size, but for a last one that may be smaller (0: it is not), and before them the
// size that each is compressed to.
std::string VtkXmlArrays::unpack(const VtkXmlArray& array, ByteSource& source,
                                 std::uint64_t num_blocks) {
    if (xml_.compressor != "vtkZLibDataCompressor") {
        file_.fail_malformed(array.tag, "the arrays are compressed by " +
                                            in_quotes(xml_.compressor) +
                                            ", which is not supported; save the file with zlib, or "
                                            "without compression");
    }
    if (!knows_gzip()) {
        file_.fail_malformed(array.tag,
                             "the arrays are compressed, and this program was built without zlib; "
                             "save the file without compression");
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
        const auto packed = source.take(packed_sizes[b], buffer_, ticker_);
        if (!packed) fail(array, array_is_truncated);
        if (!append_unpacked(*packed, DeflatedIn::Zlib, is_partial ? last_size : block_size,
                             ticker_, bytes)) {
            fail(array, "block " + std::to_string(b) + " of its compressed data is damaged");
        }
    }
    return bytes;
}

// Arrays of points or cells, piece after piece. What not all pieces have is declined.
class PieceArrays {
public:
    void take(std::vector<VtkArray> arrays, std::vector<DeclinedAttribute>& declined,
              const char* kind) {
        std::map<std::string, std::size_t> of_name;
        for (std::size_t i = 0; i < arrays.size(); ++i) of_name.try_emplace(arrays[i].name, i);
        if (std::exchange(is_first_, false)) {
            arrays_ = std::move(arrays);
            return;
        }
        std::erase_if(arrays_, [&](VtkArray& whole) {
            const auto found = of_name.find(whole.name);
            if (found != of_name.end()) {
                const VtkArray part = std::move(arrays[found->second]);
                of_name.erase(found);
                if (part.type == whole.type && part.num_components == whole.num_components) {
                    whole.values.insert(whole.values.end(), part.values.begin(), part.values.end());
                    return false;
                }
            }
            declined.push_back({kind + whole.name, "not all pieces have it"});
            return true;
        });
        for (const auto& [name, array] : of_name) {
            declined.push_back({kind + name, "not all pieces have it"});
        }
    }
    std::vector<VtkArray> finish() && { return std::move(arrays_); }

private:
    std::vector<VtkArray> arrays_;
    bool is_first_ = true;
};

class VtpReader {
public:
    explicit VtpReader(const SourceFile& file)
        : file_(file), xml_(parse_vtk_xml(file)), arrays_(file, xml_) {}

    VtkData read() {
        for (const VtkXmlPiece& piece : xml_.pieces) read_piece(piece);
        data_.points = std::move(points_);
        data_.of_points = std::move(of_points_).finish();
        data_.of_cells = std::move(of_cells_).finish();
        return std::move(data_);
    }

private:
    using Count = std::optional<std::uint64_t>;

    void read_piece(const VtkXmlPiece& piece) {
        const std::uint64_t num_points = read_points(piece);
        std::uint64_t num_cells = 0;
        const auto read = [&](const char* section, const std::string& count, VtkCell type) {
            num_cells += read_cells(piece, section, arrays_.count(count, section, piece.tag), type,
                                    num_points);
        };
        if (xml_.is_grid) {
            read("Cells", piece.num_cells, VtkCell{0});
        } else {
            read("Verts", piece.num_verts, VtkCell::Vertices);
            read("Lines", piece.num_lines, VtkCell::Lines);
            read("Polys", piece.num_polys, VtkCell::Polygon);
            read("Strips", piece.num_strips, VtkCell::Strip);
        }
        num_points_ += num_points;
        if (!file_.with_attributes || (num_points == 0 && num_cells == 0)) return;
        of_points_.take(read_data(piece, "PointData", num_points), data_.declined, "vertex ");
        of_cells_.take(read_data(piece, "CellData", num_cells), data_.declined, "face ");
    }

    static const VtkXmlArray* find(const VtkXmlPiece& piece, std::string_view section,
                                   std::string_view name) {
        const auto found =
            std::find_if(piece.arrays.begin(), piece.arrays.end(), [&](const VtkXmlArray& array) {
                return array.section == section && (name.empty() || array.name == name);
            });
        return found == piece.arrays.end() ? nullptr : &*found;
    }

    // \return how many points the piece has.
    std::uint64_t read_points(const VtkXmlPiece& piece) {
        const Count announced = arrays_.count(piece.num_points, "NumberOfPoints", piece.tag);
        const VtkXmlArray* const found = find(piece, "Points", "");
        if (found == nullptr) {
            if (announced.value_or(0) == 0) return 0;
            file_.fail_malformed(piece.tag, "NumberOfPoints is " + std::to_string(*announced) +
                                                ", but the piece has no array of Points; export "
                                                "the file again");
        }
        VtkArray points = arrays_.read(*found);
        if (points.num_components != 3) arrays_.fail(*found, "it has not three coordinates each");
        require_count(*found, points, announced);
        const std::uint64_t count = points.values.size() / 3;
        if (!points_) {
            points_ = std::move(points);
        } else {
            points_->values.insert(points_->values.end(), points.values.begin(),
                                   points.values.end());
        }
        return count;
    }

    void require_count(const VtkXmlArray& found, const VtkArray& array,
                       const Count& announced) const {
        const std::size_t size = array.values.size(), width = array.num_components;
        const bool is_whole = width != 0 && size % width == 0;
        if (is_whole && (!announced || size / width == *announced)) return;
        arrays_.fail(found, "it has " + std::to_string(size) + " numbers for " +
                                std::to_string(announced.value_or(0)) + " elements with " +
                                std::to_string(width) + " each");
    }

    // \return how many cells the section has.
    std::uint64_t read_cells(const VtkXmlPiece& piece, const char* section, const Count& announced,
                             VtkCell type, std::uint64_t num_points) {
        const VtkXmlArray* const corners = find(piece, section, "connectivity");
        const VtkXmlArray* const ends = find(piece, section, "offsets");
        const VtkXmlArray* const types = xml_.is_grid ? find(piece, section, "types") : nullptr;
        if (corners == nullptr || ends == nullptr || (xml_.is_grid && types == nullptr)) {
            if (announced.value_or(0) == 0) return 0;
            file_.fail_malformed(piece.tag, "there are " + std::to_string(*announced) + " cells (" +
                                                section +
                                                "), but not the arrays that make them; export the "
                                                "file again");
        }
        VtkCells cells{.corners = arrays_.read(*corners), .ends = {}, .types = {type}};
        const VtkArray offsets = arrays_.read(*ends);
        require_count(*ends, offsets, announced);
        cells.ends = ends_of_cells(offsets, 0, cells.corners.values.size(), file_);
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
                file_.fail_unusable(
                    found.tag, "array " + in_quotes(found.name) + " of " + found.section +
                                   " names point " + shown(corner) + ", but the piece has only " +
                                   std::to_string(num_points) +
                                   " points, counted from 0; correct the cell, or export the file "
                                   "again");
            }
            corner += static_cast<double>(num_points_);
        }
    }
    static std::string shown(double number) {
        std::string text = std::to_string(number);
        return text.substr(0, text.find('.'));
    }

    std::vector<VtkArray> read_data(const VtkXmlPiece& piece, std::string_view section,
                                    std::uint64_t count) {
        const bool is_of_points = section == "PointData";
        const char* const kind = is_of_points ? "vertex " : "face ";
        std::vector<VtkArray> result;
        for (const VtkXmlArray& array : piece.arrays) {
            if (array.section != section) continue;
            const VtkType* const type = find_vtk_xml_type(array.type);
            const auto is = [&](const std::string& name) {
                return !name.empty() && array.name == name;
            };
            if (type == nullptr) {
                decline(kind + array.name, "arrays of this type are not carried over");
            } else if (is_of_points && is(piece.normals_of_points)) {
                data_.normals = type->type;
            } else if (is_of_points && is(piece.texture_of_points)) {
                decline(kind + array.name, "texture coordinates are not carried over");
            } else if (!is_of_points && is(piece.normals_of_cells)) {
                decline(kind + array.name, "normals of faces are not carried over");
            } else {
                result.push_back(arrays_.read(array));
                require_count(array, result.back(), count);
            }
        }
        return result;
    }

    void decline(const std::string& name, const char* reason) {
        const auto is_same = [&](const DeclinedAttribute& one) { return one.name == name; };
        if (std::none_of(data_.declined.begin(), data_.declined.end(), is_same)) {
            data_.declined.push_back({name, reason});
        }
    }

    const SourceFile& file_;
    VtkXmlFile xml_;
    VtkXmlArrays arrays_;
    VtkData data_;
    std::optional<VtkArray> points_;
    PieceArrays of_points_, of_cells_;
    std::uint64_t num_points_ = 0;  // Of the pieces before.
};

}  // namespace

VtkData read_vtk_xml(const SourceFile& file) { return VtpReader(file).read(); }

MeshFile read_vtp(SourceFile file) { return make_mesh(read_vtk_xml(file), file); }

}  // namespace remesh
