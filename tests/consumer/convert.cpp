#include <remesh/meshfile/mesh_file.h>

int main(int, char** argv) { remesh::write_mesh(argv[2], remesh::read_mesh(argv[1]).mesh.view()); }
