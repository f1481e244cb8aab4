#include <remesh/meshfile/openmesh_exchange.h>
#include <remesh/remesh.h>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

int main() {
    OpenMesh::PolyMesh_ArrayKernelT<> mesh;  // Or any TriMesh, with any traits.
    std::vector<OpenMesh::VertexHandle> v;
    for (const float x : {0, 1, 2}) {
        for (const float y : {0, 1}) v.push_back(mesh.add_vertex({x, y, 0}));
    }
    mesh.add_face(v[0], v[2], v[3], v[1]);
    mesh.add_face(v[2], v[4], v[5], v[3]);
    const auto result = remesh::remesh(remesh::from_openmesh(mesh), {.num_samples = 100});
    const OpenMesh::TriMesh back = remesh::to_openmesh(result.mesh).mesh;
    return back.n_vertices() == 100 ? 0 : 1;
}
