#include "levels.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "agvd/core/error.h"
#include "help.h"
#include "mesh_paths.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr int most_levels = 16;  // 4^15 times fewer vertices.

// A number of levels, or two or more numbers of samples between commas.
// \return what is wrong; otherwise empty.
std::string take_levels(const std::string& text, LevelArguments& arguments) {
    const std::vector<std::string> values = CLI::detail::split(text, ',');
    if (values.size() == 1) {
        int& count = arguments.count;
        if (CLI::detail::lexical_cast(text, count) && count >= 2 && count <= most_levels) return {};
    } else if (std::all_of(values.begin(), values.end(), is_number_of_samples)) {
        arguments.count = static_cast<int>(values.size());
        for (const std::string& value : values) arguments.samples.push_back(*parse_amount(value));
        return {};
    }
    return "the value is '" + text + "'; use a number of levels from 2 to " +
           std::to_string(most_levels) +
           ", or numbers of samples between commas (such as 8000,2000,500)";
}

fs::path level_path(const fs::path& path, int level) {
    fs::path stem = path.stem(), extension = path.extension();
    if (extension == ".gz") {
        extension = stem.extension().concat(".gz");
        stem = stem.stem();
    }
    return path.parent_path() / (stem.string() + '-' + std::to_string(level) + extension.string());
}

}  // namespace

void add_level_option(CLI::App& app, LevelArguments& arguments) {
    const auto take = [&arguments](const std::string& text) {
        const std::string complaint = take_levels(text, arguments);
        if (!complaint.empty()) throw CLI::ValidationError("--levels", complaint);
    };
    start_group(app, heading::count);
    app.add_option_function<std::string>(
           "--levels", take,
           "Levels of detail in one run, each made from IN; the files get -0, -1, ... before the "
           "extension. K: so many, each with a quarter of the vertices of the one before (twice "
           "the length of edges, four times the distance); N,N,...: one for each number of "
           "samples, or percentage")
        ->type_name("K|N,N,...")
        ->excludes("--sites");
}

void check_levels(const LevelArguments& arguments, const SizingArguments& sizing) {
    if (arguments.samples.empty() || !has_count(sizing)) return;
    throw agvd::InvalidOption(
        "--levels gives the numbers of samples; leave out --samples, --faces, --edge-length and "
        "--max-distance, or give --levels the number of levels");
}

std::vector<fs::path> level_paths(const LevelArguments& arguments, const fs::path& path) {
    if (arguments.count == 1 || path.empty()) {
        return {static_cast<std::size_t>(arguments.count), path};
    }
    if (is_standard_stream(path)) {
        throw agvd::InvalidOption(
            "--levels writes a file for each level, and standard output can be one only; name a "
            "file");
    }
    std::vector<fs::path> paths;
    for (int level = 0; level < arguments.count; ++level) paths.push_back(level_path(path, level));
    return paths;
}

remesh::RemeshOptions options_of_level(const LevelArguments& arguments, std::size_t level,
                                       remesh::RemeshOptions options, std::size_t num_vertices) {
    remesh::Sizing& sizing = options.sizing;
    const bool is_given =
        arguments.samples.empty() ? level == 0 : !arguments.samples[level].is_percent;
    if (!is_given && options.vertex_count == remesh::VertexCount::Exact) {
        options.vertex_count = remesh::VertexCount::Raise;
    }
    if (!arguments.samples.empty()) {
        options.num_samples = num_samples_for(arguments.samples[level], num_vertices);
        if (std::holds_alternative<remesh::CountOfLengths>(sizing.count)) {
            sizing.count = remesh::NumSamples{};
        }
        return options;
    }
    const double factor = std::ldexp(1, static_cast<int>(level));  // Of lengths.
    const auto fewer = [&](agvd::Index& count) {
        count = static_cast<agvd::Index>(std::max(1.0, std::round(count / (factor * factor))));
    };
    fewer(options.num_samples);
    const auto longer = [&](std::vector<double>& lengths) {
        for (double& length : lengths) length *= factor;
    };
    sizing.min_edge *= factor;
    sizing.max_edge *= factor;
    if (auto* lengths = std::get_if<remesh::VertexLengths>(&sizing.edges)) longer(lengths->values);
    if (auto* lengths = std::get_if<remesh::FaceLengths>(&sizing.edges)) longer(lengths->values);
    if (auto* faces = std::get_if<remesh::NumFaces>(&sizing.count)) fewer(faces->number);
    if (auto* mean = std::get_if<remesh::MeanEdge>(&sizing.count)) mean->length *= factor;
    if (auto* most = std::get_if<remesh::MaxDistance>(&sizing.count)) {
        most->distance *= factor * factor;
    }
    return options;
}

}  // namespace cli
