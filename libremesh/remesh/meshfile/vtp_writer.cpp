#include "remesh/meshfile/vtp_writer.h"

namespace remesh {
namespace {

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

}  // namespace

std::string xml_escaped(std::string_view text) {
    std::string escaped;
    while (!text.empty()) {
        const std::size_t size = num_bytes_of_character(text);
        switch (text.front()) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += size == 0 ? "_" : text.substr(0, size);
        }
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return escaped;
}

VtpWriter::VtpWriter(const Counts& counts, bool is_grid)
    : is_grid_(is_grid),
      kind_(is_grid ? "UnstructuredGrid" : "PolyData"),
      xml_(std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"") + kind_ +
           "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<" + kind_ +
           ">\n<Piece NumberOfPoints=\"" + std::to_string(counts.points)) {
    const std::string polys = std::to_string(counts.polys);
    xml_ += is_grid ? "\" NumberOfCells=\"" + polys + "\">\n"
                    : "\" NumberOfVerts=\"" + std::to_string(counts.verts) + "\" NumberOfLines=\"" +
                          std::to_string(counts.lines) +
                          "\" NumberOfStrips=\"0\" NumberOfPolys=\"" + polys + "\">\n";
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
    xml_ += std::string("</Piece>\n</") + kind_ + ">\n<AppendedData encoding=\"raw\">\n_";
    xml_ += data_;
    return std::move(xml_) + "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace remesh
