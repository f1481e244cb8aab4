#include "remesh/meshfile/vtk_xml_arrays.h"

#include <charconv>

#include "remesh/meshfile/byte_order.h"
#include "remesh/meshfile/deflated.h"
#include "remesh/meshfile/gzip.h"
#include "remesh/meshfile/text_scanner.h"

namespace remesh {
namespace {

constexpr const char* array_is_truncated = "the file ends within it, or it is no base64";

// Points often have no name.
std::string shown(const VtkXmlArray& array) {
    return "array " + (array.name.empty() ? "" : in_quotes(array.name) + " ") + "of " +
           array.section;
}

}  // namespace

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

}  // namespace remesh
