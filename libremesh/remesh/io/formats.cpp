#include "remesh/io/formats.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "agvd/core/error.h"

namespace remesh {
namespace {

constexpr double any_double = std::numeric_limits<double>::max();
constexpr double any_float = std::numeric_limits<float>::max();

bool ply_holds(const Attribute&, ElementKind, const MeshAttributes&) { return true; }
bool stl_holds(const Attribute&, ElementKind, const MeshAttributes&) { return false; }

constexpr MeshFormat formats[] = {{".ply", read_ply, format_ply, ply_holds, true, any_double},
                                  {".obj", read_obj, format_obj, obj_holds, true, any_double},
                                  {".off", read_off, format_off, off_holds, true, any_double},
                                  {".stl", read_stl, format_stl, stl_holds, false, any_float}};

}  // namespace

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    // Not std::tolower, which depends on the locale.
    for (char& c : extension) c = 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return extension;
}

void attach(MeshAttributes attributes, MeshFile& file) {
    file.attributes = std::move(attributes);
    // Otherwise each polygon is a triangle.
    if (file.polygons > 0 || file.dropped_polygons > 0) {
        spread_to_triangles(file.face_polygon, file.attributes.of_faces);
    }
}

const MeshFormat* find_format(const std::filesystem::path& path) {
    const std::string extension = lower_extension(path);
    const auto* const found =
        std::find_if(std::begin(formats), std::end(formats),
                     [&](const MeshFormat& format) { return extension == format.extension; });
    return found == std::end(formats) ? nullptr : found;
}

const MeshFormat& require_format(const std::filesystem::path& path) {
    if (const MeshFormat* const format = find_format(path)) return *format;
    throw agvd::IoError(path.string() + ": unknown extension " +
                        in_quotes(path.extension().string()) + "; use .ply, .obj, .off or .stl");
}

}  // namespace remesh
