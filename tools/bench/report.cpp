#include "bench/report.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <iomanip>
#include <map>
#include <sstream>

#include "cli.h"

namespace bench {
namespace {

constexpr int column_width = 11;

std::string cell(const nlohmann::ordered_json& value, int digits) {
    if (value.is_string()) return value.get<std::string>();
    std::ostringstream text;
    if (digits < 0) {
        text << std::scientific << std::setprecision(-digits) << value.get<double>();
    } else {
        text << std::fixed << std::setprecision(digits) << value.get<double>();
    }
    return text.str();
}

}  // namespace

void add_options(CLI::App& app, Options& options) {
    const std::map<std::string, Place> places{{"vertices", Place::Vertices},
                                              {"faces", Place::Faces}};
    app.add_option("meshes", options.meshes, "Meshes to measure on")->required();
    app.add_option("-t,--sites", options.sites, "Numbers of sites")->capture_default_str();
    app.add_option("-m,--steiner-points", options.steiner_points, "Steiner points per edge")
        ->capture_default_str();
    app.add_option("--place", options.place, "Where sites lie: vertices or faces")
        ->transform(CLI::CheckedTransformer(places));
    app.add_option("--seed", options.seed, "Seed of the random sites")->capture_default_str();
    app.add_option("--threads", options.threads, "Threads; 0: all cores")->capture_default_str();
    app.add_option("--json", options.json, "Write the results to this file");
}

Seconds time(const std::function<void()>& job) {
    const auto wall = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    job();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - wall;
    return {taken.count(), static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC};
}

Spread spread_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const double median = values[values.size() / 2];
    return {median, (values.back() - values.front()) / median};
}

void print_heading(const std::vector<Column>& columns) {
    std::ostringstream line;
    for (const Column& column : columns) line << std::setw(column_width) << column.heading << ' ';
    cli::print(line.str() + '\n');
}

void print_row(const std::vector<Column>& columns, const nlohmann::ordered_json& row) {
    std::ostringstream line;
    for (const auto& [key, heading, digits] : columns) {
        line << std::setw(column_width) << cell(row.at(key), digits) << ' ';
    }
    cli::print(line.str() + '\n');
}

void write_json(const Options& options, const std::string& benchmark,
                const nlohmann::ordered_json& rows) {
    if (options.json.empty()) return;
    const nlohmann::ordered_json report{
        {"benchmark", benchmark}, {"commit", AGVD_GIT_COMMIT}, {"rows", rows}};
    cli::write_text(options.json, report.dump(2) + '\n');
}

}  // namespace bench
