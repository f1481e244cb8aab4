#include "remesh/pipeline/remesh.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "agvd/core/parallel.h"
#include "agvd/mesh/scale.h"
#include "remesh/pipeline/region.h"
#include "remesh/pipeline/run.h"
#include "remesh/pipeline/run_wrapped.h"
#include "remesh/tiles/tiling.h"

namespace remesh {
namespace {

void require(bool is_fine, const std::string& text) {
    if (!is_fine) throw InvalidOption(text);
}

// \param one, many  names of the elements that have a value each.
void check_values(const std::string& name, const std::vector<double>& values, std::size_t count,
                  const std::string& one, const std::string& many) {
    require(values.size() == count, name + " has " + std::to_string(values.size()) +
                                        " values, but the mesh has " + std::to_string(count) + ' ' +
                                        many + "; give one for each, or none");
    const auto is_bad = [](double value) { return !(value > 0 && std::isfinite(value)); };
    const auto bad = std::find_if(values.begin(), values.end(), is_bad);
    if (bad == values.end()) return;
    throw InvalidOption(name + " is " + std::to_string(*bad) + " at " + one + ' ' +
                        std::to_string(bad - values.begin()) + "; use numbers above 0");
}

// Whether what gives the number suits where edges are how long.
void check_count(const Sizing& sizing) {
    const auto& count = sizing.count;
    const bool has_values = !sizing.is_even() && !sizing.is_adaptive();
    require(!std::holds_alternative<MaxError>(count) || sizing.is_adaptive(),
            "MaxError needs AdaptiveEdges");
    require(!std::holds_alternative<MaxDistance>(count) || !has_values,
            "MaxDistance excludes VertexLengths, FaceLengths and VertexDensities");
    require(!std::holds_alternative<CountOfLengths>(count) ||
                (has_values && !std::holds_alternative<VertexDensities>(sizing.edges)),
            "CountOfLengths needs VertexLengths or FaceLengths");
    const auto check = [](double value) {
        require(value > 0 && std::isfinite(value),
                "MaxError, MaxDistance, MeanEdge and NumFaces must be above 0");
    };
    if (const auto* mean = std::get_if<MeanEdge>(&count)) check(mean->length);
    if (const auto* faces = std::get_if<NumFaces>(&count)) check(faces->number);
    if (const auto* most = std::get_if<MaxError>(&count)) check(most->error);
    if (const auto* most = std::get_if<MaxDistance>(&count)) check(most->distance);
}

void check_sizing(const Sizing& sizing, const MeshView& mesh) {
    const std::size_t num_vertices = mesh.positions.size();
    if (const auto* at = std::get_if<VertexLengths>(&sizing.edges)) {
        check_values("VertexLengths", at->values, num_vertices, "vertex", "vertices");
    } else if (const auto* of = std::get_if<FaceLengths>(&sizing.edges)) {
        check_values("FaceLengths", of->values, mesh.triangles.size(), "face", "faces");
    } else if (const auto* densities = std::get_if<VertexDensities>(&sizing.edges)) {
        check_values("VertexDensities", densities->values, num_vertices, "vertex", "vertices");
    }
    check_count(sizing);
    for (const SizedPlace& place : sizing.places) {
        require(
            place.length > 0 && std::isfinite(place.length),
            "length of SizedPlace is " + std::to_string(place.length) + "; use a length above 0");
        require(place.radius >= 0, "radius of SizedPlace is " + std::to_string(place.radius) +
                                       "; use a length of 0 or more");
    }
    require(sizing.min_edge >= 0 && sizing.max_edge > 0 && sizing.min_edge <= sizing.max_edge,
            "min_edge is " + std::to_string(sizing.min_edge) + " and max_edge " +
                std::to_string(sizing.max_edge) +
                "; use numbers above 0, the second not below the first");
    require(sizing.gradation >= 1 && std::isfinite(sizing.gradation),
            "gradation is " + std::to_string(sizing.gradation) + "; use a number of 1 or more");
}

void check_bounds(const ShapeBounds& bounds) {
    require(bounds.min_angle >= 0 && bounds.min_angle <= 30,
            "min_angle is " + std::to_string(bounds.min_angle) + "; use 0 to 30 degrees");
    require(bounds.max_angle >= 90 && bounds.max_angle <= 180,
            "max_angle is " + std::to_string(bounds.max_angle) + "; use 90 to 180 degrees");
    require(bounds.longest_edge > 0,
            "longest_edge is " + std::to_string(bounds.longest_edge) + "; use a length above 0");
}

void check_wrap(const RemeshOptions& options) {
    if (!options.wrap) return;
    require(*options.wrap >= 0 && std::isfinite(*options.wrap),
            "wrap is " + std::to_string(*options.wrap) + "; use a length of 0 or more");
    require(!options.sites && options.feature_edges.empty() && options.sizing.places.empty() &&
                options.locked.empty() && options.locked_edges.empty() && !options.lock_boundary,
            "wrap is given, and sites, feature_edges, places or locked elements, which a wrap does "
            "not have; leave out one of them");
    require(!std::holds_alternative<MaxDistance>(options.sizing.count),
            "wrap excludes MaxDistance, which is not proved to the mesh that is wrapped");
}

void check_options(const RemeshOptions& options, const MeshView& mesh) {
    require(options.num_samples >= 1, "num_samples is 0; use 1 or more");
    require(options.relax_steps >= 0,
            "relax_steps is " + std::to_string(options.relax_steps) + "; use 0 or more");
    require(options.samples_per_tile == 0 || options.samples_per_tile >= least_samples_per_tile,
            "samples_per_tile is " + std::to_string(options.samples_per_tile) +
                "; use 0, for one piece, or " + std::to_string(least_samples_per_tile) +
                " or more");
    require(options.drop_components >= 0 && options.drop_components <= 1,
            "drop_components is " + std::to_string(options.drop_components) +
                "; use a share from 0 to 1");
    require(options.feature_angle > 0 && options.feature_angle < 180,
            "feature_angle is " + std::to_string(options.feature_angle) +
                "; use degrees above 0 and below 180");
    require(options.face_labels.empty() || options.face_labels.size() == mesh.triangles.size(),
            "face_labels has " + std::to_string(options.face_labels.size()) +
                " labels, but the mesh has " + std::to_string(mesh.triangles.size()) +
                " faces; give one for each, or none");
    require(!options.sites ||
                (options.locked.empty() && options.locked_edges.empty() && !options.lock_boundary),
            "sites are given, and vertices or edges are locked; use one of them");
    check_wrap(options);
    check_sizing(options.sizing, mesh);
    check_bounds(options.bounds);
    check_num_threads(options.num_threads);
}

// Multiplies all lengths by 2^exponent.
void scale_lengths(Sizing& sizing, int exponent) {
    const auto scale = [&](double& length) { length = std::ldexp(length, exponent); };
    if (auto* at = std::get_if<VertexLengths>(&sizing.edges)) {
        std::ranges::for_each(at->values, scale);
    } else if (auto* of = std::get_if<FaceLengths>(&sizing.edges)) {
        std::ranges::for_each(of->values, scale);
    }
    if (auto* mean = std::get_if<MeanEdge>(&sizing.count)) scale(mean->length);
    if (auto* most = std::get_if<MaxError>(&sizing.count)) scale(most->error);
    if (auto* most = std::get_if<MaxDistance>(&sizing.count)) scale(most->distance);
    for (SizedPlace& place : sizing.places) {
        scale(place.length);
        scale(place.radius);
    }
    scale(sizing.min_edge);
    scale(sizing.max_edge);
}

// Scales the lengths of a result back: it was computed from the mesh times 2^-exponent.
void scale_back(RemeshResult& result, int exponent) {
    result.mesh = scaled(result.mesh.view(), exponent);
    Verdict& verdict = result.verdict;
    for (double* length :
         {&result.wrapped.radius, &result.features.length, &result.features.close_length,
          &result.features.dropped_length, &result.features.freed_length,
          &result.features.seam_length, &result.features.dropped_seam_length,
          &result.sizing.mean_edge, &result.sizing.least_target, &result.sizing.largest_target,
          &result.sizing.largest_distance, &verdict.spacing, &verdict.thinnest_wall,
          &verdict.largest_distance, &verdict.diagonal}) {
        *length = std::ldexp(*length, exponent);
    }
    for (double& target : result.sizing.targets) target = std::ldexp(target, exponent);
    for (auto* place : {&verdict.farthest, &result.features.freed_near, &result.crossing_near}) {
        for (double& coordinate : *place) coordinate = std::ldexp(coordinate, exponent);
    }
    for (ComponentTopology& component : result.input_topology.components) {
        component.area = std::ldexp(component.area, 2 * exponent);
    }
    for (RelaxLevel& level : result.relaxation) {
        for (double& energy : level.energy) energy = std::ldexp(energy, 4 * exponent);
    }
}

// Whether some faces are to stay.
// \throw InvalidOption  the region does not fit to the mesh or to other options.
bool is_part(const MeshView& mesh, const RemeshOptions& options) {
    const std::vector<std::uint8_t>& region = options.region;
    if (region.empty()) return false;
    require(region.size() == mesh.triangles.size(),
            "region has " + std::to_string(region.size()) + " values, but the mesh has " +
                std::to_string(mesh.triangles.size()) + " faces; give one for each, or none");
    require(!options.sites && !(options.drop_components > 0) && !(options.cleaning.weld > 0) &&
                options.cleaning.fill_holes == 0 && options.sizing.places.empty() && !options.wrap,
            "a region is given, and sites, places, drop_components, weld, fill_holes or wrap as "
            "well; "
            "leave out one of them");
    if (std::find(region.begin(), region.end(), 0) == region.end()) return false;
    check_options(options, mesh);
    return true;
}

RemeshResult run(const detail::InputMesh& input, const RemeshOptions& options) {
    check_options(options, input.view);
    const double size = box_of(input.view, options.num_threads).longest_side();
    const auto run_stages = options.wrap ? detail::run_wrapped : detail::run_stages;
    if (is_in_scale(size)) return run_stages(input, options);
    const int exponent = std::ilogb(size);
    TriangleMesh normal = scaled(input.view, -exponent);
    RemeshOptions scaled_options = options;
    scale_lengths(scaled_options.sizing, -exponent);
    scaled_options.bounds.longest_edge = std::ldexp(options.bounds.longest_edge, -exponent);
    scaled_options.cleaning.weld = std::ldexp(options.cleaning.weld, -exponent);
    if (options.wrap) scaled_options.wrap = std::ldexp(*options.wrap, -exponent);
    RemeshResult result = run_stages({normal.view(), &normal}, scaled_options);
    scale_back(result, exponent);
    return result;
}

}  // namespace

RemeshResult remesh(const MeshView& mesh, const RemeshOptions& options) {
    if (is_part(mesh, options)) return detail::remesh_region(mesh, options);
    return run({mesh, nullptr}, options);
}

RemeshResult remesh_moved(TriangleMesh mesh, const RemeshOptions& options) {
    if (is_part(mesh.view(), options)) return remesh(mesh.view(), options);
    return run({mesh.view(), &mesh}, options);
}

}  // namespace remesh
