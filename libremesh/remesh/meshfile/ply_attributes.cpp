// Which properties of PLY are carried over is decided by their names, as programs use them:
// normals are computed anew, texture coordinates belong to corners, other lists have no single
// value.
#include "remesh/meshfile/ply_attributes.h"

#include <array>
#include <utility>

namespace remesh {
namespace {

constexpr std::array normal_names = {"nx", "ny", "nz"};

bool is_normal(const std::string& name) {
    return std::find(normal_names.begin(), normal_names.end(), name) != normal_names.end();
}

// Why a property is not carried over; empty: it is.
std::string reason_against(const PlyProperty& property, const PlyElement& element,
                           ElementKind kind) {
    if (property.size_type) return "lists are not carried over";
    if (kind == ElementKind::Face && is_normal(property.name)) {
        return "normals of faces are not carried over";
    }
    return element.find(property.name) == &property ? "" : "another property has the same name";
}

}  // namespace

PlyAttributes::PlyAttributes(const PlyElement& element, ElementKind kind,
                             const std::vector<const PlyProperty*>& used, const SourceFile& file,
                             MeshAttributes& attributes)
    : element_(element), kind_(kind), file_(file), column_(element.properties.size(), no_column) {
    if (!file.with_attributes) return;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (std::find(used.begin(), used.end(), &property) != used.end()) continue;
        const std::string reason = reason_against(property, element, kind);
        if (!reason.empty()) {
            attributes.declined.push_back({element.name + " " + property.name, reason});
        } else if (kind == ElementKind::Vertex && is_normal(property.name)) {
            attributes.normals = property.type;
        } else {
            column_[i] = columns_.size();
            columns_.push_back({{.name = property.name, .type = property.type}});
        }
    }
    // No value takes less than a byte, so that memory follows the bytes that are there.
    const std::uint64_t most = file.bytes.size() / std::max<std::size_t>(1, column_.size());
    for (Column& column : columns_) {
        column.attribute.values.reserve(std::min(element.count, most));
    }
}

void PlyAttributes::finish(MeshAttributes& attributes) && {
    auto& target = kind_ == ElementKind::Vertex ? attributes.of_vertices : attributes.of_faces;
    for (Column& column : columns_) {
        if (column.is_broken) {
            attributes.declined.push_back({element_.name + " " + column.attribute.name,
                                           "some of its values are not of its type"});
        } else {
            target.push_back(std::move(column.attribute));
        }
    }
}

}  // namespace remesh
