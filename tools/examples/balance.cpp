// example-balance: cells of equal areas. Each site starts at a distance of its own, which counts as
// an additive weight; a larger start makes the cell smaller. Such starts exist for any areas
// ([geiss2013]), and maximise a concave function whose gradient is what areas lack.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "agvd/agvd.h"
#include "examples/example.h"
#include "remesh/meshfile/mesh_file.h"

namespace {

using agvd::Index;

constexpr const char* usage =
    "usage: example-balance MESH N CELLS.ply SITES.txt\n"
    "Takes N vertices as sites, each as far as can be from those before, and lets each start at a\n"
    "distance such that all cells have the same area within 1 %. Prints the areas. Writes the\n"
    "mesh cut along the borders, with the property `site` of each face, and the sites with their\n"
    "starts, for `agvd diagram --sites`.\n";

constexpr double tolerance = 0.01;    // Of the areas.
constexpr double least_share = 0.01;  // Of a step: shorter ones are given up.

// Each as far as can be from those before, the first in the first face.
std::vector<Index> farthest_vertices(const agvd::Surface& surface, Index count) {
    std::vector<Index> vertices{surface.tail(0)};
    std::vector<agvd::SurfacePoint> points{agvd::point_at(surface, vertices[0])};
    while (vertices.size() < count) {
        auto distance = agvd::propagate(surface, points).vertex_distance;
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            if (surface.outgoing[v] == agvd::no_index) distance[v] = 0;  // It is in no face.
        }
        const auto farthest = std::max_element(distance.begin(), distance.end());
        vertices.push_back(static_cast<Index>(farthest - distance.begin()));
        points.push_back(agvd::point_at(surface, vertices.back()));
    }
    return vertices;
}

struct Cells {
    agvd::SitePoints points;  // With the starts.
    agvd::Diagram diagram;
    Eigen::VectorXd excess;  // Of the areas, as a share of their mean.
};

double worst(const Cells& cells) { return cells.excess.cwiseAbs().maxCoeff(); }

// Starts count by their differences: they are moved so that the least is 0.
Cells cells_of(const agvd::Surface& surface, const std::vector<agvd::SurfacePoint>& sites,
               const Eigen::VectorXd& starts) {
    Cells cells;
    for (const double start : starts) cells.points.start.push_back(start - starts.minCoeff());
    cells.diagram = agvd::build_diagram(surface, sites,
                                        agvd::propagate(surface, sites, {.points = cells.points}));
    const Eigen::Map<const Eigen::ArrayXd> areas(cells.diagram.cell_area.data(), starts.size());
    cells.excess = areas / areas.mean() - 1;
    return cells;
}

// By how much starts should change for the areas to lose their excess: these change by half the
// border's length for each unit of difference between both sides.
Eigen::VectorXd newton_step(const agvd::Surface& surface, const Cells& cells) {
    const Eigen::Index n = cells.excess.size();
    const double mean_area = agvd::surface_area(surface) / static_cast<double>(n);
    // Equal changes of all starts do nothing; the matrix would be singular.
    Eigen::MatrixXd change = Eigen::MatrixXd::Constant(n, n, std::sqrt(mean_area));
    for (Index e = 0; e < cells.diagram.edges.size(); ++e) {
        const agvd::VoronoiEdge& edge = cells.diagram.edges[e];
        if (!edge.right.is_valid()) continue;
        const Index i = edge.left.value(), j = edge.right.value();
        const double rate = agvd::curve_length(surface, cells.diagram, e) / 2;
        change(i, i) += rate;
        change(j, j) += rate;
        change(i, j) -= rate;
        change(j, i) -= rate;
    }
    return change.ldlt().solve(mean_area * cells.excess);
}

// Steps are halved until areas are more even and no cell is nearly lost ([kitagawa2019]).
Cells balance(const agvd::Surface& surface, const std::vector<agvd::SurfacePoint>& sites) {
    Eigen::VectorXd starts = Eigen::VectorXd::Zero(std::ssize(sites));
    Cells cells = cells_of(surface, sites, starts);
    const double least_excess = std::min(-0.5, (cells.excess.minCoeff() - 1) / 2);
    double share = 1;  // Of a step.
    const auto is_better = [&](const Cells& next) {
        return next.excess.minCoeff() >= least_excess &&
               next.excess.norm() <= (1 - share / 4) * cells.excess.norm();
    };
    while (worst(cells) > tolerance) {
        const Eigen::VectorXd step = newton_step(surface, cells);
        share = std::min(1.0, 4 * share);
        Cells next = cells_of(surface, sites, starts + share * step);
        while (!is_better(next)) {
            share /= 2;
            if (share < least_share) {
                throw agvd::ConstraintUnmet("a cell stays " + std::to_string(100 * worst(cells)) +
                                            " % off; take another number of sites");
            }
            next = cells_of(surface, sites, starts + share * step);
        }
        starts += share * step;
        cells = std::move(next);
    }
    return cells;
}

void write_cells(const example::Arguments& arguments) {
    const agvd::Surface surface = agvd::build_surface(remesh::read_mesh(arguments[0]).mesh.view());
    const auto count = static_cast<Index>(
        example::number(arguments[1], "N", 2, std::min(2000U, surface.num_vertices())));
    const std::vector<Index> vertices = farthest_vertices(surface, count);
    std::vector<agvd::SurfacePoint> sites;
    sites.reserve(count);
    for (const Index v : vertices) sites.push_back(agvd::point_at(surface, v));
    const Cells balanced = balance(surface, sites);
    std::ostringstream lines;
    lines.precision(17);
    for (Index i = 0; i < count; ++i) {
        std::printf("cell %u: area %.8g\n", i, balanced.diagram.cell_area[i]);
        lines << "v " << vertices[i] << " start " << balanced.points.start[i] << '\n';
    }
    std::printf("at most %.2f %% off\n", 100 * worst(balanced));

    const agvd::CutCells cut = agvd::cut_cells(surface, balanced.diagram);
    remesh::Attribute site{.name = "site", .type = remesh::NumberType::Int32};
    for (const agvd::SiteId id : cut.face_site) site.values.push_back(id.value());
    example::write_file(arguments[2], remesh::format_mesh(std::filesystem::path(arguments[2]),
                                                          cut.mesh.view(), {.of_faces = {site}}));
    example::write_file(arguments[3], lines.str());
}

}  // namespace

int main(int argc, char** argv) { return example::run(argc, argv, usage, 4, 4, write_cells); }
