// example-shapes: the shapes by formula on which the other examples have known results. Each is a
// sheet of rows of points, some of them closed by a fan.
#include <cmath>
#include <cstdio>

#include "agvd/core/error.h"
#include "examples/example.h"
#include "remesh/meshfile/mesh_file.h"

namespace {

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;

constexpr double pi = std::numbers::pi;

constexpr const char* usage =
    "usage: example-shapes SHAPE OUT\n"
    "Writes a mesh (.obj, .ply, ...). SHAPE is one of\n"
    "  sphere     of radius 1\n"
    "  rectangle  2 x 1, squares of 1/40\n"
    "  ellipse    a flat one of half axes 2 and 1\n"
    "  tube       of radius 1, bent about z with radius 10 by 90 degrees, open ends\n";

// Rows of num_columns points, place(row, column) each; a closed sheet joins the last column to the
// first.
template <typename Place>
TriangleMesh sheet(Index num_rows, Index num_columns, bool is_closed, const Place& place) {
    TriangleMesh mesh;
    for (Index row = 0; row < num_rows; ++row) {
        for (Index column = 0; column < num_columns; ++column) {
            mesh.positions.push_back(place(row, column));
        }
    }
    for (Index row = 0; row + 1 < num_rows; ++row) {
        for (Index column = 0; column < num_columns - (is_closed ? 0 : 1); ++column) {
            const Index a = row * num_columns + column;
            const Index b = row * num_columns + (column + 1) % num_columns;
            mesh.triangles.push_back({a, b, b + num_columns});
            mesh.triangles.push_back({a, b + num_columns, a + num_columns});
        }
    }
    return mesh;
}

// Closes a row by triangles to a new point; the first row, or else the last one.
void add_fan(TriangleMesh& mesh, Index first, Index num_columns, const Vec3& tip) {
    for (Index column = 0; column < num_columns; ++column) {
        Index a = first + column, b = first + (column + 1) % num_columns;
        if (first == 0) std::swap(a, b);
        mesh.triangles.push_back({a, b, static_cast<Index>(mesh.positions.size())});
    }
    mesh.positions.push_back(tip);
}

TriangleMesh sphere() {
    constexpr Index rows = 47, columns = 96;
    TriangleMesh mesh = sheet(rows, columns, true, [](Index row, Index column) {
        const double height = pi * (row + 1) / (rows + 1), turn = 2 * pi * column / columns;
        return Vec3(std::sin(height) * std::cos(turn), std::sin(height) * std::sin(turn),
                    -std::cos(height));
    });
    add_fan(mesh, 0, columns, {0, 0, -1});
    add_fan(mesh, (rows - 1) * columns, columns, {0, 0, 1});
    return mesh;
}

TriangleMesh rectangle() {
    return sheet(41, 81, false,
                 [](Index row, Index column) { return Vec3(column / 40.0, row / 40.0, 0); });
}

TriangleMesh ellipse() {
    constexpr Index rows = 30, columns = 200;
    TriangleMesh mesh = sheet(rows, columns, true, [](Index row, Index column) {
        const double share = (rows - row) / double{rows}, turn = 2 * pi * column / columns;
        return Vec3(2 * share * std::cos(turn), share * std::sin(turn), 0);
    });
    add_fan(mesh, (rows - 1) * columns, columns, {0, 0, 0});
    return mesh;
}

TriangleMesh tube() {
    constexpr Index rows = 81, columns = 32;
    return sheet(rows, columns, true, [](Index row, Index column) {
        const double along = pi / 3 * row / (rows - 1), around = -2 * pi * column / columns;
        const double radius = 20 + std::cos(around);
        return Vec3(radius * std::cos(along), radius * std::sin(along), std::sin(around));
    });
}

void write_shape(const example::Arguments& arguments) {
    const std::string& name = arguments[0];
    const auto shape = name == "sphere"      ? sphere
                       : name == "rectangle" ? rectangle
                       : name == "ellipse"   ? ellipse
                       : name == "tube"      ? tube
                                             : nullptr;
    if (shape == nullptr) {
        throw agvd::InvalidOption("there is no shape " + name + "; see --help");
    }
    remesh::write_mesh(arguments[1], shape().view());
}

}  // namespace

int main(int argc, char** argv) { return example::run(argc, argv, usage, 2, 2, write_shape); }
