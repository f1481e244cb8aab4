#include "remesh/meshfile/vtk_output.h"

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/materials.h"

namespace remesh {
namespace {

NumberType stored_type(const Attribute& attribute) {
    return attribute.is_intensity ? NumberType::Float32 : attribute.type;
}

// Whether the attribute goes on where the array ends.
bool is_next_part(const Attribute& attribute, const VtkOutputArray& array) {
    return attribute.name == array.name + '_' + std::to_string(array.parts.size()) &&
           stored_type(attribute) == array.type && array.parts.size() < most_vtk_components;
}

// Of the character that begins the text; 0: XML has no such character, or it is no UTF-8.
std::size_t num_bytes_of_character(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const unsigned first = byte(0);
    if (first < 0x80) return first >= ' ' && first != 0x7F ? 1 : 0;
    const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    std::uint32_t code = first & (0x7Fu >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return 0;
        code = code << 6 | (byte(i) & 0x3F);
    }
    constexpr std::uint32_t smallest[] = {0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xD800 && code < 0xE000;
    const bool is_character = code >= smallest[size - 2] && code <= 0x10FFFF && !is_surrogate &&
                              code != 0xFFFE && code != 0xFFFF;
    return first >= 0xC2 && first < 0xF5 && is_character ? size : 0;
}

void add_attributes(const std::vector<Attribute>& attributes, std::size_t count, Ticker& ticker,
                    VtpWriter& writer) {
    for (const VtkOutputArray& array : arrays_of(attributes)) {
        std::string& bytes =
            writer.begin_array(array.name, vtk_type_of(array.type).xml_name, array.parts.size());
        append_values(array, count, std::endian::little, ticker, bytes);
        writer.end_array();
    }
}

std::string format_vtk_xml(const MeshView& mesh, const MeshAttributes& attributes, bool is_grid,
                           Ticker ticker) {
    const std::size_t num_points = mesh.positions.size(), num_faces = mesh.triangles.size();
    VtpWriter writer(is_grid);
    writer.begin_section("PointData", attributes.normals ? " Normals=\"Normals\"" : "");
    if (attributes.normals) {
        const std::vector<Vec3> normals = vertex_normals(mesh);
        writer.add_array<float>("Normals", "Float32", 3, num_points, ticker,
                                [&](std::size_t v) { return normals[v]; });
    }
    add_attributes(attributes.of_vertices, num_points, ticker, writer);
    writer.end_section();
    writer.begin_section("CellData");
    add_attributes(attributes.of_faces, num_faces, ticker, writer);
    writer.end_section();
    writer.add_points(mesh.positions, ticker);
    writer.add_cells(is_grid ? "Cells" : "Polys", num_faces, ticker,
                     [&](std::size_t f) { return mesh.triangles[f]; });
    return std::move(writer).finish();
}

}  // namespace

std::vector<VtkOutputArray> arrays_of(const std::vector<Attribute>& attributes) {
    std::vector<VtkOutputArray> arrays;
    const std::vector<const Attribute*> colors = colors_of(attributes);
    if (!colors.empty()) {
        arrays.push_back({colors.size() == 4 ? "RGBA" : "RGB", NumberType::UInt8, colors, true});
    }
    for (std::size_t i = 0; i < attributes.size(); ++i) {
        const Attribute& first = attributes[i];
        if (std::find(colors.begin(), colors.end(), &first) != colors.end()) continue;
        VtkOutputArray whole{first.name, stored_type(first), {&first}};
        if (first.name.ends_with("_0")) {
            whole.name.resize(first.name.size() - 2);
            while (i + 1 < attributes.size() && is_next_part(attributes[i + 1], whole))
                whole.parts.push_back(&attributes[++i]);
            if (whole.parts.size() == 1) whole.name = first.name;
        }
        arrays.push_back(std::move(whole));
    }
    return arrays;
}

void append_values(const VtkOutputArray& array, std::size_t num_elements, std::endian order,
                   Ticker& ticker, std::string& bytes) {
    for (std::size_t i = 0; i < num_elements; ++i) {
        ticker.tick();
        for (const Attribute* part : array.parts) {
            const double value = array.is_color ? 255 * intensity(*part, i) : part->values[i];
            append_number(bytes, array.type, value, order);
        }
    }
}

std::string xml_escaped(std::string_view text) {
    std::string escaped;
    while (!text.empty()) {
        const std::size_t size = num_bytes_of_character(text);
        const char first = text.front();
        escaped += first == '&'   ? "&amp;"
                   : first == '<' ? "&lt;"
                   : first == '"' ? "&quot;"
                   : size == 0    ? "_"
                                  : text.substr(0, size);
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return escaped;
}

void VtpWriter::begin_section(const char* name, const std::string& attributes) {
    section_ = name;
    xml_ += '<' + section_ + attributes + ">\n";
}

void VtpWriter::end_section() { xml_ += "</" + section_ + ">\n"; }

std::string& VtpWriter::begin_array(const std::string& name, const char* type,
                                    std::size_t num_components) {
    array_begin_ = data_.size();
    xml_ += std::string("<DataArray type=\"") + type + "\" Name=\"" + xml_escaped(name) +
            "\" NumberOfComponents=\"" + std::to_string(num_components) +
            "\" format=\"appended\" offset=\"" + std::to_string(array_begin_) + "\"/>\n";
    append(data_, std::uint64_t{0});
    return data_;
}

void VtpWriter::end_array() {
    std::string size;
    append(size, std::uint64_t{data_.size() - array_begin_ - sizeof(std::uint64_t)});
    data_.replace(array_begin_, size.size(), size);
}

std::string VtpWriter::finish() && {
    const std::string kind = is_grid_ ? "UnstructuredGrid" : "PolyData";
    std::string bytes =
        joined("<?xml version=\"1.0\"?>\n<VTKFile type=\"", kind,
               "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<", kind,
               ">\n<Piece NumberOfPoints=\"", num_points_, "\"");
    using Names = std::vector<const char*>;
    for (const char* section :
         is_grid_ ? Names{"Cells"} : Names{"Verts", "Lines", "Strips", "Polys"}) {
        bytes += joined(" NumberOf", section, "=\"", num_cells_[section], "\"");
    }
    bytes += ">\n" + xml_ + "</Piece>\n</" + kind + ">\n<AppendedData encoding=\"raw\">\n_";
    bytes += data_;
    bytes += "\n</AppendedData>\n</VTKFile>\n";
    return bytes;
}

std::string format_vtp(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    return format_vtk_xml(mesh, attributes, false, ticker);
}

std::string format_vtu(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    return format_vtk_xml(mesh, attributes, true, ticker);
}

}  // namespace remesh
