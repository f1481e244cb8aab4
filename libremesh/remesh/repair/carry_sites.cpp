#include "remesh/repair/carry_sites.h"

#include <cmath>

#include "agvd/core/error.h"

namespace remesh {
namespace {

using agvd::FaceId;
using agvd::Index;
using agvd::MeshView;
using agvd::SurfacePoint;

// The point with its coordinates given to the corners of face `to` at the same positions: cleaning
// may renumber and reorder the corners of a face, but neither moves nor joins them.
SurfacePoint carry(const SurfacePoint& point, const MeshView& from, const MeshView& to,
                   Index to_face) {
    const agvd::Triangle& old_corners = from.triangles[point.face.value()];
    const agvd::Triangle& new_corners = to.triangles[to_face];
    SurfacePoint carried{FaceId(to_face), {0, 0, 0}};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (from.positions[old_corners[i]] == to.positions[new_corners[k]]) {
                carried.barycentric[k] = point.barycentric[i];
            }
        }
    }
    return carried;
}

void check_site(const SurfacePoint& site, std::size_t number, Index num_faces) {
    const std::string name = "site " + std::to_string(number);
    if (!site.face.is_valid() || site.face.value() >= num_faces) {
        throw agvd::InvalidInput(name + " names a face that does not exist; there are " +
                                 std::to_string(num_faces));
    }
    const auto& [a, b, c] = site.barycentric;
    // Decimals in a file and sums in double are this good.
    constexpr double tolerance = 1e-6;
    if (!(a >= 0 && b >= 0 && c >= 0 && std::abs(a + b + c - 1) <= tolerance)) {
        throw agvd::InvalidInput(name + " on face " + std::to_string(site.face.value()) +
                                 " has coordinates that are negative or do not sum to 1");
    }
}

}  // namespace

std::vector<SurfacePoint> to_cleaned(const std::vector<SurfacePoint>& sites, const MeshView& mesh,
                                     const CleanResult& clean) {
    std::vector<Index> cleaned_face(mesh.triangles.size(), agvd::no_index);
    for (Index f = 0; f < clean.face_origin.size(); ++f) cleaned_face[clean.face_origin[f]] = f;
    std::vector<SurfacePoint> carried;
    carried.reserve(sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i) {
        check_site(sites[i], i, static_cast<Index>(mesh.triangles.size()));
        const Index face = cleaned_face[sites[i].face.value()];
        if (face == agvd::no_index) {
            throw agvd::InvalidInput("site " + std::to_string(i) + " lies on face " +
                                     std::to_string(sites[i].face.value()) +
                                     ", which cleaning dropped as degenerate or duplicate; "
                                     "place it on a neighbour");
        }
        carried.push_back(carry(sites[i], mesh, clean.mesh.view(), face));
    }
    return carried;
}

std::vector<SurfacePoint> to_original(const std::vector<SurfacePoint>& sites, const MeshView& mesh,
                                      const CleanResult& clean) {
    std::vector<SurfacePoint> carried;
    carried.reserve(sites.size());
    for (const SurfacePoint& site : sites) {
        carried.push_back(
            carry(site, clean.mesh.view(), mesh, clean.face_origin[site.face.value()]));
    }
    return carried;
}

}  // namespace remesh
