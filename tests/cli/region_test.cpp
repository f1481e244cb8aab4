// --region and --lock: a part of a mesh is remeshed, vertices stay.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "remesh/meshfile/mesh_file.h"
#include "support/scratch.h"
#include "support/shapes.h"

using agvd::Index;
using agvd::Vec3;
using remesh::Attribute;
using remesh::NumberType;

namespace {

class RemeshRegion : public Scratch {
protected:
    // A sphere with a mark on the faces of its upper half; `none` is 0 everywhere. One of the other
    // faces is there twice, with different values.
    RemeshRegion() {
        const auto is_low = [&](const agvd::Triangle& t) {
            return std::all_of(t.begin(), t.end(),
                               [&](Index v) { return sphere_.positions[v].z() < -0.5; });
        };
        auto& faces = sphere_.triangles;
        faces.push_back(agvd::Triangle(*std::find_if(faces.begin(), faces.end(), is_low)));
        remesh::MeshAttributes attributes;
        Attribute mark{"mark", NumberType::UInt8}, none{"none", NumberType::Float32};
        Attribute value{"value", NumberType::Float64}, heat{"heat", NumberType::Float64};
        for (const auto& [a, b, c] : sphere_.triangles) {
            const double z =
                sphere_.positions[a].z() + sphere_.positions[b].z() + sphere_.positions[c].z();
            mark.values.push_back(z > 0 ? 3 : 0);
            none.values.push_back(0);
            value.values.push_back(0.1 * static_cast<double>(value.values.size()));
        }
        for (const Vec3& p : sphere_.positions) {
            heat.values.push_back(p.z() < -0.5 ? std::nan("") : p.x());
        }
        attributes.of_vertices = {heat};
        attributes.of_faces = {mark, none, value};
        input_ = put("in.ply", remesh::format_mesh("in.ply", sphere_.view(), attributes));
        mark_ = mark.values;
        value_ = value.values;
    }

    [[nodiscard]] process::Outcome remesh(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {input_, at("out.ply")});
        return run(REMESH_PROGRAM, std::move(arguments));
    }

    agvd::TriangleMesh sphere_ = shapes::sphere(4);
    std::string input_;
    std::vector<double> mark_, value_;
};

}  // namespace

TEST_F(RemeshRegion, MarkedFacesOnlyAreRemeshed) {
    const auto outcome = remesh({"--region", "mark", "-n", "400", "--report", "-"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto file =
        remesh::read_mesh(at("out.ply"), remesh::ReadOptions{.with_attributes = true});
    std::vector<Index> kept;
    for (Index f = 0; f < mark_.size(); ++f) {
        if (mark_[f] == 0) kept.push_back(f);
    }
    const auto& values = file.attributes.of_faces;
    ASSERT_EQ(values.size(), 3u);
    for (Index i = 0; i < kept.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(file.mesh.positions[file.mesh.triangles[i][k]],
                      sphere_.positions[sphere_.triangles[kept[i]][k]]);
        }
        EXPECT_EQ(values[0].values[i], 0);
        EXPECT_EQ(values[2].values[i], value_[kept[i]]);
    }
    EXPECT_EQ(values[0].values.back(), 3);
    int num_nan = 0;
    for (Index v = 0; v < file.mesh.positions.size(); ++v) {
        const double heat = file.attributes.of_vertices[0].values[v];
        if (std::isnan(heat)) ++num_nan;
        if (file.mesh.positions[v].z() > -0.4) {
            EXPECT_NEAR(heat, file.mesh.positions[v].x(), 0.1);
        }
    }
    EXPECT_GT(num_nan, 100);
    const nlohmann::json report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["kept"]["kept_faces"], kept.size());
    EXPECT_EQ(report["kept"]["rim_edges"].get<int>() > 20, true);
    EXPECT_EQ(report["options"]["region"], true);
}

TEST_F(RemeshRegion, PercentagesCountInTheRegion) {
    ASSERT_EQ(remesh({"--region", "mark", "-n", "50%"}).exit_code, 0);
    const auto mesh = remesh::read_mesh(at("out.ply")).mesh;
    const auto num_kept = static_cast<std::size_t>(std::count(mark_.begin(), mark_.end(), 0));
    std::set<Index> inside, all;
    for (Index f = 0; f < mark_.size(); ++f) {
        if (mark_[f] == 0) continue;
        inside.insert(sphere_.triangles[f].begin(), sphere_.triangles[f].end());
    }
    for (std::size_t f = num_kept; f < mesh.triangles.size(); ++f) {
        all.insert(mesh.triangles[f].begin(), mesh.triangles[f].end());
    }
    EXPECT_NEAR(static_cast<double>(all.size()), static_cast<double>(inside.size()) / 2, 0.6);
}

TEST_F(RemeshRegion, WorksWithLengthsAndMaps) {
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{"--edge-length", "5%"},
                                               {"--max-distance", "1%"},
                                               {"--adaptive", "-n", "400"},
                                               {"--faces", "500"},
                                               {"--relax", "0", "-n", "400"},
                                               {"--engine", "steiner", "-n", "400"},
                                               {"--keep-labels=mark", "-n", "400"},
                                               {"--transfer", "none", "-n", "400"},
                                               {"--map", at("map.txt"), "-n", "400"}}) {
        std::vector<std::string> arguments{"--region", "mark"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto outcome = remesh(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << options.front() << outcome.err;
    }
    // A line for each vertex; those that stay are corners.
    const std::string map = bytes("map.txt");
    EXPECT_EQ(static_cast<std::size_t>(std::count(map.begin(), map.end(), '\n')),
              remesh::read_mesh(at("out.ply")).mesh.positions.size());
}

TEST_F(RemeshRegion, WhatDoesNotFitIsAUsageErrorAndWritesNothing) {
    const std::string sites = put("sites.txt", "v 0\nv 1\nv 2\nv 3\n");
    for (const auto& [options, text] :
         std::vector<std::pair<std::vector<std::string>, const char*>>{
             {{"--region", "none"}, "is 0 for all faces"},
             {{"--region", "marks"}, "has no property of faces 'marks'; use mark"},
             {{"--region", "mark", "--sites", sites}, "--sites"},
             {{"--region", "mark", "--drop-components", "1"}, "--drop-components"},
             {{"--region", "mark", "--weld", "1"}, "--weld"},
             {{"--region", "mark", "--fill-holes", "3"}, "--fill-holes"},
             {{"--lock", put("v.txt", "0\n"), "--sites", sites}, "--sites"}}) {
        const auto outcome = remesh(options);
        EXPECT_EQ(outcome.exit_code, 2) << text;
        EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
    }
    const auto few = remesh({"--region", "mark", "-n", "10"});
    EXPECT_EQ(few.exit_code, 5);
    EXPECT_NE(few.err.find("tried and work"), std::string::npos) << few.err;
    EXPECT_FALSE(std::filesystem::exists(at("out.ply")));
}

TEST_F(RemeshRegion, LockedVerticesStay) {
    const std::string lock = put("lock.txt", "# two of them\n7\n  100 # the second\r\n\n2000\n");
    for (const bool with_region : {false, true}) {
        std::vector<std::string> arguments{"--lock", lock, "-n", "500"};
        if (with_region) arguments.insert(arguments.end(), {"--region", "mark"});
        const auto outcome = remesh(arguments);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const auto& positions = remesh::read_mesh(at("out.ply")).mesh.positions;
        for (const Index v : {7u, 100u, 2000u}) {
            EXPECT_NE(std::find(positions.begin(), positions.end(), sphere_.positions[v]),
                      positions.end());
        }
    }
}

TEST_F(RemeshRegion, LockedBoundariesStay) {
    const agvd::TriangleMesh plate = shapes::jitter(shapes::grid(5), 0.05, 1);
    const auto boundary = [](const agvd::TriangleMesh& mesh) {
        std::map<std::pair<Index, Index>, int> count;
        for (const agvd::Triangle& t : mesh.triangles) {
            for (std::size_t k = 0; k < 3; ++k) ++count[std::minmax(t[k], t[(k + 1) % 3])];
        }
        std::set<std::set<std::array<double, 3>>> edges;
        const auto place = [&](Index v) {
            const Vec3& p = mesh.positions[v];
            return std::array{p.x(), p.y(), p.z()};
        };
        for (const auto& [edge, faces] : count) {
            if (faces == 1) edges.insert({place(edge.first), place(edge.second)});
        }
        return edges;
    };
    const std::string in = put("plate.off", plate);
    const auto boundary_with = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {in, at("plate-out.ply"), "-n", "150"});
        const auto outcome = run(REMESH_PROGRAM, options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return boundary(remesh::read_mesh(at("plate-out.ply")).mesh);
    };
    const auto given = boundary(remesh::read_mesh(in).mesh);
    EXPECT_EQ(given.size(), 20u);
    EXPECT_EQ(boundary_with({"--lock-boundary"}), given);
    EXPECT_NE(boundary_with({}), given);
}

TEST_F(RemeshRegion, FilesOfVerticesAreChecked) {
    for (const auto& [text, code, message] : std::vector<std::tuple<const char*, int, const char*>>{
             {"1\n99999\n", 4, "line 2: there is no vertex 99999: the mesh has 2562 vertices"},
             {"-1\n", 4, "line 1: there is no vertex -1"},
             {"1 2\n", 3, "line 1: "},
             {"one\n", 3, "line 1: "},
             {"1.5\n", 3, "line 1: "},
             {"# nothing\n", 3, "the file holds no vertex"}}) {
        const auto outcome = remesh({"--lock", put("lock.txt", text)});
        EXPECT_EQ(outcome.exit_code, code) << text << outcome.err;
        EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(remesh({"--lock", at("absent.txt")}).exit_code, 3);
    EXPECT_FALSE(std::filesystem::exists(at("out.ply")));
}
