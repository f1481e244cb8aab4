// Compares our readers with OpenMesh's: bench-read FILE... prints, for each file, the result and
// the time of both, measured in turn. OpenMesh reads into an importer that keeps plain arrays in
// double, which is the least work for it and the most reliable way to use it.

#include <OpenMesh/Core/IO/IOManager.hh>
#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <algorithm>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>

#include "remesh/meshfile/mesh_file.h"

namespace {

using namespace OpenMesh;  // NOLINT: the overrides below are all in its words.

// Keeps positions and triangles; ignores everything else in a file.
class ArrayImporter : public IO::BaseImporter {
public:
    agvd::TriangleMesh mesh;

    VertexHandle add_vertex(const Vec3f& p) override { return add_vertex(Vec3d(p)); }
    VertexHandle add_vertex(const Vec3d& p) override {
        mesh.positions.emplace_back(p[0], p[1], p[2]);
        return VertexHandle(static_cast<int>(mesh.positions.size()) - 1);
    }
    VertexHandle add_vertex() override { return add_vertex(Vec3d(0, 0, 0)); }
    FaceHandle add_face(const VHandles& corners) override {
        for (std::size_t k = 2; k < corners.size(); ++k) {
            mesh.triangles.push_back({index(corners[0]), index(corners[k - 1]), index(corners[k])});
        }
        return FaceHandle(static_cast<int>(mesh.triangles.size()) - 1);
    }
    void set_point(VertexHandle v, const Vec3f& p) override {
        mesh.positions[index(v)] = {p[0], p[1], p[2]};
    }
    std::size_t n_vertices() const override { return mesh.positions.size(); }
    std::size_t n_faces() const override { return mesh.triangles.size(); }
    std::size_t n_edges() const override { return 0; }

    HalfedgeHandle add_edge(VertexHandle, VertexHandle) override { return HalfedgeHandle(); }
    FaceHandle add_face(HalfedgeHandle) override { return FaceHandle(); }
    void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec2f>&) override {}
    void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec3f>&) override {}
    void set_face_texindex(FaceHandle, int) override {}
    void set_halfedge(VertexHandle, HalfedgeHandle) override {}
    void set_normal(VertexHandle, const Vec3f&) override {}
    void set_normal(VertexHandle, const Vec3d&) override {}
    void set_normal(FaceHandle, const Vec3f&) override {}
    void set_normal(FaceHandle, const Vec3d&) override {}
    void set_color(VertexHandle, const Vec3uc&) override {}
    void set_color(VertexHandle, const Vec4uc&) override {}
    void set_color(VertexHandle, const Vec3f&) override {}
    void set_color(VertexHandle, const Vec4f&) override {}
    void set_color(EdgeHandle, const Vec3uc&) override {}
    void set_color(EdgeHandle, const Vec4uc&) override {}
    void set_color(EdgeHandle, const Vec3f&) override {}
    void set_color(EdgeHandle, const Vec4f&) override {}
    void set_color(FaceHandle, const Vec3uc&) override {}
    void set_color(FaceHandle, const Vec4uc&) override {}
    void set_color(FaceHandle, const Vec3f&) override {}
    void set_color(FaceHandle, const Vec4f&) override {}
    void set_texcoord(VertexHandle, const Vec2f&) override {}
    void set_texcoord(VertexHandle, const Vec3f&) override {}
    void set_texcoord(HalfedgeHandle, const Vec2f&) override {}
    void set_texcoord(HalfedgeHandle, const Vec3f&) override {}
    void set_status(VertexHandle, const Attributes::StatusInfo&) override {}
    void set_status(HalfedgeHandle, const Attributes::StatusInfo&) override {}
    void set_status(EdgeHandle, const Attributes::StatusInfo&) override {}
    void set_status(FaceHandle, const Attributes::StatusInfo&) override {}
    void set_next(HalfedgeHandle, HalfedgeHandle) override {}
    void set_face(HalfedgeHandle, FaceHandle) override {}
    void request_face_texcoords2D() override {}
    void add_texture_information(int, std::string) override {}

private:
    static agvd::Index index(VertexHandle v) { return static_cast<agvd::Index>(v.idx()); }
};

std::string describe(const agvd::TriangleMesh& mesh) {
    const auto is_float = [](const agvd::Vec3& p) { return p == p.cast<float>().cast<double>(); };
    const auto is_safe = [&](const agvd::Triangle& t) {
        return std::ranges::max(t) < mesh.positions.size();
    };
    const bool is_finite = std::ranges::all_of(mesh.positions, &agvd::Vec3::allFinite);
    return std::to_string(mesh.positions.size()) + " vertices, " +
           std::to_string(mesh.triangles.size()) + " triangles" +
           (is_finite ? "" : ", not finite") +
           (std::ranges::all_of(mesh.positions, is_float) ? ", cut to float" : "") +
           (std::ranges::all_of(mesh.triangles, is_safe) ? "" : ", indices out of range");
}

std::string read_ours(const std::string& path) {
    try {
        return describe(remesh::read_mesh(path).mesh);
    } catch (const std::exception& error) {
        return error.what();
    }
}

std::string read_theirs(const std::string& path) {
    ArrayImporter importer;
    IO::Options options;
    const bool is_read = IO::IOManager().read(path, importer, options);
    return is_read ? describe(importer.mesh) : "false";
}

// Of the processor time, which other programs on the machine do not change.
double milliseconds(std::string (*read)(const std::string&), const std::string& path) {
    const std::clock_t start = std::clock();
    static_cast<void>(read(path));
    return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

int main(int argc, char** argv) {
    constexpr std::size_t runs = 21;
    for (int i = 1; i < argc; ++i) {
        std::vector<double> ours, theirs, ratio;
        for (std::size_t run = 0; run < runs; ++run) {
            ours.push_back(milliseconds(read_ours, argv[i]));
            theirs.push_back(milliseconds(read_theirs, argv[i]));
            ratio.push_back(theirs.back() / ours.back());
        }
        for (auto* times : {&ours, &theirs, &ratio}) std::ranges::sort(*times);
        std::cout << nlohmann::json{{"file", argv[i]},
                                    {"ours", read_ours(argv[i])},
                                    {"openmesh", read_theirs(argv[i])},
                                    {"ours_ms", ours[runs / 2]},
                                    {"openmesh_ms", theirs[runs / 2]},
                                    {"ratio", ratio[runs / 2]},
                                    {"ratio_quartiles", {ratio[runs / 4], ratio[3 * runs / 4]}}}
                  << '\n';
    }
}
