
#include "remesh/meshfile/formats.h"

#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/packed.h"

namespace remesh {
namespace {

constexpr std::string_view compressed = ".gz";

constexpr double any_double = std::numeric_limits<double>::max();
constexpr double any_float = std::numeric_limits<float>::max();

bool holds_all(const Attribute&, ElementKind, const MeshAttributes&) { return true; }

constexpr MeshFormat formats[] = {
    {"ply", read_ply, format_ply, holds_all, true, TexturePlace::Corners, any_double},
    {"obj", read_obj, format_obj, obj_holds, true, TexturePlace::Corners, any_double},
    {"off", read_off, format_off, off_holds, true, TexturePlace::Vertices, any_double},
    {"stl", read_stl, format_stl, stl_holds, false, TexturePlace::Nothing, any_float,
     MaterialPlace::Nothing, "millimeter"},
    {"vtk", read_vtk, format_vtk, holds_all, true, TexturePlace::Vertices, any_double},
    {"vtp", read_vtp, format_vtp, holds_all, true, TexturePlace::Nothing, any_double},
    {"vtu", read_vtp, format_vtu, holds_all, true, TexturePlace::Nothing, any_double},
    {"mesh", read_medit, format_medit, medit_holds, false, TexturePlace::Nothing, any_double},
    {"msh", read_msh, format_msh, msh_holds, false, TexturePlace::Nothing, any_double},
    {"3mf", read_3mf, format_3mf, holds_3mf, false, TexturePlace::Nothing, any_double,
     MaterialPlace::Colors, ""},
    {"glb", read_gltf, format_glb, gltf_holds, true, TexturePlace::Corners, any_float,
     MaterialPlace::All, "meter"},
    {"gltf", read_gltf, format_gltf, gltf_holds, true, TexturePlace::Corners, any_float,
     MaterialPlace::All, "meter"}};

MeshFile read_source(const MeshFormat& format, SourceFile file, const ReadOptions& options) {
    file.is_lenient = options.is_lenient;
    file.with_attributes = options.with_attributes;
    if (is_gzip(file.bytes)) unpack_gzip(file);
    return format.read(std::move(file));
}

}  // namespace

std::string lower_extension(const std::filesystem::path& path) {
    return in_lower_case(path.extension().string());
}

void attach(MeshAttributes attributes, MeshFile& file) {
    attributes.texture = std::move(file.attributes.texture);
    attributes.declined.insert(attributes.declined.begin(), file.attributes.declined.begin(),
                               file.attributes.declined.end());
    file.attributes = std::move(attributes);
    // Otherwise each polygon is a triangle.
    if (file.polygons > 0 || file.dropped_polygons > 0) {
        spread_to_triangles(file.face_polygon, file.attributes.of_faces);
    }
}

std::vector<Vec2> coordinates_of_vertices(const MeshView& mesh, const TextureCoordinates& texture) {
    if (texture.empty()) return {};
    const CornerAgreement agree(texture.corners);
    constexpr std::size_t none = ~std::size_t{0};
    std::vector<std::size_t> first(mesh.positions.size(), none);  // 3 face + corner
    std::vector<Vec2> result(mesh.positions.size(), no_coordinates()[0]);
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = mesh.triangles[f][k];
            if (first[v] == none) {
                first[v] = 3 * std::size_t{f} + k;
                result[v] = texture.corners[f][k];
            } else if (!agree(f, k, static_cast<Index>(first[v] / 3), first[v] % 3)) {
                return {};
            }
        }
    }
    return result;
}

const Attribute* labels_to_write(const std::vector<Attribute>& attributes, std::string_view name) {
    const auto fits = [](const Attribute& attribute) {
        return is_label(attribute) && attribute.type != NumberType::UInt32;
    };
    const Attribute* const named = find_attribute(attributes, name);
    if (named != nullptr && fits(*named)) return named;
    const auto found = std::ranges::find_if(attributes, fits);
    return found == attributes.end() ? nullptr : &*found;
}

std::string mesh_formats(const char* mark) {
    std::string text;
    for (const MeshFormat& format : formats) {
        const bool is_last = &format == std::end(formats) - 1;
        text += (text.empty() ? "" : is_last ? " or " : ", ") + std::string(mark) + format.name;
    }
    return text;
}

bool is_compressed(const MeshPath& path) {
    return knows_gzip() && (path.format.empty() ? lower_extension(path.path) == compressed
                                                : path.format.ends_with(compressed));
}

const MeshFormat* find_format(const MeshPath& path) {
    const bool is_packed = is_compressed(path);
    std::string name = path.format;
    if (name.empty())
        name = lower_extension(is_packed ? path.path.stem() : path.path);
    else if (is_packed)
        name.resize(name.size() - compressed.size());
    if (name.starts_with('.')) name.erase(0, 1);
    const auto* const found = std::ranges::find(formats, name, &MeshFormat::name);
    return found == std::end(formats) ? nullptr : found;
}

const MeshFormat& require_format(const MeshPath& path) {
    if (const MeshFormat* const format = find_format(path)) return *format;
    std::error_code none;
    if (std::filesystem::is_directory(path.path, none)) {
        throw IoError(joined(path.path.string(), ": is a folder; name a file"));
    }
    const std::string begin = path.path.string() + ": unknown ";
    if (!path.format.empty()) {
        throw IoError(joined(begin, "format ", in_quotes(path.format), "; use ", mesh_formats()));
    }
    throw IoError(joined(
        begin, "extension ", in_quotes(path.path.extension().string()), "; use ", mesh_formats("."),
        ", or name the format (remesh: --from for an input, --to for the output)"));
}

MeshFile read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
    Poller poller(options.progress);
    poller.poll();
    const MeshFormat& format = require_format({path, options.format});
    return read_source(format, load_file(path, poller), options);
}

MeshFile read_mesh_bytes(std::string bytes, const std::filesystem::path& name,
                         const ReadOptions& options) {
    Poller poller(options.progress);
    const MeshFormat& format = require_format({name, options.format});
    return read_source(format, take_bytes(name, std::move(bytes), poller), options);
}

MeshFile read_mesh(const std::filesystem::path& path, const Progress& progress) {
    return read_mesh(path, ReadOptions{.progress = progress});
}

const Attribute* find_attribute(const std::vector<Attribute>& attributes, std::string_view name) {
    const auto found = std::ranges::find(attributes, name, &Attribute::name);
    return found == attributes.end() ? nullptr : &*found;
}

std::string names_of(const std::vector<Attribute>& attributes) {
    std::string text;
    for (const Attribute& attribute : attributes) {
        text += (text.empty() ? "" : ", ") + attribute.name;
    }
    return text;
}

bool is_color(std::string_view name) {
    return std::ranges::find(color_names, name) != color_names.end();
}

bool is_label(const Attribute& attribute) {
    return is_integer(attribute.type) && !is_color(attribute.name);
}

bool is_value_of(NumberType type, double value) {
    return with_type(type, [&]<typename T>(T) {
        return !std::is_integral_v<T> ||
               (value >= std::numeric_limits<T>::min() && value <= std::numeric_limits<T>::max() &&
                value == std::floor(value));
    });
}

void spread_to_triangles(const std::vector<Index>& face_polygon, std::vector<Attribute>& of_faces) {
    for (Attribute& attribute : of_faces) {
        std::vector<double> values;
        values.reserve(face_polygon.size());
        for (const Index polygon : face_polygon) values.push_back(attribute.values[polygon]);
        attribute.values = std::move(values);
    }
}

}  // namespace remesh
