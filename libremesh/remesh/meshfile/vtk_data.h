//! \file
//! What a file of VTK holds, in any of its encodings, and the mesh that it makes. Private to the
//! readers of VTK, and of Gmsh's values.
#pragma once

#include <bit>

#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/source_file.h"

namespace remesh {

//! A type of numbers.
struct VtkType {
    const char* name;      //!< In legacy files; lower case.
    const char* xml_name;  //!< In XML files; empty: they have no such type.
    std::size_t size;      //!< Bytes.
    NumberType type;  //!< Of the attribute. 64-bit integers have a type only with their values.
    double (*load)(const char* bytes, std::endian order);
};

//! The type of a legacy name, in lower case; nullptr: unknown.
[[nodiscard]] const VtkType* find_vtk_type(std::string_view name);
//! The type of an attribute.
[[nodiscard]] const VtkType& vtk_type_of(NumberType type);
//! The type of a name in XML files, such as Float64; nullptr: unknown.
[[nodiscard]] const VtkType* find_vtk_xml_type(std::string_view name);

struct VtkArray {
    std::string name;
    const VtkType* type = nullptr;
    std::size_t num_components = 1;
    std::vector<double> values = {};  //!< All components of an element next to each other.
    std::size_t offset = 0;           //!< Where it begins in the file.

    //! Takes the numbers of its type that these bytes are.
    void read(std::string_view bytes, std::endian order, Ticker& ticker);
};

//! Types of cells by VTK's numbers; all others are skipped.
enum class VtkCell : std::uint8_t {
    Vertices = 2,
    Lines = 4,
    Triangle = 5,
    Strip = 6,
    Polygon = 7,
    Pixel = 8,  //!< A quad whose corners are listed row by row.
    Quad = 9,
    Tetrahedron = 10,
    Voxel = 11,  //!< A hexahedron whose corners are listed row by row.
    Hexahedron = 12,
    Wedge = 13,
    Pyramid = 14
};

//! Cells that stand together in the file.
struct VtkCells {
    VtkArray corners;               //!< Of all cells, one after the other.
    std::vector<std::size_t> ends;  //!< By cell: its end in the corners.
    std::vector<VtkCell> types;     //!< By cell; a single one holds for all.
};

//! Where each cell ends in an array of corners.
//! \throw IoError  they are not in order, or do not end with the corners.
[[nodiscard]] std::vector<std::size_t> ends_of_cells(const VtkArray& offsets,
                                                     std::size_t num_corners,
                                                     const SourceFile& file);

//! Numbers that are types of cells; others become one that is no face.
[[nodiscard]] std::vector<VtkCell> types_of_cells(const VtkArray& numbers);

struct VtkData {
    std::optional<VtkArray> points;
    std::vector<VtkCells> cells;  //!< In the order of the data of cells.
    std::vector<VtkArray> of_points = {}, of_cells = {};
    std::optional<NumberType> normals = {};  //!< Of points.
    std::optional<VtkArray> texture = {};    //!< Of points; two or three coordinates.
    std::vector<DeclinedAttribute> declined = {};
};

//! The points, cells and arrays of an XML file of VTK.
//! \throw IoError, InvalidInput  damaged; names the array.  \throw Cancelled
[[nodiscard]] VtkData read_vtk_xml(const SourceFile& file);

//! The components of an array that is carried over, at most.
constexpr std::size_t most_vtk_components = 64;

//! Adds an array as attributes, one for each component. What cannot be carried over is declined.
//! \throw IoError  it has another number of values.
void add_array(const VtkArray& array, ElementKind kind, std::size_t num_elements,
               const SourceFile& file, MeshAttributes& attributes);

//! The mesh of all faces; where there are none, the surface of the volume cells, with a warning.
//! Other cells are skipped with a warning.
//! \throw IoError  counts do not fit.  \throw InvalidInput  no face is left, an index is
//!        out of range, a coordinate is not finite.
[[nodiscard]] MeshFile make_mesh(VtkData data, const SourceFile& file);

}  // namespace remesh
