// remesh() on a small mesh with any options: the mesh that it promises, or an error that it names.
#include "remesh/pipeline/remesh.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

#include "agvd/core/error.h"
#include "remesh/clean/clean_input.h"
#include "require.h"
#include "small_mesh.h"

using namespace agvd;
using fuzz::require;

namespace {

// None is out of its range.
remesh::RemeshOptions remesh_options(fuzz::Bytes& bytes) {
    using namespace remesh;
    RemeshOptions options{.num_samples = 4 + bytes.below(57), .num_threads = 1};
    options.features = bytes.pick({Features::Auto, Features::Angle, Features::Off});
    options.feature_angle = 1 + bytes.below(179);
    options.relax_steps = static_cast<int>(bytes.below(4));
    options.boundary = bytes.pick({Boundary::Keep, Boundary::Keep, Boundary::Free});
    options.init = bytes.pick({Init::BlueNoise, Init::Farthest, Init::Random});
    options.junctions = bytes.pick({Junctions::Apart, Junctions::Keep});
    options.delaunay = bytes.pick({Delaunay::Intrinsic, Delaunay::Extrinsic, Delaunay::Off});
    options.vertex_count =
        bytes.pick({VertexCount::Exact, VertexCount::Exact, VertexCount::Exact, VertexCount::Add});
    options.fit = bytes.pick<std::optional<bool>>({{}, true, false});
    options.drop_components = bytes.pick({0.0, 0.0, 0.0, 0.01, 0.5, 1.0});
    options.seed = bytes.below(256);
    auto& propagation = options.propagation;
    propagation.engine =
        bytes.pick({Engine::Window, Engine::Window, Engine::Window, Engine::Steiner});
    const auto max_error = bytes.pick<std::optional<double>>({{}, 0.0, 1e-2, 0.5});
    if (propagation.engine == Engine::Window) propagation.max_error = max_error;
    propagation.steiner_points = static_cast<int>(bytes.below(9));
    return options;
}

// Options that refer to elements of the mesh; most often none.
void add_references(fuzz::Bytes& bytes, const TriangleMesh& mesh, remesh::RemeshOptions& options) {
    const Index kind = bytes.below(16);
    if (kind == 1) {
        for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
            options.face_labels.push_back(bytes.below(3));
        }
    } else if (kind == 2) {
        for (Index i = bytes.below(10); i > 0; --i) {
            const Triangle& t = mesh.triangles[bytes.below(mesh.triangles.size())];
            options.feature_edges.push_back({t[0], t[1]});
        }
    } else if (kind == 3) {
        options.sites.emplace();
        for (Index i = 1 + bytes.below(40); i > 0; --i) {
            options.sites->push_back(fuzz::point_on(bytes, mesh.triangles.size()));
        }
        options.keep_sites = bytes.flip();
    }
}

void check_sites(const TriangleMesh& mesh, const remesh::RemeshResult& result) {
    require(result.sites.size() == result.mesh.positions.size(), "each vertex has its site");
    for (const auto& [face, b] : result.sites) {
        require(face.value() < mesh.triangles.size(), "sites lie on faces");
        require(b[0] >= 0 && b[1] >= 0 && b[2] >= 0 && std::abs(b[0] + b[1] + b[2] - 1) < 1e-9,
                "sites lie in their faces");
    }
}

void check_result(const TriangleMesh& mesh, const remesh::RemeshOptions& options,
                  const remesh::RemeshResult& result) {
    for (const Vec3& p : result.mesh.positions) require(p.allFinite(), "positions are finite");
    for (const Triangle& t : result.mesh.triangles) {
        require(std::ranges::max(t) < result.mesh.positions.size(), "corners are in range");
    }
    check_sites(mesh, result);
    if (options.vertex_count == remesh::VertexCount::Exact && !options.sites) {
        require(result.mesh.positions.size() == options.num_samples, "as many vertices as asked");
    }
    if (options.junctions == remesh::Junctions::Keep && result.junctions.edges > 0) return;
    const remesh::Topology topology = remesh::analyze_topology(result.mesh.view());
    require(topology.is_manifold && topology.is_oriented, "the result is a manifold");
    require(same_topology(topology, result.input_topology), "the topology is kept");
    if (options.drop_components > 0) return;
    const TriangleMesh clean = remesh::clean_input(mesh.view(), {.num_threads = 1}).mesh;
    require(same_topology(topology, remesh::analyze_topology(clean.view())),
            "the topology is that of the cleaned input");
}

void check_same(const remesh::RemeshResult& a, const remesh::RemeshResult& b) {
    require(a.mesh.triangles == b.mesh.triangles && a.sites == b.sites &&
                a.mesh.positions.size() == b.mesh.positions.size() &&
                std::memcmp(a.mesh.positions.data(), b.mesh.positions.data(),
                            a.mesh.positions.size() * sizeof(Vec3)) == 0,
            "the same bytes for any number of threads");
}

// The number that an error says works.
Index number_named(const std::string& text) {
    const std::size_t end = text.rfind(" work");
    if (end == std::string::npos) return 0;
    const std::size_t begin = text.find_last_not_of("0123456789", end - 1) + 1;
    Index number = 0;
    std::from_chars(text.data() + begin, text.data() + end, number);
    return number;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Bytes bytes(data, size);
    remesh::RemeshOptions options = remesh_options(bytes);
    const bool is_repeated = bytes.below(8) == 1;
    const TriangleMesh mesh = fuzz::small_mesh(bytes);
    if (!mesh.triangles.empty()) add_references(bytes, mesh, options);
    try {
        const remesh::RemeshResult result = remesh::remesh(mesh.view(), options);
        check_result(mesh, options, result);
        if (!is_repeated) return 0;
        options.num_threads = 2;
        check_same(result, remesh::remesh(mesh.view(), options));
    } catch (const InvalidInput&) {
    } catch (const InvalidOption&) {
        require(options.drop_components > 0, "no option is out of its range");  // None is left.
    } catch (const ConstraintUnmet& error) {
        const Index enough = number_named(error.what());
        if (enough == 0 || options.sites || !is_repeated) return 0;
        options.num_samples = enough;
        check_result(mesh, options, remesh::remesh(mesh.view(), options));
    }
    return 0;
}
