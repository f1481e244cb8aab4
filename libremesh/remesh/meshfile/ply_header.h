//! \file
//! The head of a PLY file: which elements follow, and how they are stored. Private to the reader.
#pragma once

#include <bit>
#include <optional>
#include <vector>

#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/source_file.h"

namespace remesh {

using PlyType = NumberType;

struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> size_type = {};  //!< Of a list: the type of its length, an integer one.
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;  //!< As announced; not reliable before the bytes are read.
    std::vector<PlyProperty> properties;

    //! The property of that name, or nullptr.
    [[nodiscard]] const PlyProperty* find(std::string_view property) const;
};

//! The name of a type in a header.
[[nodiscard]] const char* name_of(PlyType type);

struct PlyHeader {
    std::optional<std::endian> byte_order;  //!< None: ascii.
    std::vector<PlyElement> elements = {};  //!< In the order of the data.
    std::size_t size = 0;                   //!< Bytes up to the first datum.
    std::string warning = {};               //!< Lines that were passed over, leniently.
};

//! \throw IoError  by line: no PLY, an unknown type or format, an element without a name, ...
[[nodiscard]] PlyHeader read_ply_header(const SourceFile& file);

//! The mesh of binary data behind a head; binary OFF has the same layout.
//! \throw IoError, InvalidInput  as read_mesh.  \throw Cancelled
[[nodiscard]] MeshFile read_binary_ply(const PlyHeader& header, const SourceFile& file);

}  // namespace remesh
