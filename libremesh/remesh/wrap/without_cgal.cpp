// What needs CGAL, for a build without it.
#include "agvd/core/error.h"
#include "remesh/wrap/wrap.h"

namespace remesh::detail {

TriangleMesh alpha_wrap(const MeshView&, double, const Progress&) {
    throw InvalidOption(
        "the wrap is computed by CGAL, and this build is without it; leave out wrap, or build with "
        "AGVD_WITH_CGAL=ON");
}

std::optional<TriangleMesh> unite_solids(const TriangleMesh&, int, const Progress&) {
    return std::nullopt;
}

}  // namespace remesh::detail
