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

// The wrap, and where its elements lie on the mesh.
class Wrapper {
public:
    Wrapper(const MeshView& mesh, const RemeshOptions& options)
        : mesh_(mesh), options_(options), tree_(mesh, cleaned_progress(options)) {}

    FittedWrap wrap(double& radius) const {
        // Balls of half the spacing do not know yet how much of the mesh lies inside.
        const bool is_given = *options_.wrap > 0;
        double area = area_of(mesh_);
        radius = is_given ? *options_.wrap : spacing_for(area, options_) / 2;
        TriangleMesh wrap = alpha_wrap(mesh_, radius, cleaned_progress(options_));
        if (!is_given) {
            const double smaller = spacing_for(std::min(area, area_of(wrap)), options_) / 2;
            if (smaller < most_excess * radius) {
                radius = smaller;
                wrap = alpha_wrap(mesh_, radius, cleaned_progress(options_));
            }
        }
        return fit_wrap(wrap, tree_,
                        {.radius = radius,
                         .num_threads = options_.num_threads,
                         .progress = cleaned_progress(options_)});
    }

    // The nearest point of the mesh as seen from outside.
    SurfacePoint below(const FittedWrap& wrap, const SurfacePoint& point) const {
        return tree_.query(position({wrap.outside, wrap.mesh.triangles}, point)).point;
    }

private:
    static constexpr double most_excess = 0.8;

    MeshView mesh_;
    const RemeshOptions& options_;
    ClosestPointTree tree_;
};

}  // namespace

RemeshResult run_wrapped(const InputMesh& input, const RemeshOptions& options) {
    const MeshView& mesh = input.view;
    const auto start = std::chrono::steady_clock::now();
    {
        const Progress progress = progress_at(Stage::Clean, options, 0);
        Poller poller(progress);
        check_elements(mesh, Ticker(poller));
    }
    const Wrapper wrapper(mesh, options);
    WrapCounts counts;
    const FittedWrap wrap = wrapper.wrap(counts.radius);
    counts.faces = static_cast<Index>(wrap.mesh.triangles.size());
    counts.sheets = wrap.sheets;

    RemeshOptions changed = options;
    changed.wrap.reset();
    changed.texture_seams.clear();
    const auto middle = [](Index f) {
        return SurfacePoint{FaceId(f), {1.0 / 3, 1.0 / 3, 1.0 / 3}};
    };
    const auto by_face = [&](auto& values) {
        if (values.empty()) return;
        std::remove_reference_t<decltype(values)> carried(counts.faces);
        for (Index f = 0; f < counts.faces; ++f)
            carried[f] = values[wrapper.below(wrap, middle(f)).face.value()];
        values = std::move(carried);
    };
    by_face(changed.face_labels);
    if (auto* lengths = std::get_if<FaceLengths>(&changed.sizing.edges)) by_face(lengths->values);
    const auto at_vertices = [&](std::vector<double>& values) {
        std::vector<double> carried(wrap.mesh.positions.size());
        for (Index f = 0; f < counts.faces; ++f) {
            for (std::size_t k = 0; k < 3; ++k) {
                SurfacePoint corner{FaceId(f), {0, 0, 0}};
                corner.barycentric[k] = 1;
                const SurfacePoint below = wrapper.below(wrap, corner);
                double value = 0;
                for (std::size_t i = 0; i < 3; ++i)
                    value += below.barycentric[i] * values[mesh.triangles[below.face.value()][i]];
                carried[wrap.mesh.triangles[f][k]] = value;
            }
        }
        values = std::move(carried);
    };
    if (auto* lengths = std::get_if<VertexLengths>(&changed.sizing.edges))
        at_vertices(lengths->values);
    if (auto* densities = std::get_if<VertexDensities>(&changed.sizing.edges))
        at_vertices(densities->values);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    RemeshResult result = run_stages({wrap.mesh.view(), nullptr}, changed);
    for (SurfacePoint& site : result.sites) site = wrapper.below(wrap, site);
    result.wrapped = counts;
    result.seconds.front().second += spent.count();
    return result;
}

}  // namespace remesh::detail
