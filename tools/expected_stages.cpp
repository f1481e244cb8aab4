// Times that --verbose tells on the machine of remesh::expected_work: of `remesh --map`, and of
// `agvd diagram`, with 200 to 20 000 sites on the bunny and on one of 1.1 million faces; of
// `agvd compare` on the bunny with 200 sites.
#include "expected_stages.h"

#include <algorithm>
#include <numbers>
#include <system_error>

namespace cli {
namespace {

// Text files have 39 to 46 bytes for each face.
constexpr double bytes_of_face = 40;
constexpr double reading_of_byte = 1.1e-8;
constexpr double writing_of_sample = 5e-7;
constexpr double mapping_of_face = 2.4e-7, mapping_of_sample = 1e-6;

// Where lengths decide the number of samples.
constexpr std::size_t faces_of_unknown_sample = 20;

double sum(const std::vector<ExpectedStage>& stages) {
    double work = 0;
    for (const ExpectedStage& stage : stages) work += stage.work;
    return work;
}

}  // namespace

std::vector<ExpectedStage> stages_with_reading(const std::filesystem::path& input,
                                               std::size_t num_samples) {
    std::error_code none;  // Such as standard input.
    const std::uintmax_t size = std::filesystem::file_size(input, none);
    const double bytes = none ? 0 : static_cast<double>(size);
    const auto num_faces = static_cast<std::size_t>(bytes / bytes_of_face);
    return {{"read", bytes * reading_of_byte},
            {"rest", sum(stages_of_remesh(num_faces, num_samples, false, {}))}};
}

std::vector<ExpectedStage> stages_of_remesh(std::size_t num_faces, std::size_t num_samples,
                                            bool has_map, const remesh::RemeshOptions& options) {
    if (num_samples == 0) num_samples = num_faces / faces_of_unknown_sample;
    std::vector<ExpectedStage> stages;
    for (const auto& [stage, work] : remesh::expected_work(num_faces, num_samples, options)) {
        stages.push_back({remesh::stage_name(stage), work, stage == remesh::Stage::Clean});
    }
    const auto faces = static_cast<double>(num_faces), samples = static_cast<double>(num_samples);
    if (has_map) {
        stages.push_back({"transfer", mapping_of_face * faces + mapping_of_sample * samples});
    }
    stages.push_back({"write", writing_of_sample * samples});
    return stages;
}

Runs runs_of_remesh(const remesh::RemeshOptions& options) {
    return std::holds_alternative<remesh::MaxDistance>(options.sizing.count) ? Runs::Unknown
                                                                             : Runs::One;
}

std::vector<ExpectedStage> stages_of_diagram(std::size_t num_faces, std::size_t num_sites) {
    const auto faces = static_cast<double>(num_faces), sites = static_cast<double>(num_sites);
    return {{"clean", 3e-6 * faces},
            {"sample", 7e-7 * faces + 4e-5 * sites},
            {"propagate", 3e-6 * faces + 1e-5 * sites},
            {"diagram", 4e-7 * faces + 6e-5 * sites},
            {"write", 1e-7 * faces + 1e-5 * sites}};
}

std::vector<ExpectedStage> stages_of_query(std::size_t num_faces, const char* query) {
    const auto faces = static_cast<double>(num_faces);
    return {{"clean", 3e-6 * faces},
            {"sample", 7e-7 * faces},
            {"propagate", 2e-5 * faces},
            {query, 3e-6 * faces},
            {"write", 1e-7 * faces}};
}

std::vector<ExpectedStage> stages_of_comparison(bool is_exact) {
    std::vector<ExpectedStage> stages{{"read", 0.12}};
    if (is_exact) stages.insert(stages.end(), {{"propagate", 0.19}, {"diagram", 0.1}});
    stages.push_back({"compare", 2.4});
    return stages;
}

std::size_t estimated_samples(const remesh::RemeshOptions& options, const agvd::MeshView& mesh) {
    const auto& wanted = options.sizing.count;
    if (options.sites) return options.sites->size();
    if (const auto* faces = std::get_if<remesh::NumFaces>(&wanted)) return faces->number / 2;
    if (std::holds_alternative<remesh::NumSamples>(wanted)) return options.num_samples;
    const auto* mean = std::get_if<remesh::MeanEdge>(&wanted);
    if (mean == nullptr) return 0;
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const agvd::Vec3& p = mesh.positions[a];
        area += (mesh.positions[b] - p).cross(mesh.positions[c] - p).norm() / 2;
    }
    const double count = 2 / std::numbers::sqrt3 * area / (mean->length * mean->length);
    constexpr double most = 1e12;
    return static_cast<std::size_t>(std::clamp(count, 1.0, most));
}

std::size_t least_memory(std::size_t num_faces, std::size_t num_samples) {
    const std::size_t in_work =
        std::min<std::size_t>(num_samples, remesh::RemeshOptions{}.samples_per_tile);
    return 200 * num_faces + 3000 * in_work + 300 * num_samples;
}

}  // namespace cli
