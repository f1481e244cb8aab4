#include "remesh/meshfile/gltf_document.h"

#include "remesh/meshfile/byte_source.h"
#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/system_file.h"

namespace remesh {
namespace {

constexpr std::size_t glb_header_size = 12;
constexpr std::size_t glb_chunk_header_size = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534A, bin_chunk = 0x004E4942;
constexpr int max_depth = 64;

struct GltfComponent {
    std::uint64_t number;  // By which glTF names the type.
    NumberType type;
    double largest;  // See GltfArray.
};
constexpr GltfComponent component_types[] = {
    {5120, NumberType::Int8, 127},    {5121, NumberType::UInt8, 255},
    {5122, NumberType::Int16, 32767}, {5123, NumberType::UInt16, 65535},
    {5125, NumberType::UInt32, 0},    {5126, NumberType::Float32, 0}};

constexpr std::array gltf_shapes = {"SCALAR", "VEC2", "VEC3", "VEC4"};

// Extensions that do not change positions and corners.
bool is_harmless(const std::string& extension) {
    constexpr std::array begins = {"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_",
                                   "KHR_mesh_quantization"};
    return std::any_of(begins.begin(), begins.end(),
                       [&](const char* begin) { return extension.starts_with(begin); });
}

}  // namespace

GltfDocument::GltfDocument(SourceFile& file) : file_(file), file_size_(file.bytes.size()) {
    file_.is_binary = true;
    const bool has_chunks = file_.bytes.starts_with("glTF");
    if (has_chunks) {
        read_chunks();
    } else {
        text_ = {0, file_size_};
    }
    const char* const begin = file_.bytes.data() + text_.begin;
    // What is nested deeper is left out: other code walks the values by recursion.
    const auto is_flat = [](int depth, auto, const auto&) { return depth < max_depth; };
    json_ = nlohmann::json::parse(begin, begin + text_.size, is_flat, false);
    if (!json_.is_object()) {
        fail(
            "this is not a glTF file, as it neither begins with 'glTF' nor is a JSON object; check "
            "its extension");
    }
    if (!has_chunks && text(member(json_, "asset"), "version") != "2.0") {
        fail("the file does not say that it is glTF of version 2.0");
    }
    for (const nlohmann::json& extension : list(json_, "extensionsRequired")) {
        const std::string name = extension.is_string() ? extension.get<std::string>() : "?";
        if (is_harmless(name)) continue;
        file_.fail_malformed(
            text_.begin, "the file needs the extension ", in_quotes(name),
            ", which is not supported; export it without, such as without compression");
    }
    read_buffers();
}

void GltfDocument::read_chunks() {
    const std::string& bytes = file_.bytes;
    const auto require_size = [&](std::uint64_t size) {
        if (size <= bytes.size()) return;
        file_.fail_malformed(bytes.size(), "the file ends before byte ", size,
                             "; it is truncated: export the file again");
    };
    require_size(glb_header_size + glb_chunk_header_size);
    const auto version = load<std::uint32_t>(&bytes[4]);
    if (version != 2) {
        file_.fail_malformed(4, "glTF of version ", version,
                             " is not supported; export the file as glTF 2.0");
    }
    require_size(load<std::uint32_t>(&bytes[8]));
    const std::uint64_t json_size = load<std::uint32_t>(&bytes[glb_header_size]);
    const std::size_t json_begin = glb_header_size + glb_chunk_header_size;
    if (load<std::uint32_t>(&bytes[glb_header_size + 4]) != json_chunk) {
        file_.fail_damaged(glb_header_size, "the first chunk is not JSON");
    }
    require_size(json_begin + json_size);
    const auto next = static_cast<std::size_t>(json_begin + json_size);
    if (next + glb_chunk_header_size <= bytes.size() &&
        load<std::uint32_t>(&bytes[next + 4]) == bin_chunk) {
        const std::uint64_t size = load<std::uint32_t>(&bytes[next]);
        const std::size_t begin = next + glb_chunk_header_size;
        require_size(begin + size);
        bin_ = {begin, static_cast<std::size_t>(size)};
    }
    text_ = {json_begin, next - json_begin};
}

void GltfDocument::read_buffers() {
    for (const nlohmann::json& buffer : list(json_, "buffers")) {
        if (!buffer.contains("uri")) {
            buffers_.push_back(buffers_.empty() ? bin_ : Range{});
            continue;
        }
        const std::string bytes = resource(text(buffer, "uri"));
        buffers_.push_back({file_.bytes.size(), bytes.size()});
        file_.bytes += bytes;
    }
}

std::string GltfDocument::resource(const std::string& uri) const {
    if (uri.starts_with("data:")) {
        constexpr std::string_view mark = ";base64,";
        const std::size_t at = uri.find(mark);
        std::string buffer;
        Ticker ticker = file_.ticker;
        if (at != std::string::npos) {
            const std::string_view text = std::string_view(uri).substr(at + mark.size());
            const std::size_t num_digits = text.find_last_not_of('=') + 1;
            const auto bytes = ByteSource(text, true).take(num_digits * 3 / 4, buffer, ticker);
            if (bytes) return std::string(*bytes);
        }
        fail("the data in a URI are not base64");
    }
    const std::filesystem::path path = path_of(without_escapes(uri));
    if (path.empty() || path.has_root_path() || uri.find("://") != std::string::npos) {
        fail("data lie at ", in_quotes(uri), ", but only files beside this one are read");
    }
    try {
        Poller poller;
        return load_file(file_.path.parent_path() / path, poller).bytes;
    } catch (const IoError&) {
        fail("the file ", in_quotes(path.string()), ", which it names, cannot be read");
    }
}

std::string GltfDocument::image(const nlohmann::json& properties) const {
    if (member(properties, "uri").is_string()) return resource(text(properties, "uri"));
    const auto view = number(properties, "bufferView");
    if (!view) return {};
    const Range range = range_of_view(at("bufferViews", *view), "an image");
    return file_.bytes.substr(range.begin, range.size);
}

std::size_t GltfDocument::place(const GltfArray& array, std::uint64_t row) const {
    const std::size_t at = array.offset + row * array.stride;
    return at < file_size_ ? at : 0;
}

GltfDocument::Range GltfDocument::range_of_view(const nlohmann::json& view,
                                                const std::string& name) const {
    const std::uint64_t buffer = number(view, "buffer").value_or(0);
    const Range all = buffer < buffers_.size() ? buffers_[buffer] : Range{};
    const std::uint64_t begin = number(view, "byteOffset").value_or(0);
    const std::uint64_t size = number(view, "byteLength").value_or(0);
    // No sum can overflow: each part is checked before it is added.
    if (begin > all.size || size > all.size - begin) {
        fail(name, " does not lie within the data of the file");
    }
    return {all.begin + static_cast<std::size_t>(begin), static_cast<std::size_t>(size)};
}

const nlohmann::json& GltfDocument::at(const char* list_name, std::uint64_t index) const {
    const nlohmann::json& all = list(json_, list_name);
    if (index >= all.size() || !all[index].is_object()) {
        fail(list_name, " has no element ", index);
    }
    return all[index];
}

const nlohmann::json& GltfDocument::member(const nlohmann::json& object, const char* key) {
    static const nlohmann::json none;
    const auto found = object.find(key);
    return found == object.end() ? none : *found;
}

std::string GltfDocument::text(const nlohmann::json& object, const char* key) {
    const nlohmann::json& found = member(object, key);
    return found.is_string() ? found.get<std::string>() : "";
}

const nlohmann::json& GltfDocument::list(const nlohmann::json& object, const char* key) const {
    static const nlohmann::json empty = nlohmann::json::array();
    if (!object.contains(key)) return empty;
    if (!object[key].is_array()) fail(key, " is not a list");
    return object[key];
}

std::optional<std::uint64_t> GltfDocument::number(const nlohmann::json& object,
                                                  const char* key) const {
    if (!object.contains(key)) return std::nullopt;
    if (!object[key].is_number_unsigned()) fail(key, " is not a whole number from 0");
    return object[key].get<std::uint64_t>();
}

std::optional<std::vector<double>> GltfDocument::numbers(const nlohmann::json& object,
                                                         const char* key, std::size_t count) const {
    if (!object.contains(key)) return std::nullopt;
    std::vector<double> values;
    for (const nlohmann::json& value : list(object, key)) {
        values.push_back(value.is_number() ? value.get<double>() : std::nan(""));
        if (!std::isfinite(values.back())) fail(key, " has a value that is not a number");
    }
    if (values.size() != count) fail(key, " does not have ", count, " numbers");
    return values;
}

GltfArray GltfDocument::array(std::uint64_t index) const {
    const nlohmann::json& accessor = at("accessors", index);
    const std::string name = "accessor " + std::to_string(index);
    if (accessor.contains("sparse") || !accessor.contains("bufferView")) {
        fail(name, " is sparse or has no data, which is not supported");
    }
    const nlohmann::json& view = at("bufferViews", *number(accessor, "bufferView"));
    const std::uint64_t type = number(accessor, "componentType").value_or(0);
    const auto* const component = std::ranges::find(component_types, type, &GltfComponent::number);
    const auto* const shape = std::ranges::find(gltf_shapes, text(accessor, "type"));
    if (component == std::end(component_types) || shape == gltf_shapes.end()) {
        fail(name, " has an unknown type");
    }
    GltfArray array{.num_rows = number(accessor, "count").value_or(0),
                    .num_columns = static_cast<std::size_t>(shape - gltf_shapes.begin()) + 1,
                    .type = component->type};
    if (member(accessor, "normalized") == true) array.largest = component->largest;
    const std::size_t row_size = size_of(array.type) * array.num_columns;
    array.stride = number(view, "byteStride").value_or(row_size);
    const Range range = range_of_view(view, name);
    const std::uint64_t begin = number(accessor, "byteOffset").value_or(0);
    const bool is_inside = begin <= range.size && array.stride >= row_size && array.stride <= 1024;
    const std::uint64_t room = is_inside ? range.size - begin : 0;
    if (!is_inside || (array.num_rows > 0 && (room < row_size || (room - row_size) / array.stride <
                                                                     array.num_rows - 1))) {
        fail(name, " does not lie within the data of the file");
    }
    array.offset = range.begin + begin;
    return array;
}

double GltfDocument::value(const GltfArray& array, std::uint64_t row, std::size_t column) const {
    const char* const bytes = file_.bytes.data() + array.offset + row * array.stride;
    const double number = load_number(bytes + column * size_of(array.type), array.type);
    return array.largest > 0 ? std::max(number / array.largest, -1.0) : number;
}

}  // namespace remesh
