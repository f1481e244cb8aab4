//! \file
//! What every reader of meshes promises.
#pragma once

#include <algorithm>
#include <cstring>
#include <optional>

#include "agvd/core/error.h"
#include "remesh/meshfile/formats.h"
#include "require.h"

namespace fuzz {

//! Of the bytes of a whole file; nothing where they are refused in the documented way.
inline std::optional<remesh::MeshFile> read_bytes(const remesh::MeshFormat& format,
                                                  std::string bytes, bool is_lenient) {
    try {
        return format.read({.path = std::string("fuzzed.") + format.name,
                            .bytes = std::move(bytes),
                            .is_lenient = is_lenient,
                            .with_attributes = !is_lenient});
    } catch (const agvd::IoError&) {
    } catch (const agvd::InvalidInput&) {
    }
    return {};
}

inline bool has_same_bits(const agvd::TriangleMesh& a, const agvd::TriangleMesh& b) {
    return a.triangles == b.triangles && a.positions.size() == b.positions.size() &&
           std::equal(a.positions.begin(), a.positions.end(), b.positions.begin(),
                      [](const agvd::Vec3& p, const agvd::Vec3& q) {
                          return std::memcmp(p.data(), q.data(), sizeof(p)) == 0;
                      });
}

inline void check_mesh_file(const remesh::MeshFile& file) {
    const auto& [positions, triangles] = file.mesh;
    require(!triangles.empty(), "there is a face");
    for (const agvd::Vec3& p : positions) require(p.allFinite(), "coordinates are finite");
    for (const agvd::Triangle& t : triangles) {
        require(std::ranges::max(t) < positions.size(), "corners are in range");
    }
    for (const remesh::Attribute& attribute : file.attributes.of_vertices) {
        require(attribute.values.size() == positions.size(), "each vertex has its value");
    }
    for (const remesh::Attribute& attribute : file.attributes.of_faces) {
        require(attribute.values.size() == triangles.size(), "each face has its value");
    }
    const remesh::TextureCoordinates& texture = file.attributes.texture;
    require(texture.empty() || texture.corners.size() == triangles.size(),
            "each face has its texture coordinates");
    for (const remesh::CornerCoordinates& corners : texture.corners) {
        for (const agvd::Vec2& corner : corners) {
            require(corner.allFinite() || (corner.array() != corner.array()).all(),
                    "texture coordinates are finite, or none");
        }
    }
    for (const auto& [a, b] : texture.seams) {
        require(std::max(a, b) < positions.size(), "ends of seams are in range");
    }
    require(file.face_polygon.size() == triangles.size(), "each face has its polygon");
    require(std::ranges::is_sorted(file.face_polygon), "polygons are in order");
}

//! Reads the bytes as the whole file, strictly and leniently, then what is written of the result.
//! \param extension  with its dot.
inline int check_reader(const char* extension, const std::uint8_t* data, std::size_t size) {
    const remesh::MeshFormat& format = *remesh::find_format({std::string("fuzzed") + extension});
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    if (bytes.empty()) return 0;  // Refused before the format matters.
    const auto lenient = read_bytes(format, bytes, true);
    if (lenient) check_mesh_file(*lenient);
    const auto strict = read_bytes(format, bytes, false);
    if (!strict) return 0;
    check_mesh_file(*strict);
    require(lenient && has_same_bits(strict->mesh, lenient->mesh), "leniency only adds");
    for (const agvd::Vec3& p : strict->mesh.positions) {
        if ((p.array().abs() > format.largest).any()) return 0;  // A limit of single precision.
    }
    const auto again =
        read_bytes(format, format.format(strict->mesh.view(), strict->attributes, {}), false);
    require(again.has_value(), "what was written can be read");
    // Such formats round, and STL welds; objects of 3MF have vertices of their own.
    const bool has_objects =
        remesh::find_attribute(strict->attributes.of_faces, "object") != nullptr;
    require(format.is_single() || has_objects
                ? again->mesh.triangles.size() == strict->mesh.triangles.size()
                : has_same_bits(again->mesh, strict->mesh),
            "what was written comes back");
    return 0;
}

}  // namespace fuzz
