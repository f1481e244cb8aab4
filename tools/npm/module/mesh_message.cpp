#include "mesh_message.h"

#include "choose.h"

namespace npm {
namespace {

using agvd::Index;
using remesh::Attribute;
using remesh::MeshAttributes;
using remesh::NumberType;

const char* type_name(NumberType type) {
    constexpr const char* names[] = {"int8",  "uint8",  "int16",   "uint16",
                                     "int32", "uint32", "float32", "float64"};
    return names[static_cast<std::size_t>(type)];
}

NumberType type_of(const Json& name) {
    using enum NumberType;
    return cli::choose<NumberType>("the type", name.get<std::string>(),
                                   {Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64},
                                   type_name);
}

std::optional<NumberType> optional_type(const Json& object, const char* key) {
    if (!object.contains(key)) return std::nullopt;
    return type_of(object[key]);
}

template <typename Number>
std::vector<Number> copy_of(const Request& request, const std::string& name) {
    const std::span<const Number> array = request.array<Number>(name);
    return {array.begin(), array.end()};
}

// Rows of numbers that stand one behind the other.
template <typename Row, typename Number>
std::span<const Row> rows_of(const Request& request, const std::string& name) {
    constexpr std::size_t width = sizeof(Row) / sizeof(Number);
    const std::span<const Number> array = request.array<Number>(name);
    return {reinterpret_cast<const Row*>(array.data()), array.size() / width};
}

template <typename Row, typename Number>
std::vector<Row> copied_rows(const Request& request, const std::string& name) {
    const std::span<const Row> rows = rows_of<Row, Number>(request, name);
    return {rows.begin(), rows.end()};
}

std::string numbered(const char* kind, std::size_t i) { return kind + ("." + std::to_string(i)); }

std::vector<Attribute> attributes_of(const Request& request, const char* kind) {
    const Json& mesh = request.json()["mesh"];
    std::vector<Attribute> attributes;
    for (const Json& one : mesh.value(kind, Json::array())) {
        attributes.push_back({.name = one["name"],
                              .type = type_of(one["type"]),
                              .values = copy_of<double>(request, numbered(kind, attributes.size())),
                              .names = one.value("names", std::vector<std::string>()),
                              .is_intensity = one.value("isIntensity", false)});
    }
    return attributes;
}

Json add_attributes(std::vector<Attribute> attributes, const char* kind, Answer& answer) {
    Json all = Json::array();
    for (Attribute& one : attributes) {
        answer.add<double>(numbered(kind, all.size()), std::move(one.values));
        Json described = {{"name", one.name}, {"type", type_name(one.type)}};
        if (!one.names.empty()) described["names"] = one.names;
        if (one.is_intensity) described["isIntensity"] = true;
        all.push_back(std::move(described));
    }
    return all;
}

constexpr const char* of_vertices = "vertexData";
constexpr const char* of_faces = "faceData";

MeshAttributes all_attributes(const Request& request) {
    const Json& mesh = request.json()["mesh"];
    MeshAttributes attributes{
        .of_vertices = attributes_of(request, of_vertices),
        .of_faces = attributes_of(request, of_faces),
        .normals = optional_type(mesh, "normals"),
        .material_files = mesh.value("materialFiles", std::vector<std::string>()),
        .unit = mesh.value("unit", std::string())};
    attributes.texture.type = optional_type(mesh, "uvType");
    attributes.texture.corners = copied_rows<remesh::CornerCoordinates, double>(request, "uv");
    attributes.materials.json = mesh.value("materials", std::string());
    for (std::size_t i = 0; request.has_array(numbered("image", i).c_str()); ++i) {
        const auto bytes = request.array<char>(numbered("image", i));
        attributes.materials.images.emplace_back(bytes.begin(), bytes.end());
    }
    return attributes;
}

}  // namespace

agvd::MeshView view_of(const Request& request) {
    return {rows_of<agvd::Vec3, double>(request, "positions"),
            rows_of<agvd::Triangle, Index>(request, "triangles")};
}

remesh::MeshFile mesh_of(const Request& request) {
    const agvd::MeshView view = view_of(request);
    const Json& mesh = request.json()["mesh"];
    remesh::MeshFile file;
    file.mesh.positions.assign(view.positions.begin(), view.positions.end());
    file.mesh.triangles.assign(view.triangles.begin(), view.triangles.end());
    file.attributes = all_attributes(request);
    file.face_polygon = copy_of<Index>(request, "facePolygon");
    if (!file.face_polygon.empty()) {
        file.polygons = mesh.value("polygons", Index{0});
        file.dropped_polygons = mesh.value("droppedPolygons", Index{0});
    } else {
        for (Index f = 0; f < view.triangles.size(); ++f) file.face_polygon.push_back(f);
    }
    file.feature_edges = copied_rows<std::array<Index, 2>, Index>(request, "featureEdges");
    file.locked_edges = copied_rows<std::array<Index, 2>, Index>(request, "lockedEdges");
    file.locked = copy_of<Index>(request, "locked");
    return file;
}

void add_mesh(remesh::MeshFile file, Answer& answer) {
    MeshAttributes& attributes = file.attributes;
    Json mesh = Json::object();
    mesh[of_vertices] = add_attributes(std::move(attributes.of_vertices), of_vertices, answer);
    mesh[of_faces] = add_attributes(std::move(attributes.of_faces), of_faces, answer);
    if (attributes.normals) mesh["normals"] = type_name(*attributes.normals);
    if (attributes.texture.type) mesh["uvType"] = type_name(*attributes.texture.type);
    if (!attributes.material_files.empty()) mesh["materialFiles"] = attributes.material_files;
    if (!attributes.unit.empty()) mesh["unit"] = attributes.unit;
    if (!attributes.materials.empty()) mesh["materials"] = attributes.materials.json;
    std::size_t num_images = 0;
    for (std::string& image : attributes.materials.images) {
        answer.add_bytes(numbered("image", num_images++), std::move(image));
    }
    answer.add<double>("positions", std::move(file.mesh.positions));
    answer.add<Index>("triangles", std::move(file.mesh.triangles));
    if (!attributes.texture.empty()) {
        answer.add<double>("uv", std::move(attributes.texture.corners));
    }
    if (file.polygons > 0 || file.dropped_polygons > 0) {
        mesh["polygons"] = file.polygons;
        mesh["droppedPolygons"] = file.dropped_polygons;
        answer.add<Index>("facePolygon", std::move(file.face_polygon));
    }
    if (!file.feature_edges.empty()) answer.add<Index>("featureEdges", file.feature_edges);
    if (!file.locked_edges.empty()) answer.add<Index>("lockedEdges", file.locked_edges);
    if (!file.locked.empty()) answer.add<Index>("locked", file.locked);
    answer.json["mesh"] = std::move(mesh);
}

}  // namespace npm
