#include "binding/arrays.h"

namespace python {
namespace {

void require(bool is_right, const char* text) {
    if (!is_right) throw py::value_error(text);
}

bool has_three_columns(const py::array& array) { return array.ndim() == 2 && array.shape(1) == 3; }

}  // namespace

agvd::MeshView view_of(const Doubles& positions, const Indices& triangles) {
    require(has_three_columns(positions), "positions must have three columns");
    require(has_three_columns(triangles), "triangles must have three columns");
    static_assert(sizeof(agvd::Vec3) == 3 * sizeof(double));
    static_assert(sizeof(agvd::Triangle) == 3 * sizeof(agvd::Index));
    return {{reinterpret_cast<const agvd::Vec3*>(positions.data()),
             static_cast<std::size_t>(positions.shape(0))},
            {reinterpret_cast<const agvd::Triangle*>(triangles.data()),
             static_cast<std::size_t>(triangles.shape(0))}};
}

std::vector<agvd::SurfacePoint> points_of(const Indices& faces, const Doubles& barycentric) {
    require(faces.ndim() == 1, "faces must have one dimension");
    require(has_three_columns(barycentric) && barycentric.shape(0) == faces.shape(0),
            "there must be three coordinates for each face");
    std::vector<agvd::SurfacePoint> points(static_cast<std::size_t>(faces.size()));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double* const b = barycentric.data() + 3 * i;
        points[i] = {agvd::FaceId(faces.data()[i]), {b[0], b[1], b[2]}};
    }
    return points;
}

std::vector<remesh::GivenShape> shapes_of(const std::vector<Indices>& lines,
                                          const std::vector<Indices>& regions, agvd::Index first) {
    std::vector<remesh::GivenShape> shapes;
    for (const Indices& line : lines) {
        remesh::GivenShape shape{.site = first++};
        for (py::ssize_t i = 1; i < line.size(); ++i) {
            shape.edges.push_back({line.data()[i - 1], line.data()[i]});
        }
        shapes.push_back(std::move(shape));
    }
    for (const Indices& region : regions) {
        shapes.push_back({.faces = vector_of(region), .site = first++});
    }
    return shapes;
}

std::vector<std::array<agvd::Index, 2>> edges_of(const Indices& edges) {
    require(edges.size() == 0 || (edges.ndim() == 2 && edges.shape(1) == 2),
            "edges must have two columns");
    std::vector<std::array<agvd::Index, 2>> result(static_cast<std::size_t>(edges.size()) / 2);
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = {edges.data()[2 * i], edges.data()[2 * i + 1]};
    }
    return result;
}

py::tuple to_arrays(const std::vector<agvd::SurfacePoint>& points) {
    std::vector<std::int64_t> faces;
    std::vector<std::array<double, 3>> barycentric;
    faces.reserve(points.size());
    barycentric.reserve(points.size());
    for (const agvd::SurfacePoint& point : points) {
        faces.push_back(point.face.value());
        barycentric.push_back(point.barycentric);
    }
    return py::make_tuple(to_array<std::int64_t>(std::move(faces)),
                          to_array<double>(std::move(barycentric), 3));
}

std::span<const remesh::CornerCoordinates> corners_of(const Doubles& values) {
    static_assert(sizeof(remesh::CornerCoordinates) == 6 * sizeof(double));
    return {reinterpret_cast<const remesh::CornerCoordinates*>(values.data()),
            static_cast<std::size_t>(values.size()) / 6};
}

}  // namespace python
