// Writes VTK's XML PolyData (.vtp) and UnstructuredGrid (.vtu): a piece of triangles, coordinates
// in double.

#include <array>

#include "agvd/mesh/mesh.h"
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/vtk_output.h"
#include "remesh/meshfile/vtp_writer.h"

namespace remesh {
namespace {

const char* vtp_name_of(NumberType type) {
    constexpr std::array names = {"Int8",  "UInt8",  "Int16",   "UInt16",
                                  "Int32", "UInt32", "Float32", "Float64"};
    return names[static_cast<std::size_t>(type)];
}

void add_attributes(const std::vector<Attribute>& attributes, std::size_t count, Ticker& ticker,
                    VtpWriter& writer) {
    for (const VtkOutputArray& array : arrays_of(attributes)) {
        std::string& bytes =
            writer.begin_array(array.name, vtp_name_of(array.type), array.parts.size());
        append_values(array, count, std::endian::little, ticker, bytes);
        writer.end_array();
    }
}

std::string format_vtk_xml(const MeshView& mesh, const MeshAttributes& attributes, bool is_grid,
                           Ticker ticker) {
    const std::size_t num_points = mesh.positions.size(), num_faces = mesh.triangles.size();
    VtpWriter writer({.points = num_points, .polys = num_faces}, is_grid);
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
    writer.begin_section("Points");
    writer.add_array<double>("Points", "Float64", 3, num_points, ticker,
                             [&](std::size_t v) { return mesh.positions[v]; });
    writer.end_section();
    writer.add_cells(is_grid ? "Cells" : "Polys", num_faces, ticker,
                     [&](std::size_t f) { return mesh.triangles[f]; });
    return std::move(writer).finish();
}

}  // namespace

std::string format_vtp(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    return format_vtk_xml(mesh, attributes, false, ticker);
}

std::string format_vtu(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    return format_vtk_xml(mesh, attributes, true, ticker);
}

}  // namespace remesh
