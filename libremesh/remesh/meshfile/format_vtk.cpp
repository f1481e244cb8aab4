// Writes legacy VTK of version 3.0, which all programs read: binary POLYDATA with coordinates in
// double. Texture coordinates belong to points.

#include <array>

#include "agvd/core/error.h"
#include "agvd/mesh/mesh.h"
#include "remesh/meshfile/append_number.h"
#include "remesh/meshfile/byte_order.h"
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/vtk_output.h"

namespace remesh {
namespace {

constexpr std::endian vtk_order = std::endian::big;

const char* vtk_name_of(NumberType type) {
    constexpr std::array names = {"char", "unsigned_char", "short", "unsigned_short",
                                  "int",  "unsigned_int",  "float", "double"};
    return names[static_cast<std::size_t>(type)];
}

// A blank would end a name.
std::string encoded(const std::string& name) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string text;
    for (const char c : name) {
        const auto code = static_cast<unsigned char>(c);
        if (c > ' ' && c != '%' && c != '"') {
            text += c;
        } else {
            text.append({'%', digits[code / 16], digits[code % 16]});
        }
    }
    return text;
}

std::string array_head(const std::string& name, std::size_t num_components, std::size_t count,
                       NumberType type) {
    return encoded(name) + ' ' + std::to_string(num_components) + ' ' + std::to_string(count) +
           ' ' + vtk_name_of(type) + '\n';
}

void append_attributes(const char* section, const std::vector<Attribute>& attributes,
                       std::size_t count, Ticker& ticker, std::string& bytes) {
    const std::vector<VtkOutputArray> arrays = arrays_of(attributes);
    if (arrays.empty()) return;
    bytes += section;
    bytes += "FIELD FieldData " + std::to_string(arrays.size()) + '\n';
    for (const VtkOutputArray& array : arrays) {
        bytes += array_head(array.name, array.parts.size(), count, array.type);
        append_values(array, count, vtk_order, ticker, bytes);
        bytes += '\n';
    }
}

}  // namespace

std::string format_vtk(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    const std::size_t num_points = mesh.positions.size(), num_faces = mesh.triangles.size();
    if (num_points > INT32_MAX || num_faces > INT32_MAX / 4) {
        throw InvalidInput("the mesh is too large for a legacy VTK file; write .ply");
    }
    std::string bytes = "# vtk DataFile Version 3.0\nremesh\nBINARY\nDATASET POLYDATA\nPOINTS " +
                        std::to_string(num_points) + " double\n";
    for (const Vec3& p : mesh.positions) {
        ticker.tick();
        for (const double x : p) append(bytes, x, vtk_order);
    }
    bytes += "\nPOLYGONS " + std::to_string(num_faces) + ' ' + std::to_string(4 * num_faces) + '\n';
    for (const Triangle& triangle : mesh.triangles) {
        ticker.tick();
        append(bytes, std::int32_t{3}, vtk_order);
        for (const Index v : triangle) append(bytes, static_cast<std::int32_t>(v), vtk_order);
    }
    bytes += '\n';
    std::string of_points = "POINT_DATA " + std::to_string(num_points) + '\n';
    if (attributes.normals) {
        bytes += of_points + "NORMALS normals float\n";
        of_points.clear();
        for (const Vec3& normal : vertex_normals(mesh)) {
            for (const double x : normal) append(bytes, static_cast<float>(x), vtk_order);
        }
        bytes += '\n';
    }
    if (const auto texture = coordinates_of_vertices(mesh, attributes.texture); !texture.empty()) {
        const NumberType type = attributes.texture.type == NumberType::Float32
                                    ? NumberType::Float32
                                    : NumberType::Float64;
        bytes += of_points + "TEXTURE_COORDINATES " + TextureCoordinates::name + " 2 " +
                 vtk_name_of(type) + '\n';
        of_points.clear();
        for (const Vec2& p : texture) {
            for (const double x : p) append_number(bytes, type, x, vtk_order);
        }
        bytes += '\n';
    }
    append_attributes(of_points.c_str(), attributes.of_vertices, num_points, ticker, bytes);
    const std::string of_cells = "CELL_DATA " + std::to_string(num_faces) + '\n';
    append_attributes(of_cells.c_str(), attributes.of_faces, num_faces, ticker, bytes);
    return bytes;
}

}  // namespace remesh
