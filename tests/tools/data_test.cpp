// The meshes of data/, and the code that makes them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "agvd/mesh/topology.h"
#include "make_data/data_files.h"
#include "make_data/formula.h"
#include "make_data/planar.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/shapes.h"

namespace {

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec2;
using agvd::Vec3;

const std::filesystem::path folder = AGVD_DATA_DIR;

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TriangleMesh read(const char* name) { return remesh::read_mesh(folder / name).mesh; }

// The numbers of a file's row in data/README.md: vertices, faces, components, genus, loops.
std::vector<int> stated(const std::string& name) {
    std::ifstream readme(folder / "README.md");
    for (std::string line; std::getline(readme, line);) {
        if (!line.starts_with("| " + name + " |")) continue;
        std::istringstream row(line.substr(name.size() + 4));
        std::vector<int> numbers(5);
        char bar = 0;
        for (int& number : numbers) row >> number >> bar;
        return numbers;
    }
    return {};
}

std::vector<double> sorted_areas(const TriangleMesh& mesh) {
    std::vector<double> areas;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3& p = mesh.positions[a];
        areas.push_back((mesh.positions[b] - p).cross(mesh.positions[c] - p).norm() / 2);
    }
    std::sort(areas.begin(), areas.end());
    return areas;
}

double degrees(const Vec3& u, const Vec3& v) {
    return std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::numbers::pi;
}

TEST(DataFiles, AreWhatTheirReadmeSays) {
    for (const make_data::DataFile& file : make_data::data_files()) {
        SCOPED_TRACE(file.name);
        const TriangleMesh mesh = read(file.name);
        const remesh::Topology topology = remesh::analyze_topology(mesh.view());
        EXPECT_TRUE(topology.is_manifold);
        EXPECT_TRUE(topology.is_oriented);
        const std::vector found{static_cast<int>(mesh.positions.size()),
                                static_cast<int>(mesh.triangles.size()),
                                static_cast<int>(topology.components.size()), topology.genus(),
                                topology.boundary_loops()};
        EXPECT_EQ(found, stated(file.name));
        EXPECT_TRUE(topology.boundary_loops() > 0 || shapes::signed_volume(mesh) > 0);
    }
}

TEST(DataFiles, AreWrittenAgainByteForByte) {
    for (const make_data::DataFile& file : make_data::data_files()) {
        EXPECT_TRUE(format(file) == bytes_of(folder / file.name)) << file.name;
    }
}

TEST(DataFiles, FitInThreeMegabytes) {
    std::uintmax_t sum = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) sum += entry.file_size();
    EXPECT_LE(sum, 3'000'000U);
}

TEST(DataFiles, FacesOfTheOrganicExampleVaryTenfold) {
    const TriangleMesh mesh = read("organic.ply");
    EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), 50'000, 2500);
    const std::vector<double> areas = sorted_areas(mesh);
    EXPECT_GE(areas[areas.size() * 95 / 100] / areas[areas.size() * 5 / 100], 10);
}

TEST(DataFiles, PlateIsFiveHundredTimesAsLongAsThick) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : read("plate.stl").positions) box.extend(p);
    EXPECT_NEAR(box.sizes().z() / box.sizes().x(), 0.002, 1e-8);
}

TEST(DataFiles, PartsSpanAThousandInSize) {
    const TriangleMesh mesh = read("parts.ply");
    const remesh::Topology topology = remesh::analyze_topology(mesh.view());
    std::vector<Eigen::AlignedBox3d> boxes(topology.components.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        for (const Index v : mesh.triangles[f]) {
            boxes[topology.face_component[f]].extend(mesh.positions[v]);
        }
    }
    std::vector<double> sizes;
    for (const auto& box : boxes) sizes.push_back(box.diagonal().norm());
    const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
    EXPECT_NEAR(*most / *least, 1000, 50);
}

TEST(DataFiles, SliversAreExtremeButHaveArea) {
    const TriangleMesh mesh = read("slivers.off");
    EXPECT_GT(sorted_areas(mesh).front(), 0);
    std::size_t slivers = 0;
    for (const agvd::Triangle& t : mesh.triangles) {
        double least = 180;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = mesh.positions[t[k]];
            least = std::min(least, degrees(mesh.positions[t[(k + 1) % 3]] - p,
                                            mesh.positions[t[(k + 2) % 3]] - p));
        }
        if (least < 0.01) ++slivers;
    }
    EXPECT_GT(slivers, mesh.triangles.size() / 5);
}

TEST(MakeData, CircleAgreesWithTheSystemsSine) {
    for (int i = 0; i <= 1000; ++i) {
        const double angle = 2 * std::numbers::pi * i / 400;
        const Vec2 p = make_data::unit_circle(i / 400.0);
        EXPECT_LT((p - Vec2(std::cos(angle), std::sin(angle))).norm(), 1e-12) << i;
    }
}

TEST(MakeData, PolygonWithTwoHolesIsCoveredOnce) {
    const std::vector<std::vector<Vec2>> loops{
        {{0, 0}, {9, 0}, {9, 5}, {5, 2}, {0, 5}},
        {{1, 1}, {1, 2}, {2, 2}, {2, 1}},
        {{6, 1}, {7, 2}, {8, 1}},
    };
    std::vector<Vec2> points;
    for (const auto& loop : loops) points.insert(points.end(), loop.begin(), loop.end());
    const std::vector<agvd::Triangle> triangles = make_data::triangulate(loops);
    EXPECT_EQ(triangles.size(), points.size() + 2 * 2 - 2);
    double area = 0;
    for (const auto& [a, b, c] : triangles) {
        const Vec2 u = points[b] - points[a], v = points[c] - points[a];
        const double doubled = u.x() * v.y() - u.y() * v.x();
        EXPECT_GT(doubled, 0);
        area += doubled / 2;
    }
    EXPECT_NEAR(area, 45 - 13.5 - 1 - 1, 1e-12);
}

}  // namespace
