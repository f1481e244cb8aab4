#include "agvd/mesh/mesh.h"

#include "agvd/core/portable_math.h"

namespace agvd {

std::vector<Vec3> vertex_normals(const MeshView& mesh) {
    std::vector<Vec3> normals(mesh.positions.size(), Vec3::Zero());
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& at = mesh.positions[t[k]];
            const Vec3 u = mesh.positions[t[(k + 1) % 3]] - at;
            const Vec3 v = mesh.positions[t[(k + 2) % 3]] - at;
            const Vec3 normal = u.cross(v);
            const double angle = portable::atan2(normal.stableNorm(), u.dot(v));
            normals[t[k]] += angle * normal.stableNormalized();
        }
    }
    for (Vec3& normal : normals) normal.stableNormalize();
    return normals;
}

}  // namespace agvd
