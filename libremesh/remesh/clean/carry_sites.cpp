// Carries points between a mesh and its cleaned version: bit for bit where the face kept its
// corners, otherwise to the closest point, on pieces of the same face first. Several pieces of a
// face are found by sorting pairs (input face, cleaned face).
#include "remesh/clean/carry_sites.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/mesh/closest_point.h"

namespace remesh {
namespace {

// As a share of the box diagonal of the cleaned mesh. A site farther from the mesh lies where
// cleaning left no surface. Positions are accurate to 1e-16 of the largest coordinate, so that
// meshes far from the origin pass too.
constexpr double place_tolerance = 1e-9;

std::array<Vec3, 3> corners_of(const MeshView& mesh, Index face) {
    const Triangle& t = mesh.triangles[face];
    return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

// Divides coordinates by their sum. If this is 1 up to rounding, they stay, bit for bit.
SurfacePoint normalized(SurfacePoint point) {
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    const double sum = point.barycentric[0] + point.barycentric[1] + point.barycentric[2];
    if (std::abs(sum - 1) > rounding) {
        for (double& coordinate : point.barycentric) coordinate /= sum;
    }
    return point;
}

// The same point of `to`, if both faces have the same three corner positions. Cleaning may renumber
// and reorder corners, and may split the face.
std::optional<SurfacePoint> carry_exactly(const SurfacePoint& point,
                                          const std::array<Vec3, 3>& from,
                                          const std::array<Vec3, 3>& to, Index to_face) {
    SurfacePoint carried{FaceId(to_face), {0, 0, 0}};
    std::array<bool, 3> is_taken{};
    for (std::size_t i = 0; i < 3; ++i) {
        std::size_t k = 0;
        while (k < 3 && (is_taken[k] || from[i] != to[k])) ++k;
        if (k == 3) return std::nullopt;
        is_taken[k] = true;
        carried.barycentric[k] = point.barycentric[i];
    }
    return carried;
}

// The square of place_tolerance in mesh units.
double squared_reach(const MeshView& mesh) {
    Vec3 low = mesh.positions[0], high = low;
    for (const Vec3& position : mesh.positions) {
        low = low.cwiseMin(position);
        high = high.cwiseMax(position);
    }
    return place_tolerance * place_tolerance * (high - low).squaredNorm();
}

// Where points of the input lie on the cleaned mesh.
class CleanedSurface {
public:
    CleanedSurface(const MeshView& mesh, const CleanedView& clean)
        : mesh_(mesh), clean_(clean.mesh) {
        pieces_.reserve(clean.face_origin.size());
        for (Index f = 0; f < clean.face_origin.size(); ++f) {
            pieces_.emplace_back(clean.face_origin[f], f);
        }
        std::sort(pieces_.begin(), pieces_.end());
        reach_sq_ = squared_reach(clean_);
    }

    // None if cleaning left no surface there. Tries pieces of the site's own face first: another
    // part of the mesh may lie at the same place.
    [[nodiscard]] std::optional<SurfacePoint> place(const SurfacePoint& site) {
        const Index origin = site.face.value();
        const std::array<Vec3, 3> corners = corners_of(mesh_, origin);
        const Vec3 query = position(mesh_, site);
        ClosestPoint nearest;
        nearest.distance_sq = std::numeric_limits<double>::infinity();
        for (auto piece = std::lower_bound(pieces_.begin(), pieces_.end(),
                                           std::pair<Index, Index>(origin, 0));
             piece != pieces_.end() && piece->first == origin; ++piece) {
            const Index face = piece->second;
            const std::array<Vec3, 3> piece_corners = corners_of(clean_, face);
            if (const auto same = carry_exactly(site, corners, piece_corners, face)) return same;
            const ClosestPoint found =
                closest_point_on_triangle(piece_corners, FaceId(face), query);
            if (found.distance_sq < nearest.distance_sq) nearest = found;
        }
        if (nearest.distance_sq > reach_sq_) {
            if (!tree_) tree_.emplace(clean_);
            nearest = tree_->query(query);
        }
        if (nearest.distance_sq > reach_sq_) return std::nullopt;
        return nearest.point;
    }

private:
    MeshView mesh_, clean_;
    std::vector<std::pair<Index, Index>> pieces_;  // (input face, cleaned face), sorted.
    double reach_sq_ = 0;
    std::optional<ClosestPointTree> tree_;  // Few inputs need it.
};

void check_site(const SurfacePoint& site, std::size_t number, Index num_faces) {
    const std::string name = "site " + std::to_string(number);
    if (!site.face.is_valid() || site.face.value() >= num_faces) {
        throw InvalidSites(name + " names a face that does not exist; use one of the " +
                           std::to_string(num_faces) + " faces, counted from 0");
    }
    const auto& [a, b, c] = site.barycentric;
    // The accuracy of decimals in a file and of sums in double.
    constexpr double tolerance = 1e-6;
    if (!(a >= 0 && b >= 0 && c >= 0 && std::abs(a + b + c - 1) <= tolerance)) {
        throw InvalidSites(name + " on face " + std::to_string(site.face.value()) +
                           " has barycentric coordinates that are negative or do not sum "
                           "to 1; correct them");
    }
}

}  // namespace

std::vector<SurfacePoint> to_cleaned(const std::vector<SurfacePoint>& sites, const MeshView& mesh,
                                     const CleanedView& clean) {
    CleanedSurface surface(clean.welded(mesh), clean);
    std::vector<SurfacePoint> carried;
    carried.reserve(sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i) {
        check_site(sites[i], i, static_cast<Index>(mesh.triangles.size()));
        const std::optional<SurfacePoint> placed = surface.place(normalized(sites[i]));
        if (!placed) {
            throw InvalidSites("site " + std::to_string(i) + " lies on face " +
                               std::to_string(sites[i].face.value()) +
                               ", which cleaning dropped as degenerate or duplicate; "
                               "place it on another face");
        }
        carried.push_back(*placed);
    }
    return carried;
}

std::vector<SurfacePoint> to_original(const std::vector<SurfacePoint>& sites, const MeshView& given,
                                      const CleanedView& clean) {
    if (clean.face_origin.empty()) {
        std::vector<SurfacePoint> carried;
        carried.reserve(sites.size());
        for (const SurfacePoint& site : sites) carried.push_back(normalized(site));
        return carried;
    }
    const MeshView mesh = clean.welded(given);
    const MeshView& cleaned = clean.mesh;
    const double reach_sq = squared_reach(cleaned);
    std::optional<ClosestPointTree> tree;  // Few meshes need it.
    std::vector<SurfacePoint> carried;
    carried.reserve(sites.size());
    for (const SurfacePoint& on_cleaned : sites) {
        const SurfacePoint site = normalized(on_cleaned);
        const Index origin = clean.face_origin[site.face.value()];
        const std::array<Vec3, 3> corners = corners_of(mesh, origin);
        if (const auto same =
                carry_exactly(site, corners_of(cleaned, site.face.value()), corners, origin)) {
            carried.push_back(*same);
            continue;
        }
        const Vec3 where = position(cleaned, site);
        ClosestPoint nearest = closest_point_on_triangle(corners, FaceId(origin), where);
        if (nearest.distance_sq > reach_sq) {  // Edges were flipped there.
            if (!tree) tree.emplace(mesh);
            nearest = tree->query(where);
        }
        carried.push_back(nearest.point);
    }
    return carried;
}

}  // namespace remesh
