#include "stage_details.h"

#include <cmath>
#include <cstdio>
#include <locale>
#include <sstream>

#include "report/report.h"

namespace cli {
namespace {

using remesh::RemeshResult;
using remesh::Stage;

std::string after_clean(const RemeshResult& result, std::size_t num_faces) {
    return std::to_string(num_faces) + " faces, " +
           std::to_string(result.input_topology.face_component.size()) + " when cleaned, " +
           std::to_string(result.refined_faces) + " in the base; " +
           remesh::to_text(result.cleaned) +
           "; components dropped: " + std::to_string(result.components_dropped);
}

// "2000 sites, 60 steps, energy 1 .991 .987": after each tenth step, as a share of the first.
std::string after_relax(const RemeshResult& result) {
    constexpr std::size_t between = 10;
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(4);
    for (const remesh::RelaxLevel& level : result.relaxation) {
        const std::size_t num_steps = level.energy.size() - 1;
        text << (text.tellp() > 0 ? "; " : "") << level.num_sites << " sites, " << num_steps
             << " steps";
        for (std::size_t step = 0; step <= num_steps; ++step) {
            if (step % between != 0 && step != num_steps) continue;
            const auto energy = remesh::energy_share(level, step);
            if (energy) text << (step == 0 ? ", energy " : " ") << *energy;
        }
    }
    return result.relaxation.empty() ? "sites stay as sampled" : text.str();
}

std::string after_dual(const RemeshResult& result) {
    const remesh::DualCounts& dual = result.dual;
    return std::to_string(dual.sites_of_cells) + " of " + std::to_string(dual.sites) +
           " sites with the triangles of their cells; cells that are no discs, or meet others " +
           "along several arcs: " + std::to_string(dual.narrow_sites) +
           "; parts simplified: " + std::to_string(dual.simplified_parts) +
           "; sites dropped: " + std::to_string(result.sites_dropped);
}

std::string after_check(const RemeshResult& result) {
    return "self-intersections: " +
           (result.self_intersections ? std::to_string(*result.self_intersections)
                                      : std::string("not counted")) +
           " in the result, " + std::to_string(result.input_self_intersections) +
           " in the input; " + std::to_string(result.unfitted_vertices) + " vertices moved back";
}

std::string after_propagate(const RemeshResult& result) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(3);
    text << result.propagation_bytes << " bytes, distances ";
    if (std::isfinite(result.certified_error)) {
        text << "at most " << 100 * result.certified_error << " % above exact";
    } else {
        text << "of unknown error";
    }
    return text.str();
}

std::string after(Stage stage, const RemeshResult& result, std::size_t num_faces) {
    switch (stage) {
        case Stage::Clean:
            return after_clean(result, num_faces);
        case Stage::Sample:
            return std::to_string(result.sizing.num_samples) + " samples asked for";
        case Stage::Relax:
            return after_relax(result);
        case Stage::Propagate:
            return after_propagate(result);
        case Stage::Diagram:
            return "creases and boundary: " + std::to_string(result.features.curves) +
                   " curves with " + std::to_string(result.features.vertices) + " vertices";
        case Stage::Dual:
            return after_dual(result);
        case Stage::Delaunay:
            return std::to_string(result.delaunay.failing_before) + " edges failed, " +
                   std::to_string(result.delaunay.flips) + " flips, " +
                   std::to_string(result.delaunay.failing_after) + " fail";
        case Stage::Place:
            return std::to_string(result.mesh.positions.size()) + " vertices, " +
                   std::to_string(result.mesh.triangles.size()) + " faces";
        case Stage::Check:
            return after_check(result);
    }
    return "";
}

}  // namespace

std::string stage_details(const RemeshResult& result, std::size_t num_faces) {
    std::string text;
    for (const auto& [stage, seconds] : result.seconds) {
        char start[64];
        std::snprintf(start, sizeof start, "%-10s%7.2f s  ", remesh::stage_name(stage), seconds);
        if (!text.empty()) text += '\n';
        text += start + after(stage, result, num_faces);
    }
    return text;
}

}  // namespace cli
