#include "mesh_run.h"

#include <exception>
#include <utility>

#include "report/report.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

void write(const MeshRun& run, const Products& products, Console& console) {
    // They may have appeared since they were checked.
    if (run.no_clobber) {
        for (const remesh::FileContent& file : products.files) require_new(file.path);
    }
    remesh::write_files_atomically(products.files, console.progress_of("write"));
    console.info(products.text);
    for (const remesh::FileContent& file : products.files) {
        const std::string path = file.path.string();
        if (products.text.find(path) == std::string::npos) console.info("written: " + path);
    }
}

std::string report_without_result(const MeshRun& run, const Failure& failure,
                                  const Console& console) {
    remesh::RunInfo info;
    info.version = REMESH_VERSION;
    info.input_path = run.input.string();
    info.output_path = run.output.string();
    info.warnings = console.warnings();
    return remesh::to_json(
        remesh::RunFailure{
            .exit_code = failure.exit_code, .error = failure.text, .stage = console.stage()},
        info);
}

std::string to_report(const MeshRun& run, std::span<const std::string> objects) {
    return run.has_levels ? to_array(objects) : objects.front();
}

void report_failure(const MeshRun& run, const Failure& failure, Console& console) {
    if (run.report.empty() || interrupted()) return;
    try {
        write_text(run.report,
                   to_report(run, std::vector{report_without_result(run, failure, console)}));
    } catch (const agvd::Error& error) {
        console.warn(error.what());
    }
}

}  // namespace

void run_alone(const MeshRun& run, Console& console) {
    run.check_outputs();
    try {
        console.run([&] {
            Products products = run.make();
            if (run.report == "-") {
                print(to_report(run, products.reports));
            } else if (!run.report.empty()) {
                products.files.push_back({run.report, to_report(run, products.reports)});
            }
            write(run, products, console);
        });
    } catch (...) {
        report_failure(run, failure_of(std::current_exception()), console);
        throw;
    }
}

MeshOutcome run_in_batch(const MeshRun& run, Console& console) {
    MeshOutcome outcome;
    if (run.no_clobber && fs::exists(run.output)) {
        const std::string text = run.output.string() + ": exists already; skipped";
        console.info(text);
        outcome.is_skipped = true;
        outcome.reports = {report_without_result(run, {.exit_code = 0, .text = text}, console)};
        return outcome;
    }
    try {
        run.check_outputs();
        console.run([&] {
            Products products = run.make();
            write(run, products, console);
            outcome.reports = std::move(products.reports);
        });
    } catch (...) {
        outcome.failure = failure_of(std::current_exception());
        outcome.reports = {report_without_result(run, *outcome.failure, console)};
    }
    return outcome;
}

}  // namespace cli
