#include "remesh/relax/cvt_energy.h"

namespace remesh::detail {

using agvd::Index;
using agvd::Vec3;

void measure_energy(const SiteMesh& mesh, std::span<const Vec3> positions,
                    std::span<const Vec3> facing, std::span<const double> weight,
                    CvtEnergy& result) {
    result.energy = 0;
    result.weighted = 0;
    result.slope.assign(positions.size(), Vec3::Zero());
    result.mass.assign(positions.size(), 0);
    result.area.assign(positions.size(), 0);
    result.normal.assign(positions.size(), Vec3::Zero());
    result.cotangent.assign(3 * mesh.triangles.size(), 0);
    result.turned.clear();
    for (Index i = 0; i < mesh.triangles.size(); ++i) {
        const agvd::Triangle& t = mesh.triangles[i];
        const std::array<Vec3, 3> edge{positions[t[1]] - positions[t[0]],
                                       positions[t[2]] - positions[t[1]],
                                       positions[t[0]] - positions[t[2]]};
        const Vec3 normal = edge[0].cross(edge[1]);
        const double doubled_area = normal.norm();
        if (!(normal.dot(facing[t[0]] + facing[t[1]] + facing[t[2]]) > 0)) {
            result.turned.push_back(i);
        }
        if (!(doubled_area > 0)) continue;
        const Vec3 up = normal / doubled_area;
        const double density = (weight[t[0]] + weight[t[1]] + weight[t[2]]) / 3;
        for (std::size_t k = 0; k < 3; ++k) {
            // The circumcentre lies above the middle of the edge by half of it times the cotangent:
            // two right triangles, one in the cell of either end.
            const double cotangent = -edge[(k + 1) % 3].dot(edge[(k + 2) % 3]) / doubled_area;
            const double area = cotangent * edge[k].squaredNorm() / 8;
            const double mass = density * area;
            const Vec3 along = (-2.0 / 3 * mass) * edge[k];
            const Vec3 across = 0.5 * cotangent * up.cross(along);
            const double spread = edge[k].squaredNorm() * (3 + cotangent * cotangent) / 12;
            const Index a = t[k], b = t[(k + 1) % 3];
            result.energy += area * spread;
            result.weighted += mass * spread;
            result.cotangent[3 * std::size_t{i} + k] = cotangent;
            result.area[a] += area;
            result.area[b] += area;
            result.mass[a] += mass;
            result.mass[b] += mass;
            result.slope[a] += across + along;
            result.slope[b] += across - along;
            result.normal[a] += normal;
        }
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
        result.normal[i].normalize();
        result.slope[i] -= result.normal[i].dot(result.slope[i]) * result.normal[i];
    }
}

}  // namespace remesh::detail
