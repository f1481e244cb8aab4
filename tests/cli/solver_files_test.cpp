// The program `remesh`: files of Gmsh and Medit.
#include <sstream>

#include "cli/remesh_program.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/shapes.h"

namespace {

class RemeshSolverFiles : public Remesh {
protected:
    // Short edges on one half of a plate: as a property, of .ply and of .msh, and as .sol.
    RemeshSolverFiles() {
        remesh::MeshAttributes attributes;
        remesh::Attribute size{.name = "size"};
        std::ostringstream sol, data;
        const std::size_t count = plate_.positions.size();
        sol << "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n" << count << "\n1 1\n";
        data << "$NodeData\n1\n\"size\"\n1\n0\n3\n0\n1\n" << count << '\n';
        for (std::size_t v = 0; v < count; ++v) {
            size.values.push_back(plate_.positions[v].x() > 0.5 ? 0.05 : 0.2);
            sol << size.values[v] << '\n';
            data << v + 1 << ' ' << size.values[v] << '\n';
        }
        attributes.of_vertices.push_back(size);
        ply_ = put("in.ply", remesh::format_mesh("in.ply", plate_.view(), attributes));
        msh_ = put("in.msh", remesh::format_mesh("in.msh", plate_.view(), {}) + data.str() +
                                 "$EndNodeData\n");
        sol_ = put("size.sol", sol.str() + "End\n");
    }

    [[nodiscard]] std::string result(const std::string& in, const std::string& sizing,
                                     const std::string& out) const {
        const auto outcome = remesh({in, at(out), "--sizing", sizing});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return bytes(out);
    }

    agvd::TriangleMesh plate_ = shapes::grid(20);
    std::string ply_, msh_, sol_;
};

}  // namespace

TEST_F(RemeshSolverFiles, LengthsComeFromASolOrAPropertyAlike) {
    const std::string expected = result(ply_, "size", "a.off");
    EXPECT_GT(remesh::read_mesh(at("a.off")).mesh.positions.size(), 200u);
    EXPECT_EQ(result(ply_, sol_, "b.off"), expected);
    EXPECT_EQ(result(msh_, "size", "c.off"), expected);
    EXPECT_EQ(result(msh_, sol_, "d.off"), expected);
    const auto bounded = remesh({msh_, at("e.off"), "--sizing", sol_, "--min-edge", ".1"});
    EXPECT_EQ(bounded.exit_code, 0) << bounded.err;
    EXPECT_LT(remesh::read_mesh(at("e.off")).mesh.positions.size(), 200u);
}

TEST_F(RemeshSolverFiles, AWrongSolLeavesNothing) {
    const auto missing = remesh({ply_, at("out.off"), "--sizing", at("no.sol")});
    EXPECT_EQ(missing.exit_code, 3) << missing.err;
    EXPECT_NE(missing.err.find("no.sol"), std::string::npos) << missing.err;
    const std::string cube = put("cube.off", shapes::cube());
    const auto other = remesh({cube, at("out.off"), "--sizing", sol_});
    EXPECT_EQ(other.exit_code, 4) << other.err;
    EXPECT_NE(other.err.find("size.sol: line 4: the file has 441 values, but the mesh has 8"),
              std::string::npos)
        << other.err;
    EXPECT_EQ(remesh({ply_, at("out.off"), "--sizing", sol_, "--adaptive"}).exit_code, 2);
    EXPECT_EQ(num_files(), 4u);
}

TEST_F(RemeshSolverFiles, GroupsKeepTheirBordersNumbersAndNames) {
    remesh::MeshAttributes attributes;
    attributes.of_faces.push_back({.name = "group",
                                   .type = remesh::NumberType::Int32,
                                   .names = std::vector<std::string>(10)});
    for (const agvd::Triangle& t : plate_.triangles) {
        const double x =
            (plate_.positions[t[0]] + plate_.positions[t[1]] + plate_.positions[t[2]]).x() / 3;
        attributes.of_faces[0].values.push_back(x > 0.3 ? 9 : 4);
    }
    attributes.of_faces[0].names[4] = "inlet";
    attributes.of_faces[0].names[9] = "wet walls";
    const std::string in =
        put("groups.msh", remesh::format_mesh("groups.msh", plate_.view(), attributes));
    const auto outcome = remesh({in, at("out.msh"), "-n", "150", "--keep-labels"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto file =
        remesh::read_mesh(at("out.msh"), remesh::ReadOptions{.with_attributes = true});
    ASSERT_EQ(file.attributes.of_faces.size(), 1u);
    EXPECT_EQ(file.attributes.of_faces[0].names, attributes.of_faces[0].names);
    for (std::size_t f = 0; f < file.mesh.triangles.size(); ++f) {
        for (const agvd::Index v : file.mesh.triangles[f]) {
            const double x = file.mesh.positions[v].x();
            if (file.attributes.of_faces[0].values[f] == 4) {
                EXPECT_LE(x, 0.3 + 1e-9);
            } else {
                EXPECT_GE(x, 0.3 - 1e-9);
            }
        }
    }
    const auto sized = remesh({in, at("sized.off"), "--edge-length-of", "group=outlet:.1"});
    EXPECT_EQ(sized.exit_code, 2);
    EXPECT_NE(sized.err.find("use inlet, wet walls\n"), std::string::npos) << sized.err;
}
