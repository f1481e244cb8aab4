//! \file
//! What an XML file of VTK holds, before its arrays are decoded. Private to the reader of .vtp.
#pragma once

#include <bit>
#include <string>
#include <vector>

#include "remesh/meshfile/source_file.h"

namespace remesh {

//! A DataArray: where it stands and how it is encoded.
struct VtkXmlArray {
    std::string section;  //!< "Points", "Polys", "PointData", ...
    std::string name, type, format;
    std::string num_components;      //!< Empty: 1.
    std::string appended_at;         //!< Of appended data: where they begin behind the '_'.
    std::size_t tag = 0;             //!< Of its tag in the file.
    std::size_t begin = 0, end = 0;  //!< Of the text between its tags.
};

struct VtkXmlPiece {
    std::size_t tag = 0;  //!< In the file.
    std::string num_points, num_verts, num_lines, num_strips, num_polys, num_cells;
    std::string normals_of_points, texture_of_points, normals_of_cells;  //!< Names of arrays.
    std::vector<VtkXmlArray> arrays = {};
};

struct VtkXmlFile {
    bool is_grid = false;  //!< UnstructuredGrid, else PolyData.
    std::endian order = std::endian::little;
    std::size_t header_size = 4;  //!< Bytes of a count before an array.
    std::string compressor;       //!< Empty: none.
    std::vector<VtkXmlPiece> pieces;
    bool is_appended_raw = false;    //!< Else base64.
    std::size_t appended_begin = 0;  //!< Behind the '_'; 0: there is none.
};

//! \throw IoError  it is no XML, or no PolyData nor UnstructuredGrid.  \throw Cancelled
[[nodiscard]] VtkXmlFile parse_vtk_xml(const SourceFile& file);

}  // namespace remesh
