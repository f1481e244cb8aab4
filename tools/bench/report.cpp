#include "bench/report.h"

#include <iomanip>
#include <map>
#include <sstream>

#include "cli.h"

namespace bench {
namespace {

std::string cell(const nlohmann::ordered_json& row, const Column& column) {
    const auto found = row.find(column.key);
    if (found == row.end() || found->is_null()) return "-";
    const nlohmann::ordered_json& value = *found;
    const int digits = column.digits;
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
    app.add_option("meshes", options.meshes, "Meshes to measure on; torus:FACES is a generated one")
        ->required();
    app.add_option("-t,--sites", options.sites, "Numbers of sites")->capture_default_str();
    app.add_option("-m,--steiner-points", options.steiner_points, "Steiner points per edge")
        ->capture_default_str();
    app.add_option("--place", options.place, "Where sites lie: vertices or faces")
        ->transform(CLI::CheckedTransformer(places));
    app.add_option("--seed", options.seed, "Seed of the random sites")->capture_default_str();
    app.add_option("--json", options.json, "Write the results to this file");
}

void print_heading(const std::vector<Column>& columns) {
    std::ostringstream line;
    for (const Column& column : columns) line << std::setw(column.width) << column.heading << ' ';
    cli::print(line.str() + '\n');
}

void print_row(const std::vector<Column>& columns, const nlohmann::ordered_json& row) {
    std::ostringstream line;
    for (const Column& column : columns) {
        line << std::setw(column.width) << cell(row, column) << ' ';
    }
    cli::print(line.str() + '\n');
}

std::string markdown(const std::vector<Column>& columns, const nlohmann::ordered_json& rows) {
    std::string heading = "|", rule = "|", body;
    for (const Column& column : columns) {
        heading += ' ' + column.heading + " |";
        rule += "---|";
    }
    for (const nlohmann::ordered_json& row : rows) {
        body += '|';
        for (const Column& column : columns) body += ' ' + cell(row, column) + " |";
        body += '\n';
    }
    return heading + '\n' + rule + '\n' + body;
}

void write_json(const Options& options, const std::string& benchmark,
                const nlohmann::ordered_json& rows) {
    if (!options.json.empty()) write_json(options.json, benchmark, rows);
}

void write_json(const std::filesystem::path& path, const std::string& benchmark,
                const nlohmann::ordered_json& rows) {
    const nlohmann::ordered_json report{
        {"benchmark", benchmark}, {"commit", AGVD_GIT_COMMIT}, {"rows", rows}};
    cli::write_text(path, report.dump(2) + '\n');
}

}  // namespace bench
