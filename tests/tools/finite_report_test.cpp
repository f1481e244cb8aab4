// No number of a report is infinite or NaN, whatever the mesh.
#include <gtest/gtest.h>

#include <cstdio>
#include <regex>

#include "agvd/core/error.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "report/report.h"
#include "support/damages.h"
#include "support/files.h"
#include "support/report_keys.h"
#include "support/shapes.h"

namespace {

using agvd::TriangleMesh;

void expect_finite(const std::string& text, const std::string& json, const std::string& title) {
    static const std::regex not_finite("(^|[^a-z])-?(nan|inf|infinity)([^a-z]|$)",
                                       std::regex::icase);
    std::smatch found;
    EXPECT_FALSE(std::regex_search(text, found, not_finite)) << text;
    report_keys::expect_nulls_documented(json, {title, "What reports share"});
}

// \return whether there is a result.
template <typename MakeMesh>
bool expect_finite_reports(const MakeMesh& make_mesh, const remesh::RemeshOptions& options) {
    try {
        const TriangleMesh mesh = make_mesh();
        const remesh::RemeshResult made = remesh::remesh(mesh.view(), options);
        const remesh::RunInfo info{.version = "1", .options = options};
        expect_finite(remesh::to_text(made, info) + '\n' + remesh::details_to_text(made, info),
                      remesh::to_json(made, info), "remesh");
        if (!made.self_intersections) return true;  // Without CGAL most of an evaluation is null.
        const remesh::Evaluation judged = remesh::evaluate(mesh.view(), made.mesh.view());
        expect_finite(remesh::to_text(judged), remesh::to_json(judged, {.version = "1"}),
                      "remesh-eval");
        return true;
    } catch (const agvd::Error&) {
        return false;
    }
}

}  // namespace

TEST(FiniteReports, HoldForDamagedMeshes) {
    int num_results = 0;
    for (const char* const kind : damages::kinds()) {
        SCOPED_TRACE(kind);
        Dice dice(1);
        const auto damaged = [&] { return damages::apply(kind, shapes::torus(20, 10), dice); };
        if (expect_finite_reports(damaged, {.num_samples = 60})) ++num_results;
    }
    EXPECT_GT(num_results, static_cast<int>(damages::kinds().size()) / 2);
}

// A plane strip of two triangles whose sites lie in a row: all triangles of the sites are thin.
TEST(FiniteReports, HoldWhereAllTrianglesOfTheSitesAreThin) {
    for (const double width : {1e-1, 1e-2, 1e-4}) {
        TriangleMesh strip = shapes::grid(2);
        for (agvd::Vec3& p : strip.positions) p.y() *= width;
        for (const agvd::Index num_samples : {4U, 5U, 8U, 30U}) {
            static_cast<void>(
                expect_finite_reports([&] { return strip; }, {.num_samples = num_samples}));
        }
    }
}

// Every twentieth mesh of the corpus.
TEST(FiniteReports, HoldForRealMeshes) {
    const std::filesystem::path folder = files::find_mesh("../corpus");
    if (!exists(folder)) GTEST_SKIP() << folder << " is absent; set AGVD_MESHES to its neighbour";
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".gz") paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    int num_results = 0;
    for (std::size_t i = 0; i < paths.size(); i += 20) {
        SCOPED_TRACE(paths[i].string());
        const auto read = [&] { return remesh::read_mesh(paths[i]).mesh; };
        if (expect_finite_reports(read, {.num_samples = 100})) ++num_results;
    }
    std::printf("%d results\n", num_results);
    EXPECT_GT(num_results, 5);
}
