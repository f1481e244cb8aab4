// The structure of an XML file of VTK (format: The VTK User's Guide, "VTK File Formats", "XML File
// Formats"). Appended data may hold any bytes: XML is read up to the '_' that begins them.
#include "remesh/meshfile/vtk_xml.h"

#include "remesh/meshfile/xml_reader.h"

namespace remesh {
namespace {

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

}  // namespace

VtkXmlFile parse_vtk_xml(const SourceFile& file) {
    VtkXmlParser parser(file);
    read_xml(file, parser);
    return std::move(parser).finish();
}

}  // namespace remesh
