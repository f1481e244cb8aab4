#include <agvd/mesh/arrays.h>
#include <remesh/remesh.h>

int main() {
    const std::vector<float> positions{1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
    const std::vector<int> triangles{0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
    const auto result =
        remesh::remesh(agvd::from_arrays(positions, triangles), {.num_samples = 100});
    const double* const x = result.mesh.positions.front().data();  // 300 numbers in a row
    const agvd::Index* const corner = result.mesh.triangles.front().data();
    return x[299] >= -1 && x[299] <= 1 && corner[3 * 196 - 1] < 100 ? 0 : 1;
}
