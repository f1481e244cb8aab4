#include <agvd/mesh/arrays.h>
#include <remesh/remesh.h>

int main() {
    Eigen::MatrixXd V(4, 3);  // As igl::read_triangle_mesh fills them.
    Eigen::MatrixXi F(4, 3);
    V << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
    F << 0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2;
    const auto result = remesh::remesh(agvd::from_matrices(V, F), {.num_samples = 100});
    V = agvd::matrix_of(result.mesh.positions);
    F = agvd::matrix_of(result.mesh.triangles).cast<int>();
    return V.rows() == 100 && F.rows() == 196 ? 0 : 1;
}
