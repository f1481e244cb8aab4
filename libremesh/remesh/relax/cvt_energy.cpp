#include "remesh/relax/cvt_energy.h"

#include <algorithm>
#include <cmath>

namespace remesh::detail {

using agvd::Index;
using agvd::Vec3;

namespace {

// Flat triangles have no part in the energy, which would have no bounds. Inside others make up for
// what a circumcentre far outside does to it; at the rim none does, so that an angle of 11 or 169
// degrees is enough there.
constexpr double flat_cotangent = 50;
constexpr double flat_cotangent_at_rim = 5;

}  // namespace

void measure_energy(const SiteMesh& mesh, std::span<const Vec3> positions,
                    std::span<const double> weight, agvd::Ticker& ticker, CvtEnergy& result) {
    result.energy = 0;
    result.weighted = 0;
    result.cells.assign(positions.size(), {Vec3::Zero(), Vec3::Zero(), 0, 0});
    result.cotangent.assign(3 * mesh.triangles.size(), 0);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        ticker.tick();
        const agvd::Triangle& t = mesh.triangles[i];
        const std::array<Vec3, 3> edge{positions[t[1]] - positions[t[0]],
                                       positions[t[2]] - positions[t[1]],
                                       positions[t[0]] - positions[t[2]]};
        const Vec3 normal = edge[0].cross(edge[1]);
        const double doubled_area = normal.norm();
        if (!(doubled_area > 0)) continue;
        const Vec3 up = normal / doubled_area;
        const double density = (weight[t[0]] + weight[t[1]] + weight[t[2]]) / 3;
        // The circumcentre lies above the middle of each edge by half of it times the cotangent:
        // two right triangles, one in the cell of either end.
        std::array<double, 3> area, mass;
        std::array<Vec3, 3> at_tail, at_head;  // What the edge's triangles give to the slopes.
        double energy = 0, weighted = 0;
        double flat = flat_cotangent, steepest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double cotangent = -edge[(k + 1) % 3].dot(edge[(k + 2) % 3]) / doubled_area;
            const double squared_length = edge[k].squaredNorm();
            area[k] = cotangent * squared_length / 8;
            mass[k] = density * area[k];
            const double spread = squared_length * (3 + cotangent * cotangent) / 12;
            energy += area[k] * spread;
            weighted += mass[k] * spread;
            if (mesh.twin[3 * i + k] == agvd::no_index) flat = flat_cotangent_at_rim;
            steepest = std::max(steepest, std::abs(cotangent));
            result.cotangent[3 * i + k] = cotangent;
            const Vec3 along = (-2.0 / 3 * mass[k]) * edge[k];
            const Vec3 across = 0.5 * cotangent * up.cross(along);
            at_tail[k] = across + along;
            at_head[k] = across - along;
        }
        if (steepest <= flat) {
            result.energy += energy;
            result.weighted += weighted;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t previous = (k + 2) % 3;
            CvtEnergy::Cell& cell = result.cells[t[k]];
            cell.slope += at_tail[k] + at_head[previous];
            cell.normal += normal;
            cell.mass += mass[k] + mass[previous];
            cell.area += area[k] + area[previous];
        }
    }
    for (CvtEnergy::Cell& cell : result.cells) {
        cell.normal.normalize();
        cell.slope -= cell.normal.dot(cell.slope) * cell.normal;
    }
}

void find_turned(const SiteMesh& mesh, std::span<const Vec3> positions,
                 std::span<const Vec3> facing, std::vector<Index>& turned) {
    turned.clear();
    for (Index i = 0; i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        const Vec3 normal = (positions[b] - positions[a]).cross(positions[c] - positions[b]);
        if (!(normal.dot(facing[a] + facing[b] + facing[c]) > 0)) turned.push_back(i);
    }
}

}  // namespace remesh::detail
