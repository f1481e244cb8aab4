//! \file
//! NumPy arrays seen as meshes and points, and vectors handed over to NumPy.
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/mesh_file.h"

namespace python {

namespace py = pybind11;

//! C-contiguous and aligned. Arguments of this type are never converted: the Python part of the
//! package has done that.
using Doubles = py::array_t<double, py::array::c_style>;
using Indices = py::array_t<agvd::Index, py::array::c_style>;
using Flags = py::array_t<std::uint8_t, py::array::c_style>;

//! The arrays' own memory: no copy. They outlive the view.
//! \param positions  #V x 3
//! \param triangles  #F x 3
//! \throw py::value_error  another shape.
[[nodiscard]] agvd::MeshView view_of(const Doubles& positions, const Indices& triangles);

//! A copy.
template <typename Scalar>
[[nodiscard]] std::vector<Scalar> vector_of(const py::array_t<Scalar, py::array::c_style>& values) {
    return {values.data(), values.data() + values.size()};
}

//! \param faces        k
//! \param barycentric  k x 3
//! \throw py::value_error  another shape.
[[nodiscard]] std::vector<agvd::SurfacePoint> points_of(const Indices& faces,
                                                        const Doubles& barycentric);

//! \param lines    chains of vertices: edges between each and the next one.
//! \param regions  sets of faces.
//! \param first    the number of the first line; then come the other lines, then the regions.
[[nodiscard]] std::vector<remesh::GivenShape> shapes_of(const std::vector<Indices>& lines,
                                                        const std::vector<Indices>& regions,
                                                        agvd::Index first);

//! The array's own memory.
//! \param values  #F x 3 x 2, or none
[[nodiscard]] std::span<const remesh::CornerCoordinates> corners_of(const Doubles& values);

//! \param edges  k x 2, or none
//! \throw py::value_error  another shape.
[[nodiscard]] std::vector<std::array<agvd::Index, 2>> edges_of(const Indices& edges);

//! Of points_of the reverse: a pair of arrays, k of int64 and k x 3 of double.
[[nodiscard]] py::tuple to_arrays(const std::vector<agvd::SurfacePoint>& points);

//! Hands the memory over: no copy. \return #rows x columns, or #rows if `columns` is 0.
template <typename Scalar, typename Row>
[[nodiscard]] py::array_t<Scalar> to_array(std::vector<Row> rows, std::size_t columns = 0) {
    static_assert(sizeof(Row) % sizeof(Scalar) == 0);
    auto owned = std::make_unique<std::vector<Row>>(std::move(rows));
    const auto* const data = reinterpret_cast<const Scalar*>(owned->data());
    std::vector<std::size_t> shape{owned->size()};
    if (columns > 0) shape.push_back(columns);
    const py::capsule owner(owned.get(),
                            [](void* memory) { delete static_cast<std::vector<Row>*>(memory); });
    static_cast<void>(owned.release());
    return py::array_t<Scalar>(shape, data, owner);
}

//! Ids as int64, -1 for none: a copy.
template <typename Ids>
[[nodiscard]] py::array_t<std::int64_t> to_numbers(const Ids& ids) {
    std::vector<std::int64_t> numbers(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if constexpr (std::is_integral_v<std::decay_t<decltype(ids[i])>>) {
            numbers[i] = ids[i];
        } else {
            numbers[i] = ids[i].is_valid() ? std::int64_t{ids[i].value()} : -1;
        }
    }
    return to_array<std::int64_t>(std::move(numbers));
}

}  // namespace python
