#include <remesh/remesh.h>

#include <cstdio>

int main() {
    const std::vector<agvd::Vec3> positions{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    const std::vector<agvd::Triangle> triangles{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    const auto result = remesh::remesh({positions, triangles}, {.num_samples = 100});
    for (const auto& p : result.mesh.positions) std::printf("v %g %g %g\n", p.x(), p.y(), p.z());
    for (const auto& [a, b, c] : result.mesh.triangles) {
        std::printf("f %u %u %u\n", a + 1, b + 1, c + 1);
    }
}
