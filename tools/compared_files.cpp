#include "compared_files.h"

#include <algorithm>
#include <array>

#include "based_diagram.h"
#include "cli.h"
#include "given_surface.h"
#include "remesh/meshfile/diagram_file.h"

namespace cli {
namespace {

// \throw agvd::InvalidInput  b is not of the same mesh and sites.
void check_same_input(const ComparedFiles& files, const remesh::DiagramFile& a,
                      const remesh::DiagramFile& b) {
    const std::string both = files.a.string() + " and " + files.b.string();
    if (a.mesh.positions != b.mesh.positions || a.mesh.triangles != b.mesh.triangles) {
        throw agvd::InvalidInput(
            both + " have different meshes (" + std::to_string(a.mesh.triangles.size()) + " and " +
            std::to_string(b.mesh.triangles.size()) + " faces); compare diagrams of the same mesh");
    }
    const auto [in_a, in_b] =
        std::mismatch(a.sites.begin(), a.sites.end(), b.sites.begin(), b.sites.end());
    if (in_a != a.sites.end() || in_b != b.sites.end()) {
        throw agvd::InvalidInput(both + " have different sites (" + std::to_string(a.sites.size()) +
                                 " and " + std::to_string(b.sites.size()) +
                                 " sites, which first differ at site " +
                                 std::to_string(in_a - a.sites.begin()) +
                                 "); write both with the same --sites, or the same --samples, "
                                 "--init and --seed");
    }
    if (a.points != b.points) {
        throw agvd::InvalidInput(both +
                                 " group their points differently, or start them at different "
                                 "distances; write both with the same --sites");
    }
    if (a.shapes != b.shapes) {
        throw agvd::InvalidInput(both +
                                 " have different lines or regions among their sites; write both "
                                 "with the same --sites");
    }
}

}  // namespace

remesh::Comparison compare_files(const ComparedFiles& files, int num_threads,
                                 const std::function<agvd::Progress(const char*)>& progress_of) {
    const remesh::DiagramFile a = remesh::read_diagram(files.a, progress_of("read"));
    const auto naming_a = [&](const auto& work) { return naming_file(files.a, work); };
    const agvd::Surface surface = naming_a(
        [&] { return agvd::build_surface(a.mesh.view(), num_threads, progress_of("read")); });
    const std::vector<agvd::SiteShape> shapes = naming_a(
        [&] { return carry_shapes(a.shapes, a.mesh.view(), remesh::CleanResult(), surface); });
    agvd::Diagram b;
    if (files.b == exact_diagram) {
        const agvd::PropagationOptions exact{
            .points = a.points, .shapes = shapes, .max_error = 0, .num_threads = num_threads};
        b = naming_a([&] { return based_diagram(surface, a.sites, exact, progress_of).diagram; });
    } else {
        remesh::DiagramFile file = remesh::read_diagram(files.b, progress_of("read"));
        check_same_input(files, a, file);
        b = std::move(file.diagram);
    }
    agvd::DiagramCompareOptions options = files.options;
    options.num_threads = num_threads;
    options.progress = progress_of("compare");
    remesh::Comparison comparison{
        .sites = a.diagram.num_sites,
        .difference = agvd::compare_diagrams(surface, a.diagram, b, options)};
    if (files.points == 0) return comparison;
    const std::array<const agvd::Diagram*, 2> diagrams{&a.diagram, &b};
    const auto errors = agvd::exact_bisector_errors(surface, a.sites, diagrams,
                                                    {.points = a.points,
                                                     .shapes = shapes,
                                                     .max_points = files.points,
                                                     .num_threads = num_threads,
                                                     .progress = progress_of("compare")});
    comparison.bisectors_a = errors[0];
    comparison.bisectors_b = errors[1];
    return comparison;
}

}  // namespace cli
