#include "remesh/pipeline/run_wrapped.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/scale.h"
#include "remesh/clean/soup.h"
#include "remesh/pipeline/run.h"
#include "remesh/sites/shares.h"
#include "remesh/wrap/wrap.h"

namespace remesh::detail {
namespace {

double area_of(const MeshView& mesh) {
    double doubled = 0;
    for (const Triangle& t : mesh.triangles) doubled += doubled_normal(mesh.positions, t).norm();
    return doubled / 2;
}

// Of the samples of a surface with this area.
double spacing_for(double area, const RemeshOptions& options) {
    const auto& count = options.sizing.count;
    if (const auto* mean = std::get_if<MeanEdge>(&count)) return mean->length;
    if (const auto* faces = std::get_if<NumFaces>(&count))
        return spacing_of(faces->number / 2.0, area);
    if (std::holds_alternative<CountOfLengths>(count)) {
        const auto* at = std::get_if<VertexLengths>(&options.sizing.edges);
        const std::vector<double>& lengths =
            at != nullptr ? at->values : std::get<FaceLengths>(options.sizing.edges).values;
        return std::accumulate(lengths.begin(), lengths.end(), 0.0) /
               static_cast<double>(lengths.size());
    }
    return spacing_of(options.num_samples, area);
}

// Whether faces look at others that are parallel and nearer than a width: a ball between them
// touches both.
bool has_gaps(const TriangleMesh& mesh, double width) {
    constexpr double least_share = 0.9;       // Of the radius.
    constexpr double parallel_cosine = -0.9;  // Some 155 degrees.
    const ClosestPointTree tree(mesh);
    return std::ranges::any_of(mesh.triangles, [&](const Triangle& t) {
        const auto normal_of = [&](const Triangle& face) {
            return Vec3(doubled_normal(mesh.positions, face).normalized());
        };
        const Vec3 normal = normal_of(t);
        const Vec3 middle =
            (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
        const ClosestPoint nearest = tree.query(middle + width / 2 * normal);
        const Vec3 beyond = normal_of(mesh.triangles[nearest.point.face.value()]);
        return std::sqrt(nearest.distance_sq) < least_share * width / 2 &&
               beyond.dot(normal) < parallel_cosine;
    });
}

// Wraps a mesh, or unites its solids, and tells where that lies on it.
class Wrapper {
public:
    Wrapper(const MeshView& mesh, const RemeshOptions& options)
        : mesh_(mesh), progress_(cleaned_progress(options)), tree_(mesh, progress_) {}

    // \return whether the mesh is of solids only, whose union has no gaps that a wrap would close.
    bool unite(const RemeshOptions& options) {
        try {
            const CleanResult clean = clean_input(mesh_, cleaning_of(options));
            std::optional<TriangleMesh> united =
                unite_solids(clean.mesh, options.num_threads, progress_);
            if (!united || has_gaps(*united, spacing_for(area_of(*united), options) / 4)) {
                return false;
            }
            wrap_.outside = united->positions;
            wrap_.mesh = *std::move(united);
            return true;
        } catch (const InvalidInput&) {
            return false;  // Such as a piece that is not orientable.
        }
    }
    void wrap(const RemeshOptions& options) {
        // Balls of half the spacing do not know yet how much of the mesh lies inside.
        // Of needles, which have hardly an area, the vertices would lie along the diagonal.
        const MeshBox box = box_of(mesh_, options.num_threads);
        const double least = (box.high - box.low).squaredNorm() / options.num_samples;
        const double area = std::max(area_of(mesh_), least);
        radius_ = *options.wrap > 0 ? *options.wrap : spacing_for(area, options) / 2;
        TriangleMesh wrap = alpha_wrap(mesh_, radius_, progress_);
        const double smaller = spacing_for(std::clamp(area_of(wrap), least, area), options) / 2;
        if (*options.wrap == 0 && smaller < most_excess * radius_) {
            radius_ = smaller;
            wrap = alpha_wrap(mesh_, radius_, progress_);
        }
        wrap_ = fit_wrap(
            wrap, tree_,
            {.radius = radius_, .num_threads = options.num_threads, .progress = progress_});
    }

    [[nodiscard]] const TriangleMesh& mesh() const { return wrap_.mesh; }
    [[nodiscard]] WrapCounts counts() const { return {radius_, num_faces(), wrap_.sheets}; }

    // The nearest point of the mesh as seen from outside.
    [[nodiscard]] SurfacePoint below(const SurfacePoint& point) const {
        return tree_.query(position({wrap_.outside, wrap_.mesh.triangles}, point)).point;
    }

    // Values of the mesh for the wrap.
    template <typename Value>
    void carry_to_faces(std::vector<Value>& values) const {
        if (values.empty()) return;
        std::vector<Value> carried;
        for (Index f = 0; f < num_faces(); ++f) {
            const SurfacePoint middle{FaceId(f), {1.0 / 3, 1.0 / 3, 1.0 / 3}};
            carried.push_back(values[below(middle).face.value()]);
        }
        values = std::move(carried);
    }
    void carry_to_vertices(std::vector<double>& values) const {
        std::vector<double> carried;
        for (const Vec3& outside : wrap_.outside) {
            const SurfacePoint point = tree_.query(outside).point;
            double value = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                value += point.barycentric[k] * values[mesh_.triangles[point.face.value()][k]];
            }
            carried.push_back(value);
        }
        values = std::move(carried);
    }

private:
    static constexpr double most_excess = 0.8;  // Where the wrap is not made again.

    [[nodiscard]] Index num_faces() const {
        return static_cast<Index>(wrap_.mesh.triangles.size());
    }

    MeshView mesh_;
    Progress progress_;
    ClosestPointTree tree_;
    FittedWrap wrap_;
    double radius_ = 0;
};

RemeshOptions options_of_wrap(const RemeshOptions& given, const Wrapper& wrapper) {
    RemeshOptions options = given;
    options.texture_seams.clear();
    wrapper.carry_to_faces(options.face_labels);
    auto& edges = options.sizing.edges;
    if (auto* of = std::get_if<FaceLengths>(&edges)) wrapper.carry_to_faces(of->values);
    if (auto* at = std::get_if<VertexLengths>(&edges)) wrapper.carry_to_vertices(at->values);
    if (auto* at = std::get_if<VertexDensities>(&edges)) wrapper.carry_to_vertices(at->values);
    return options;
}

}  // namespace

RemeshResult run_wrapped(const InputMesh& input, const RemeshOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const Progress progress = cleaned_progress(options);
    Poller poller(progress);
    check_elements(input.view, Ticker(poller));
    Wrapper wrapper(input.view, options);
    const auto run = [&](bool is_union) {
        RemeshOptions of_wrap = options_of_wrap(options, wrapper);
        if (is_union) of_wrap.wrap.reset();
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        RemeshResult result = run_stages({wrapper.mesh(), nullptr}, of_wrap);
        for (SurfacePoint& site : result.sites) site = wrapper.below(site);
        result.wrapped = wrapper.counts();
        result.seconds.front().second += spent.count();  // Of cleaning.
        return result;
    };
    // With a radius gaps are to be closed, which a union keeps.
    if (*options.wrap == 0 && wrapper.unite(options)) {
        RemeshResult united = run(true);
        if (united.self_intersections.value_or(0) == 0) return united;
    }
    wrapper.wrap(options);
    return run(false);
}

}  // namespace remesh::detail
