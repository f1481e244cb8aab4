// What is XML, for a build without expat: it is refused.
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/vtk_data.h"
#include "remesh/meshfile/xml_reader.h"

namespace remesh {

bool knows_xml() { return false; }

VtkData read_vtk_xml(const SourceFile& file) {
    file.fail_malformed(
        0, "the file is XML, and this program was built without expat; convert the file to .ply");
}

MeshFile read_vtp(SourceFile file) { return make_mesh(read_vtk_xml(file), file); }

MeshFile read_3mf(SourceFile file) {
    file.fail_malformed(
        0, "this program was built without expat, which 3MF needs; convert the file to .ply");
}

}  // namespace remesh
