// XML, for a build without expat: it is refused.
#include "remesh/meshfile/xml_reader.h"

namespace remesh {

bool knows_xml() { return false; }

void read_xml(const SourceFile& file, XmlVisitor&) {
    file.fail_malformed(
        0, "the file is XML, and this program was built without expat; convert the file to .ply");
}

}  // namespace remesh
