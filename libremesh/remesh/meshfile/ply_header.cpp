#include "remesh/meshfile/ply_values.h"

namespace remesh {
namespace {

// By NumberType: both names of each.
constexpr std::array<std::array<const char*, 2>, 8> type_names = {{{"char", "int8"},
                                                                   {"uchar", "uint8"},
                                                                   {"short", "int16"},
                                                                   {"ushort", "uint16"},
                                                                   {"int", "int32"},
                                                                   {"uint", "uint32"},
                                                                   {"float", "float32"},
                                                                   {"double", "float64"}}};

std::string read_name(TextScanner& scan, const char* what) {
    if (!scan.has_word()) scan.fail_expecting(what);
    return std::string(scan.word());
}

PlyType read_type(TextScanner& scan, const SourceFile& file) {
    const std::size_t start = scan.offset();
    const std::string name = read_name(scan, "a type");
    for (std::size_t type = 0; type < type_names.size(); ++type) {
        if (name == type_names[type][0] || name == type_names[type][1]) return PlyType(type);
    }
    file.fail_malformed(start, "unknown property type ", in_quotes(name),
                        "; PLY has char, uchar, short, ushort, int, uint, float and double; "
                        "export the file with these");
}

PlyProperty read_property(TextScanner& scan, const SourceFile& file) {
    const bool is_list = scan.has_word() && scan.take("list");
    const std::size_t start = scan.offset();
    std::optional<PlyType> size_type;
    if (is_list) {
        size_type = read_type(scan, file);
        if (!is_integer(*size_type)) {
            file.fail_damaged(start, "the length of a list has a type that is not an integer type");
        }
    }
    const PlyType type = read_type(scan, file);
    return {read_name(scan, "the property's name"), type, size_type};
}

std::optional<std::endian> read_byte_order(TextScanner& scan, const SourceFile& file) {
    const std::size_t start = scan.offset();
    const std::string name = read_name(scan, "the format");
    if (name == "ascii") return {};
    if (name == "binary_little_endian") return std::endian::little;
    if (name == "binary_big_endian") return std::endian::big;
    file.fail_malformed(start, "unknown PLY format ", in_quotes(name),
                        "; export as ascii, binary_little_endian or binary_big_endian");
}

// Data begin after the line end of end_header. Some programs end this line in CR LF and those
// before it in LF. Behind a lone CR the first datum may look like a line feed: only where the
// file's first line ends in a lone CR, this one may too.
std::size_t end_of_header(const SourceFile& file, std::size_t offset) {
    const std::string& bytes = file.bytes;
    if (offset == bytes.size()) return offset;
    const std::size_t first_end = bytes.find_first_of("\r\n");
    const bool is_lone_cr = bytes[first_end] == '\r' && bytes.compare(first_end, 2, "\r\n") != 0;
    return offset + (!is_lone_cr && bytes.compare(offset, 2, "\r\n") == 0 ? 2 : 1);
}

}  // namespace

const char* name_of(PlyType type) { return type_names[static_cast<std::size_t>(type)][0]; }

const PlyProperty* PlyElement::find(std::string_view property) const {
    const auto found = std::ranges::find(properties, property, &PlyProperty::name);
    return found == properties.end() ? nullptr : &*found;
}

PlyHeader read_ply_header(const SourceFile& file) {
    TextScanner scan(file, 0, {});
    PlyHeader header;
    if (scan.word() != "ply") {
        file.fail_malformed(
            0, "this is not a PLY file, as it does not begin with 'ply'; check its extension");
    }
    bool has_format = false;
    std::size_t num_unknown = 0, first_unknown = 0;  // Lines without a keyword.
    while (true) {
        scan.skip_line();
        if (!scan.find_word()) {
            scan.fail_malformed(
                "the header has no 'end_header'; it is truncated: export the file again");
        }
        const std::size_t start = scan.offset();
        const std::string_view keyword = scan.word();
        if (keyword == "end_header") break;
        if (keyword == "comment" || keyword == "obj_info") continue;
        if (keyword == "format") {
            header.byte_order = read_byte_order(scan, file);
            has_format = true;
        } else if (keyword == "element") {
            std::string name = read_name(scan, "the element's name");
            header.elements.push_back({std::move(name), scan.count("the number of elements"), {}});
        } else if (keyword == "property" && !header.elements.empty()) {
            header.elements.back().properties.push_back(read_property(scan, file));
        } else if (keyword == "property") {
            file.fail_damaged(start, "unexpected 'property' before an element");
        } else if (file.is_lenient) {
            if (num_unknown++ == 0) first_unknown = start;
        } else {
            file.fail_malformed(start, "unexpected ", in_quotes(keyword),
                                " in the header; export the file again, or pass over such lines "
                                "(remesh and agvd diagram: --lenient)");
        }
    }
    if (num_unknown > 0) {
        header.warning =
            joined(file.place(first_unknown), num_unknown,
                   num_unknown == 1 ? " line of the header begins with no keyword and is skipped"
                                    : " lines of the header begin with no keyword and are skipped");
    }
    if (!has_format) file.fail_damaged(0, "the header has no 'format'");
    if (scan.has_word()) scan.fail_damaged("data follow on the line of 'end_header'");
    header.size = end_of_header(file, scan.offset());
    return header;
}

}  // namespace remesh
