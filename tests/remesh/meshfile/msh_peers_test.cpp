// Files of Gmsh that meshio and Gmsh write are read, and both read ours, where they are installed.
#include <gtest/gtest.h>

#include <map>

#include "remesh/meshfile/mesh_file.h"
#include "support/scratch.h"

using agvd::Triangle;
using agvd::Vec3;
using Values = std::vector<double>;

namespace {

class MshPeers : public Scratch {
protected:
    static process::Outcome shell(const std::string& command) {
        return process::run({"/usr/bin/env", "sh", "-c", command});
    }
    // Debian has meshio for its own Python.
    static std::string python_with_meshio() {
        for (const char* python : {"python3", "/usr/bin/python3"}) {
            if (shell(std::string(python) + " -c 'import meshio'").exit_code == 0) return python;
        }
        return {};
    }
    static bool has_gmsh() { return shell("command -v gmsh").exit_code == 0; }

    [[nodiscard]] process::Outcome run_python(const std::string& python,
                                              const std::string& script) const {
        return shell(python + " " + put("script.py", script));
    }
    [[nodiscard]] remesh::MeshFile read(const std::string& name) const {
        return remesh::read_mesh(at(name), remesh::ReadOptions{.with_attributes = true});
    }
};

// The sum of the areas of the faces of each group.
std::map<double, double> areas_of(const remesh::MeshFile& file) {
    std::map<double, double> areas;
    const auto& p = file.mesh.positions;
    for (std::size_t f = 0; f < file.mesh.triangles.size(); ++f) {
        const auto& [a, b, c] = file.mesh.triangles[f];
        areas[file.attributes.of_faces.at(0).values[f]] +=
            (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
    }
    return areas;
}

// Two triangles and a quad, the quad in group 9.
const std::string made_by_meshio = R"(import meshio, numpy, sys
points = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 1 / 3], [2, 0, .1], [2, 1, .1]])
cells = [("triangle", numpy.array([[0, 1, 2], [1, 3, 2]])), ("quad", numpy.array([[1, 4, 5, 3]]))]
tags = {"gmsh:physical": [numpy.array([7, 7]), numpy.array([9])],
        "gmsh:geometrical": [numpy.array([1, 1]), numpy.array([2])]}
names = {"wet walls": numpy.array([7, 2]), "inlet": numpy.array([9, 2])}
entities = numpy.array([[2, 1], [2, 1], [2, 1], [2, 1], [2, 2], [2, 2]])
for name, form, binary in (("22", "gmsh22", False), ("22b", "gmsh22", True), ("41", "gmsh", False), ("41b", "gmsh", True)):
    data = {"height": points[:, 2], **({"gmsh:dim_tags": entities} if form == "gmsh" else {})}
    mesh = meshio.Mesh(points, cells, cell_data=tags, point_data=data, field_data=names)
    meshio.write(sys.path[0] + "/" + name + ".msh", mesh, file_format=form, binary=binary)
)";

const std::string read_by_meshio = R"(import meshio, sys
mesh = meshio.read(sys.path[0] + "/ours.msh")
print(mesh.points.tolist(), [(cells.type, cells.data.tolist()) for cells in mesh.cells],
      [tags.tolist() for tags in mesh.cell_data["gmsh:physical"]],
      {name: value.tolist() for name, value in mesh.field_data.items()})
)";

remesh::MeshAttributes two_groups() {
    remesh::MeshAttributes attributes;
    attributes.of_faces.push_back({.name = "group",
                                   .type = remesh::NumberType::Int32,
                                   .values = {7, 9},
                                   .names = std::vector<std::string>(10)});
    attributes.of_faces[0].names[7] = "wet walls";
    attributes.of_faces[0].names[9] = "inlet";
    return attributes;
}

const agvd::TriangleMesh two_faces{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1.0 / 3}},
                                   {{0, 1, 2}, {1, 3, 2}}};

}  // namespace

TEST_F(MshPeers, WhatMeshioWritesIsRead) {
    const std::string python = python_with_meshio();
    if (python.empty()) GTEST_SKIP() << "there is no meshio";
    const process::Outcome outcome = run_python(python, made_by_meshio);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const char* name : {"22.msh", "22b.msh", "41.msh", "41b.msh"}) {
        const remesh::MeshFile file = read(name);
        EXPECT_EQ(file.mesh.positions,
                  (std::vector<Vec3>{
                      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1.0 / 3}, {2, 0, .1}, {2, 1, .1}}))
            << name;
        ASSERT_EQ(file.mesh.triangles.size(), 4u) << name;
        EXPECT_EQ(file.mesh.triangles[1], (Triangle{1, 3, 2})) << name;
        EXPECT_EQ(file.face_polygon, (std::vector<agvd::Index>{0, 1, 2, 2})) << name;
        EXPECT_EQ(file.attributes.of_vertices.at(0).name, "height") << name;
        EXPECT_EQ(file.attributes.of_vertices[0].values, (Values{0, 0, 0, 1.0 / 3, .1, .1}))
            << name;
        ASSERT_EQ(file.attributes.of_faces.size(), 1u) << name;
        EXPECT_EQ(file.attributes.of_faces[0].values, (Values{7, 7, 9, 9})) << name;
        EXPECT_EQ(file.attributes.of_faces[0].names.at(7), "wet walls") << name;
        EXPECT_EQ(file.attributes.of_faces[0].names.at(9), "inlet") << name;
    }
}

TEST_F(MshPeers, MeshioReadsOurs) {
    const std::string python = python_with_meshio();
    if (python.empty()) GTEST_SKIP() << "there is no meshio";
    put("ours.msh", remesh::format_mesh("ours.msh", two_faces.view(), two_groups()));
    const process::Outcome outcome = run_python(python, read_by_meshio);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], "
                               "[1.0, 1.0, 0.3333333333333333]] "
                               "[('triangle', [[0, 1, 2], [1, 3, 2]])] [[7, 9]] "
                               "{'wet walls': [7, 2], 'inlet': [9, 2]}"),
              std::string::npos)
        << outcome.out;
}

TEST_F(MshPeers, GmshReadsOurs) {
    if (!has_gmsh()) GTEST_SKIP() << "there is no program gmsh";
    put("ours.msh", remesh::format_mesh("ours.msh", two_faces.view(), two_groups()));
    for (const char* form : {"msh22", "msh41", "msh22 -bin", "msh41 -bin"}) {
        const process::Outcome outcome = shell("gmsh -v 2 " + at("ours.msh") + " -save -format " +
                                               form + " -o " + at("theirs.msh"));
        ASSERT_EQ(outcome.exit_code, 0) << form << outcome.out << outcome.err;
        const remesh::MeshFile file = read("theirs.msh");
        EXPECT_EQ(file.mesh.positions, two_faces.positions) << form;
        EXPECT_EQ(file.mesh.triangles, two_faces.triangles) << form;
        EXPECT_EQ(file.attributes.of_faces.at(0).values, (Values{7, 9})) << form;
        EXPECT_EQ(file.attributes.of_faces.at(0).names, two_groups().of_faces[0].names) << form;
    }
}

// A box whose sides are in two groups, one in none: as a surface, with volumes, of higher order, in
// parts. Of version 2.2 Gmsh leaves out what is in no group.
TEST_F(MshPeers, WhatGmshMeshesIsRead) {
    if (!has_gmsh()) GTEST_SKIP() << "there is no program gmsh";
    put("box.geo",
        "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 2, 3};\nMesh.MeshSizeMax = 0.7;\n"
        "Physical Surface(\"walls\", 7) = {1, 2, 3, 4};\n"
        "Physical Surface(\"in let\", 12) = {5};\nPhysical Volume(\"body\", 1) = {1};\n");
    for (const char* way :
         {"-2 -format msh22", "-2 -format msh22 -bin", "-2 -format msh41", "-2 -format msh41 -bin",
          "-3 -order 2 -format msh41 -bin", "-3 -order 2 -format msh22", "-3 -part 3 -format msh41",
          "-3 -part 3 -format msh41 -bin", "-2 -order 3 -format msh41"}) {
        const bool is_version_2 = std::string(way).find("msh22") != std::string::npos;
        const process::Outcome outcome =
            shell("gmsh -v 2 " + at("box.geo") + (is_version_2 ? " " : " -save_all ") + way +
                  " -o " + at("box.msh"));
        ASSERT_EQ(outcome.exit_code, 0) << way << outcome.out << outcome.err;
        const remesh::MeshFile file = read("box.msh");
        const bool is_several = std::string(way).find("-order") != std::string::npos;
        ASSERT_EQ(file.attributes.of_faces.size(), 1u) << way;
        EXPECT_EQ(file.attributes.of_faces[0].names.at(12), "in let") << way;
        EXPECT_EQ(file.attributes.of_faces[0].names.at(7), "walls") << way;
        const std::map<double, double> areas = areas_of(file);
        ASSERT_EQ(areas.size(), is_version_2 ? 2u : 3u) << way;
        EXPECT_NEAR(areas.at(7), 2 * 2 * 3 + 2 * 1 * 3, 1e-9) << way;
        EXPECT_NEAR(areas.at(12), 2, 1e-9) << way;
        if (!is_version_2) {
            EXPECT_NEAR(areas.at(0), 2, 1e-9) << way;
        }
        bool is_told = false;
        for (const std::string& warning : file.warnings) {
            is_told = is_told || warning.find("curved elements") != std::string::npos;
        }
        EXPECT_EQ(is_told, is_several) << way;
    }
}
